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

// What stands on the course: trees, stones, walls, water, the pin, the tee markers.
import { THREE } from "nicegui-scene";
import { SUN } from "./land.js";

const FLAG = [0.78, 0.5]; // m
const PIN = 2.13; // m

function random(seed) {
  let s = seed;
  return () => (s = (s * 16807) % 2147483647) / 2147483647;
}

// A crown of many round tufts in the unit sphere; its normals are between the tufts' and the whole's.
function crown() {
  const places = [], normals = [], next = random(5), tufts = [[0, 0, 0, 0.8]];
  for (let n = 0; n < 15; n++) {
    const z = 1 - (2 * (n + 0.5)) / 15, turn = 2.39996 * n, flat = Math.sqrt(1 - z * z), out = 0.58 + 0.08 * next();
    tufts.push([out * flat * Math.cos(turn), out * flat * Math.sin(turn), out * z, 0.36 + 0.08 * next()]);
  }
  for (const [x, y, z, radius] of tufts) {
    const shape = new THREE.IcosahedronGeometry(radius, 3).attributes.position;
    for (let k = 0; k < shape.count; k++) {
      const n = [shape.getX(k) / radius, shape.getY(k) / radius, shape.getZ(k) / radius];
      const swell = 1 + 0.07 * Math.sin(9 * n[0] + 5 * x) * Math.cos(8 * n[1] + 7 * y + 5 * n[2]);
      const p = [x + n[0] * radius * swell, y + n[1] * radius * swell, z + n[2] * radius * swell];
      const out = Math.hypot(...p) || 1, mixed = n.map((c, i) => 0.55 * c + (0.6 * p[i]) / out);
      const length = Math.hypot(...mixed);
      places.push(...p);
      normals.push(...mixed.map((c) => c / length));
    }
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(places), 3));
  geometry.setAttribute("normal", new THREE.BufferAttribute(new Float32Array(normals), 3));
  return geometry;
}

function leafy(noise) {
  const material = new THREE.MeshLambertMaterial({ color: 0xffffff });
  material.onBeforeCompile = (shader) => {
    shader.uniforms.noise = { value: noise };
    shader.vertexShader = "varying vec3 vLeaf;\n" + shader.vertexShader.replace("#include <begin_vertex>", "#include <begin_vertex>\n vLeaf = position;");
    shader.fragmentShader = "uniform sampler2D noise; varying vec3 vLeaf;\n" + shader.fragmentShader.replace(
      "#include <map_fragment>", `#include <map_fragment>
        float leaves = texture2D(noise, vLeaf.xy * 0.55 + vLeaf.z * 0.37).b + texture2D(noise, vLeaf.yz * 0.24 + vLeaf.x * 0.3).g - 1.0;
        diffuseColor.rgb *= (1.0 + 0.85 * leaves) * mix(0.5, 1.08, smoothstep(-0.9, 0.8, vLeaf.z));
        diffuseColor.rgb = mix(diffuseColor.rgb, diffuseColor.rgb * vec3(1.25, 1.12, 0.7), clamp(leaves + 0.3 * vLeaf.z, 0.0, 1.0));`);
  };
  return material;
}

// A conifer's crown in the cylinder of radius 1 from z = -1 to 1: whorls of branches, each a ragged skirt.
function pine() {
  const WHORLS = 9, profile = [new THREE.Vector2(0, -0.96)];
  for (let k = 0; k < WHORLS; k++) {
    const out = 1 - 0.62 * (k / WHORLS) ** 2.6, low = -1 + (2 * k) / WHORLS, next = low + 2 / WHORLS;
    profile.push(new THREE.Vector2(0.6 * out, low + 0.03), new THREE.Vector2(0.97 * out, low), new THREE.Vector2(0.8 * out, low + 0.09), new THREE.Vector2(0.56 * out, next));
  }
  profile.push(new THREE.Vector2(0, 1.02));
  const geometry = new THREE.LatheGeometry(profile, 20).rotateX(Math.PI / 2);
  const place = geometry.attributes.position;
  for (let k = 0; k < place.count; k++) {
    const x = place.getX(k), y = place.getY(k), z = place.getZ(k), turn = Math.atan2(y, x), whorl = Math.floor((z + 1.001) * WHORLS / 2);
    const ragged = 1 - 0.1 * (1 + Math.sin(7 * turn + 2.4 * whorl)) - 0.06 * (1 + Math.sin(4 * turn - 1.7 * whorl));
    place.setXYZ(k, x * ragged, y * ragged, z + 0.035 * Math.sin(5 * turn + 1.3 * whorl) * Math.hypot(x, y));
  }
  geometry.computeVertexNormals();
  return geometry;
}

