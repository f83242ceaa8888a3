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

// The ground: one grid of heights with one painted picture, and hills up to the horizon.
import { THREE } from "nicegui-scene";
import { SUN } from "./land.js";

const RINGS = [4, 12, 30, 60, 110, 180, 280, 420, 620, 900, 1400, 2200, 3400]; // m beyond the grid
const HILLS = 44; // m: how high they are at most

// What every kind of grass has: soft patches, straw, grain close to the eye, woods far away.
const GRASS = `
  vec2 at = vGround.xy;
  float wild = GRASS_WILD;
  float way = length(vViewPosition);
  float broad = texture2D(noise, at / 173.0).a + 0.6 * texture2D(noise, at.yx / 61.0 + 0.37).r - 0.8;
  float mid = texture2D(noise, at / 19.0).g + texture2D(noise, at.yx / 7.1).g - 1.0;
  float fine = texture2D(noise, at / 4.3).b + texture2D(noise, at.yx / 1.27).b - 1.0;
  diffuseColor.rgb *= 1.0 + wild * (0.42 * broad + 0.42 * mid + 0.40 * fine);
  diffuseColor.rgb = mix(diffuseColor.rgb, diffuseColor.rgb * vec3(1.34, 1.10, 0.72),
    wild * 0.75 * clamp(broad + 0.55 * mid, 0.0, 1.0));
  float near = clamp(1.0 - way / 26.0, 0.0, 1.0);
  float blades = texture2D(noise, at * 2.1).b + texture2D(noise, at.yx * 5.3).b - 1.0;
  diffuseColor.rgb *= 1.0 + near * blades * (0.30 + 0.35 * wild);
`;

// Edges of mown grass and sand are no straight lines: the picture is read a hand's breadth aside.
const WARPED_MAP = `
  #ifdef USE_MAP
    vec2 aside = texture2D(noise, vGround.xy / 3.1).gb + texture2D(noise, vGround.yx / 0.83).bg - 1.0;
    vec4 sampledDiffuseColor = texture2D(map, vMapUv + aside * warp);
    diffuseColor *= sampledDiffuseColor;
  #endif
`;

const WOODS = `
  float woods = smoothstep(0.46, 0.58, texture2D(noise, at / 900.0).a + 0.13 * (texture2D(noise, at / 90.0).g - 0.5))
    * smoothstep(150.0, 420.0, vFar);
  diffuseColor.rgb = mix(diffuseColor.rgb, vec3(0.045, 0.085, 0.036) * (0.8 + 0.8 * texture2D(noise, at / 37.0).b), 0.9 * woods);
`;

function grassy(material, noise, wild, { far = false, warp = [0, 0] } = {}) {
  material.onBeforeCompile = (shader) => {
    Object.assign(shader.uniforms, { noise: { value: noise }, warp: { value: new THREE.Vector2(...warp) } });
    const varyings = `varying vec3 vGround;${far ? " varying float vFar;" : ""}\n`;
    shader.vertexShader = (far ? "attribute float far;\n" : "") + varyings + shader.vertexShader.replace(
      "#include <begin_vertex>", `#include <begin_vertex>\n vGround = position;${far ? " vFar = far;" : ""}`);
    shader.fragmentShader = "uniform sampler2D noise; uniform vec2 warp;\n" + varyings + shader.fragmentShader.replace(
      "#include <map_fragment>",
      WARPED_MAP + GRASS.replace("GRASS_WILD", wild) + (far ? WOODS : ""));
  };
  return material;
}

export function groundMesh(land, noise, anisotropy) {
  const { nx, ny, x, y, spacing, mx, my } = land.grid;
  const geometry = new THREE.BufferGeometry();
  const places = new Float32Array(3 * nx * ny), normals = new Float32Array(3 * nx * ny), uv = new Float32Array(2 * nx * ny);
  const z = land.heights;
  for (let j = 0, k = 0; j < ny; j++) {
    for (let i = 0; i < nx; i++, k++) {
      places.set([x + i * spacing, y + j * spacing, z[k]], 3 * k);
      const a = z[k - (i > 0)], b = z[k + (i < nx - 1)], c = z[k - (j > 0 ? nx : 0)], d = z[k + (j < ny - 1 ? nx : 0)];
      const across = (b - a) / (spacing * ((i > 0) + (i < nx - 1))), up = (d - c) / (spacing * ((j > 0) + (j < ny - 1)));
      const length = Math.hypot(across, up, 1);
      normals.set([-across / length, -up / length, 1 / length], 3 * k);
      uv.set([i / (nx - 1), j / (ny - 1)], 2 * k);
    }
  }
  const index = new Uint32Array(6 * (nx - 1) * (ny - 1));
  for (let j = 0, n = 0; j < ny - 1; j++) {
    for (let i = 0; i < nx - 1; i++, n += 6) {
      const k = j * nx + i;
      index.set([k, k + 1, k + nx + 1, k, k + nx + 1, k + nx], n);
    }
  }
  geometry.setAttribute("position", new THREE.BufferAttribute(places, 3));
  geometry.setAttribute("normal", new THREE.BufferAttribute(normals, 3));
  geometry.setAttribute("uv", new THREE.BufferAttribute(uv, 2));
  geometry.setIndex(new THREE.BufferAttribute(index, 1));
  const picture = new THREE.DataTexture(land.paint(), mx, my);
  picture.colorSpace = THREE.SRGBColorSpace;
  picture.generateMipmaps = true;
  picture.minFilter = THREE.LinearMipmapLinearFilter;
  picture.magFilter = THREE.LinearFilter;
  picture.anisotropy = anisotropy;
  picture.needsUpdate = true;
  const mesh = new THREE.Mesh(geometry, grassy(new THREE.MeshLambertMaterial({ map: picture }), noise, "sampledDiffuseColor.a", { warp: [0.26 / land.width, 0.26 / land.depth] }));
  mesh.receiveShadow = true;
  mesh.castShadow = true;
  return mesh;
}

