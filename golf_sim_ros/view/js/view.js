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

// The picture: a course, balls on it, a camera. Knows nothing of where poses come from.
import { THREE } from "nicegui-scene";
import { Ball, Ribbon } from "./ball.js";
import { Cameras } from "./cameras.js";
import { groundMesh, hillsMesh, lights } from "./ground.js";
import { installHaze, noiseTexture, skyDome } from "./sky.js";
import { boundary, pin, ponds, solids, teeMarkers, trees, trunks, walls } from "./things.js";

const COLORS = [0xffffff, 0xff8a5c, 0x7cc7ff, 0xffe066, 0xd9a5ff, 0x8ff0a4];
const IDLE = 1 / 15; // s between pictures while only flag and water move
const SLOW = 0.12; // s a picture takes where a processor draws: then pictures are fewer and plainer
const EXPOSURE = 0.95;

export class GolfView {
  constructor(box) {
    installHaze();
    this.box = box;
    this.renderer = new THREE.WebGLRenderer({ antialias: true, powerPreference: "high-performance" });
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.toneMapping = THREE.ACESFilmicToneMapping;
    this.renderer.toneMappingExposure = EXPOSURE;
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = THREE.PCFSoftShadowMap;
    this.renderer.shadowMap.autoUpdate = false;
    this.renderer.domElement.style.cssText = "position:absolute;inset:0;display:block";
    box.prepend(this.renderer.domElement);
    this.camera = new THREE.PerspectiveCamera(48, 1, 0.15, 6000);
    this.cameras = new Cameras(this.camera, this.renderer.domElement);
    this.noise = noiseTexture();
    this.scene = new THREE.Scene();
    this.scene.fog = new THREE.Fog(0xffffff);
    this.sky = skyDome(this.noise);
    this.scene.add(this.sky);
    this.time = this.sky.material.uniforms.time;
    this.balls = [];
    this.wind = [0, 0, 0];
    this.drawnAt = this.slowness = 0;
    this.frames = 0;
    this.followed = 0;
    this.source = null; // moves the balls: `update(now)` says whether anything moved
    this.onFrame = () => {};
    this.watch = new ResizeObserver(() => this.resize());
    this.watch.observe(box);
    this.resize();
    this.renderer.setAnimationLoop((now) => this.frame(now / 1000));
  }

  resize() {
    const width = this.box.clientWidth || 2, height = this.box.clientHeight || 2;
    this.renderer.setSize(width, height);
    this.camera.aspect = width / height;
    this.camera.fov = Math.min(68, Math.max(44, 46 / Math.sqrt(Math.min(1.6, this.camera.aspect) / 1.6)));
    this.camera.updateProjectionMatrix();
    this.changed = true;
  }

  // Another course, in place of the one before.
  show(land) {
    this.clear();
    this.land = land;
    const anisotropy = Math.min(8, this.renderer.capabilities.getMaxAnisotropy());
    this.pin = land.hole ? pin(land) : null;
    this.made = [
      groundMesh(land, this.noise, anisotropy),
      hillsMesh(land, this.noise),
      ...lights(land),
      ...trees(land, this.noise),
      ...trunks(land),
      ...solids(land),
      ...walls(land),
      ...ponds(land, this.noise, this.time),
      ...teeMarkers(land),
      ...boundary(land),
      ...(this.pin ? [this.pin] : []),
    ];
    this.scene.add(...this.made);
    this.renderer.shadowMap.needsUpdate = true;
    this.begin();
  }

  // One ball on the tee, and nothing of what was played before.
  begin() {
    const { land } = this;
    this.clearPlay();
    this.ball(0).moveTo(land.tee[0], land.tee[1], land.tee[2] + land.radius);
    this.followed = 0;
    this.cameras.jump = this.changed = true;
  }

  clearPlay() {
    for (const ball of this.balls) ball.close();
    this.balls = [];
    this.hideHints();
  }

  clear() {
    this.clearPlay();
    for (const thing of this.made ?? []) {
      this.scene.remove(thing);
      thing.traverse((part) => {
        part.geometry?.dispose();
        part.material?.map?.dispose();
        part.material?.dispose();
        part.shadow?.dispose?.();
      });
    }
    this.made = [];
  }

  ball(number) {
    while (this.balls.length <= number) this.balls.push(new Ball(this.scene, this.land.radius, COLORS[this.balls.length % COLORS.length]));
    return this.balls[number];
  }

  // A line where a shot would go, a ring where it lands, a disc where it ends.
  predict({ path, landing, end }) {
    this.hint ??= new Ribbon(this.scene, { color: 0xffffff, most: 400, opacity: 0.8, dashes: 1 });
    this.hint.clear();
    for (const p of path) this.hint.add(...p);
    this.hint.material.uniforms.dashes.value = this.hint.way / 40;
    this.rings ??= [0xffffff, 0xffd84a].map((color) => {
      const ring = new THREE.Mesh(new THREE.RingGeometry(0.78, 1, 48), new THREE.MeshBasicMaterial({ color, transparent: true, opacity: 0.9, depthTest: false, side: THREE.DoubleSide }));
      ring.renderOrder = 6;
      this.scene.add(ring);
      return ring;
    });
    [landing, end].forEach((place, n) => {
      this.rings[n].visible = Boolean(place);
      if (place) this.rings[n].position.set(place[0], place[1], place[2] + 0.05);
    });
    this.changed = true;
  }

