# SPDX-License-Identifier: Apache-2.0
"""Path of a ball as a chain of segments, its equations of motion, and the record of a shot."""
