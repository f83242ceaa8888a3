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

"""The simulator and the wind until Ctrl-C, and how to shoot: what ``make sim`` does."""

import os
import sys
import time

from golf_sim_ros.nodes.environment import complete_environment
import rclpy
from rclpy.signals import SignalHandlerOptions
from running import BIN, Failed, nodes, Spectator


def main():
    """Run until a signal comes; the exit code is 0 then, and 1 when a node ended by itself."""
    complete_environment()
    rclpy.init(signal_handler_options=SignalHandlerOptions.NO)
    try:
        with nodes() as processes:
            Spectator(processes).wait_for_ball()
            print(
                f'\nRunning until Ctrl-C. To shoot, in another terminal: '
                f'{os.path.relpath(BIN)}/shoot driver --aim hole\n',
                flush=True,
            )
            watch(processes)
    except Failed as failure:
        print(f'sim: {failure}', file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        return 0
    finally:
        rclpy.try_shutdown()
    return 0


def watch(processes):
    """Wait until one of `processes` ends."""
    while all(process.poll() is None for process in processes.values()):
        time.sleep(0.2)


if __name__ == '__main__':
    sys.exit(main())
