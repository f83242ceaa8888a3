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

// Where the picture is taken from: behind the ball, broadcast, above, at the pin, free.
import { OrbitControls, THREE } from "nicegui-scene";

export const CAMERAS = ["behind", "broadcast", "above", "pin", "free"];

const PATIENCE = { place: 0.45, target: 0.22 }; // s in which the camera makes up two thirds of its way
const LOWEST = 0.55; // m over the ground

export class Cameras {
  constructor(camera, element) {
    this.camera = camera;
    this.controls = new OrbitControls(camera, element);
    this.controls.maxPolarAngle = 1.54;
    this.controls.minDistance = 0.6;
    this.controls.maxDistance = 900;
    this.controls.enabled = false;
    this.place = new THREE.Vector3(-9, 0, 3);
    this.target = new THREE.Vector3(30, 0, 0);
    this.up = new THREE.Vector3(0, 0, 1);
    this.heading = new THREE.Vector3(1, 0, 0);
    this.mode = "broadcast";
    this.jump = true;
  }

  choose(mode) {
    if (mode === this.mode && mode !== "free") this.jump = true;
    this.mode = mode;
    this.controls.enabled = mode === "free";
    if (mode === "free") {
      this.camera.up.set(0, 0, 1);
      this.controls.target.copy(this.target);
      this.controls.update();
    }
  }

  // Direction from the ball to the hole; along x where there is none or the ball is in it.
  aim(ball, land) {
    const hole = land.hole ?? [ball.place.x + 150, ball.place.y, 0];
    const x = hole[0] - ball.place.x, y = hole[1] - ball.place.y, way = Math.hypot(x, y);
    if (way > 0.25) this.heading.set(x / way, y / way, 0);
    return way;
  }

  update(seconds, ball, land) {
    const { camera } = this;
    if (this.mode === "free") {
      this.controls.update();
      camera.position.z = Math.max(camera.position.z, land.height(camera.position.x, camera.position.y) + LOWEST);
      return;
    }
    const way = this.aim(ball, land), wanted = this[this.mode](ball, land, way);
    wanted.place.z = Math.max(wanted.place.z, land.height(wanted.place.x, wanted.place.y) + LOWEST);
    const far = wanted.place.distanceTo(this.place) > 160;
    const share = (patience) => (this.jump || far ? 1 : 1 - Math.exp(-seconds / patience));
    this.place.lerp(wanted.place, share(PATIENCE.place));
    this.target.lerp(wanted.target, share(PATIENCE.target));
    this.jump = false;
    this.place.z = Math.max(this.place.z, land.height(this.place.x, this.place.y) + LOWEST);
    camera.up.copy(wanted.up ?? this.up);
    camera.position.copy(this.place);
    camera.lookAt(this.target);
  }

  behind(ball, land, way) {
    const [back, up] = way < 1.5 ? [1.6, 0.53] : way < 14 ? [2.6, 0.86] : way < 40 ? [4.5, 1.4] : [7.5, 2.3];
    const d = this.heading, { x, y, z } = ball.place;
    const place = new THREE.Vector3(x - back * d.x, y - back * d.y, z + up + (ball.moving ? 0.8 : 0));
    const ahead = Math.min(Math.max(way, 1.2), 42);
    const target = new THREE.Vector3(x + ahead * d.x, y + ahead * d.y, 0);
    // a ball at rest is seen over the cards and the timeline
    target.z = ball.moving ? z : land.height(target.x, target.y);
    return { place, target };
  }

  broadcast(ball, land, way) {
    if (!ball.moving) return this.behind(ball, land, way);
    const { x, y, z } = ball.place, d = this.heading, speed = ball.velocity.length();
    const height = z - land.height(x, y), close = height < 1 && speed < 9;
    const back = close ? Math.max(3.4, Math.min(16, 1.1 * way)) : 15 + 0.5 * Math.min(speed, 30), side = 0.24 * back;
    const place = new THREE.Vector3(x - back * d.x - side * d.y, y - back * d.y + side * d.x, z + 0.2 * back + (close ? 0.4 : 1.6));
    const target = ball.place.clone().addScaledVector(ball.velocity, close ? 0.1 : 0.32);
    target.z = Math.max(target.z, land.height(target.x, target.y));
    return { place, target };
  }

  above(ball, land, way) {
    const d = this.heading, { x, y } = ball.place, length = Math.max(6, way), tall = 1.4 * length + 5;
    const middle = new THREE.Vector3(x + 0.5 * way * d.x, y + 0.5 * way * d.y, ball.place.z);
    return { place: new THREE.Vector3(middle.x - 0.02 * d.x, middle.y - 0.02 * d.y, middle.z + tall), target: middle, up: d.clone() };
  }

  pin(ball, land, way) {
    if (!land.hole) return this.behind(ball, land, way);
    const [x, y, z] = land.hole, d = this.heading, back = way < 12 ? 3.2 : 8;
    return {
      place: new THREE.Vector3(x + back * d.x + 0.22 * back * d.y, y + back * d.y - 0.22 * back * d.x, z + 0.36 * back),
      target: way < 60 || ball.moving ? ball.place.clone() : new THREE.Vector3(x - 25 * d.x, y - 25 * d.y, z),
    };
  }

  close() {
    this.controls.dispose();
  }
}
