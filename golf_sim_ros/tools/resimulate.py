# SPDX-License-Identifier: Apache-2.0
"""Run recorded play again, without ROS: is it the same, and what would another accuracy change?"""
import argparse
from math import dist
import sys

from .. import __version__
from ..bag import BagError, read_bag
from ..journal import made_with
from ..physics import ACCURACY
from ..replay import difference, rerun, shots, tick_of, timed, world_of
from .pipes import in_pipes

EPILOG = """The exit code is 0 when every shot is the same to the bit, 1 when one is not or the bag cannot
be used, 2 for wrong arguments."""


@in_pipes
def main(args=None):
    """Run a bag's play again; return the exit code."""
    options = parser().parse_args(args)
    try:
        plays = [play for play in read_bag(options.bag) if shots(play)]
        if not plays:
            raise BagError(f'{options.bag}: no strike is in a journal: it cannot be run again')
        return 0 if all([resimulated(play, options) for play in plays]) else 1
    except BagError as error:
        print(f'resimulate: {" ".join(str(error).split())}', file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        return 130


def parser():
    """Reader of the command line."""
    reader = argparse.ArgumentParser(prog='resimulate', description=__doc__, epilog=EPILOG)
    reader.add_argument('bag', help='folder of a rosbag2 bag, or one of its files, .mcap or .db3')
    reader.add_argument('--accuracy', choices=list(ACCURACY), help='also play every shot at this accuracy')
    reader.add_argument('--course', help='name or path of the course, if it is not where it was')
    return reader


def resimulated(play, options):
    """Run one recorded sim again and tell of every shot; whether all are the same."""
    world = world_of(play, options.course)
    introduce(play, world)
    found = shots(play)
    same = [retold(play, world, shot, options.accuracy) for shot in found]
    print(f'{sum(same)} of {len(found)} identical', flush=True)
    return all(same)


def introduce(play, world):
    """Tell what is played again, and on what if that is not what it was recorded on."""
    config = play.config
    print(f'{play.namespace or "/"}: {world.course.name}, {config["parameters"]["rate"]:g} ticks a second, '
          f'accuracy {config["parameters"]["accuracy"]}')
    then = {'golf_sim_ros': config['version'], **config['made_with']}
    now = {'golf_sim_ros': __version__, **made_with()}
    others = [f'{name} {then.get(name)} then, {now[name]} now' for name in now if then.get(name) != now[name]]
    if others:
        print(f'note: {"; ".join(others)}: the same bits are promised only where these are the same')
    if not world.compiled:
        print('compiling the physics, which takes up to a minute, once a machine', flush=True)
    world.compile()


def retold(play, world, shot, accuracy):
    """Tell of one shot; whether it is the same."""
    name = f'shot {shot.strike["shot"]} ({shot.strike["ball"]})'
    if shot.gap:
        print(f'{name}: journal entries {shot.gap} are missing: it cannot be run again')
        return False
    again = rerun(world, shot, tick_of(play))
    found = difference(play, shot, again)
    if found:
        after = (found.tick - shot.strike['tick']) * tick_of(play)
        print(f'{name}: differs first at tick {found.tick}, {after:g} s after the strike, in {found.field}: '
              f'{found.recorded} recorded, {found.again} again')
    else:
        print(f'{name}: identical' + ('' if shot.rest else ', as far as it was recorded'), flush=True)
    if accuracy and again.result:
        print('  ' + compared(world, shot, tick_of(play), accuracy), flush=True)
    return found is None


def compared(world, shot, tick, accuracy):
    """What another accuracy does to a shot, in a line."""
    rest, time = timed(world, shot, tick)
    other, faster = timed(world, shot, tick, accuracy)
    times = f'{1e3 * time:.3f} ms at {shot.strike["accuracy"]}, {1e3 * faster:.3f} ms at {accuracy}'
    if rest is None or other is None:
        return f'ended by a reset; {times}'
    return f'rest moves by {dist(rest, other):.3g} m; {times}'


if __name__ == '__main__':
    sys.exit(main())
