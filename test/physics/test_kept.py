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

"""What is built for a course is built once, and anew where anything of its ground differs."""

from concurrent.futures import ThreadPoolExecutor
import pickle

from golf_sim_ros.physics import Course, Heightmap, Plane
from golf_sim_ros.physics.scene import kept as kept_module
from golf_sim_ros.physics.scene import kernel_model
from golf_sim_ros.physics.scene.kept import fingerprint, kept, MOST_KEPT
import numpy as np
import pytest


def course(heights=None, **more):
    """Height map on a plane."""
    heights = np.zeros((4, 5)) if heights is None else heights
    return Course((Plane(), Heightmap(heights, (5.0, 0.0))), **more)


def test_the_ground_is_built_once_for_courses_that_share_it():
    first = kernel_model.ground(course())
    assert kernel_model.ground(course()) is first
    assert kernel_model.ground(course(name='another', tee=(0.5, 0.0))) is first
    assert kernel_model.ground(pickle.loads(pickle.dumps(course()))) is first
    with ThreadPoolExecutor(2) as two:
        assert all(found is first for found in two.map(kernel_model.ground, [course()] * 4))


def test_an_array_that_was_written_to_is_another_ground():
    heights = np.zeros((4, 5))
    played = course(heights)
    low = kernel_model.ground(played)
    heights[:] = 2.0
    high = kernel_model.ground(played)
    assert (low.highest, high.highest) == (0.0, 2.0)


@pytest.mark.parametrize(
    'more',
    [
        {'hole': (-3.0, 0.0)},
        {'hole': (-3.0, 0.0), 'flagstick': False},
        {'bounds': ((-9.0, -9.0), (9.0, -9.0), (0.0, 9.0))},
    ],
)
def test_what_belongs_to_the_ground_tells_courses_apart(more):
    assert kernel_model.ground(course(**more)) is not kernel_model.ground(course())


def test_fingerprints_are_of_content():
    one = np.arange(6.0)
    assert fingerprint((one, 1)) == fingerprint((one.copy(), 1))
    assert fingerprint(one) == fingerprint(np.arange(12.0)[::2] / 2.0)
    others = (one.reshape(2, 3), one.astype('float32'), one[::-1], [*one], {'heights': one})
    assert len({fingerprint(one), *map(fingerprint, others)}) == 1 + len(others)


def test_large_arrays_are_told_apart_by_their_digests(monkeypatch):
    monkeypatch.setattr(kept_module, 'LARGE', 8)
    one = np.arange(6.0)
    other = one.copy()
    other[5] = np.nextafter(5.0, 6.0)
    assert fingerprint(one) == fingerprint(np.arange(12.0)[::2] / 2.0)
    assert fingerprint(one) != fingerprint(other)
    assert len(fingerprint(one)[2]) == len(fingerprint(np.zeros(1000))[2])


def test_arrays_of_objects_have_no_fingerprint():
    with pytest.raises(TypeError, match='object'):
        fingerprint(np.array([[1.0], 'a'], object))


def test_the_last_ones_used_are_kept():
    calls = []
    build = kept(lambda record: calls.append(record) or record)
    for number in range(MOST_KEPT):
        build((number,))
    build((0,))
    build((MOST_KEPT,))
    build((0,))
    build((1,))
    assert calls == [(number,) for number in range(MOST_KEPT + 1)] + [(1,)]
