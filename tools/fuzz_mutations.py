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

"""Mutations of bytes, of text and of structure."""

from datetime import date

# fmt: off
TOKENS = [
    b'\0', b'\n', b'\r\n', b'\t', b' ', b'\\\n', b'#', b'-', b'.', b'e', b'1e999', b'nan', b'inf',
    b'-1', b'0', b'99999999999999999999', b'4294967295', b'2147483648', b'\xff\xfe',
    b'\xef\xbb\xbf', b'\x85', b'\xe2\x80\xa8', b'/', b'//', b'"', b"'", b'{', b'}', b'[', b']',
    b',', b':',
    b'\xff' * 4, b'\0' * 8, b'1' * 400, b'9' * 5000,
]
YAML_TOKENS = [
    b'&a ', b'*a', b'<<: *a', b'!!bool x', b'!!int ', b'!!float ', b'!!timestamp x', b'!!binary x',
    b'!!set ', b'!!omap ', b'!!null x', b'!!str ', b'!!python/name:os.system ', b'? ', b'| ',
    b'> ', b'---\n', b'...\n', b'%YAML 1.1\n', b'[' * 300, b'{a: ' * 50, b':'.join([b'1'] * 3000),
    b'0x' + b'f' * 3000, b'1' * 9999 + b'e', b'~nobody_at_all/x.stl', b'2026-13-45', b'0b', b'0o9',
    b'.inf', b'.nan', b'yes', b'1:30', b'\xc2\x85', b'!<tag:yaml.org,2002:int> x', b'- ',
    b'&b [*b]', b'"\\0"', b'"\\uD800"', b"'\\n'",
]
# fmt: on


def bytes_mutated(rng, raw, tokens=TOKENS):
    """`raw` with a few bytes changed, left out, repeated, moved or put in."""
    raw = bytearray(raw)
    for _ in range(rng.choice((1, 1, 1, 2, 3, 8))):
        at, size = rng.randrange(len(raw) + 1), rng.choice((1, 1, 2, 4, 8, rng.randrange(1, 200)))
        end, way = at + size, rng.randrange(26) % 8
        if way == 0 and raw:
            raw[at % len(raw)] ^= 1 << rng.randrange(8)
        elif way == 1 or way == 7:
            end = at + min(size, 8)
            raw[at:end] = bytes(rng.randrange(256) for _ in range(end - at))
        elif way == 2:
            del raw[at:end]
        elif way == 3:
            raw[at:at] = raw[at:end] * rng.choice((1, 2, 50))
        elif way == 4:
            token = rng.choice(tokens)
            end = at + rng.choice((0, size))
            raw[at:end] = token
        elif way == 5:
            other = rng.randrange(len(raw) + 1)
            other_end = other + size
            raw[at:end] = raw[other:other_end]
        elif rng.random() < 0.2:
            del raw[at:]
    return bytes(raw)


def words_mutated(rng, raw):
    """Text with some of its words replaced by others of it, or by odd ones."""
    words = raw.split(b' ')
    for _ in range(rng.choice((1, 2, 5))):
        words[rng.randrange(len(words))] = rng.choice((rng.choice(words), rng.choice(TOKENS)))
    return b' '.join(words)


def junk(rng):
    """Any value that YAML can say."""
    return rng.choice(
        (
            None,
            True,
            False,
            0,
            1,
            -1,
            10 ** rng.randrange(1, 400),
            -0.0,
            1e-320,
            1e308,
            float('nan'),
            float('inf'),
            '',
            'x',
            'rough',
            '\0',
            'a\nb',
            'é' * 400,
            '~nobody_at_all/x.stl',
            '/dev/zero',
            '.',
            '..',
            date(2026, 1, 2),
            b'\xff',
            [],
            {},
            [[]],
            [0, 0],
            [[0, 0], [1, 0], [1, 1]],
            {'shape': 'plane', 'material': 'rough'},
            rng.random(),
            rng.uniform(-1e6, 1e6),
            rng.randrange(-10, 10),
            [rng.uniform(-50, 50), rng.uniform(-50, 50)],
            {'law': rng.choice(('log', 'power', 'penner', 'quadratic'))},
        )
    )


def places(content, way=()):
    """Ways to everything in `content`."""
    yield way
    items = (
        content.items()
        if isinstance(content, dict)
        else enumerate(content)
        if isinstance(content, list)
        else ()
    )
    for key, value in items:
        yield from places(value, (*way, key))


def at(content, way):
    """Return what is at a place."""
    for key in way:
        content = content[key]
    return content


def changed(rng, content, way, value):
    """`content` with `value` at a place; or without it, or with its key renamed, or twice."""
    if not way:
        return value
    copy = content.copy()
    if len(way) > 1:
        copy[way[0]] = changed(rng, content[way[0]], way[1:], value)
        return copy
    how = rng.randrange(8)
    if how == 0:
        del copy[way[0]]
    elif how == 1 and isinstance(copy, dict):
        copy[rng.choice(('x', 'format', 'cut', 'shape', 'material', 'like', 3))] = copy.pop(way[0])
    elif how == 2 and isinstance(copy, list):
        index = way[0]
        copy[index:index] = [copy[index]] * rng.choice((1, 3, 300))
    else:
        copy[way[0]] = value
    return copy


def structure_mutated(rng, content):
    """`content` with a few places changed: to junk, to what is elsewhere, or a list of itself."""
    for _ in range(rng.choice((1, 1, 1, 1, 2, 6))):
        ways = list(places(content))
        way = rng.choice(ways)
        here = at(content, way)
        value = rng.choice(
            (junk(rng), junk(rng), at(content, rng.choice(ways)), [here], {'x': here})
        )
        if isinstance(here, (int, float)) and abs(here) < 1e300 and rng.random() < 0.3:
            value = here * rng.choice((-1, 0.5, 10, 1e6, 1e-6))
        content = changed(rng, content, way, value)
    return content
