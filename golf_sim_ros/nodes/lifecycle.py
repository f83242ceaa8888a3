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

"""The life of a node's process: from the first line of `main` to its exit code."""

from collections.abc import Callable
import signal
import sys
from types import FrameType
from typing import Any, Optional

import rclpy
from rclpy.exceptions import ParameterException
from rclpy.executors import SingleThreadedExecutor
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.logging import get_logger
from rclpy.node import Node
from rclpy.signals import SignalHandlerOptions

from .command_line import answered, explained, Program
from .environment import complete_environment, unsafe

try:
    from rclpy.experimental import EventsExecutor
except ImportError:  # rclpy before Jazzy's 7.1.5
    EventsExecutor = SingleThreadedExecutor

SIGNALS = (signal.SIGINT, signal.SIGTERM)
AGAIN = 0.2  # s after which an interruption that was not heard is repeated
REFUSED = (ValueError, ParameterException)  # a wrong parameter or file


def say_nothing(unraisable: Any) -> None:
    """Ignore an exception that cannot be raised, in place of `sys.unraisablehook`."""


class Ending:
    """Whether a signal has told this process to end (`told`).

    While `at_once`, it also interrupts whatever goes on, a compilation say. As a callback of the
    compiler may swallow that, it is repeated until it has been heard.
    """

    def __init__(self) -> None:
        self.told = False
        self.at_once = True
        for number in (*SIGNALS, signal.SIGALRM):
            signal.signal(number, self.tell)

    def tell(self, number: int, frame: FrameType | None) -> None:
        """Handle a signal: note it, and interrupt what goes on while `at_once`."""
        self.told = True
        if self.at_once:
            # Callbacks that are interrupted would print a traceback.
            sys.unraisablehook = say_nothing
            signal.setitimer(signal.ITIMER_REAL, AGAIN)
            raise KeyboardInterrupt

    def be_patient(self) -> None:
        """Interrupt nothing from now on."""
        self.at_once = False
        signal.setitimer(signal.ITIMER_REAL, 0.0)


def run(make_node: Callable[[], Node], program: Program, args: list[str] | None = None) -> int:
    """Run the node made by `make_node` until the process is told to stop; return the exit code.

    SIGINT and SIGTERM end it with 0 at any time from here on, also while it compiles. Where
    `make_node` raises what a user can put right (`REFUSED`), the log has one line and the code is
    1. Where the arguments leave nothing to run, as `--help` does, the `Program` has its answer.
    """
    ending = Ending()
    try:
        complete_environment()
        if unsafe():
            print(f'golf_sim_ros: {unsafe()}', file=sys.stderr)
            return 1
        code = answered(program, args)
        if code is not None:
            return code
        node = checked(make_node, args)
        if node is None:
            return 0 if ending.told else 1
        ending.be_patient()
        spin(node, ending)
    except BaseException:  # interrupted, a compiler may well raise something else
        ending.be_patient()
        if not ending.told:
            raise
    finally:
        rclpy.try_shutdown()
    return 0


def checked(make_node: Callable[[], Node], args: list[str] | None) -> Optional[Node]:
    """Make a node by `make_node`; None after a line in the log that says what was wrong."""
    try:
        rclpy.init(args=args, signal_handler_options=SignalHandlerOptions.NO)
    except rclpy_implementation.RCLError as error:
        # Of what the arguments name: an enclave, a pipe.
        get_logger('golf_sim_ros').fatal(explained(error))
        return None
    try:
        return make_node()
    except REFUSED as error:
        get_logger('golf_sim_ros').fatal(' '.join(str(error).split()))
        return None


def spin(node: Node, ending: Ending) -> None:
    """Let `node` work until the `ending` is told, never stopping in the middle of a callback.

    `EventsExecutor` takes a fifth of the processor time; its `spin` without a timeout never calls
    back in rclpy 7.1, `spin_once` does. On simulated time it may call a timer twice for one
    period, and then skip the next: `UpdateTimers` of rclpy's timers_manager.cpp queues a timer
    anew at every /clock that comes before its call.
    """
    on_simulated_time = node.get_clock().ros_time_is_active
    executor = SingleThreadedExecutor() if on_simulated_time else EventsExecutor()
    executor.add_node(node)
    while rclpy.ok() and not ending.told:
        executor.spin_once(timeout_sec=0.25)
    executor.remove_node(node)
    node.destroy_node()
