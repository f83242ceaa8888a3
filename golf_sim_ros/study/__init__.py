# SPDX-License-Identifier: Apache-2.0
"""Study of what accuracy costs in time: scenes, methods, measurement, and the page that says it."""
