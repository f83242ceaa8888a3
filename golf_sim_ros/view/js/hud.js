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

// What lies over the picture: head, wind, map, cards, cameras, timeline. Plain elements, no framework.
import { CAMERAS } from "./cameras.js";
import { SPEEDS } from "./recorded.js";

const YARD = 0.9144;
const FOOT = 0.3048;
const LEAST_APEX = 0.1; // m that a ball rises at least if it flew: a putt that drops in has a carry, too
const ENDINGS = { holed: "In the hole", water: "In the water", out_of_bounds: "Out of bounds", time_limit: "Still moving", aborted: "Ended by a reset", failed: "Failed", rejected: "Not played" };
const TITLES = { behind: "Behind the ball", broadcast: "Broadcast", above: "From above", pin: "At the pin", free: "Free: drag, wheel" };
const ICONS = {
  behind: "M4 19l8-14 8 14M8.5 19l3.5-6 3.5 6",
  broadcast: "M3 8h11v9H3zM14 11l6-3v9l-6-3",
  above: "M12 3v18M3 12h18M12 7a5 5 0 100 10 5 5 0 000-10",
  pin: "M8 21V3l10 4-10 4",
  free: "M12 3a9 9 0 100 18 9 9 0 000-18M3 12h18M12 3c4 5 4 13 0 18M12 3c-4 5-4 13 0 18",
};

const STYLE = `
.golf{position:absolute;inset:0;overflow:hidden;font:15px/1.35 "Segoe UI",Roboto,"Helvetica Neue",Arial,sans-serif;color:#fff;user-select:none;background:#bcd3e2}
.golf .over{position:absolute;z-index:2;pointer-events:none}
.golf .glass{background:linear-gradient(#0d2015d9,#0a180fd9);border:1px solid #ffffff24;border-radius:9px;box-shadow:0 3px 14px #00000038;backdrop-filter:blur(3px)}
.golf .head{padding:9px 15px 10px;min-width:150px}
.golf .head b{font-size:19px;font-weight:650;letter-spacing:.01em}
.golf .head .sub{opacity:.8;font-size:13px}
.golf .head .big{font-size:27px;font-weight:680;font-variant-numeric:tabular-nums;margin-top:2px}
.golf .head .big small{font-size:14px;font-weight:500;opacity:.85;margin-left:6px}
.golf .right{right:16px;top:14px;display:flex;flex-direction:column;gap:8px;align-items:flex-end}
.golf .left{left:16px;top:14px;display:flex;flex-direction:column;gap:8px;align-items:flex-start}
.golf .wind{width:86px;height:86px;border-radius:50%;display:grid;place-items:center;position:relative}
.golf .wind svg{position:absolute;inset:0}
.golf .wind span{font-size:17px;font-weight:680;line-height:1;text-align:center;font-variant-numeric:tabular-nums;text-shadow:0 0 4px #000}
.golf .wind span small{display:block;font-size:9.5px;font-weight:500;opacity:.85;margin-top:1px}
.golf .map{padding:5px;line-height:0}
.golf .map canvas{border-radius:5px}
.golf .cams{pointer-events:auto;display:flex;gap:2px;padding:3px}
.golf .cams button,.golf .line button{all:unset;cursor:pointer;width:27px;height:27px;display:grid;place-items:center;border-radius:6px;opacity:.72}
.golf .cams button:hover,.golf .line button:hover{opacity:1;background:#ffffff1f}
.golf .cams button.on{opacity:1;background:#4f9e48}
.golf .cams button:focus-visible,.golf .line button:focus-visible{outline:2px solid #ffd84a}
.golf svg.icon{width:17px;height:17px;fill:none;stroke:#fff;stroke-width:1.8;stroke-linejoin:round;stroke-linecap:round}
.golf .cards{left:16px;bottom:16px;display:flex;gap:4px;flex-wrap:wrap;max-width:calc(100% - 300px)}
.golf .cards div{padding:6px 13px 7px;min-width:58px;text-align:center}
.golf .cards small{display:block;opacity:.72;font-size:10.5px;text-transform:uppercase;letter-spacing:.07em}
.golf .cards span{font-size:18px;font-weight:640;font-variant-numeric:tabular-nums;white-space:nowrap}
.golf .cards .end{background:linear-gradient(#7a5a12e0,#5d430be0)}
.golf .cards .end.holed{background:linear-gradient(#2f7d36e0,#22622ae0)}
.golf .pin{left:0;top:0;padding:1px 8px 2px;font-size:12.5px;font-weight:600;white-space:nowrap;will-change:transform;border-radius:7px}
.golf .pin::after{content:"";position:absolute;left:50%;bottom:-5px;margin-left:-4px;border:4px solid transparent;border-top-color:#0a180fd9;border-bottom:0}
.golf .note{left:50%;top:18px;transform:translateX(-50%);padding:8px 18px;font-weight:600;max-width:70%;text-align:center}
.golf .note.bad{background:#8c1f1fe6}
.golf .line{left:50%;bottom:16px;transform:translateX(-50%);pointer-events:auto;display:flex;gap:8px;align-items:center;padding:5px 12px}
.golf .line input{width:min(300px,24vw);accent-color:#6fbf5f}
.golf .line .text{font-size:12.5px;min-width:120px;white-space:nowrap;text-align:center;font-variant-numeric:tabular-nums}
.golf .line .speed{width:38px;font-size:13px;font-weight:600}
.golf.recorded .cards{bottom:66px;max-width:calc(100% - 32px)}
.golf [hidden]{display:none!important}
@media (max-width:760px){.golf .cards div{padding:4px 8px;min-width:40px}.golf .cards span{font-size:14px}.golf .head .big{font-size:20px}.golf .wind{width:66px;height:66px}.golf .cards{max-width:calc(100% - 250px)}}
`;