const isTree = (o) => o.material === (o.kind === "sphere" ? "leaves" : "pine");

// Many things of one shape: `set(place, color, thing)` says where each is, and in which colour.
function instances(geometry, material, things, set) {
  const mesh = new THREE.InstancedMesh(geometry, material, things.length);
  const place = new THREE.Object3D(), color = new THREE.Color();
  things.forEach((thing, n) => {
    set(place, color, thing);
    place.updateMatrix();
    mesh.setMatrixAt(n, place.matrix);
    mesh.setColorAt(n, color);
  });
  mesh.castShadow = mesh.receiveShadow = true;
  return mesh;
}

export function trees(land, noise) {
  const all = land.obstacles.filter(isTree), next = random(11);
  const of = (kind) => all.filter((o) => o.kind === kind);
  const crowns = [];
  if (of("sphere").length) {
    crowns.push(instances(crown(), leafy(noise), of("sphere"), (place, color, { place: [x, y, z], radius }) => {
      place.position.set(x, y, z);
      place.rotation.set(0, 0, 2 * Math.PI * next());
      place.scale.setScalar(radius);
      color.setHSL(0.265 + 0.035 * next(), 0.44 + 0.08 * next(), 0.24 + 0.05 * next());
    }));
  }
  if (of("cylinder").length) {
    crowns.push(instances(pine(), leafy(noise), of("cylinder"), (place, color, { place: [x, y, z], radius, height }) => {
      place.position.set(x, y, z + 0.5 * height);
      place.rotation.set(0, 0, 2 * Math.PI * next());
      place.scale.set(radius, radius, 0.5 * height);
      color.setHSL(0.3 + 0.04 * next(), 0.32 + 0.08 * next(), 0.17 + 0.05 * next());
    }));
  }
  return crowns;
}

const LOW = 0.8; // m that a thing goes on below: it may stand on a slope
const IN_CROWN = 1.2; // m that a trunk goes on above

const isTrunk = (o) => o.kind === "cylinder" && o.material === "wood";

export function trunks(land) {
  const all = land.obstacles.filter(isTrunk);
  if (!all.length) return [];
  return [instances(new THREE.CylinderGeometry(0.8, 1.25, 1, 14), new THREE.MeshLambertMaterial({ color: 0xffffff }), all, (place, color, o) => {
    place.rotation.set(Math.PI / 2, 0, 0);
    place.position.set(o.place[0], o.place[1], o.place[2] + 0.5 * (o.height + IN_CROWN - LOW));
    place.scale.set(o.radius, o.height + IN_CROWN + LOW, o.radius);
    color.set(0x6a5138);
  })];
}

export function solids(land) {
  return land.obstacles.filter((o) => !isTree(o) && !isTrunk(o)).map((o) => {
    const material = new THREE.MeshLambertMaterial({ color: new THREE.Color().setRGB(...o.color, THREE.SRGBColorSpace) });
    let mesh;
    if (o.kind === "sphere") {
      mesh = new THREE.Mesh(new THREE.SphereGeometry(o.radius, 32, 20), material);
      mesh.position.set(...o.place);
    } else {
      mesh = new THREE.Mesh(new THREE.CylinderGeometry(o.radius, o.radius, o.height + LOW, 14), material);
      mesh.rotation.x = Math.PI / 2;
      mesh.position.set(o.place[0], o.place[1], o.place[2] + 0.5 * (o.height - LOW));
    }
    mesh.castShadow = mesh.receiveShadow = true;
    return mesh;
  });
}

