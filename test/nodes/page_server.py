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

"""What tests of the page share: its server, and one that listens as a browser does."""

import asyncio
from contextlib import contextmanager, suppress
import json
import threading

import aiohttp
from processes import wait_until
import pytest

POSE = 20  # bytes


class Listener:
    """Hears what the page's websocket says, in a thread of its own, as a browser that draws."""

    def __init__(self, url):
        self.url, self.events, self.poses, self.bytes = url, [], [], 0
        self.loop = asyncio.new_event_loop()
        self.task = self.loop.create_task(self.listen())
        self.thread = threading.Thread(target=self.run)
        self.thread.start()

    def run(self):
        with suppress(asyncio.CancelledError, ConnectionError):
            self.loop.run_until_complete(self.task)

    async def listen(self):
        async with aiohttp.ClientSession() as session:
            async with session.ws_connect(f'{self.url}/feed') as socket:
                async for message in socket:
                    self.bytes += len(message.data) + 4
                    if message.type is aiohttp.WSMsgType.BINARY:
                        starts = range(0, len(message.data), POSE)
                        self.poses += [message.data[at:][:POSE] for at in starts]
                        continue
                    self.events.append(json.loads(message.data))
                    if self.events[-1]['kind'] == 'course':
                        async with session.get(self.url + self.events[-1]['url']) as answer:
                            self.course = await answer.read()
                        await socket.send_str('ready')

    def of(self, kind):
        """Events of a kind so far."""
        return [event for event in list(self.events) if event['kind'] == kind]

    def wait_for(self, kind, count=1):
        """Wait for so many events of a kind; the latest of them."""
        wait_until(lambda: len(self.of(kind)) >= count, f'{count} {kind} at {self.url}')
        return self.of(kind)[-1]

    def close(self):
        self.loop.call_soon_threadsafe(self.task.cancel)
        self.thread.join()
        self.loop.close()


@contextmanager
def listening(url):
    """Connect a `Listener` to a page's server."""
    wait_until(lambda: url, 'the page is there')
    listener = Listener(url)
    try:
        wait_until(lambda: listener.events, 'the page said something')
        yield listener
    finally:
        listener.close()


def served(start, *command):
    """Process of a page's server, and its URL.

    NiceGUI would wait for a test framework of its own where it sees pytest.
    """
    with pytest.MonkeyPatch.context() as patch:
        patch.delenv('PYTEST_CURRENT_TEST', raising=False)
        process = start(*command)
    return process, process.wait_for('http://').split()[0]
