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

"""Picture of a play, and where its parts go."""

from collections.abc import Iterable, Sequence
from os import PathLike

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import MaxNLocator

from . import table, wind
from .charts import charts
from .shots import detailed, DrawnShot
from .style import bare, INK, PALE, SMALL, TITLE
from .views import above, from_side
from .window import near_hole, Window, window
from ..physics import Course
from ..physics.scene.kernel_model import materials

Box = tuple[float, float, float, float]  # left, top, width, height

# Inches, all of them.
WIDTH = 12.0
LEFT = 0.7
RIGHT = 0.3
TOP = 0.98
BOTTOM = 0.2
SIDE = 1.75  # height
CHARTS = 2.1  # height
KEY = 0.85  # below the view from above
GAP = 0.6  # below the charts
APART = 0.62  # between charts
ROSE = 0.75
INNER = WIDTH - LEFT - RIGHT

MARKS = (
    ('strike', 'D', INK, 'white'),
    ('bounce', 'o', 'white', INK),
    ('end', 'o', INK, 'white'),
    ('tee', 's', 'white', 'black'),
)


def draw(
    path: str | PathLike[str],
    shots: Sequence[DrawnShot],
    course: Course | None = None,
    title: str = '',
    dpi: int = 150,
) -> None:
    """Write the `picture` of a play to `path`, in the format that its name ends with."""
    picture(shots, course, title, dpi).savefig(path, dpi=dpi)


def picture(
    shots: Sequence[DrawnShot], course: Course | None = None, title: str = '', dpi: int = 150
) -> Figure:
    """Make the picture of a play.

    Parameters
    ----------
    shots : sequence of DrawnShot
        At least one.
    course : golf_sim_ros.physics.Course, optional
        Without it only paths are drawn.
    title : str
        By default the course's name.
    dpi : int
        Pixels of the ground an inch.

    Returns
    -------
    matplotlib.figure.Figure
        Its axes are labelled side, above, wind, speed, height, spin, table and, where shots ended
        near it, hole.

    Raises
    ------
    ValueError
        There is no shot.
    """
    if not shots:
        raise ValueError('there is no shot to draw')
    shots = [detailed(shot) for shot in shots]
    seen = window(shots, course)
    near = near_hole(shots, course, seen)
    boxes = arranged(INNER * seen.height / seen.width, near is not None, table.height(shots))
    figure = Figure(figsize=(WIDTH, boxes['table'][1] + boxes['table'][3] + BOTTOM))
    axes = {name: axes_in(figure, name, box) for name, box in boxes.items()}
    views(axes, boxes, shots, course, seen, dpi)
    if near:
        at_hole(axes['hole'], boxes['hole'], shots, course, near, dpi)
    charts([axes[name] for name in ('speed', 'height', 'spin')], shots)
    wind.rose(axes['wind'], shots)
    table.table(axes['table'], shots)
    headed(figure, shots, course, title)
    return figure


def arranged(plan: float, hole: bool, rows: float) -> dict[str, Box]:
    """Place of each part: left, top, width, height, in inches from the upper left corner."""
    above_top = TOP + SIDE + 0.35
    top = above_top + plan + KEY
    width = (INNER - hole * (CHARTS + APART) - 2 * APART) / 3
    boxes = {'side': (LEFT, TOP, INNER, SIDE), 'above': (LEFT, above_top, INNER, plan)}
    boxes['wind'] = (WIDTH - RIGHT - ROSE, 0.5 * (TOP - ROSE), ROSE, ROSE)
    for i, name in enumerate(('speed', 'height', 'spin')):
        boxes[name] = (LEFT + i * (width + APART), top, width, CHARTS)
    if hole:
        boxes['hole'] = (WIDTH - RIGHT - CHARTS, top, CHARTS, CHARTS)
    return {**boxes, 'table': (LEFT, top + CHARTS + GAP, INNER, rows)}


def axes_in(figure: Figure, label: str, box: Box) -> Axes:
    """Add axes in a `box` of inches from the upper left corner."""
    (width, height), (left, top, wide, high) = figure.get_size_inches(), box
    place = left / width, 1.0 - (top + high) / height, wide / width, high / height
    return figure.add_axes(place, label=label)


def views(
    axes: dict[str, Axes],
    boxes: dict[str, Box],
    shots: Sequence[DrawnShot],
    course: Course | None,
    seen: Window,
    dpi: int,
) -> None:
    """Draw what `seen`, a Window, shows, from the side and from above."""
    from_side(axes['side'], shots, course, seen, boxes['side'][2:])
    axes['side'].tick_params(labelbottom=seen.height > seen.width)
    numbers = above(axes['above'], shots, course, seen, boxes['above'][2:], round(INNER * dpi))
    bare(axes['above'], 'From above', 'x, towards the target [m]', 'y, left [m]')
    drawn_like(axes['above'], boxes['above'][3], course, numbers)


def at_hole(
    axes: Axes, box: Box, shots: Sequence[DrawnShot], course: Course | None, near: Window, dpi: int
) -> None:
    """Draw the surroundings of the hole."""
    above(axes, shots, course, near, box[2:], round(CHARTS * dpi))
    bare(axes, 'At the hole', 'x [m]', '')
    axes.xaxis.set_major_locator(MaxNLocator(4))


def drawn_like(axes: Axes, height: float, course: Course | None, numbers: Iterable[int]) -> None:
    """Explain colours and marks below `axes`, `height` inches high."""
    seen = [materials(course)[i] for i in sorted(numbers)] if course else []
    key = [Patch(facecolor=material.color, label=material.name) for material in seen]
    for label, mark, fill, edge in MARKS[: len(MARKS) if course else -1]:
        key.append(
            Line2D(
                [],
                [],
                marker=mark,
                markerfacecolor=fill,
                markeredgecolor=edge,
                linestyle='none',
                markersize=5,
                label=label,
            )
        )
    axes.legend(
        handles=key,
        loc='upper right',
        bbox_to_anchor=(1.0, -0.27 / height),
        borderaxespad=0.0,
        ncol=len(key),
        frameon=False,
        fontsize=SMALL,
        labelcolor=PALE,
        handlelength=1.1,
        handletextpad=0.5,
        columnspacing=1.4,
    )


def headed(figure: Figure, shots: Sequence[DrawnShot], course: Course | None, title: str) -> None:
    """Write what is drawn at the top."""
    played = f'{len(shots)} shot' + 's' * (len(shots) > 1)
    seconds = sum(shot.result.duration for shot in shots)
    high = figure.get_size_inches()[1]
    figure.text(
        LEFT / WIDTH,
        1.0 - 0.2 / high,
        title or (course.name if course else 'A play'),
        va='top',
        fontsize=TITLE,
        fontweight='bold',
        color=INK,
    )
    figure.text(
        LEFT / WIDTH,
        1.0 - 0.46 / high,
        f'{played}, {seconds:.0f} s of play',
        va='top',
        fontsize=SMALL + 1,
        color=PALE,
    )
