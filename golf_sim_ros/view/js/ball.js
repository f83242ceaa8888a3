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

// Balls with their shadows and tracers. A ball and its tracer have a least size on the screen.
import { THREE } from "nicegui-scene";

const LEAST_BALL = 0.0031; // of the distance: radius
const LEAST_LINE = 0.0017; // of the distance: half the width
const MOST = 6000; // points of a tracer
const KEPT = 5; // tracers of earlier shots

// A ribbon that always faces the camera; the shader gives it its width.
export class Ribbon {
  constructor(scene, { color = 0xffd84a, most = MOST, opacity = 0.95, dashes = 0 } = {}) {
    this.most = most;
    this.count = 0;
    this.way = 0;
    const geometry = (this.geometry = new THREE.BufferGeometry());
    const attribute = (name, size) => {
      const made = new THREE.BufferAttribute(new Float32Array(2 * most * size), size);
      made.setUsage(THREE.DynamicDrawUsage);
      geometry.setAttribute(name, made);
      return made;
    };
    this.places = attribute("position", 3);
    this.tangents = attribute("tangent3", 3);
    this.sides = attribute("side", 2);
    const index = new Uint32Array(6 * (most - 1));
    for (let k = 0; k < most - 1; k++) index.set([2 * k, 2 * k + 1, 2 * k + 2, 2 * k + 1, 2 * k + 3, 2 * k + 2], 6 * k);
    geometry.setIndex(new THREE.BufferAttribute(index, 1));
    geometry.setDrawRange(0, 0);
    this.material = new THREE.ShaderMaterial({
      transparent: true,
      depthWrite: false,
      side: THREE.DoubleSide,
      uniforms: { color: { value: new THREE.Color(color).convertLinearToSRGB() }, opacity: { value: opacity }, dashes: { value: dashes }, width: { value: 1 } },
      vertexShader: `
        attribute vec3 tangent3; attribute vec2 side; uniform float width; varying vec2 vSide;
        void main() {
          vec3 p = (modelMatrix * vec4(position, 1.0)).xyz, eye = cameraPosition - p;
          vec3 across = cross(eye, tangent3);
          float wide = max(0.012, width * ${LEAST_LINE} * length(eye));
          vSide = side;
          gl_Position = projectionMatrix * viewMatrix * vec4(p + normalize(across + 1e-9) * side.x * wide, 1.0);
        }`,
      fragmentShader: `
        uniform vec3 color; uniform float opacity, dashes; varying vec2 vSide;
        void main() {
          float edge = 1.0 - smoothstep(0.55, 1.0, abs(vSide.x));
          float dash = dashes > 0.0 ? step(0.42, fract(vSide.y / dashes)) : 1.0;
          float alpha = opacity * edge * dash;
          if (alpha < 0.01) discard;
          gl_FragColor = vec4(color, alpha);
        }`,
    });
    this.mesh = new THREE.Mesh(geometry, this.material);
    this.mesh.frustumCulled = false;
    this.mesh.renderOrder = 5;
    this.scene = scene;
    scene.add(this.mesh);
  }

  clear() {
    this.count = this.way = 0;
    this.geometry.setDrawRange(0, 0);
  }

  add(x, y, z) {
    if (this.count === this.most) this.thin();
    const last = this.point(this.count - 1);
    if (last && Math.hypot(x - last[0], y - last[1], z - last[2]) < 1e-4) return;
    this.way += last ? Math.hypot(x - last[0], y - last[1], z - last[2]) : 0;
    this.count++;
    this.set(this.count - 1, x, y, z);
  }

  // Where the line ends now: a point beyond the last one, which moves.
  tip(x, y, z) {
    if (!this.count || this.count === this.most) return;
    this.set(this.count, x, y, z);
    this.geometry.setDrawRange(0, 6 * this.count);
  }

  point(n) {
    return n < 0 ? null : [this.places.array[6 * n], this.places.array[6 * n + 1], this.places.array[6 * n + 2]];
  }

