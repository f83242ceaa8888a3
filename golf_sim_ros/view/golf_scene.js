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

// The page's picture as a component of NiceGUI: `js/` does the work.
import { GolfPage } from "golf-view";

export default {
  template: '<div style="position:absolute;inset:0"><div v-if="problem" style="position:absolute;inset:0;display:grid;place-items:center;padding:2em">{{ problem }}</div></div>',
  props: { feed: String, course: String, play: String, units: String },
  data: () => ({ problem: "" }),
  async mounted() {
    let page;
    try {
      page = new GolfPage(this.$el, { units: this.units });
    } catch (error) {
      this.problem = `This browser shows no 3D picture: ${error.message}`;
      return;
    }
    // Outside of data(): Vue must not watch what is drawn.
    this._page = window.golf = page;
    if (this.feed) {
      const scheme = location.protocol === "https:" ? "wss:" : "ws:";
      page.listen(`${scheme}//${location.host}${this.feed}`);
    } else {
      page.showCourse(await this.read(this.course));
      page.replay(await this.read(this.play));
    }
    this.$emit("ready");
  },
  unmounted() {
    this._page?.close();
  },
  methods: {
    async read(url) {
      return (await fetch(url)).arrayBuffer();
    },
    predict(hint) {
      this._page?.view.predict(hint);
    },
    readGreen(kind, rows) {
      if (kind === "slopes") this._page?.view.showSlopes(rows);
      else this._page?.view.showLine(rows);
    },
    hideHints() {
      this._page?.view.hideHints();
    },
    hideLine() {
      this._page?.view.hideLine();
    },
    choose(mode) {
      this._page?.hud.choose(mode);
    },
  },
};
