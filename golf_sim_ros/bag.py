# SPDX-License-Identifier: Apache-2.0
"""Recorded play, read without ROS: see `golf_sim_ros.recording.bag`."""
from .recording.bag import BagError, read_bag

__all__ = ['BagError', 'read_bag']
