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

"""A drive, an approach and a putt over ROS 2, each hit with `shoot`, recorded, drawn.

``make play`` runs it.
"""

import json
import os
from pathlib import Path
import shutil
import subprocess
import sys

from golf_sim_ros.course import load_course
from golf_sim_ros.nodes.environment import complete_environment
from golf_sim_ros.physics import World
from golf_sim_ros.shot_input.clubs import CLUBS
from golf_sim_ros.shot_input.launch_monitor import Launch, velocity_and_spin
from golf_sim_ros.shot_input.units import UNITS
import numpy as np
import rclpy
from rclpy.signals import SignalHandlerOptions
from running import BIN, Failed, nodes, Spectator, start

LONGEST = 360.0  # s: a shot lasts 300 s at most
LEFT = Path(__file__).resolve().parent.parent / 'play'  # what is left of the play
BAG, PICTURE = LEFT / 'bag', LEFT / 'play.png'
COURSE = 'golf_without_friends'  # the sim's default
HARDEST = 20.0  # m/s: of a putt
ROUNDS = 12  # of halving what is tried
BEYOND = 0.3  # m: a putt that dies at the hole falls short of it half of the time


def main():
    """Play; the exit code is 0 when all three shots came to an end."""
    complete_environment()
    keep_to_ourselves()
    clear()
    rclpy.init(signal_handler_options=SignalHandlerOptions.NO)
    try:
        with nodes() as processes:
            spectator = Spectator(processes)
            spectator.wait_for_ball()
            start(processes, 'record_play', '--output', BAG, '--balls', 'ball')
            spectator.wait_for_recorder()
            summarize(play(spectator))
        draw()
    except Failed as failure:
        print(f'play: {failure}', file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        return 130
    finally:
        rclpy.try_shutdown()
    return 0


def keep_to_ourselves():
    """Meet no other game: this machine only and, if none is chosen, a domain of our own."""
    os.environ.setdefault('ROS_AUTOMATIC_DISCOVERY_RANGE', 'LOCALHOST')
    os.environ.setdefault('ROS_DOMAIN_ID', str(1 + os.getpid() % 100))
    print(f'Playing on ROS_DOMAIN_ID={os.environ["ROS_DOMAIN_ID"]}', flush=True)


def clear():
    """Make room for what will be left of this play, in place of the one before."""
    LEFT.mkdir(exist_ok=True)
    shutil.rmtree(BAG, ignore_errors=True)
    PICTURE.unlink(missing_ok=True)


def draw():
    """Draw what was recorded."""
    code = subprocess.call([BIN / 'plot_play', BAG, '--output', PICTURE])
    if code != 0:
        raise Failed(f'the play was not drawn, exit code {code}')
    commands, bag = os.path.relpath(BIN), os.path.relpath(BAG)
    print(
        f'{BAG}: the recording\n'
        f'  {commands}/view_play {bag}                 looks at it in a browser\n'
        f'  {commands}/view_play {bag} -o play.html    makes one file of that\n'
        f'  {commands}/resimulate {bag}                plays it again, to the bit'
    )


def play(spectator):
    """Results of the shots."""
    results = []
    for choose in (drive, approach, putt):
        title, arguments = choose(results[-1] if results else None)
        hit(title, arguments)
        results.append(spectator.result(len(results) + 1))
        if results[-1]['status'] == 'holed':
            break
    return results


def drive(_):
    """Name and arguments of the first shot."""
    return 'drive', ['driver']


def approach(last):
    """Name and arguments of a shot that ends at the hole: a whole one, or part of a wedge."""
    reach = {name: club.carry for name, club in CLUBS.items() if club.carry}
    name = min(reach, key=lambda club: abs(reach[club] - last['to_hole']))
    full = CLUBS[name].launch

    def part(power):
        return full._replace(speed=power * full.speed, backspin=power * full.backspin)

    power = enough(last, part, 1.0)
    return f'approach with the {name}', [name, '--power', f'{power:.3f}']


def putt(last):
    """Name and arguments of a shot along the ground that rolls to the hole."""
    speed = enough(last, Launch, HARDEST) / UNITS['golf'].speed.size  # in shoot's units
    return 'putt', ['putter', '--speed', f'{speed:.2f}']


def enough(last, launch, most):
    """Least number, up to `most`, for which `launch` of it, aimed at the hole, gets there.

    In still air.

    Tried on the course without its hole, from where the `last` shot ended.
    """
    course = load_course(COURSE)
    hole, place = np.array(course.hole), np.array(last['position'][:2])
    way = hole - place
    distance = np.hypot(*way)
    low, high = 0.0, most
    for _ in range(ROUNDS):
        tried = 0.5 * (low + high)
        world = World(course._replace(hole=None))
        world.place('ball', tuple(place))
        world.strike('ball', *velocity_and_spin(launch(tried), np.arctan2(way[1], way[0])))
        while world.moving:
            world.advance(1.0)
        if np.dot(world['ball'].position[:2] - place, way) < (distance + BEYOND) * distance:
            low = tried
        else:
            high = tried
    return high


def hit(title, arguments):
    """Hit one shot at the hole."""
    command = ['shoot', *arguments, '--aim', 'hole']
    print(f'\n{title.capitalize()}: {" ".join(command)}', flush=True)
    try:
        code = subprocess.call([BIN / command[0], *command[1:]], timeout=LONGEST)
    except subprocess.TimeoutExpired:
        raise Failed(f'the {title} had no result after {LONGEST:g} s') from None
    if code != 0:
        raise Failed(f'the {title} was not played, exit code {code}')


def summarize(results):
    """Print what became of the shots."""
    print('\nPlayed:')
    for result in results:
        keys = ('shot', 'status', 'carry', 'total', 'side', 'to_hole', 'lie')
        print('  ' + json.dumps({key: result[key] for key in keys}))


if __name__ == '__main__':
    sys.exit(main())
