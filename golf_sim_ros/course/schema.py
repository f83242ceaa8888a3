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

"""Checkers of values from a file: each returns its value or says what is wrong with it.

A checker is called with a value and its key, ``ground[3].normal``, and raises `CourseError` with
one line: key, value, what is allowed. Functions named after a thing (`number`, `polygon`) are
checkers or, where they need to know more, make one.
"""

from collections.abc import Callable, Iterable, Mapping, Sequence
from difflib import get_close_matches
from math import hypot, inf
from reprlib import Repr
from typing import Any

from .simple_polygon import crossing

Checker = Callable[[Any, str], Any]  # of a value and its key

FAR = 1e6  # m: beyond this no coordinate is meant

LONGEST = 300  # letters of a message
CUT = ' ... '  # stands for those left out
MANY = 20  # known names at most in a message

_SHORT = Repr()
_SHORT.maxlevel = 3
_SHORT.maxstring = 80
_SHORT.maxother = 80
_SHORT.maxdict = 4


class CourseError(ValueError):
    """A course or material that cannot be used.

    One line with file, key, value and what is allowed.
    """

    def __init__(self, message: object) -> None:
        super().__init__(one_line(message))


def one_line(message: object) -> str:
    """`message` as one line that can be printed, of at most `LONGEST` letters.

    Of a longer one the middle is left out.
    """
    line = printable(message)
    if len(line) <= LONGEST:
        return line
    half = LONGEST // 2 - len(CUT)
    return line[:half] + CUT + line[-half:]


def printable(message: object) -> str:
    """`message` as one line: what would end it, or cannot be printed, is a question mark."""
    return ''.join(letter if letter.isprintable() else '?' for letter in str(message))


def shown(value: Any) -> str:
    """`value` as a person may have written it, short and on one line."""
    try:
        return 'nothing' if value is None else _SHORT.repr(value)
    except ValueError:  # Python refuses to print integers of thousands of digits
        return 'a very long number'


def below(key: str, name: str) -> str:
    """Key of what is called `name` inside of `key`."""
    return f'{key}.{name}' if key else name


def refused(key: str, value: Any, allowed: str) -> CourseError:
    """Error that says what `key` must be."""
    return CourseError(f'{key or "the file"} {shown(value)} must be {allowed}')


def unknown(what: str, value: Any, choices: Iterable[str]) -> CourseError:
    """Error for a `value` that is none of `choices`, with the one that was probably meant."""
    known = sorted(choices)
    close = (
        get_close_matches(value, known, 1)
        if isinstance(value, str) and len(value) < LONGEST
        else []
    )
    hint = f'; did you mean {close[0]!r}?' if close else ''
    more = f' and {len(known) - MANY} more' if len(known) > MANY else ''
    return CourseError(
        f'{what} {shown(value)} is unknown; known: {", ".join(known[:MANY])}{more}{hint}'
    )


def number(least: float = -FAR, most: float = FAR) -> Checker:
    """Make the checker of a finite number from `least` to `most`."""
    allowed = f'a number from {least:g} to {most:g}'

    def check(value: Any, key: str) -> float:
        if isinstance(value, bool) or not isinstance(value, (int, float)):
            raise refused(key, value, allowed)
        if not least <= value <= most:  # refuses nan too
            raise refused(key, value, allowed)
        return float(value)

    return check


def flag(value: Any, key: str) -> bool:
    """Check that it is true or false."""
    if not isinstance(value, bool):
        raise refused(key, value, 'true or false')
    return value


def text(value: Any, key: str) -> str:
    """Check that it is a line of text that is not empty."""
    if not isinstance(value, str) or not value.strip() or not value.isprintable():
        raise refused(key, value, 'a line of text')
    return value


def one_of(choices: Mapping[str, Any]) -> Checker:
    """Make the checker of a name; it returns what `choices` hold under that name."""

    def check(value: Any, key: str) -> Any:
        if not isinstance(value, str) or value not in choices:
            raise unknown(key, value, choices)
        return choices[value]

    return check


def list_of(check_one: Checker, allowed: str, least: int = 0, most: float = inf) -> Checker:
    """Make the checker of a list of `least` to `most` entries; it returns a tuple."""

    def check(value: Any, key: str) -> tuple:
        if not isinstance(value, list) or not least <= len(value) <= most:
            raise refused(key, value, allowed)
        return tuple(check_one(v, f'{key}[{i}]') for i, v in enumerate(value))

    return check


def vector(size: int, least: float = -FAR, most: float = FAR) -> Checker:
    """Make the checker of a list of `size` numbers; it returns a tuple of floats."""
    example = ', '.join('0' * (size - 1) + '1')
    return list_of(number(least, most), f'{size} numbers, as in [{example}]', size, size)


def direction(value: Any, key: str) -> tuple[float, float, float]:
    """Check three numbers, not all 0; return the unit vector."""
    x, y, z = vector(3)(value, key)
    size = hypot(x, y, z)
    if size < 1e-9:
        raise refused(key, value, 'a direction, and (almost) zero has none')
    return x / size, y / size, z / size


def polygon(value: Any, key: str) -> tuple[tuple[float, float], ...]:
    """Check corners [x, y]; return a tuple of them, without a last one equal to the first."""
    corners = list_of(vector(2), 'a list of 3 or more corners [x, y]', 3)(value, key)
    if len(corners) > 3 and corners[0] == corners[-1]:
        corners = corners[:-1]
    for corner, after in zip(corners, corners[1:] + corners[:1]):
        if corner == after:
            raise refused(key, value, f'a polygon, but corner {list(corner)} comes twice in a row')
    found = crossing(corners)
    if found:
        raise refused(
            key,
            value,
            f'a polygon without crossings, but its sides {found[0]} and {found[1]} meet',
        )
    return corners


def mapping(value: Any, key: str) -> dict:
    """Check that it is a mapping of names to anything."""
    if not isinstance(value, dict):
        raise refused(key, value, 'a mapping (key: value)')
    return value


def fields(checkers: Mapping[str, Checker], needed: Sequence[str] = ()) -> Checker:
    """Make the checker of a mapping with a checker for every name in it; it returns a dict."""

    def check(value: Any, key: str) -> dict[str, Any]:
        place = f'{key}: ' if key else ''
        for name in mapping(value, key):
            if name not in checkers:
                raise unknown(f'{place}key', name, checkers)
        for name in needed:
            if name not in value:
                raise CourseError(f'{place}key {name!r} is missing; needed: {", ".join(needed)}')
        return {name: checkers[name](v, below(key, name)) for name, v in value.items()}

    return check


def record(
    kind: Callable[..., Any], checkers: Mapping[str, Checker], needed: Sequence[str] = ()
) -> Checker:
    """Make the checker of a mapping that is a record.

    It returns one of `kind`, a NamedTuple, with defaults for what is left out.
    """
    read = fields(checkers, needed)
    return lambda value, key: kind(**read(value, key))


def tagged(tag: str, kinds: Mapping[str, Checker]) -> Checker:
    """Make the checker of a mapping whose key `tag` names one of `kinds`.

    `kinds`: by name, checkers for the rest of it.
    """

    def check(value: Any, key: str) -> Any:
        if tag not in mapping(value, key):
            raise CourseError(
                f'{key}: key {tag!r} is missing; it is one of: {", ".join(sorted(kinds))}'
            )
        read = one_of(kinds)(value[tag], below(key, tag))
        return read({name: v for name, v in value.items() if name != tag}, key)

    return check
