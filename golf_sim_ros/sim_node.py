# SPDX-License-Identifier: Apache-2.0
"""The node that plays, to be made in other programs: see `golf_sim_ros.nodes.sim_node`."""
from .nodes.sim_node import main, SimNode

__all__ = ['SimNode', 'main']
