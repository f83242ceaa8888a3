# SPDX-License-Identifier: Apache-2.0
"""The shipped courses, one module each: ``files()`` gives names and bytes."""
