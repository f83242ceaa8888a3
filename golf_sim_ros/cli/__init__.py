# SPDX-License-Identifier: Apache-2.0
"""What people start by hand. Only here are there yards, miles an hour and degrees."""
