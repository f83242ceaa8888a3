# SPDX-License-Identifier: Apache-2.0
"""Compiled code: where it is kept."""
