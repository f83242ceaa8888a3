# SPDX-License-Identifier: Apache-2.0
"""The nodes: the simulator and the wind generator. Only here, in `cli` and in `launch` is there ROS."""
