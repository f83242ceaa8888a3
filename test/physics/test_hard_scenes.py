# SPDX-License-Identifier: Apache-2.0
"""The hard cases of hard_scenes.py, once each; `make hard` plays them at all presets and rates."""
from hard_scenes import SCENES
import pytest

ALL = [scene for scenes in SCENES.values() for scene in scenes]


@pytest.mark.parametrize('accuracy', ['standard', 'reference'])
@pytest.mark.parametrize('scene', ALL, ids=[f'{k} {scene.name}' for k, scene in enumerate(ALL)])
def test_a_hard_scene_ends_as_expected(scene, accuracy):
    assert scene.least <= scene.figure(accuracy, 50) <= scene.most
