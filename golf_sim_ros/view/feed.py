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

"""What browsers are told of a play: the state now, and what changes. Bounded, whatever they read.

A pose is 20 bytes, little endian: u8 ball, u8 whether it is past, u16 0, u32 time [1e-4 s],
3 f32 place [m]. All else is JSON. One thread calls all of this: that of the event loop.
"""

import asyncio
from collections import deque
import json
import struct
from typing import Any

from .course_data import CourseData

Pose = tuple[float, float, float, float]  # time, x, y, z

POSE = struct.Struct('<BBHI3f')
PAST = 1
THIN = 0.0385  # s between poses that are sent: 25 a second of the sim's 50
STILL = 5e-4  # m: a ball that moved less lies still
TRAIL = 250  # poses of the last shot that a new browser gets
QUEUE = 800  # messages that may wait for a browser: then it is dropped, and connects anew
WIND_STEP = 0.15  # m/s: smaller changes of the wind are not told
WIND_GAP = 1.0  # s from one telling of the wind to the next


class Client:
    """One browser's queue of messages, text and bytes."""

    def __init__(self) -> None:
        self.waiting: deque[str | bytes] = deque()
        self.news, self.ended = asyncio.Event(), asyncio.Event()
        self.ready = self.closed = False

    def put(self, message: str | bytes) -> None:
        """Add a message; a queue that is full is closed."""
        if len(self.waiting) >= QUEUE:
            self.close()
        if not self.closed:
            self.waiting.append(message)
            self.news.set()

    def close(self) -> None:
        """Let go of all that waits."""
        self.closed = True
        self.ended.set()
        self.waiting.clear()
        self.news.set()

    async def take(self) -> str | bytes | None:
        """Next message, poses that wait joined into one; None once it is closed."""
        while not self.waiting:
            if self.closed:
                return None
            self.news.clear()
            await self.news.wait()
        message = self.waiting.popleft()
        if isinstance(message, str):
            return message
        while self.waiting and isinstance(self.waiting[0], bytes):
            more = self.waiting.popleft()
            assert isinstance(more, bytes)
            message += more
        return message


class Ball:
    """What is known of one ball: the last pose that was sent and that was heard, its trail."""

    def __init__(self, name: str) -> None:
        self.name = name
        self.sent: Pose | None = None
        self.heard: Pose | None = None
        self.trail: list[Pose] = []
        self.every = 1  # of the poses sent, those that the trail keeps
        self.count = 0


class Feed:
    """State of a play, told to every browser that listens."""

    def __init__(self) -> None:
        self.clients: set[Client] = set()
        self.course: CourseData | None = None
        self.balls: list[Ball] = []
        self.status: dict[str, Any] = {
            'kind': 'status',
            'reached': False,
            'text': 'Looking for a sim ...',
        }
        self.wind: tuple[float, ...] = (0.0, 0.0, 0.0)
        self.wind_told = -1e9
        self.score: dict[str, Any] = {}
        self.last: dict[str, Any] | None = None  # the last result, until the next strike

    def connect(self) -> Client:
        """Queue of a new browser, which begins with the course."""
        client = Client()
        self.clients.add(client)
        client.put(json.dumps(self.status))
        if self.course:
            client.put(self.about_course())
        return client

    def disconnect(self, client: Client) -> None:
        """Forget a browser."""
        client.close()
        self.clients.discard(client)

    def close(self) -> None:
        """Let all browsers go."""
        for client in list(self.clients):
            self.disconnect(client)

    def about_course(self) -> str:
        """Message that names the course."""
        tag = self.course.tag if self.course else ''
        return json.dumps({'kind': 'course', 'url': f'/course/{tag}.bin'})

    def show_course(self, course: CourseData, names: list[str]) -> None:
        """Begin anew: another course, or another sim; `names` are its balls."""
        self.course, self.balls, self.last = course, [Ball(name) for name in names], None
        self.wind_told = -1e9
        for client in list(self.clients):
            client.ready = False
            client.put(self.about_course())

    def catch_up(self, client: Client) -> None:
        """Tell a browser that has drawn the course what has happened on it."""
        client.ready = True
        client.put(json.dumps({'kind': 'wind', 'wind': self.wind}))
        if self.score:
            client.put(json.dumps({'kind': 'score', **self.score}))
        for number, ball in enumerate(self.balls):
            past = [packed(number, pose, PAST) for pose in ball.trail]
            past += [packed(number, ball.sent, PAST)] if ball.sent else []
            if past:
                client.put(b''.join(past))
        if self.last:
            client.put(json.dumps(self.last))

    def tell(self, message: str | bytes) -> None:
        """Send a message to every browser that has drawn the course."""
        for client in list(self.clients):
            if client.ready:
                client.put(message)

    def pose(
        self, number: int, time: float, place: tuple[float, float, float], exact: bool = False
    ) -> None:
        """Tell a ball's place; `exact` is an impact, which is never left out."""
        ball = self.balls[number]
        before, ball.heard = ball.sent, (time, *place)
        if before and not exact:
            still = max(abs(a - b) for a, b in zip(before[1:], place)) < STILL
            if still or 0.0 <= time - before[0] < THIN:
                return
        self.send(number, ball, (time, *place))

    def send(self, number: int, ball: Ball, pose: Pose) -> None:
        """Tell a pose that is not left out."""
        ball.sent = max(ball.sent or pose, pose)
        self.tell(packed(number, pose, 0))
        if ball.count % ball.every == 0:
            ball.trail.append(pose)
        ball.count += 1
        if len(ball.trail) > TRAIL:
            ball.trail, ball.every = ball.trail[::2], 2 * ball.every

    def strike(self, number: int, time: float) -> None:
        """Tell that a ball was struck."""
        ball = self.balls[number]
        ball.trail, ball.every, ball.count = [ball.sent] if ball.sent else [], 1, 0
        self.last = None
        self.tell(json.dumps({'kind': 'strike', 'ball': number, 'time': time}))

    def result(self, result: dict[str, Any]) -> None:
        """Tell the end of a shot, and where exactly its ball was last seen."""
        number = next((n for n, ball in enumerate(self.balls) if ball.name == result['ball']), 0)
        ball = self.balls[number] if self.balls else None
        if ball and ball.heard and ball.heard != ball.sent:
            self.send(number, ball, ball.heard)
        self.last = {'kind': 'result', **result}
        self.tell(json.dumps(self.last))

    def blow(self, wind: tuple[float, float, float], now: float) -> None:
        """Tell the wind, where it changed by what can be seen, and not too often."""
        changed = max(abs(a - b) for a, b in zip(wind, self.wind)) >= WIND_STEP
        if changed and now - self.wind_told >= WIND_GAP:
            self.wind, self.wind_told = tuple(round(float(v), 2) for v in wind), now
            self.tell(json.dumps({'kind': 'wind', 'wind': self.wind}))

    def say(self, reached: bool, text: str) -> None:
        """Tell whether the sim can be reached, and a line about it, in every browser."""
        status = {'kind': 'status', 'reached': reached, 'text': text}
        if status != self.status:
            self.status = status
            for client in list(self.clients):
                client.put(json.dumps(status))

    def tell_score(self, score: dict[str, Any]) -> None:
        """Tell hole, par and stroke."""
        if score != self.score:
            self.score = score
            self.tell(json.dumps({'kind': 'score', **score}))


def packed(number: int, pose: Pose, past: int) -> bytes:
    """Bytes of a pose: time, x, y, z."""
    ticks = int(round(1e4 * pose[0])) % 2**32
    return POSE.pack(number % 256, past, 0, ticks, *pose[1:])
