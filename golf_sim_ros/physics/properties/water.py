# SPDX-License-Identifier: Apache-2.0
"""Properties of water."""
WATER_DENSITY = 998.0  # kg/m^3, fresh, at 20 degrees Celsius
ADDED_MASS = 0.5  # of the water that a sphere displaces: so much goes along with it (Lamb, Hydrodynamics)
