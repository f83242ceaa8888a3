# SPDX-License-Identifier: Apache-2.0
"""Its being here makes what lies in this folder, oracles.py, importable for all tests."""
from golf_sim_ros.physics.engine.engines import prefer_compiled

prefer_compiled()  # tests play thousands of shots; the nodes that they start do not look at this