export function walls(land) {
  return land.walls.map(({ corners, color }) => {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(corners.flat()), 3));
    geometry.setIndex([0, 1, 2, 0, 2, 3]);
    geometry.computeVertexNormals();
    const material = new THREE.MeshLambertMaterial({ color: new THREE.Color().setRGB(...color, THREE.SRGBColorSpace), side: THREE.DoubleSide });
    const mesh = new THREE.Mesh(geometry, material);
    mesh.castShadow = mesh.receiveShadow = true;
    return mesh;
  });
}

// Water: clear at the shore, the sky's mirror far away, ripples that glitter towards the sun.
export function ponds(land, noise, skyTime) {
  return land.water.map(({ polygon, cut, level }) => {
    const outline = (corners) => corners.map((p) => new THREE.Vector2(...p));
    const shape = new THREE.Shape(outline(polygon));
    shape.holes = cut.map((hole) => new THREE.Path(outline(hole)));
    const material = new THREE.MeshBasicMaterial({ color: 0x1c4f63, transparent: true, toneMapped: false });
    material.onBeforeCompile = (shader) => {
      Object.assign(shader.uniforms, { noise: { value: noise }, time: skyTime });
      shader.vertexShader = "varying vec3 vPond;\n" + shader.vertexShader.replace("#include <begin_vertex>", "#include <begin_vertex>\n vPond = (modelMatrix * vec4(position, 1.0)).xyz;");
      shader.fragmentShader = "uniform sampler2D noise; uniform float time; varying vec3 vPond;\n" + shader.fragmentShader.replace(
        "#include <opaque_fragment>", `
          vec3 eye = normalize(cameraPosition - vPond);
          vec2 p = vPond.xy;
          vec2 ripple = vec2(texture2D(noise, p / 5.0 + 0.020 * time).g, texture2D(noise, p.yx / 4.1 - 0.017 * time).g)
                      + 0.6 * vec2(texture2D(noise, p / 2.3 - 0.03 * time).b, texture2D(noise, p.yx / 2.9 + 0.027 * time).b) - 0.8;
          vec3 n = normalize(vec3(0.075 * ripple, 1.0));
          float fresnel = 0.03 + 0.97 * pow(1.0 - max(dot(n, eye), 0.0), 4.0);
          vec3 back = reflect(-eye, n);
          vec3 mirror = skyColor(normalize(vec3(back.xy, abs(back.z))));
          float glint = pow(max(dot(back, vec3(${SUN.map((c) => c.toFixed(4)).join(",")})), 0.0), 220.0);
          vec3 body = vec3(0.115, 0.30, 0.36);
          outgoingLight = mix(body, mirror, fresnel) + vec3(1.0, 0.93, 0.78) * glint;
          diffuseColor.a = mix(0.66, 0.97, fresnel);
          #include <opaque_fragment>`).replace("#include <colorspace_fragment>", "");
    };
    const mesh = new THREE.Mesh(new THREE.ShapeGeometry(shape), material);
    mesh.position.z = level;
    return mesh;
  });
}

