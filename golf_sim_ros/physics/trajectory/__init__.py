# SPDX-License-Identifier: Apache-2.0
"""A path as a chain of segments, the equations of motion behind it, and what is kept of a shot."""
