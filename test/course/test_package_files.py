# Copyright 2026 golf_sim_ros maintainers
#
# Licensed under the Apache License, Version 2.0 (the "License");
# you may not use this file except in compliance with the License.
# You may obtain a copy of the License at
#
#     http://www.apache.org/licenses/LICENSE-2.0
#
# Unless required by applicable law or agreed to in writing, software
# distributed under the License is distributed on an "AS IS" BASIS,
# WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
# See the License for the specific language governing permissions and
# limitations under the License.

"""The files that come with the package are found wherever it lies."""

from pathlib import Path
import shutil
import subprocess
import sys

from golf_sim_ros.course import package_files as module
from golf_sim_ros.course.package_files import share
import pytest


def run_copy(site_packages, environment=None):
    """Run `share('config')` in a copy of the package that lies in `site_packages`."""
    package = site_packages / 'golf_sim_ros'
    (package / 'course').mkdir(parents=True)
    shutil.copy(module.__file__, package / 'course')
    for folder in (package, package / 'course'):
        (folder / '__init__.py').touch()
    code = 'from golf_sim_ros.course.package_files import share; print(share("config"))'
    return subprocess.run(
        [sys.executable, '-c', code],
        capture_output=True,
        text=True,
        cwd=site_packages,
        env={'PATH': '', 'PYTHONPATH': str(site_packages), **(environment or {})},
    )


def install_files(folder):
    """Make `folder` what an installation leaves in share/golf_sim_ros."""
    (folder / 'config').mkdir(parents=True)
    (folder / 'package.xml').touch()


def test_the_shipped_courses_are_found_from_here():
    assert list(share('config', 'courses').glob('*.yaml'))


@pytest.mark.parametrize(
    'library',
    [
        'lib/python3.12/site-packages',
        'local/lib/python3.10/dist-packages',
        'lib64/python3.13/site-packages',
    ],
)
def test_an_installed_package_finds_the_share_folder_of_its_own_prefix(tmp_path, library):
    site_packages = tmp_path / library
    prefix = site_packages.parents[2]
    install_files(prefix / 'share' / 'golf_sim_ros')
    run = run_copy(site_packages)
    assert run.stdout.strip() == str(prefix / 'share' / 'golf_sim_ros' / 'config'), run.stderr


def test_a_package_elsewhere_finds_the_prefix_that_ros_has_sourced(tmp_path):
    install_files(tmp_path / 'overlay' / 'share' / 'golf_sim_ros')
    prefixes = f'{tmp_path / "underlay"}:{tmp_path / "overlay"}'
    run = run_copy(tmp_path / 'anywhere', {'AMENT_PREFIX_PATH': prefixes})
    assert run.stdout.strip() == str(tmp_path / 'overlay' / 'share' / 'golf_sim_ros' / 'config'), (
        run.stderr
    )


def test_a_source_checkout_finds_its_own_files_even_with_another_one_sourced(tmp_path):
    install_files(tmp_path / 'share' / 'golf_sim_ros')
    install_files(tmp_path / 'checkout')
    run = run_copy(tmp_path / 'checkout', {'AMENT_PREFIX_PATH': str(tmp_path)})
    assert run.stdout.strip() == str(tmp_path / 'checkout' / 'config'), run.stderr


def test_without_any_files_the_error_names_the_places(monkeypatch, tmp_path):
    monkeypatch.setattr(module, '_candidates', lambda: [Path(tmp_path)])
    with pytest.raises(FileNotFoundError, match=str(tmp_path)):
        share('config')
