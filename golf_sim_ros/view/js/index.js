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

// The page's picture, with what lies over it: of a live play, or of a recorded one.
import { Hud } from "./hud.js";
import { unpack } from "./land.js";
import { Feed, LiveSource } from "./live.js";
import { RecordedSource, unpackPlay } from "./recorded.js";
import { GolfView } from "./view.js";

export class GolfPage {
  constructor(box, { units } = {}) {
    this.view = new GolfView(box);
    this.hud = new Hud(box, this.view, units);
    this.view.onFrame = (now) => this.hud.frame(now);
  }

  showCourse(buffer) {
    const land = unpack(buffer);
    this.view.show(land);
    this.hud.show(land);
    this.hud.showResult(null);
  }

  // Follow what a server sends.
  listen(url) {
    this.live = this.view.source = new LiveSource(this.view);
    this.waiting = Promise.resolve();
    this.ready = false;
    const poses = (...pose) => this.ready && this.live.pose(...pose);
    this.feed = new Feed(url, poses, (event) => this.onEvent(event), (up) => {
      this.linked = up;
      if (!up) this.hud.say("The page's server cannot be reached", true);
    });
  }

  onEvent(event) {
    const { hud, live, view } = this;
    if (event.kind === "course") return this.fetchCourse(event);
    if (event.kind === "status") return this.showStatus(event);
    if (event.kind === "score") return hud.update(event);
    if (event.kind === "wind") {
      view.wind = event.wind;
      return hud.blow(event.wind);
    }
    if (!this.ready) return undefined;
    if (event.kind === "strike") {
      hud.showResult(null);
      view.hideHints();
      live.strike(event.ball, event.time);
    } else if (event.kind === "result") {
      hud.showResult(event);
    }
    return undefined;
  }

  async fetchCourse({ url }) {
    if (url === this.url) {
      // The same course: a hole begins anew, or the server is back.
      this.live.forget();
      this.view.begin();
      this.hud.showResult(null);
      this.feed.socket.send("ready");
      return;
    }
    this.ready = false;
    const answer = await fetch(url);
    if (!answer.ok) return;
    const buffer = await answer.arrayBuffer();
    this.url = url;
    this.live.forget();
    this.showCourse(buffer);
    this.ready = true;
    this.feed.socket.send("ready");
  }

  showStatus({ reached, text }) {
    this.hud.say(text, !reached && Boolean(text));
  }

  // A recorded play, whole.
  replay(buffer) {
    const play = unpackPlay(buffer), { hud, view } = this;
    const source = new RecordedSource(view, play, (event) => {
      if (event.kind === "wind") {
        view.wind = event.wind;
        hud.blow(event.wind);
      } else if (event.kind === "result") {
        hud.showResult(event);
      } else if (event.kind === "strike") {
        hud.showResult(null);
      } else if (event.kind === "shot") {
        hud.update({ stroke: event.shot.result.stroke ?? null, hole: "" });
      }
    });
    view.source = this.recorded = source;
    hud.addTimeline(source);
  }

  close() {
    this.feed?.close();
    this.hud.close();
    this.view.close();
  }
}
