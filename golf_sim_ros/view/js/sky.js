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

// Sky and haze: one function gives the colour of both, so that the horizon has no seam.
import { THREE } from "nicegui-scene";
import { SUN } from "./land.js";

const HAZE = 1250; // m at which two thirds of a thing's colour are the sky's

const vec = (v) => `vec3(${v.map((x) => x.toFixed(4)).join(",")})`;

// Colour as shown, not as light, of the sky in a direction.
const SKY_COLOR = `
  vec3 skyColor(vec3 d) {
    float h = max(d.z, 0.0), s = max(dot(d, ${vec(SUN)}), 0.0);
    vec3 c = mix(vec3(0.83, 0.885, 0.91), vec3(0.60, 0.765, 0.905), smoothstep(0.0, 0.20, h));
    c = mix(c, vec3(0.29, 0.52, 0.80), smoothstep(0.06, 0.85, h));
    return c + vec3(1.0, 0.80, 0.50) * (0.20 * pow(s, 6.0) + 0.05 * pow(s, 40.0));
  }`;

// Things far away take the colour of the sky at the horizon behind them.
export function installHaze() {
  const chunks = THREE.ShaderChunk;
  chunks.fog_pars_vertex = "#ifdef USE_FOG\n varying vec3 vHaze;\n#endif";
  chunks.fog_vertex = "#ifdef USE_FOG\n vHaze = transpose(mat3(viewMatrix)) * mvPosition.xyz;\n#endif";
  chunks.fog_pars_fragment = `#ifdef USE_FOG\n varying vec3 vHaze;\n ${SKY_COLOR}\n#endif`;
  chunks.fog_fragment = `#ifdef USE_FOG
    float hazeWay = length(vHaze);
    vec3 hazeTo = vHaze / max(hazeWay, 1e-3);
    float haze = 1.0 - exp(-pow(hazeWay / ${HAZE.toFixed(1)}, 1.25));
    gl_FragColor.rgb = mix(gl_FragColor.rgb, skyColor(normalize(vec3(hazeTo.xy, max(hazeTo.z, 0.0)))), haze);
  #endif`;
}

// Smooth noise that repeats, for everything: red 4, green 16, blue 64 cells a side, alpha all three.
export function noiseTexture() {
  const size = 256, bytes = new Uint8Array(4 * size * size);
  const octave = (cells, seed) => {
    let s = seed;
    const grid = Float32Array.from({ length: cells * cells }, () => {
      s = (s * 16807) % 2147483647;
      return s / 2147483647;
    });
    return (x, y) => {
      const u = (x / size) * cells, v = (y / size) * cells, i = u | 0, j = v | 0;
      const a = u - i, b = v - j, s1 = a * a * (3 - 2 * a), t1 = b * b * (3 - 2 * b);
      const at = (p, q) => grid[(q % cells) * cells + (p % cells)];
      return (at(i, j) * (1 - s1) + at(i + 1, j) * s1) * (1 - t1) + (at(i, j + 1) * (1 - s1) + at(i + 1, j + 1) * s1) * t1;
    };
  };
  const octaves = [4, 8, 16, 32, 64, 128].map((cells, n) => octave(cells, 17 + 31 * n));
  for (let y = 0, k = 0; y < size; y++) {
    for (let x = 0; x < size; x++, k += 4) {
      const n = octaves.map((f) => f(x, y));
      bytes[k] = 255 * (0.62 * n[0] + 0.38 * n[1]);
      bytes[k + 1] = 255 * (0.6 * n[2] + 0.4 * n[3]);
      bytes[k + 2] = 255 * (0.5 * n[4] + 0.5 * n[5]);
      bytes[k + 3] = 255 * (0.44 * n[0] + 0.26 * n[1] + 0.15 * n[2] + 0.09 * n[3] + 0.06 * n[4]);
    }
  }
  const texture = new THREE.DataTexture(bytes, size, size);
  texture.wrapS = texture.wrapT = THREE.RepeatWrapping;
  texture.minFilter = THREE.LinearMipmapLinearFilter;
  texture.magFilter = THREE.LinearFilter;
  texture.generateMipmaps = true;
  texture.needsUpdate = true;
  return texture;
}

export function skyDome(noise) {
  const material = new THREE.ShaderMaterial({
    side: THREE.BackSide,
    depthWrite: false,
    fog: false,
    toneMapped: false,
    uniforms: { noise: { value: noise }, time: { value: 0 } },
    vertexShader: `
      varying vec3 vTo;
      void main() {
        vTo = position;
        gl_Position = projectionMatrix * vec4(mat3(modelViewMatrix) * position, 1.0);
      }`,
    fragmentShader: `
      uniform sampler2D noise; uniform float time; varying vec3 vTo;
      ${SKY_COLOR}
      void main() {
        vec3 d = normalize(vTo);
        vec3 c = skyColor(vec3(d.xy, max(d.z, 0.0)));
        if (d.z > 0.015) {
          vec2 p = d.xy / (d.z + 0.16);
          float n = texture2D(noise, 0.055 * p + vec2(0.0007 * time, 0.31)).a
                  + 0.45 * (texture2D(noise, 0.23 * p + vec2(0.002 * time, 0.0)).g - 0.5);
          float cloud = smoothstep(0.50, 0.78, n) * smoothstep(0.015, 0.16, d.z);
          float s = max(dot(d, ${vec(SUN)}), 0.0);
          c = mix(c, vec3(0.955, 0.955, 0.96) + 0.06 * pow(s, 5.0), 0.62 * cloud);
          c += vec3(1.0, 0.94, 0.8) * (smoothstep(0.99955, 0.99985, s) + 0.25 * pow(s, 600.0));
        }
        gl_FragColor = vec4(c, 1.0);
      }`,
  });
  const dome = new THREE.Mesh(new THREE.SphereGeometry(1000, 24, 12), material);
  dome.renderOrder = -1;
  dome.frustumCulled = false;
  return dome;
}
