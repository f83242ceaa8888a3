# SPDX-License-Identifier: Apache-2.0
"""Jobs of a study: one function for each row."""
from functools import lru_cache, partial

from . import effects, promises, sizes, ticks
from .measure import Stage, measured
from .methods import TRUTH, methods
from .scenes import quick_scenes, scenes

TICKED = ('iron into a green', 'bouncing on hard ground', 'mesh bounce')


def jobs(quick):
    """Part and function of each row: a list of pairs, of the quick study or of the full one."""
    found = quick_scenes() if quick else scenes()
    fairway = found[0].course.ground[0].material
    parts = {'methods': of_methods(found), 'promises': promises.jobs(fairway)}
    if not quick:
        parts['effects'] = effects.jobs(found)
        parts['ticks'] = ticks.jobs([scene for scene in found if scene.name in TICKED])
        parts['sizes'] = sizes.jobs(found[1].course.ground[0].material)
    return [(part, job) for part, some in parts.items() for job in some]


def of_methods(found):
    """A function for each row of a method on a scene."""
    for scene in found:
        truth = lru_cache(Stage(scene, TRUTH))
        for method in methods(scene):
            yield partial(against, scene, truth, method)


def against(scene, truth, method):
    """`Row` of a method, with what ``truth()`` finds as yardstick."""
    return measured(scene, truth(), method)
