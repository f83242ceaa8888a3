# SPDX-License-Identifier: Apache-2.0
"""What accuracy costs in time: scenes, methods, measurement, and the page that tells it."""