// Ground from the rim of the grid to the horizon, in the colour of the rim; low hills far out.
export function hillsMesh(land, noise) {
  const { nx, ny, x, y, spacing, mx } = land.grid;
  const rim = [];
  for (let i = 0; i < nx - 1; i++) rim.push(i);
  for (let j = 0; j < ny - 1; j++) rim.push(j * nx + nx - 1);
  for (let i = nx - 1; i > 0; i--) rim.push((ny - 1) * nx + i);
  for (let j = ny - 1; j > 0; j--) rim.push(j * nx);
  const [cx, cy] = land.center, rows = RINGS.length + 1, count = rim.length;
  const mean = rim.reduce((sum, k) => sum + land.heights[k], 0) / count;
  const places = new Float32Array(3 * rows * count), far = new Float32Array(rows * count), index = [];
  const hill = (a, b) =>
    0.5 + 0.2 * Math.sin(a / 213 + 1.7) + 0.16 * Math.sin(b / 171 - 0.6) + 0.14 * Math.sin((a + b) / 331) + 0.1 * Math.sin(a / 97 - b / 131);
  rim.forEach((k, n) => {
    const px = x + spacing * (k % nx), py = y + spacing * Math.floor(k / nx);
    const dx = px - cx, dy = py - cy, length = Math.hypot(dx, dy);
    for (let row = 0; row < rows; row++) {
      const way = row ? RINGS[row - 1] : 0, a = px + (way * dx) / length, b = py + (way * dy) / length;
      const level = Math.min(1, way / 60), rise = Math.min(1, Math.max(0, way - 120) / 800);
      const z = land.heights[k] * (1 - level) + mean * level + HILLS * rise * rise * (3 - 2 * rise) * hill(a, b);
      places.set([a, b, z], 3 * (row * count + n));
      far[row * count + n] = way;
      if (row) {
        const p = (row - 1) * count + n, q = (row - 1) * count + ((n + 1) % count);
        index.push(p, p + count, q, q, p + count, q + count);
      }
    }
  });
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(places, 3));
  geometry.setAttribute("far", new THREE.BufferAttribute(far, 1));
  geometry.setIndex(index);
  geometry.computeVertexNormals();
  const { rgb } = { rgb: land.color(land.materials[land.numbers[mx - 1]] ?? { name: "rough" }) };
  const color = new THREE.Color().setRGB(...rgb.map((c) => c / 255), THREE.SRGBColorSpace);
  const mesh = new THREE.Mesh(geometry, grassy(new THREE.MeshLambertMaterial({ color, side: THREE.DoubleSide }), noise, "1.0", { far: true }));
  mesh.frustumCulled = false;
  return mesh;
}

// Sun with one static shadow map over the course, and the light of the sky.
export function lights(land) {
  const radius = Math.min(260, 0.5 * Math.hypot(land.width, land.depth));
  const sun = new THREE.DirectionalLight(0xffe6bd, 3.3);
  sun.target.position.set(...land.center, 0);
  sun.position.set(land.center[0] + 900 * SUN[0], land.center[1] + 900 * SUN[1], 900 * SUN[2]);
  sun.castShadow = true;
  Object.assign(sun.shadow.camera, { left: -radius, right: radius, top: radius, bottom: -radius, near: 200, far: 1800 });
  sun.shadow.mapSize.set(4096, 4096);
  sun.shadow.bias = -0.0006;
  sun.shadow.normalBias = 0.06;
  return [sun, sun.target, new THREE.HemisphereLight(0xd4e4ff, 0x7f8a4c, 1.75)];
}
