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

"""Hit one shot, typed as a launch monitor shows it, and print how it ends."""

from argparse import Namespace
from collections.abc import Sequence
import sys

import rclpy
from rclpy.exceptions import NameValidationException
from rclpy.signals import SignalHandlerOptions
from rclpy.utilities import remove_ros_args

from .closed_pipe import in_pipes
from .player import NoShot, Player
from .result_table import result_table
from .shoot_arguments import parser
from ..nodes.environment import complete_environment, unsafe
from ..nodes.lifecycle import Ending
from ..shot_input.clubs import Club
from ..shot_input.launch_monitor import Launch, parted, Vector, velocity_and_spin
from ..shot_input.units import Unit, UNITS, Units


def parsed(argv: Sequence[str]) -> tuple[Namespace, Launch]:
    """Parse the command line of a shot.

    Parameters
    ----------
    argv : list of str
        Without the name of the program and without ROS's arguments.

    Returns
    -------
    options : argparse.Namespace
    launch : golf_sim_ros.shot_input.launch_monitor.Launch

    Raises
    ------
    SystemExit
        With code 2, after a line that says what is wrong.
    """
    reader = parser()
    options = reader.parse_args(argv)
    try:
        return options, launched(options)
    except ValueError as error:
        reader.error(str(error))


def launched(options: Namespace) -> Launch:
    """`Launch` of `options`: the club's, changed by what was given."""
    units, average = UNITS[options.units], _average(options)
    return Launch(
        speed=_given(options.speed, units.speed, average.speed),
        launch=_given(options.launch, units.angle, average.launch),
        azimuth=_given(options.azimuth, units.angle, 0.0),
        **_spins(options, units, average),
    )


def _average(options: Namespace) -> Launch:
    """`Launch` that the options change: the club's average, or none at all."""
    hit, power = options.club, options.power
    if hit is not None and hit.launch is not None:
        power = 1.0 if power is None else power
        return hit.launch._replace(
            speed=power * hit.launch.speed, backspin=power * hit.launch.backspin
        )
    if power is not None:
        raise ValueError('--power needs a club that has an average shot: any but the putter')
    if options.speed is None:
        raise ValueError(f'give {"a club, or " if hit is None else ""}the ball speed with --speed')
    return Launch(speed=0.0)


def _spins(options: Namespace, units: Units, average: Launch) -> dict[str, float]:
    """Backspin and sidespin, by name."""
    by_axis = options.spin is not None or options.axis is not None
    by_parts = options.backspin is not None or options.sidespin is not None
    if by_parts and by_axis:
        raise ValueError('give --backspin and --sidespin, or --spin and --axis, not both')
    if by_axis:
        spin = _given(options.spin, units.spin, average.backspin)
        backspin, sidespin = parted(spin, _given(options.axis, units.angle, 0.0))
    else:
        backspin = _given(options.backspin, units.spin, average.backspin)
        sidespin = _given(options.sidespin, units.spin, 0.0)
    return {'backspin': backspin, 'sidespin': sidespin}


def _given(value: float | None, unit: Unit, otherwise: float) -> float:
    return otherwise if value is None else value * unit.size


def publish_line(topic: str, velocity: Vector, spin: Vector) -> str:
    """Line that strikes the ball when it is pasted into a shell, in full precision."""
    linear, angular = (
        ', '.join(f'{axis}: {_yaml(number)}' for axis, number in zip('xyz', vector))
        for vector in (velocity, spin)
    )
    return (
        f'ros2 topic pub --once {topic} geometry_msgs/msg/Twist '
        f"'{{linear: {{{linear}}}, angular: {{{angular}}}}}'"
    )


def _yaml(number: float) -> str:
    """Text of a number as YAML 1.1 reads it: 1e-05 would be a text there."""
    text = repr(float(number))
    return text.replace('e', '.0e') if 'e' in text and '.' not in text else text


def described(launch: Launch, hit: Club | None, units: Units) -> str:
    """One line that describes the launch."""

    def show(number: float, unit: Unit, digits: int = 1) -> str:
        return f'{round(number / unit.size, digits) + 0.0:.{digits}f} {unit.name}'

    return (
        f'{hit.name if hit else "shot"}: {show(launch.speed, units.speed)}, '
        f'launch {show(launch.launch, units.angle)}, azimuth {show(launch.azimuth, units.angle)}, '
        f'backspin {show(launch.backspin, units.spin, 0)}, '
        f'sidespin {show(launch.sidespin, units.spin, 0)}'
    )


def shoot(player: Player, options: Namespace, launch: Launch) -> None:
    """Hit `launch`, or only print it, and print how it ends."""
    units = UNITS[options.units]
    heading, distance = player.way_to_hole() if options.aim else (0.0, None)
    velocity, spin = velocity_and_spin(launch, heading)
    if options.print:
        print(publish_line(player.shot_topic, velocity, spin))
        return
    player.find_sim()
    print(described(launch, options.club, units), flush=True)
    if distance is not None:
        print(f'to the hole: {distance / units.length.size:.2f} {units.length.name}', flush=True)
    print('\n' + result_table(player.strike(velocity, spin), units))


@in_pipes
def main(args: list[str] | None = None) -> int:
    """Hit the shot on the command line; return the exit code."""
    ending = Ending()
    try:
        options, launch = begun(sys.argv if args is None else args)
        shoot(
            Player(options.ball, options.namespace, options.timeout, options.wait), options, launch
        )
    except (NoShot, NameValidationException) as error:
        return failed(error, 1)
    except KeyboardInterrupt:
        return 130
    finally:
        ending.be_patient()
        rclpy.try_shutdown()
    return 0


def begun(args: list[str]) -> tuple[Namespace, Launch]:
    """Start ROS with its own arguments, and parse the others."""
    complete_environment()
    try:
        typed = parsed(remove_ros_args(args)[1:])
        rclpy.init(args=args, signal_handler_options=SignalHandlerOptions.NO)
        return typed
    except RuntimeError as error:
        raise SystemExit(
            failed(unsafe() or f'arguments for ROS: {error}', 1 if unsafe() else 2)
        ) from None


def failed(reason: object, code: int) -> int:
    """Say in one line why there is no shot; return the exit code."""
    print(f'shoot: {" ".join(str(reason).split())}', file=sys.stderr)
    return code


if __name__ == '__main__':
    sys.exit(main())
