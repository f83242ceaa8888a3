# SPDX-License-Identifier: Apache-2.0
"""Compile the physics beforehand, once a machine or image: the compiled engine then starts at once."""
import argparse
import sys

from ..course import CourseError, load_course
from ..physics import World
from ..physics.jit import cache
from ..physics.jit.build import READY

EPILOG = """One program serves every course with one ball, another every course with several. They are kept in
a folder of their own for each version of the physics, which GOLF_SIM_ROS_CACHE can name. The exit code is 0 when
all is compiled, 1 when it cannot be, 2 for wrong arguments."""
PROGRAMS = {'one ball': ('ball',), 'several balls': ('red', 'blue')}
WIDTH = 30  # characters of the bar
LOOK = 0.2  # s between two looks


def main(args=None):
    """Compile what is not compiled; return the exit code."""
    options = parser().parse_args(args)
    try:
        course = load_course(options.course)
        for name in options.programs or PROGRAMS:
            reason = compiled(name, World(course, PROGRAMS[name], engine='python'))
            if reason:
                print(f'compile_physics: {reason}', file=sys.stderr)
                return 1
    except CourseError as error:
        print(f'compile_physics: {" ".join(str(error).split())}', file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        return 130
    print(f'kept in {cache.folder().path}')
    return 0


def parser():
    """Reader of the command line."""
    reader = argparse.ArgumentParser(prog='compile_physics', description=__doc__, epilog=EPILOG)
    reader.add_argument('--course', default='golf_without_friends', help='a course whose effects are by name, or '
                        'with an effect of your own, needs programs of its own')
    reader.add_argument('--only', dest='programs', action='append', choices=list(PROGRAMS),
                        help='one of the programs; all if not given')
    return reader


def compiled(name, world):
    """Why the program called `name`, that of `world`, could not be compiled, or ''; a bar shows how far it is."""
    build, shown = world.build(urgent=True), sys.stderr.isatty()
    while not build.wait(LOOK):
        if shown:
            print('\r' + bar(name, build.progress), end='', file=sys.stderr, flush=True)
    if build.state != READY:
        return build.reason
    print(('\r' if shown else '') + bar(name, 1.0), file=sys.stderr, flush=True)
    return ''


def bar(name, share):
    """How far a program is, and what is left, as a line."""
    done = round(share * WIDTH)
    return f'{name:14}[{"#" * done}{"." * (WIDTH - done)}] {share:4.0%} done, {1.0 - share:4.0%} left'


if __name__ == '__main__':
    sys.exit(main())
