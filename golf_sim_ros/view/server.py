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

"""The page's server: on this machine only unless told otherwise; a signal ends it with code 0."""

import asyncio
from collections.abc import Callable
from contextlib import suppress
import errno
import gzip
import os
import signal
import socket
import sys
from typing import NamedTuple, NoReturn
import zlib

from fastapi import Request, Response, WebSocket, WebSocketDisconnect
from nicegui import app, ui
from nicegui.server import Server

from .course_data import CourseData
from .feed import Client, Feed
from .guard import ANY, Guard

FIRST_PORT, PORTS = 8470, 30
TAKEN = (errno.EADDRINUSE, errno.EACCES)
GRACE = 1  # s that browsers get to hang up
PATIENCE = 20.0  # s for which a browser that draws slowly may say nothing
LOOK = 0.05  # s from one look at whether to end to the next


class Place(NamedTuple):
    """Where a server listens: address, port, and further names of this machine."""

    address: str = '127.0.0.1'
    port: int = 0
    names: tuple = ()


def free_port(address: str) -> int:
    """First port from `FIRST_PORT` on that nobody listens on, or any that is free; or OSError."""
    for port in (*range(FIRST_PORT, FIRST_PORT + PORTS), 0):
        family = socket.AF_INET6 if ':' in address else socket.AF_INET
        with socket.socket(family, socket.SOCK_STREAM) as probe:
            probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            try:
                probe.bind((address, port))
                return probe.getsockname()[1]
            except OSError as error:
                if error.errno not in TAKEN:
                    raise OSError(f'{address}: {error.strerror}') from None
    raise OSError(f'no port is free on {address}')


def serve_bytes(path: str, find: Callable) -> None:
    """Serve compressed bytes below `path`: `find` gives those of a name, or None.

    The name says what they are, so a browser keeps them.
    """

    @app.get(path + '/{name}.bin')
    def answer(name: str, request: Request) -> Response:
        data = find(name)
        if data is None:
            return Response(status_code=404)
        tag = f'"{name}"'
        if request.headers.get('if-none-match') == tag:
            return Response(status_code=304, headers={'ETag': tag})
        return Response(
            data,
            media_type='application/octet-stream',
            headers={'Content-Encoding': 'gzip', 'ETag': tag, 'Cache-Control': 'no-cache'},
        )


def serve_feed(feed: Feed) -> None:
    """Serve a play's course and its websocket."""

    def find(name: str) -> bytes | None:
        course = feed.course
        return course.packed if course and course.tag == name else None

    serve_bytes('/course', find)

    @app.websocket('/feed')
    async def tell(socket_: WebSocket) -> None:
        await socket_.accept()
        client = feed.connect()
        hearing = asyncio.create_task(hear(socket_, feed, client))
        telling = asyncio.create_task(talk(socket_, client))
        ended = asyncio.create_task(client.ended.wait())
        tasks = (hearing, telling, ended)
        try:
            await asyncio.wait(tasks, return_when=asyncio.FIRST_COMPLETED)
        finally:
            feed.disconnect(client)
            for task in tasks:
                task.cancel()
            await asyncio.gather(*tasks, return_exceptions=True)
        with suppress(RuntimeError, WebSocketDisconnect):
            await asyncio.wait_for(socket_.close(), 0.2)


async def hear(socket_: WebSocket, feed: Feed, client: Client) -> None:
    """Take the one thing that a browser says: that it has drawn the course."""
    with suppress(WebSocketDisconnect, RuntimeError, KeyError):
        while True:
            if await socket_.receive_text() == 'ready' and not client.ready:
                feed.catch_up(client)


async def talk(socket_: WebSocket, client: Client) -> None:
    """Send what waits for a browser."""
    with suppress(WebSocketDisconnect, RuntimeError):
        while (message := await client.take()) is not None:
            await (socket_.send_text if isinstance(message, str) else socket_.send_bytes)(message)


failures: list[Exception] = []  # of what was to be done at the start


def run(
    place: Place, title: str, opened: Callable, closing: Callable, closed: Callable
) -> NoReturn:
    """Serve until a signal comes, then end the process.

    Parameters
    ----------
    place : Place
        Its port is not 0.
    title : str
    opened : callable
        Called with the URL when the page can be opened.
    closing : callable
        Called as soon as the server is told to end; must not wait.
    closed : callable
        Called when it has ended.

    Raises
    ------
    RuntimeError
        What was to be done at the start has failed.
    """
    named = () if place.address in ANY else (place.address,)
    app.add_middleware(Guard, port=place.port, names=(*named, *place.names))

    async def watch() -> None:
        while not Server.instance.started:
            await asyncio.sleep(LOOK)
        if failures:
            Server.instance.should_exit = True
        else:
            opened(url(place))
        while not Server.instance.should_exit:
            await asyncio.sleep(LOOK)
        closing()

    tasks = []
    app.on_startup(lambda: tasks.append(asyncio.create_task(watch())))
    for number in (signal.SIGINT, signal.SIGTERM):
        # uvicorn has handlers of its own while it runs, and raises the signal anew at its end
        signal.signal(number, lambda *_: sys.exit(0))
    try:
        ui.run(
            host=place.address,
            port=place.port,
            title=title,
            show=False,
            reload=False,
            tailwind=False,
            show_welcome_message=False,
            favicon='⛳',
            reconnect_timeout=PATIENCE,
            timeout_graceful_shutdown=GRACE,
            uvicorn_logging_level='error',
        )
        code = 0
    except SystemExit as ended:
        code = 1 if ended.code else 0
    finally:
        for number in (signal.SIGINT, signal.SIGTERM):
            signal.signal(number, signal.SIG_IGN)
        closed()
    if failures:
        raise RuntimeError(failures[0]) from failures[0]
    leave(code)


def leave(code: int) -> NoReturn:
    """End the process: all is closed, and Python would take one or two seconds to tidy up."""
    for stream in (sys.stdout, sys.stderr):
        with suppress(OSError, ValueError):
            stream.flush()
    os._exit(code)


def url(place: Place) -> str:
    """URL of the page."""
    address = '127.0.0.1' if place.address in ANY else place.address
    return f'http://{f"[{address}]" if ":" in address else address}:{place.port}'


def serve_replay(course: CourseData, play: bytes, build: Callable) -> None:
    """Serve a recorded play; `build` makes the page from the URLs of course and play."""
    name, packed = f'{zlib.crc32(play):08x}', gzip.compress(play, 9, mtime=0)
    serve_bytes('/course', {course.tag: course.packed}.get)
    serve_bytes('/play', {name: packed}.get)
    show('/', lambda: build(f'/course/{course.tag}.bin', f'/play/{name}.bin'))


def show(path: str, build: Callable) -> None:
    """Show what `build` makes at `path`, anew for each browser."""

    @ui.page(path)
    def page() -> None:
        build()


def at_start(act: Callable) -> None:
    """Call `act` in the event loop when the server starts, which ends where that fails."""

    def start() -> None:
        try:
            act()
        except Exception as error:
            failures.append(error)

    app.on_startup(start)
