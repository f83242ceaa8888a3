# SPDX-License-Identifier: Apache-2.0
"""Recorded play: the journal, bags of it, and whether it runs again to the bit."""
