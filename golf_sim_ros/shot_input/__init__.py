# SPDX-License-Identifier: Apache-2.0
"""Shots as players know them: clubs, launch monitors, units of golf."""
