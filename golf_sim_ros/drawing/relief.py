# SPDX-License-Identifier: Apache-2.0
"""The ground from above, at many places at once."""
import numpy as np

from ..physics import model
from ..physics.jit import borrowed, entry
from ..physics.ground import surface


@entry
def look_down(ground, xs, ys, heights, numbers):
    """What lies highest at every place. Writes heights and numbers of materials; -1 without ground."""
    ground = borrowed(ground)
    for i in range(len(xs)):
        z, part = surface.top(ground, xs[i], ys[i])
        heights[i] = z
        numbers[i] = surface.material_of(ground, part, (xs[i], ys[i], z)) if part >= 0 else -1


def relief(course, x, y):
    """Heights and materials of the highest ground at many places.

    Parameters
    ----------
    course : Course
    x, y : array_like
        Places [m]; they are broadcast against each other.

    Returns
    -------
    heights : ndarray
        [m]; not a number where there is no ground.
    numbers : ndarray of int
        Rows of `golf_sim_ros.physics.model.materials(course)`; -1 where there is no ground.
    """
    x, y = np.broadcast_arrays(np.asarray(x, float), np.asarray(y, float))
    heights, numbers = np.empty(x.size), np.empty(x.size, np.int64)
    look_down(model.bare_ground(course), x.flatten(), y.flatten(), heights, numbers)
    heights[numbers < 0] = np.nan
    return heights.reshape(x.shape), numbers.reshape(x.shape)
