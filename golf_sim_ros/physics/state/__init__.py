# SPDX-License-Identifier: Apache-2.0
"""What is known of balls and of what happened, as records, and as numbers and lists."""
