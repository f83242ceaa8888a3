# SPDX-License-Identifier: Apache-2.0
"""What RViz draws: the course, and the play on it."""
