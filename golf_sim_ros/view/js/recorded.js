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

// A recorded play with a clock of its own: play, pause, slower, faster, any time, any shot.

export const SPEEDS = [0.25, 0.5, 1, 2, 4];

const BEFORE = 1.2; // s shown before a strike
const AFTER = 2.5; // s shown after the end of a shot; the wait until the next one is left out

// The bytes of `play_data.py`: 'PLAY', length of JSON, JSON, rows of time, x, y, z of each ball.
export function unpackPlay(buffer) {
  const view = new DataView(buffer);
  if (view.getUint32(0) !== 0x504c4159) throw new Error("this is no recorded play");
  const length = view.getUint32(4, true);
  const about = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 8, length)));
  let at = 8 + length;
  for (const ball of about.balls) {
    ball.rows = new Float32Array(buffer, at, 4 * ball.count);
    at += 16 * ball.count;
  }
  return about;
}

export class RecordedSource {
  constructor(view, play, onEvent) {
    Object.assign(this, { view, play, onEvent });
    this.speed = 1;
    this.playing = true;
    this.shot = -1;
    this.start = play.shots.length ? play.shots[0].start - BEFORE : 0;
    this.end = play.shots.length ? Math.max(...play.shots.map((shot) => shot.end)) + AFTER : 0;
    this.time = this.start;
    this.last = null;
    this.drawn = null;
  }

  // Time without the waits between shots, and its whole: for the slider.
  get spans() {
    this.found ??= this.play.shots.map((shot, n) => {
      const next = this.play.shots[n + 1];
      const until = next ? Math.min(shot.end + AFTER, Math.max(next.start - BEFORE, shot.start)) : shot.end + AFTER;
      return [shot.start - BEFORE, until];
    });
    return this.found;
  }

  seek(time) {
    this.time = Math.min(this.end, Math.max(this.start, time));
    this.drawn = null;
  }

  toShot(number) {
    const { shots } = this.play;
    if (!shots.length) return;
    this.seek(shots[Math.min(shots.length - 1, Math.max(0, number))].start - BEFORE);
    this.playing = true;
  }

  current(time) {
    let found = 0;
    this.play.shots.forEach((shot, n) => {
      if (shot.start - BEFORE <= time) found = n;
    });
    return found;
  }

  // Row of a ball's poses at or before a time.
  row(ball, time) {
    let low = 0, high = ball.count - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (ball.rows[4 * middle] <= time) low = middle;
      else high = middle - 1;
    }
    return low;
  }

  update(now) {
    const passed = this.last === null ? 0 : Math.min(0.5, now - this.last);
    this.last = now;
    if (this.playing) this.time += this.speed * passed;
    if (this.time >= this.end) {
      this.time = this.end;
      this.playing = false;
    }
    const shot = this.current(this.time), span = this.spans[shot];
    if (this.playing && span && this.time > span[1] && this.play.shots[shot + 1]) this.time = this.play.shots[shot + 1].start - BEFORE;
    if (this.drawn === this.time) return false;
    const jumped = this.drawn === null || this.time < this.drawn;
    this.drawn = this.time;
    this.draw(jumped);
    return this.playing;
  }

  draw(jumped) {
    const number = this.current(this.time), shot = this.play.shots[number];
    const anew = number !== this.shot || jumped;
    this.play.balls.forEach((ball, n) => this.move(ball, n, shot, anew));
    if (!shot) return;
    this.view.followed = shot.ball;
    if (anew) this.onEvent({ kind: "shot", number, shot });
    this.shot = number;
    const over = this.time >= shot.end;
    if (anew || over !== this.over) this.onEvent(over ? { kind: "result", ...shot.result } : { kind: "strike", ball: shot.ball });
    this.over = over;
    const wind = this.play.wind.filter((row) => row[0] <= this.time).pop() ?? this.play.wind[0];
    if (wind) this.onEvent({ kind: "wind", wind: wind.slice(1) });
  }

  move(ball, n, shot, anew) {
    const body = this.view.ball(n), k = this.row(ball, this.time), r = ball.rows, own = shot && shot.ball === n;
    const next = Math.min(k + 1, ball.count - 1), span = r[4 * next] - r[4 * k];
    const share = span > 0 ? Math.min(1, Math.max(0, (this.time - r[4 * k]) / span)) : 0;
    const begun = own && this.time >= shot.start, ended = !own || this.time >= shot.end;
    const at = (m) => [r[4 * m + 1], r[4 * m + 2], r[4 * m + 3]];
    const to = at(k).map((c, i) => c + share * (at(next)[i] - c));
    body.moving = begun && !ended;
    body.velocity.set(...(body.moving && span > 0 ? at(next).map((c, i) => (c - at(k)[i]) / span) : [0, 0, 0]));
    if (own && anew) {
      body.place.set(...at(this.row(ball, shot.start)));
      body.begin();
      this.added = this.row(ball, shot.start);
    }
    if (begun) for (; this.added < k && r[4 * this.added] < shot.end; this.added++) body.tracer.add(...at(this.added + 1));
    body.moveTo(...to);
  }
}
