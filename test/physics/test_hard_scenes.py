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

"""The hard cases of hard_scenes.py, once each; `make hard` plays them at all presets and rates."""

from hard_scenes import SCENES
import pytest

ALL = [scene for scenes in SCENES.values() for scene in scenes]


@pytest.mark.parametrize('accuracy', ['standard', 'reference'])
@pytest.mark.parametrize('scene', ALL, ids=[f'{k} {scene.name}' for k, scene in enumerate(ALL)])
def test_a_hard_scene_ends_as_expected(scene, accuracy):
    assert scene.holds(scene.figure(accuracy, 50), accuracy)