  // Arrows down the slope of a green: rows of x, y, z and the slope along x and y.
  showSlopes(slopes) {
    this.hideGreen();
    const arrow = new THREE.Shape([[0.5, 0], [0.02, 0.3], [0.02, 0.1], [-0.5, 0.1], [-0.5, -0.1], [0.02, -0.1], [0.02, -0.3]].map((p) => new THREE.Vector2(...p)));
    const material = new THREE.MeshBasicMaterial({ color: 0xffffff, transparent: true, opacity: 0.62, depthWrite: false, toneMapped: false, polygonOffset: true, polygonOffsetFactor: -6, polygonOffsetUnits: -12 });
    this.arrows = new THREE.InstancedMesh(new THREE.ShapeGeometry(arrow), material, slopes.length);
    const place = new THREE.Object3D(), color = new THREE.Color();
    place.up.set(0, 0, 1);
    slopes.forEach(([x, y, z, a, b], n) => {
      const steep = Math.hypot(a, b), size = 0.14 + Math.min(0.26, 6 * steep);
      place.position.set(x, y, z + 0.02);
      place.rotation.set(0, 0, Math.atan2(-b, -a));
      place.scale.set(size, 0.55 * size, 1);
      place.updateMatrix();
      this.arrows.setMatrixAt(n, place.matrix);
      this.arrows.setColorAt(n, color.setHSL(0.55 * Math.max(0, 1 - steep / 0.05), 0.85, 0.62));
    });
    this.arrows.frustumCulled = false;
    this.arrows.renderOrder = 2;
    this.scene.add(this.arrows);
    this.changed = true;
  }

  // The line that holes, rows of x, y, z.
  showLine(rows) {
    this.line?.close();
    this.line = new Ribbon(this.scene, { color: 0x9be7ff, most: rows.length + 8, opacity: 0.95 });
    for (const [x, y, z] of rows) this.line.add(x, y, z + 0.01);
    this.changed = true;
  }

  hideGreen() {
    if (this.arrows) {
      this.scene.remove(this.arrows);
      this.arrows.geometry.dispose();
      this.arrows.material.dispose();
    }
    this.line?.close();
    this.arrows = this.line = null;
  }

  hideLine() {
    this.hint?.clear();
    for (const ring of this.rings ?? []) ring.visible = false;
    this.changed = true;
  }

  hideHints() {
    this.hideGreen();
    this.hideLine();
  }

  choose(mode) {
    this.cameras.choose(mode);
    this.changed = true;
  }

  // Where a place is on the page [px], or null behind the camera.
  project(x, y, z) {
    const p = new THREE.Vector3(x, y, z).project(this.camera);
    return p.z > 1 ? null : [((p.x + 1) / 2) * this.box.clientWidth, ((1 - p.y) / 2) * this.box.clientHeight];
  }

  frame(now) {
    if (!this.land || document.hidden) return;
    this.step(now);
  }

  // Draw what is there at a time of the page's clock [s], unless nothing has changed since.
  step(now) {
    const since = now - this.drawnAt, moving = this.source?.update(now) ?? false;
    const wait = this.slowness > SLOW ? Math.max(window.golfLeastGap ?? 0, moving ? 0 : 1.5) : moving ? 0 : IDLE;
    if (!this.changed && since < wait) return;
    this.changed = this.cameras.mode === "free";
    this.drawnAt = now;
    if (since < 2) this.slowness += 0.15 * (since - wait - this.slowness);
    this.frames++;
    this.time.value = now % 3600;
    const ball = this.balls[this.followed] ?? this.ball(0);
    const before = this.camera.position.clone();
    this.cameras.update(Math.min(since, 0.3), ball, this.land);
    this.camera.updateMatrixWorld(); // what lies over the picture is placed before it is drawn
    this.changed ||= before.distanceTo(this.camera.position) > 1e-3;
    // From afar the flag is drawn larger; the one map of shadows is made of it as it is.
    const far = this.renderer.shadowMap.needsUpdate ? 1 : this.camera.position.distanceTo(this.pin?.position ?? this.camera.position);
    if (this.pin) this.pin.wave(now % 3600, this.wind, far);
    for (const each of this.balls) each.face(this.camera, this.land);
    for (const ring of this.rings ?? []) ring.scale.setScalar(Math.max(0.12, 0.011 * ring.position.distanceTo(this.camera.position)));
    this.onFrame(now);
    this.renderer.render(this.scene, this.camera);
  }

  close() {
    this.renderer.setAnimationLoop(null);
    this.watch.disconnect();
    this.cameras.close();
    this.clear();
    this.renderer.dispose();
    this.renderer.forceContextLoss();
  }
}
