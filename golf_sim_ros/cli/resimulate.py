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

"""Run recorded play again, without ROS.

It tells whether it is the same, and what another accuracy changes.
"""

import argparse
from collections.abc import Sequence
from math import dist
import sys

from .closed_pipe import in_pipes
from .. import __version__
from ..physics import ACCURACY, World
from ..physics.jit.build import READY
from ..recording.bag import BagError, read_bag, Recording
from ..recording.journal import made_with
from ..recording.replay import (
    CLOSE,
    config_of,
    difference,
    engine_of,
    rerun,
    Shot,
    shots,
    tick_of,
    timed,
    world_of,
)

EPILOG = """Each shot is run by the engine that played it: the same bits. Where the compiled engine
is missing here, plain Python takes its place, and has to agree to 1e-9. The exit code is 0 when
every shot is the same, 1 when one is not or the bag cannot be used, 2 for wrong arguments."""
SHORT_WAIT = 5.0  # s: what is compiled is loaded by then


@in_pipes
def main(args: Sequence[str] | None = None) -> int:
    """Run a bag's play again; return the exit code."""
    options = parser().parse_args(args)
    try:
        plays = [play for play in read_bag(options.bag) if shots(play)]
        if not plays:
            raise BagError(f'{options.bag}: no strike is in a journal: it cannot be run again')
        same = [resimulated(play, options) for play in plays]
        return 0 if all(same) else 1
    except BagError as error:
        print(f'resimulate: {" ".join(str(error).split())}', file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        return 130


def parser() -> argparse.ArgumentParser:
    """Parser of the command line."""
    reader = argparse.ArgumentParser(prog='resimulate', description=__doc__, epilog=EPILOG)
    reader.add_argument('bag', help='folder of a rosbag2 bag, or one of its files, .mcap or .db3')
    reader.add_argument(
        '--accuracy', choices=list(ACCURACY), help='also play every shot at this accuracy'
    )
    reader.add_argument('--course', help='name or path of the course, if it is not where it was')
    return reader


def resimulated(play: Recording, options: argparse.Namespace) -> bool:
    """Run one recorded sim again, print a line for every shot; return whether all are the same."""
    world = world_of(play, options.course)
    introduce(play, world)
    found, engines = shots(play), engines_here(play, world)
    same = [retold(play, world, shot, options.accuracy, engines) for shot in found]
    alike = (
        'identical'
        if {engine_of(play, shot) for shot in found} <= engines
        else f'the same to {CLOSE:g}'
    )
    print(f'{sum(same)} of {len(found)} {alike}', flush=True)
    return all(same)


def introduce(play: Recording, world: World) -> None:
    """Print what is run again, and a note where versions or processor are others by now."""
    config = config_of(play)
    print(
        f'{play.namespace or "/"}: {world.course.name}, {config["parameters"]["rate"]:g} ticks a '
        f'second, accuracy {config["parameters"]["accuracy"]}'
    )
    then = {'golf_sim_ros': config['version'], **config['made_with']}
    now = {'golf_sim_ros': __version__, **made_with()}
    others = [
        f'{name} {then.get(name)} then, {now[name]} now'
        for name in now
        if then.get(name) != now[name]
    ]
    if others:
        print(
            f'note: {"; ".join(others)}: the same bits are promised only where these are the same'
        )


def engines_here(play: Recording, world: World) -> set[str]:
    """Find the engines that this machine has, of those that played; note where one is missing."""
    if 'compiled' not in {engine_of(play, shot) for shot in shots(play)}:
        return {'python'}
    build = world.build(urgent=True)
    if not build.wait(SHORT_WAIT):
        print('compiling the physics, which takes up to a minute, once a machine', flush=True)
        build.wait()
    if build.state == READY:
        return {'python', 'compiled'}
    print(
        f'note: recorded with the compiled engine, run again in plain Python, which agrees to '
        f'{CLOSE:g}: {build.reason}',
        flush=True,
    )
    return {'python'}


def retold(
    play: Recording, world: World, shot: Shot, accuracy: str | None, engines: set[str]
) -> bool:
    """Run one shot again and print a line about it; return whether it is the same.

    It is run by its engine, if that is one of `engines`.
    """
    name = f'shot {shot.strike["shot"]} ({shot.strike["ball"]})'
    if shot.gap:
        print(f'{name}: journal entries {shot.gap} are missing: it cannot be run again')
        return False
    engine = engine_of(play, shot)
    world.engine = engine if engine in engines else 'python'
    again = rerun(world, shot, tick_of(play))
    found = difference(play, shot, again, exact=world.engine == engine)
    if found:
        after = (found.tick - shot.strike['tick']) * tick_of(play)
        print(
            f'{name}: differs first at tick {found.tick}, {after:g} s after the strike, in '
            f'{found.field}: {found.recorded} recorded, {found.again} again'
        )
    else:
        alike = 'identical' if world.engine == engine else f'the same to {CLOSE:g} in plain Python'
        print(
            f'{name}: {alike}' + ('' if shot.rest else ', as far as it was recorded'), flush=True
        )
    if accuracy and again.result:
        print('  ' + compared(world, shot, tick_of(play), accuracy), flush=True)
    return found is None


def compared(world: World, shot: Shot, tick: float, accuracy: str) -> str:
    """One line on what another accuracy changes in a shot."""
    rest, time = timed(world, shot, tick)
    other, faster = timed(world, shot, tick, accuracy)
    times = (
        f'{1e3 * time:.3f} ms at {shot.strike["accuracy"]}, {1e3 * faster:.3f} ms at {accuracy}'
    )
    if rest is None or other is None:
        return f'ended by a reset; {times}'
    return f'rest moves by {dist(rest, other):.3g} m; {times}'


if __name__ == '__main__':
    sys.exit(main())
