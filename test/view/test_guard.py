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

"""What is not meant for the page's server, or comes from another site, is refused."""

import asyncio

from golf_sim_ros.view.guard import Guard
import pytest

PORT = 8470
OURS = ('127.0.0.1:8470', 'localhost:8470', '[::1]:8470', 'LOCALHOST:8470')
FOREIGN = (
    'evil.example:8470',
    '127.0.0.1:80',
    '127.0.0.1',
    'localhost',
    '127.0.0.1.evil.example:8470',
    '10.0.0.1:8470',
    '0.0.0.0:8470',
    '',
    'localhost:8470 evil.example',
)
ORIGINS = (
    'http://evil.example',
    'http://evil.example:8470',
    'https://127.0.0.1:8470',
    'http://127.0.0.1:8471',
    'http://127.0.0.1',
    'null',
    'file://',
    '',
    'http://127.0.0.1:8470@evil.example',
)


def answer(kind, headers, names=()):
    """Ask the guard: what it sends, and 'inside' where it lets the request through."""
    sent = []

    async def inside(scope, receive, send):
        sent.append('inside')

    async def send(message):
        sent.append(message.get('status', message.get('code', message['type'])))

    scope = {'type': kind, 'headers': [(k, v.encode()) for k, v in headers]}
    asyncio.run(Guard(inside, PORT, names)(scope, None, send))
    return sent


@pytest.mark.parametrize('kind', ['http', 'websocket'])
@pytest.mark.parametrize('host', OURS)
def test_ours_is_let_through(kind, host):
    assert answer(kind, [(b'host', host)]) == ['inside']
    origin = (b'origin', f'http://{host}')
    assert answer(kind, [(b'host', host), origin]) == ['inside']


@pytest.mark.parametrize('host', FOREIGN)
def test_a_foreign_host_is_refused(host):
    assert answer('http', [(b'host', host)])[0] == 403
    assert answer('websocket', [(b'host', host)]) == [1008]


@pytest.mark.parametrize('origin', ORIGINS)
def test_a_foreign_origin_is_refused(origin):
    headers = [(b'host', '127.0.0.1:8470'), (b'origin', origin)]
    assert answer('http', headers)[0] == 403
    assert answer('websocket', headers) == [1008]


@pytest.mark.parametrize('headers', [[], [(b'host', 'localhost:8470')] * 2])
def test_no_host_and_two_hosts_are_refused(headers):
    assert answer('http', headers)[0] == 403


def test_two_origins_must_both_be_ours():
    headers = [(b'host', 'localhost:8470'), (b'Origin', 'http://localhost:8470')]
    assert answer('http', [*headers, (b'ORIGIN', 'http://evil.example')])[0] == 403


def test_names_that_are_given_are_ours():
    headers = [(b'host', 'golf.lan:8470'), (b'origin', 'http://golf.lan:8470')]
    assert answer('websocket', headers, ('golf.lan',)) == ['inside']
    assert answer('websocket', headers) == [1008]