// Stick, waving flag and cup. `wave(time, wind, way)` moves the flag, and keeps stick and flag visible from afar.
export function pin(land) {
  const group = new THREE.Group();
  group.position.set(...land.hole);
  const cup = new THREE.Mesh(new THREE.CircleGeometry(0.054, 40), new THREE.MeshBasicMaterial({ color: 0x10130c }));
  const rim = new THREE.Mesh(new THREE.RingGeometry(0.052, 0.06, 40), new THREE.MeshBasicMaterial({ color: 0xf2f2ea }));
  cup.position.z = 0.006;
  rim.position.z = 0.007;
  group.add(cup, rim);
  group.wave = () => {};
  if (!land.flagstick) return group;
  const white = new THREE.MeshLambertMaterial({ color: 0xfafaf4, emissive: 0x555550 });
  const stick = new THREE.Mesh(new THREE.CylinderGeometry(0.0095, 0.0095, PIN, 10), white);
  stick.rotation.x = Math.PI / 2;
  stick.position.z = PIN / 2;
  const columns = 14, geometry = new THREE.PlaneGeometry(...FLAG, columns, 4);
  const flag = new THREE.Mesh(geometry, new THREE.MeshLambertMaterial({ color: 0xd8232a, emissive: 0x5c0a0c, side: THREE.DoubleSide }));
  const cloth = geometry.attributes.position, along = Float32Array.from({ length: cloth.count }, (_, k) => cloth.getX(k) + FLAG[0] / 2);
  const up = Float32Array.from({ length: cloth.count }, (_, k) => cloth.getY(k));
  group.add(stick, flag);
  stick.castShadow = flag.castShadow = true;
  group.wave = (time, wind, way) => {
    const large = Math.max(1, Math.min(5, way / 55)), thick = Math.max(1, (way * 0.0011) / 0.0095);
    stick.scale.set(thick, 1, thick);
    flag.scale.setScalar(large);
    const speed = Math.hypot(wind[0], wind[1]), flies = Math.min(1, 0.25 + speed / 5), hangs = Math.sqrt(1 - flies * flies);
    flag.rotation.z = speed > 0.05 ? Math.atan2(wind[1], wind[0]) : Math.PI;
    flag.position.z = PIN - (FLAG[1] / 2) * large;
    for (let k = 0; k < cloth.count; k++) {
      const u = along[k], ripple = (0.02 + 0.05 * flies) * Math.sin(8.5 * u - (4 + 3 * flies) * time) * (u / FLAG[0]);
      cloth.setXYZ(k, u * flies, ripple + 0.12 * hangs * u * Math.sin(9 * up[k]), up[k] - u * hangs * 0.9);
    }
    cloth.needsUpdate = true;
  };
  group.wave(0, [0, 0], 1);
  return group;
}

export function teeMarkers(land) {
  if (land.material(land.tee[0], land.tee[1]).endsWith("green")) return [];
  const material = new THREE.MeshLambertMaterial({ color: 0x2c5fae, emissive: 0x0b1a33 });
  return [1, -1].map((side) => {
    const [x, y] = land.tee, mesh = new THREE.Mesh(new THREE.SphereGeometry(0.09, 18, 12), material);
    mesh.position.set(x, y + 2 * side, land.height(x, y + 2 * side) + 0.06);
    mesh.castShadow = true;
    return mesh;
  });
}

export function boundary(land) {
  if (!land.bounds.length) return [];
  const stakes = [];
  land.bounds.forEach((a, n) => {
    const b = land.bounds[(n + 1) % land.bounds.length], length = Math.hypot(b[0] - a[0], b[1] - a[1]);
    const count = Math.min(60, Math.max(1, Math.round(length / 22)));
    for (let k = 0; k < count; k++) stakes.push([a[0] + ((b[0] - a[0]) * k) / count, a[1] + ((b[1] - a[1]) * k) / count]);
  });
  const geometry = new THREE.CylinderGeometry(0.035, 0.035, 0.9, 6);
  const mesh = new THREE.InstancedMesh(geometry, new THREE.MeshLambertMaterial({ color: 0xf6f6f2, emissive: 0x444440 }), stakes.length);
  const place = new THREE.Object3D();
  place.rotation.x = Math.PI / 2;
  stakes.forEach(([x, y], n) => {
    place.position.set(x, y, land.height(x, y) + 0.45);
    place.updateMatrix();
    mesh.setMatrixAt(n, place.matrix);
  });
  mesh.castShadow = true;
  return [mesh];
}