  set(n, x, y, z) {
    const before = this.point(n - 1), way = this.way;
    for (const [k, sign] of [[2 * n, 1], [2 * n + 1, -1]]) {
      this.places.setXYZ(k, x, y, z);
      this.sides.setXY(k, sign, way);
    }
    const from = before ?? [x, y, z - 1e-3], turn = (m, a, b) => {
      for (const k of [2 * m, 2 * m + 1]) this.tangents.setXYZ(k, b[0] - a[0], b[1] - a[1], b[2] - a[2]);
    };
    turn(n, from, [x, y, z]);
    if (n === 1) turn(0, from, [x, y, z]);
    if (n > 1) turn(n - 1, this.point(n - 2), [x, y, z]);
    for (const attribute of [this.places, this.sides, this.tangents]) attribute.needsUpdate = true;
    this.geometry.setDrawRange(0, 6 * Math.max(0, this.count - 1));
  }

  // Every other point of a line that is full.
  thin() {
    const kept = Array.from({ length: this.count }, (_, n) => this.point(n)).filter((_, n) => n % 2 === 0);
    this.clear();
    for (const p of kept) this.add(...p);
  }

  fade() {
    this.material.uniforms.opacity.value *= 0.42;
    this.material.uniforms.color.value.setRGB(1, 1, 1);
  }

  close() {
    this.scene.remove(this.mesh);
    this.geometry.dispose();
    this.material.dispose();
  }
}

function softDisc() {
  const size = 64, bytes = new Uint8Array(4 * size * size);
  for (let j = 0, k = 0; j < size; j++) {
    for (let i = 0; i < size; i++, k += 4) {
      const r = Math.hypot(i - 31.5, j - 31.5) / 31.5;
      bytes[k + 3] = r < 1 ? 255 * Math.pow(1 - r, 1.4) : 0;
    }
  }
  const texture = new THREE.DataTexture(bytes, size, size);
  texture.magFilter = THREE.LinearFilter;
  texture.needsUpdate = true;
  return texture;
}

let disc;

export class Ball {
  constructor(scene, radius, color = 0xffffff) {
    disc ??= softDisc();
    this.scene = scene;
    this.radius = radius;
    this.place = new THREE.Vector3();
    this.velocity = new THREE.Vector3();
    this.moving = false;
    this.seen = false;
    this.mesh = new THREE.Mesh(new THREE.SphereGeometry(radius, 24, 16), new THREE.MeshLambertMaterial({ color, emissive: color, emissiveIntensity: 0.34 }));
    this.shadow = new THREE.Mesh(new THREE.PlaneGeometry(1, 1), new THREE.MeshBasicMaterial({ map: disc, transparent: true, depthWrite: false, color: 0x000000, polygonOffset: true, polygonOffsetFactor: -1, polygonOffsetUnits: -1 }));
    this.shadow.renderOrder = 3;
    this.tracers = [new Ribbon(scene)];
    this.mesh.visible = this.shadow.visible = false;
    scene.add(this.mesh, this.shadow);
  }

  // A new shot: the tracers before fade.
  begin() {
    if (this.tracer.count) {
      for (const tracer of this.tracers) tracer.fade();
      this.tracers.push(new Ribbon(this.scene));
      if (this.tracers.length > KEPT) this.tracers.shift().close();
    }
    this.tracer.clear();
    this.tracer.add(...this.place);
  }

  get tracer() {
    return this.tracers[this.tracers.length - 1];
  }

  moveTo(x, y, z) {
    this.place.set(x, y, z);
    this.seen = this.mesh.visible = this.shadow.visible = true;
    this.tracer.tip(x, y, z);
  }

  // Keep ball and shadow large enough to be seen.
  face(camera, land) {
    const way = this.place.distanceTo(camera.position), size = Math.max(this.radius, LEAST_BALL * way);
    this.mesh.scale.setScalar(size / this.radius);
    this.mesh.position.copy(this.place);
    this.mesh.position.z += size - this.radius;
    const ground = land.height(this.place.x, this.place.y), above = Math.max(0, this.place.z - ground);
    const wide = size * (2.6 + 0.35 * Math.min(above, 12));
    this.shadow.position.set(this.place.x, this.place.y, ground + 0.012);
    this.shadow.scale.set(wide, wide, 1);
    this.shadow.material.opacity = 0.62 / (1 + 0.09 * above);
  }

  close() {
    for (const tracer of this.tracers) tracer.close();
    this.scene.remove(this.mesh, this.shadow);
  }
}
