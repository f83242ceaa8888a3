# SPDX-License-Identifier: Apache-2.0
"""Properties of air, of ground materials and of water."""
