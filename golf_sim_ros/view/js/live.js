// Copyright 2026 golf_sim_ros maintainers
//
// Licensed under the Apache License, Version 2.0 (the "License");
// you may not use this file except in compliance with the License.
// You may obtain a copy of the License at
//
//     http://www.apache.org/licenses/LICENSE-2.0
//
// Unless required by applicable law or agreed to in writing, software
// distributed under the License is distributed on an "AS IS" BASIS,
// WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
// See the License for the specific language governing permissions and
// limitations under the License.

// Balls that are moved by poses as they arrive, a little later, so that they move smoothly.

const DELAY = 0.12; // s
const MOST = 2000; // poses that wait at most
const REST = 0.5; // s after the last pose of a ball at which its shot was told to be over

export class LiveSource {
  constructor(view) {
    this.view = view;
    this.queues = new Map();
    this.offset = null; // page's time less the sim's
    this.arrived = [];
  }

  // A pose of a ball at the sim's time [s]. Impacts come on a topic of their own, not always in order.
  pose(number, time, x, y, z, past) {
    const now = performance.now() / 1000, ball = this.view.ball(number);
    if (past) {
      if (!ball.tracer.count) ball.moveTo(x, y, z);
      ball.tracer.add(x, y, z);
      ball.moveTo(x, y, z);
      this.view.changed = true;
      return;
    }
    if (this.offset === null || Math.abs(now - time - this.offset) > 2) this.offset = now - time;
    this.offset = Math.min(this.offset + 0.002, now - time);
    const queue = this.queue(number);
    let at = queue.length;
    while (at > 0 && queue[at - 1][0] > time) at--;
    queue.splice(at, 0, [time, x, y, z]);
    if (queue.length > MOST) queue.shift();
    if (window.golfArrivals) window.golfArrivals.push([now, number, time, x, y, z]);
  }

  queue(number) {
    if (!this.queues.has(number)) this.queues.set(number, []);
    return this.queues.get(number);
  }

  strike(number, time) {
    const ball = this.view.ball(number);
    ball.begin();
    this.queue(number).length = 0;
    this.view.followed = number;
  }

  forget() {
    this.queues.clear();
    this.offset = null;
  }

  // Move all balls to where they were `DELAY` ago; whether any moves.
  update(now) {
    let moved = false;
    for (const [number, queue] of this.queues) {
      const ball = this.view.ball(number), time = now - this.offset - DELAY;
      while (queue.length > 1 && queue[1][0] <= time) {
        const [, x, y, z] = queue.shift();
        if (ball.moving) ball.tracer.add(x, y, z);
      }
      if (!queue.length || queue[0][0] > time && ball.seen) continue;
      const a = queue[0], b = queue[1] ?? a, span = b[0] - a[0];
      const share = span > 0 ? Math.min(1, Math.max(0, (time - a[0]) / span)) : 0;
      const to = [1, 2, 3].map((k) => a[k] + share * (b[k] - a[k]));
      const way = Math.hypot(to[0] - ball.place.x, to[1] - ball.place.y, to[2] - ball.place.z);
      if (span > 0) ball.velocity.set(...[1, 2, 3].map((k) => (b[k] - a[k]) / span));
      if (way > 1e-4 || !ball.seen) {
        moved = true;
        if (span > 0 && span < 0.5) ball.moving = true;
      }
      ball.moveTo(...to);
      if (queue.length === 1 && time > a[0] + REST) {
        if (ball.moving) ball.tracer.add(...to);
        ball.moving = false;
        ball.velocity.set(0, 0, 0);
        queue.length = 0;
        this.view.changed = true;
      }
    }
    return moved || this.view.balls.some((ball) => ball.moving);
  }
}

// The server's words: JSON as text, poses as 20 bytes each.
export class Feed {
  constructor(url, onPose, onEvent, onLink) {
    this.url = url;
    Object.assign(this, { onPose, onEvent, onLink });
    this.open();
  }

  open() {
    const socket = (this.socket = new WebSocket(this.url));
    socket.binaryType = "arraybuffer";
    socket.onopen = () => this.onLink(true);
    socket.onmessage = ({ data }) => (typeof data === "string" ? this.onEvent(JSON.parse(data)) : this.poses(data));
    socket.onclose = () => {
      if (this.closed) return;
      this.onLink(false);
      this.timer = setTimeout(() => this.open(), 1000);
    };
  }

  poses(data) {
    const view = new DataView(data);
    for (let at = 0; at + 20 <= data.byteLength; at += 20) {
      const number = view.getUint8(at), past = view.getUint8(at + 1) === 1;
      const place = [8, 12, 16].map((k) => view.getFloat32(at + k, true));
      this.onPose(number, view.getUint32(at + 4, true) / 10000, ...place, past);
    }
  }

  close() {
    this.closed = true;
    clearTimeout(this.timer);
    this.socket.close();
  }
}
