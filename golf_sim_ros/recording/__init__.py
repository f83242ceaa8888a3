# SPDX-License-Identifier: Apache-2.0
"""Recorded play: the journal, rosbag2 bags, and replay that is the same to the bit."""