function element(parent, className, html = "", tag = "div") {
  const made = document.createElement(tag);
  made.className = className;
  made.innerHTML = html;
  parent.append(made);
  return made;
}

const escape = (text) => String(text).replace(/[&<>"]/g, (c) => ({ "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;" })[c]);
const icon = (path) => `<svg class="icon" viewBox="0 0 24 24"><path d="${path}"/></svg>`;

export class Hud {
  constructor(box, view, units) {
    Object.assign(this, { box, view });
    this.metric = units === "si";
    box.classList.add("golf");
    element(box, "", STYLE, "style");
    const left = element(box, "over left");
    this.head = element(left, "glass head");
    const right = element(box, "over right");
    this.cams = element(right, "glass cams");
    this.rose = element(right, "glass wind");
    const frame = element(left, "glass map");
    this.map = element(frame, "", "", "canvas");
    this.cards = element(box, "over cards");
    this.pin = element(box, "over glass pin");
    this.note = element(box, "over glass note");
    this.note.hidden = this.pin.hidden = true;
    this.state = { stroke: null, hole: "", par: null, result: null };
    this.buttons();
    this.blow([0, 0, 0]);
    this.keys = (event) => this.onKey(event);
    window.addEventListener("keydown", this.keys);
    let down = null;
    this.canvas = box.querySelector("canvas");
    this.canvas.addEventListener("pointerdown", (e) => (down = [e.clientX, e.clientY]));
    this.canvas.addEventListener("pointermove", (e) => {
      if (down && Math.hypot(e.clientX - down[0], e.clientY - down[1]) > 6 && view.cameras.mode !== "free") this.choose("free");
    });
    window.addEventListener("pointerup", (this.up = () => (down = null)));
  }

  buttons() {
    for (const mode of CAMERAS) {
      const button = element(this.cams, mode === this.view.cameras.mode ? "on" : "", icon(ICONS[mode]), "button");
      button.title = `${TITLES[mode]} (${1 + CAMERAS.indexOf(mode)})`;
      button.setAttribute("aria-label", button.title);
      button.onclick = () => this.choose(mode);
    }
  }

  choose(mode) {
    this.view.choose(mode);
    [...this.cams.children].forEach((button, n) => button.classList.toggle("on", CAMERAS[n] === mode));
  }

  onKey(event) {
    const tag = event.target.tagName;
    if (event.ctrlKey || event.metaKey || event.altKey || (tag === "INPUT" && event.target.type !== "range") || tag === "TEXTAREA") return;
    const mode = CAMERAS[Number(event.key) - 1];
    if (mode) this.choose(mode);
    else if (event.key === "u") this.toggleUnits();
    else if (event.key === " " && this.recorded) this.timelineKey(event);
    else if (event.key === "n" && this.recorded) this.recorded.toShot(this.recorded.shot + 1);
  }

  timelineKey(event) {
    event.preventDefault();
    this.press();
  }

  toggleUnits() {
    this.metric = !this.metric;
    this.showResult(this.state.result);
    this.showHead();
    this.blow(this.view.wind);
  }

  length(meters, digits = 0) {
    if (meters === null || meters === undefined) return "–";
    const unit = this.metric ? 1 : YARD;
    return `${(meters / unit).toFixed(digits)} ${this.metric ? "m" : "yd"}`;
  }

  // A distance as a player says it: feet, or decimetres, near the hole.
  distance(meters) {
    if (meters < 25) return this.metric ? `${meters.toFixed(1)} m` : `${(meters / FOOT).toFixed(meters < 3 ? 1 : 0)} ft`;
    return this.length(meters);
  }

  // Another course.
  show(land) {
    this.land = land;
    this.paintMap();
    this.showHead();
  }

  update(state) {
    Object.assign(this.state, state);
    this.showHead();
  }

  showHead() {
    const { land, view } = this;
    if (!land) return;
    const { hole, par, stroke, name } = this.state, ball = view.balls[view.followed] ?? view.ball(0);
    let text = `<b>${escape(name ?? land.name)}</b>`;
    const parts = [hole && `Hole ${hole}`, par && `Par ${par}`, stroke && `Stroke ${stroke}`].filter(Boolean);
    if (parts.length) text += `<div class="sub">${parts.map(escape).join(" · ")}</div>`;
    if (land.hole) {
      const way = Math.hypot(land.hole[0] - ball.place.x, land.hole[1] - ball.place.y);
      const rise = land.hole[2] - (ball.place.z - land.radius);
      const holed = this.isHoled(ball);
      const small = ball.moving || holed ? "" : `<small>${rise >= 0 ? "▲" : "▼"} ${this.metric || way >= 25 ? this.length(Math.abs(rise), 1) : `${(Math.abs(rise) / FOOT * 12).toFixed(0)} in`}</small>`;
      text += `<div class="big">${holed ? "holed" : this.distance(way)}${small}</div>`;
    }
    const lie = ball.moving ? "in motion" : this.lie(ball).replaceAll("_", " ");
    text += `<div class="sub">${escape(lie)}</div>`;
    if (text !== this.headText) this.head.innerHTML = this.headText = text;
  }

  // Whether a ball still lies where the last result left it.
  isThere(ball) {
    const { x, y, z } = ball.place, p = this.state.result?.position;
    return Boolean(p) && Math.hypot(p[0] - x, p[1] - y, p[2] - z) < 0.05;
  }

  isHoled(ball) {
    return this.state.result?.status === "holed" && this.isThere(ball);
  }

  // What the ball lies on: as the result said where it lies there still, else the ground.
  lie(ball) {
    return (this.isThere(ball) && this.state.result.lie) || this.land.material(ball.place.x, ball.place.y);
  }

  blow(wind) {
    const speed = Math.hypot(wind[0], wind[1]), key = `${wind.map((c) => c.toFixed(1))} ${this.metric}`;
    if (key === this.windKey) return;
    this.windKey = key;
    // Up on the rose is along x, to the target; the air goes where the arrow points.
    const turn = (-Math.atan2(wind[1], wind[0]) * 180) / Math.PI;
    const marks = Array.from({ length: 24 }, (_, n) => `<line x1="50" y1="${n % 6 ? 6 : 4}" x2="50" y2="${n % 6 ? 9 : 11}" transform="rotate(${15 * n} 50 50)"/>`).join("");
    const arrow = speed > 0.05 ? `<path d="M50 13l8 15-8-4.5-8 4.5z" fill="#8fd0ff" stroke="none" transform="rotate(${turn.toFixed(1)} 50 50)"/><path d="M50 87V73" stroke="#8fd0ff" stroke-width="3.4" stroke-linecap="round" transform="rotate(${turn.toFixed(1)} 50 50)"/>` : "";
    const value = this.metric ? speed : speed / 0.44704;
    this.rose.innerHTML = `<svg viewBox="0 0 100 100" stroke="#ffffffa0" stroke-width="1.6">${marks}<path d="M50 0l3 5h-6z" fill="#fff" stroke="none"/>${arrow}</svg><span>${speed > 0.05 ? value.toFixed(speed < 10 ? 1 : 0) : "calm"}<small>${speed > 0.05 ? (this.metric ? "m/s" : "mph") : ""}</small></span>`;
    this.rose.title = "The arrow points where the wind blows to; up is along the hole's x axis";
  }

  showResult(result) {
    this.state.result = result;
    this.cards.innerHTML = "";
    if (!result) return;
    const cards = [];
    const flew = result.apex > LEAST_APEX;
    if (flew) cards.push(["carry", this.length(result.carry)]);
    if (result.total !== undefined) cards.push(["total", this.distance(result.total)]);
    if (flew) {
      const side = result.side;
      cards.push(["side", `${this.length(Math.abs(side))}${Math.abs(side) < 0.5 ? "" : side > 0 ? " L" : " R"}`]);
      cards.push(["apex", this.metric ? this.length(result.apex) : `${(result.apex / FOOT).toFixed(0)} ft`]);
      cards.push(["landing", `${((result.landing_angle * 180) / Math.PI).toFixed(0)}°`]);
    }
    if (result.to_hole !== null && result.to_hole !== undefined && result.status !== "holed") cards.push(["to hole", this.distance(result.to_hole)]);
    const ended = ENDINGS[result.status];
    if (!ended && result.lie) cards.push(["lie", result.lie.replaceAll("_", " ")]);
    for (const [title, value] of cards) element(this.cards, "glass", `<small>${title}</small><span>${escape(value)}</span>`);
    if (ended) {
      const penalty = result.penalty ? ` +${result.penalty}` : result.reason ? `: ${result.reason}` : "";
      element(this.cards, `glass end ${result.status}`, `<small>${result.penalty ? "penalty" : "end"}</small><span>${escape(ended + penalty)}</span>`);
    }
  }

  say(text, bad = false) {
    this.note.hidden = !text;
    this.note.textContent = text;
    this.note.classList.toggle("bad", bad);
  }

  // The course from above, the hole at the top, once; `drawMap` draws balls over it.
  paintMap() {
    const { land } = this, { grid } = land, picture = land.paint(), [[x0, y0], [x1, y1]] = land.around;
    const rim = 0.02 * Math.max(x1 - x0, y1 - y0) + 1, left = x0 - rim, low = y0 - rim;
    const width = x1 - x0 + 2 * rim, depth = y1 - y0 + 2 * rim, long = width >= depth;
    const tall = 190, wide = Math.min(120, Math.max(44, Math.round((tall * Math.min(width, depth)) / Math.max(width, depth))));
    const sharp = Math.min(2, devicePixelRatio || 1);
    Object.assign(this.map, { width: wide * sharp, height: tall * sharp });
    this.map.style.cssText = `width:${wide}px;height:${tall}px`;
    const back = (this.back = document.createElement("canvas"));
    Object.assign(back, { width: this.map.width, height: this.map.height });
    const pen = back.getContext("2d"), image = pen.createImageData(back.width, back.height);
    for (let q = 0, k = 0; q < back.height; q++) {
      for (let p = 0; p < back.width; p++, k += 4) {
        const u = (p + 0.5) / back.width, v = (q + 0.5) / back.height;
        const x = left + width * (long ? 1 - v : u), y = low + depth * (long ? 1 - u : 1 - v);
        const i = Math.min(grid.mx - 1, Math.max(0, ((x - grid.x) / land.texel) | 0)), j = Math.min(grid.my - 1, Math.max(0, ((y - grid.y) / land.texel) | 0));
        const light = 1 + Math.max(-0.3, Math.min(0.3, 1.6 * (land.height(x + 1, y - 1) - land.height(x - 1, y + 1))));
        for (let c = 0; c < 3; c++) image.data[k + c] = Math.min(255, 0.92 * picture[4 * (j * grid.mx + i) + c] * light);
        image.data[k + 3] = 255;
      }
    }
    pen.putImageData(image, 0, 0);
    this.onMap = (x, y) => {
      const u = (x - left) / width, v = (y - low) / depth;
      return long ? [(1 - v) * back.width, (1 - u) * back.height] : [u * back.width, (1 - v) * back.height];
    };
    for (const pond of land.water) {
      pen.beginPath();
      pond.polygon.forEach(([x, y]) => pen.lineTo(...this.onMap(x, y)));
      pen.fillStyle = "#2f7393";
      pen.fill();
    }
    pen.fillStyle = "#24552b";
    for (const tree of land.obstacles.filter((o) => o.material !== "wood")) {
      pen.beginPath();
      pen.arc(...this.onMap(tree.place[0], tree.place[1]), Math.max(1.2, (tree.radius / width) * (long ? back.height : back.width)), 0, 7);
      pen.fill();
    }
    this.drawMap();
  }

  drawMap() {
    const { land, view, map } = this, pen = map.getContext("2d"), sharp = Math.min(2, devicePixelRatio || 1);
    pen.drawImage(this.back, 0, 0);
    const ball = view.balls[view.followed];
    pen.lineWidth = 1.4 * sharp;
    if (land.hole && ball && !this.isHoled(ball)) {
      const from = this.onMap(ball.place.x, ball.place.y), to = this.onMap(land.hole[0], land.hole[1]);
      pen.strokeStyle = "#ffffffb0";
      pen.setLineDash([3 * sharp, 3 * sharp]);
      pen.beginPath();
      pen.moveTo(...from);
      pen.lineTo(...to);
      pen.stroke();
      pen.setLineDash([]);
      const way = Math.hypot(land.hole[0] - ball.place.x, land.hole[1] - ball.place.y);
      pen.font = `600 ${10 * sharp}px sans-serif`;
      pen.fillStyle = "#fff";
      pen.textAlign = "center";
      pen.shadowColor = "#000";
      pen.shadowBlur = 3 * sharp;
      const text = this.distance(way), half = pen.measureText(text).width / 2 + 2 * sharp;
      const x = Math.min(map.width - half, Math.max(half, (from[0] + to[0]) / 2 + half + 4 * sharp));
      pen.fillText(text, x, (from[1] + to[1]) / 2);
      pen.shadowBlur = 0;
    }
    for (const each of view.balls) this.drawTracer(pen, each, sharp);
    if (land.hole) {
      const [p, q] = this.onMap(land.hole[0], land.hole[1]);
      pen.strokeStyle = "#fff";
      pen.beginPath();
      pen.moveTo(p, q);
      pen.lineTo(p, q - 10 * sharp);
      pen.stroke();
      pen.fillStyle = "#e3262d";
      pen.beginPath();
      pen.moveTo(p, q - 10 * sharp);
      pen.lineTo(p + 6 * sharp, q - 7.6 * sharp);
      pen.lineTo(p, q - 5.2 * sharp);
      pen.fill();
    }
    pen.strokeStyle = "#0009";
    pen.fillStyle = "#fff";
    for (const each of view.balls.filter((one) => one.seen)) {
      pen.beginPath();
      pen.arc(...this.onMap(each.place.x, each.place.y), 3 * sharp, 0, 7);
      pen.fill();
      pen.stroke();
    }
  }

  drawTracer(pen, ball, sharp) {
    const { tracer } = ball, every = Math.max(1, Math.floor(tracer.count / 60));
    if (tracer.count < 2) return;
    pen.strokeStyle = "#ffd84a";
    pen.lineWidth = 1.6 * sharp;
    pen.beginPath();
    for (let k = 0; k < tracer.count; k += every) pen.lineTo(...this.onMap(tracer.point(k)[0], tracer.point(k)[1]));
    pen.lineTo(...this.onMap(ball.place.x, ball.place.y));
    pen.stroke();
  }

  frame(now) {
    const { land, view } = this, ball = view.balls[view.followed];
    if (!land || !ball) return;
    if (!(now - this.drawnAt < 0.15)) {
      this.drawnAt = now;
      this.showHead();
      this.drawMap();
      if (this.recorded) this.showTime();
    }
    this.placePin(ball);
  }

  // The distance, over the flag.
  placePin(ball) {
    const { land, view } = this;
    const way = land.hole ? Math.hypot(land.hole[0] - ball.place.x, land.hole[1] - ball.place.y) : 0;
    const seen = view.camera.position.distanceTo(view.pin?.position ?? view.camera.position);
    const large = Math.max(1, Math.min(5, seen / 55));
    const at = land.hole && seen > 14 && view.cameras.mode !== "above" ? view.project(land.hole[0], land.hole[1], land.hole[2] + 2.3 + 0.1 * large) : null;
    this.pin.hidden = !at || at[0] < 0 || at[1] < 10 || at[0] > this.box.clientWidth || at[1] > this.box.clientHeight;
    if (this.pin.hidden) return;
    const text = this.distance(way);
    if (this.pin.textContent !== text) this.pin.textContent = text;
    this.pin.style.transform = `translate(${at[0].toFixed(0)}px,${at[1].toFixed(0)}px) translate(-50%,-130%)`;
  }

  // The timeline of a recorded play.
  addTimeline(recorded) {
    this.recorded = recorded;
    this.box.classList.add("recorded");
    const line = element(this.box, "over glass line");
    const button = (path, title, act, className = "") => {
      const made = element(line, className, path.startsWith("M") ? icon(path) : path, "button");
      made.title = title;
      made.setAttribute("aria-label", title);
      made.onclick = () => {
        act();
        this.view.changed = true;
      };
      return made;
    };
    button("M18 5L9 12l9 7zM6 5v14", "Shot before", () => recorded.toShot(recorded.shot - (recorded.time > (recorded.play.shots[recorded.shot]?.start ?? 0) + 1 ? 0 : 1)));
    this.playButton = button("M7 4l13 8-13 8z", "Play (space)", () => this.press());
    button("M6 5l9 7-9 7zM18 5v14", "Next shot (n)", () => recorded.toShot(recorded.shot + 1));
    this.slider = element(line, "", "", "input");
    Object.assign(this.slider, { type: "range", min: recorded.start, max: recorded.end, step: 0.01, title: "Time" });
    this.slider.oninput = () => {
      recorded.playing = false;
      recorded.seek(Number(this.slider.value));
      this.view.changed = true;
    };
    this.clock = element(line, "text");
    this.speed = button("1×", "Speed", () => {
      recorded.speed = SPEEDS[(SPEEDS.indexOf(recorded.speed) + 1) % SPEEDS.length];
      this.speed.textContent = `${recorded.speed < 1 ? `1/${1 / recorded.speed}` : recorded.speed}×`;
    }, "speed");
    this.showTime();
  }

  press() {
    const { recorded } = this;
    if (recorded.time >= recorded.end) recorded.seek(recorded.start);
    recorded.playing = !recorded.playing;
    this.view.changed = true;
    this.showTime();
  }

  showTime() {
    const { recorded } = this, shots = recorded.play.shots;
    this.slider.value = recorded.time;
    this.clock.textContent = `Shot ${recorded.current(recorded.time) + 1} of ${shots.length} · ${Math.max(0, recorded.time - (shots[recorded.current(recorded.time)]?.start ?? 0)).toFixed(1)} s`;
    const path = recorded.playing ? "M7 4v16M17 4v16" : "M7 4l13 8-13 8z";
    if (path !== this.playPath) this.playButton.innerHTML = icon((this.playPath = path));
  }

  close() {
    window.removeEventListener("keydown", this.keys);
    window.removeEventListener("pointerup", this.up);
  }
}
