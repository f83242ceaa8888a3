# SPDX-License-Identifier: Apache-2.0
"""What happens at an impact, and to balls that several things hold."""
