# SPDX-License-Identifier: Apache-2.0
"""The command line: programs that people start by hand."""
