# Copyright 2026 golf_sim_ros maintainers
#
# Licensed under the Apache License, Version 2.0 (the "License");
# you may not use this file except in compliance with the License.
# You may obtain a copy of the License at
#
#     http://www.apache.org/licenses/LICENSE-2.0
#
# Unless required by applicable law or agreed to in writing, software
# distributed under the License is distributed on an "AS IS" BASIS,
# WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
# See the License for the specific language governing permissions and
# limitations under the License.

"""Courses that tests of wind fields share: small, and quick to solve for."""

from golf_sim_ros.physics import (
    Course,
    Cylinder,
    Heightmap,
    LogProfile,
    Material,
    Plane,
    Sphere,
    Water,
    Zone,
)
from golf_sim_ros.physics.engine.engines import missing
import numpy as np
import pytest

needs_numba = pytest.mark.skipif(bool(missing()), reason=missing() or 'numba is here')
GRASS = Material('grass', roughness=0.03)
LEAVES = Material('leaves', drag=0.25, canopy_drag=0.3)


def level(roughness=0.02):
    """Level ground of one roughness, here as upstream."""
    return Course(
        (Plane(material=Material('grass', roughness=roughness)),),
        hole=(100.0, 0.0),
        wind_profile=LogProfile(roughness),
    )


def mounds(side=1.0):
    """Mounds, a pond, a fairway and two trees; with `side` -1 their image in the plane y = 0."""
    x, y = np.meshgrid(np.arange(0.0, 161.0, 4.0), side * np.arange(-48.0, 49.0, 4.0))
    heights = 6.0 * np.exp(-(((x - 60.0) / 25.0) ** 2) - ((y - 12.0) / 20.0) ** 2)
    heights += 3.0 * np.exp(-(((x - 120.0) / 15.0) ** 2) - ((y + 20.0) / 25.0) ** 2)

    def mirrored(*corners):
        return tuple((px, side * py) for px, py in corners)

    return Course(
        (Heightmap(heights, (0.0, -48.0), 4.0, GRASS),),
        tee=(5.0, 0.0),
        hole=(150.0, 0.0),
        zones=(
            Zone(
                Material('fairway', roughness=0.005),
                mirrored((20, -20), (140, -10), (140, 25), (20, 10)),
            ),
        ),
        water=(Water(mirrored((90, -40), (110, -40), (110, -20), (90, -20)), 0.3),),
        obstacles=(
            Sphere((100.0, side * 30.0, 8.0), 5.0, LEAVES),
            Cylinder((40.0, side * -20.0, 2.0), 4.0, 9.0, LEAVES),
        ),
    )


def places(course_field, count, seed=0):
    """Random places over the land of a field, 0 to 30 m above it."""
    survey = course_field.survey
    low, high = (survey.x[0], survey.y[0], 0.0), (survey.x[-1], survey.y[-1], 30.0)
    found = np.random.default_rng(seed).uniform(low, high, (count, 3))
    found[:, 2] += survey.heights_at(found[:, 0], found[:, 1])
    return found
