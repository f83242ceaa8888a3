# SPDX-License-Identifier: Apache-2.0
"""When things touch: time of impact along segments, with the ground, water and other balls."""
