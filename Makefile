# SPDX-License-Identifier: Apache-2.0
#
# make play    three shots over ROS 2: a drive, an approach, a putt; play/ keeps the recording and a picture
# make view    a hole to play in a browser: prints its address; VIEW_ARGS='putting_green --demo' for others
# make sim     the simulator and the wind, until Ctrl-C
# make hard    every hard case with every preset and at three rates: docs/stability.md; HARD_ARGS='shots' for a part
# make bench   what is fast and what is not, against baselines of the same run; BENCH_ARGS=--quick for less
# make fuzz    random scenes, malformed and extreme messages, broken files: what stops the sim; FUZZ_ARGS='--scenes 2000'
#              and FUZZ_FILES_ARGS='--count 20000 --kinds courses' for longer
# make docs    docs/ and the docstrings as HTML: build/docs/html/index.html; in an environment of its own, .venv_docs
# make lint    flake8, ruff, pydocstyle and mypy, there, too
# make test    all tests; PYTEST_ARGS='-k bounce' for some
#
# Each makes .venv first if need be; nothing is installed elsewhere. Another Python: make PYTHON=python3.12 play
# Other wheels where ROS 2 is not sourced: make DISTRO=kilted VENV=.venv_kilted test

PYTHON ?= python3
VENV ?= .venv
DOCS_VENV ?= .venv_docs
DISTRO ?= jazzy
PYTEST_ARGS ?=
BENCH_ARGS ?=
HARD_ARGS ?=
FUZZ_ARGS ?=
FUZZ_FILES_ARGS ?=
VIEW_ARGS ?=

# Set when make was started by a Python that has ROS 2 as wheels; it would keep .venv's from finding their libraries.
unexport _ROS_WHEELS_BOOTSTRAP_COMPLETE

.PHONY: play view sim test hard fuzz bench docs lint environment docs_environment clean

play: environment
	@$(VENV)/bin/python tools/play.py

view: environment
	@$(VENV)/bin/play_hole $(VIEW_ARGS)

sim: environment
	@$(VENV)/bin/python tools/sim.py

test: environment
	@if $(VENV)/bin/compile_physics; then \
		$(VENV)/bin/compile_physics --course links --only 'one ball' > /dev/null 2>&1 & \
	fi; \
	$(VENV)/bin/python -m pytest -n 2 --dist loadfile $(PYTEST_ARGS)

hard: environment
	@$(VENV)/bin/python tools/hard.py $(HARD_ARGS)

fuzz: environment
	@$(VENV)/bin/python tools/fuzz.py $(FUZZ_ARGS)
	@$(VENV)/bin/python tools/fuzz_files.py $(FUZZ_FILES_ARGS)

bench: environment
	@$(VENV)/bin/python benchmarks/bench.py $(BENCH_ARGS)

docs: docs_environment
	@$(DOCS_VENV)/bin/python tools/build_docs.py build/docs

lint: docs_environment
	@$(DOCS_VENV)/bin/python -m flake8
	@$(DOCS_VENV)/bin/python -m pydocstyle golf_sim_ros
	@$(DOCS_VENV)/bin/ruff check
	@$(DOCS_VENV)/bin/ruff format --check
	@$(DOCS_VENV)/bin/python -m mypy

# Needs neither ROS nor numba. Made anew where setup.py is newer.
docs_environment: $(DOCS_VENV)/made

$(DOCS_VENV)/made: setup.py
	@$(PYTHON) -m venv --clear $(DOCS_VENV)
	@$(DOCS_VENV)/bin/python -m pip install --quiet --disable-pip-version-check --editable '.[docs,lint]'
	@touch $@

environment:
	@command -v $(PYTHON) > /dev/null || { echo 'golf_sim_ros: $(PYTHON) is missing: Python 3.10 or newer is needed' >&2; exit 1; }
	@$(PYTHON) tools/make_environment.py $(VENV) $(DISTRO)

clean:
	rm -rf $(VENV) $(DOCS_VENV) build install log *.egg-info
