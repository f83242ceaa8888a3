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

"""A guard before the page: any web page could otherwise strike the ball through a browser.

A browser tells with each request which host it means (DNS rebinding shows there) and with those
that other sites make, where it comes from. What is foreign is refused, websockets too.
"""

from collections.abc import Callable, Sequence
from typing import Any

LOCAL = ('127.0.0.1', 'localhost', '::1')
ANY = ('0.0.0.0', '::', '')  # addresses that mean all of a machine's


class Guard:
    """ASGI application in front of another one: 403 for a foreign Host or Origin.

    Parameters
    ----------
    app : callable
        The application behind.
    port : int
    names : sequence of str
        Hosts by which this server is called, beside this machine's own.
    """

    def __init__(self, app: Callable[..., Any], port: int, names: Sequence[str] = ()) -> None:
        self.app = app
        hosts = {f'[{name}]' if name.count(':') > 1 else name.lower() for name in (*LOCAL, *names)}
        self.hosts = {f'{host}:{port}' for host in hosts} | (hosts if port == 80 else set())

    async def __call__(
        self, scope: dict[str, Any], receive: Callable[..., Any], send: Callable[..., Any]
    ) -> None:
        """Hand on what is meant for this server, refuse all else."""
        if scope['type'] not in ('http', 'websocket') or self.is_right(scope['headers']):
            await self.app(scope, receive, send)
        elif scope['type'] == 'websocket':
            await send({'type': 'websocket.close', 'code': 1008})  # before accept: a 403
        else:
            headers = [(b'content-type', b'text/plain')]
            await send({'type': 'http.response.start', 'status': 403, 'headers': headers})
            await send({'type': 'http.response.body', 'body': b'foreign host or origin\n'})

    def is_right(self, headers: list[tuple[bytes, bytes]]) -> bool:
        """Whether each Host and Origin in `headers`, pairs of bytes, is one of ours."""
        told = [(name.lower(), value.decode('latin-1').lower()) for name, value in headers]
        hosts = [value for name, value in told if name == b'host']
        origins = [value for name, value in told if name == b'origin']
        return (
            len(hosts) == 1
            and hosts[0] in self.hosts
            and all(
                origin.startswith('http://') and origin.removeprefix('http://') in self.hosts
                for origin in origins
            )
        )
