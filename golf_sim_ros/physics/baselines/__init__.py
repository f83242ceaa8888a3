# SPDX-License-Identifier: Apache-2.0
"""Published ways of simulating golf, to compare with."""
