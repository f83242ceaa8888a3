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

"""Solve for the wind over a course by direction, which then blows in flight. Needs no ROS."""

import argparse
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from math import degrees
from multiprocessing import get_context
from pathlib import Path
import sys
from typing import Any

from .closed_pipe import in_pipes
from ..course import CourseError
from ..optional_packages import how_to_get
from ..physics import Course, EngineUnavailable
from ..wind import FieldError, NotConverged, WindField

EPILOG = """The course takes the field by its key: wind_field: FILE.npz. It belongs to the ground,
the trees and the roughness that it was made for. Ctrl-C keeps the directions that are done, in
FILE.npz.part, and the same command goes on from there. The exit code is 0 when the field is
written, 1 when it cannot be, 2 for wrong arguments, 130 after Ctrl-C."""
NEEDED = f'--plot needs matplotlib: {how_to_get("plot", "matplotlib")}'
MOST_JOBS = 64
CASE: dict[str, Any] = {}  # of a worker process: what it solves


@in_pipes
def main(args: Sequence[str] | None = None) -> int:
    """Solve for the field and write it; return the exit code."""
    options = parser().parse_args(args)
    try:
        draw = drawing() if options.plot else None
        field, course = solved_for(options)
        field.save(options.output, options.compact)
        print(
            f'{options.output}: {len(field.angles)} directions, '
            f'{options.output.stat().st_size / 1e6:.1f} MB; in the course file: '
            f'wind_field: {options.output.name}'
        )
        if draw:
            picture = options.output.with_suffix('.png')
            draw(picture, field, course)
            print(picture)
    except (
        CourseError,
        EngineUnavailable,
        FieldError,
        NotConverged,
        OSError,
        ValueError,
    ) as error:
        print(f'wind_field: {" ".join(str(error).split())}', file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        return 130
    return 0


def parser() -> argparse.ArgumentParser:
    """Parser of the command line."""
    reader = argparse.ArgumentParser(prog='wind_field', description=__doc__, epilog=EPILOG)
    reader.add_argument('course', help='name of a shipped course, or path of a course file')
    reader.add_argument(
        '-o', '--output', type=Path, required=True, metavar='FILE.npz', help='field to write'
    )
    reader.add_argument(
        '--directions',
        type=partial(whole, 360),
        default=16,
        metavar='N',
        help='how many, evenly all round (%(default)s)',
    )
    reader.add_argument(
        '--accuracy',
        choices=('mass', 'sketch', 'standard', 'reference'),
        default='standard',
        help='mass: no lees, no trees; see docs/wind.md (%(default)s)',
    )
    reader.add_argument(
        '--jobs',
        type=partial(whole, MOST_JOBS),
        default=1,
        metavar='N',
        help='processes that solve at once (%(default)s)',
    )
    reader.add_argument(
        '--compact',
        action='store_true',
        help='in steps of 0.002 of the local wind, in a tenth of the space',
    )
    reader.add_argument(
        '--plot',
        action='store_true',
        help='draw it, too, beside it: how fast the air is at 2 and 10 m, a section, residuals',
    )
    return reader


def whole(most: int, text: str) -> int:
    """Whole number from 1 to `most`, from the command line."""
    if not text.isdecimal() or not 1 <= int(text) <= most:
        raise argparse.ArgumentTypeError(f'{text} is not a whole number from 1 to {most}')
    return int(text)


def drawing() -> Callable[..., None]:
    """Return what draws a field; ValueError where matplotlib is missing."""
    try:
        from ..drawing.wind_field import draw_field
    except ImportError as error:
        raise ValueError(f'{NEEDED} ({error})') from None
    return draw_field


def solved_for(options: argparse.Namespace) -> tuple[WindField, Course]:
    """`WindField` that the `options` ask for, and its course; it says how far it is."""
    from ..course.course_file import course_without_field
    from ..wind import solving
    from ..wind.land_survey import land_digest
    from ..wind.unfinished import Unfinished

    course = course_without_field(options.course)
    case = solving.case_of(course, solving.level_of(options.accuracy))
    nx, ny, nz = case.grid.shape
    say(f'{course.name}: {nx} x {ny} x {nz} cells of {case.grid.metric.dx.min():.1f} m')
    angles = solving.angles_of(options.directions)
    solving.check_size(case, len(angles))
    kept = Unfinished(options.output, f'{land_digest(course)} {case.level}')
    kept.solved = {angle: kept.solved[angle] for angle in angles if angle in kept.solved}
    if kept.solved:
        say(f'{len(kept.solved)} of {len(angles)} directions were done before')
    todo = [angle for angle in angles if angle not in kept.solved]
    try:
        for angle, found in in_turn(case, todo, options.jobs):
            kept.add(angle, found)
            end = f', changes {found.residuals[-1]:.1e}' if len(found.residuals) else ''
            say(
                f'direction {len(kept.solved)} of {len(angles)}, {degrees(angle):.4g} degrees: '
                f'{len(found.residuals)} steps{end}'
            )
    except KeyboardInterrupt:
        say(f'{len(kept.solved)} of {len(angles)} directions are kept; the same command goes on')
        raise
    field = solving.field_of(course, case, options.accuracy, kept.solved)
    kept.forget()
    return field, course


def in_turn(case: Any, angles: list[float], jobs: int) -> Iterator[tuple[float, Any]]:
    """Angles and what was solved for each, as they are done, by so many processes."""
    from ..wind.solving import solve_direction

    if jobs == 1 or len(angles) < 2:
        for angle in angles:
            yield angle, solve_direction(case, angle, live(angle))
        return
    with get_context('spawn').Pool(min(jobs, len(angles)), take, (case,)) as pool:
        yield from pool.imap_unordered(solve_one, angles)


def take(case: Any) -> None:
    """Take the case that this worker process solves."""
    CASE['case'] = case


def solve_one(angle: float) -> tuple[float, Any]:
    """Angle, and what was solved for it, in a worker process."""
    from ..wind.solving import solve_direction

    return angle, solve_direction(CASE['case'], angle)


def live(angle: float) -> Callable[[int, float], None] | None:
    """Return what shows the steps of a direction on a terminal; None elsewhere."""
    if not sys.stderr.isatty():
        return None

    def show(step: int, change: float) -> None:
        print(
            f'\r{degrees(angle):.4g} degrees: step {step}, changes {change:.1e}   ',
            end='',
            file=sys.stderr,
            flush=True,
        )

    return show


def say(text: str) -> None:
    """Print a line, over what a terminal shows of the steps."""
    if sys.stderr.isatty():
        print('\r\033[K', end='', file=sys.stderr, flush=True)
    print(text, flush=True)


if __name__ == '__main__':
    sys.exit(main())
