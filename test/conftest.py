# SPDX-License-Identifier: Apache-2.0
"""Its being here makes what lies in this folder, oracles.py, importable for all tests."""
