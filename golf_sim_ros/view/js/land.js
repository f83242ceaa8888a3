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

// The course as data: heights, materials, and the picture that is painted of them.

export const NO_GROUND = 255;

// The sun, low from behind the player's left: unit vector towards it.
export const SUN = unit([-0.6, 0.52, 0.4]);

// sRGB of what grows and lies on a course. Lighter than the files' colours, which suit plots.
const LOOK = {
  rough: [88, 126, 58],
  first_cut: [98, 140, 62],
  fairway: [126, 172, 82],
  tee: [128, 176, 84],
  green: [146, 194, 100],
  firm_green: [154, 198, 104],
  soft_green: [138, 190, 100],
  sand: [232, 216, 178],
  hardpan: [172, 144, 108],
  artificial_turf: [58, 136, 78],
  stone: [146, 143, 136],
  wood: [112, 84, 58],
};

// How much the grass varies, 0 to 1: kept in the picture's alpha, used by the shader.
const WILD = { rough: 1, first_cut: 0.7, fairway: 0.34, tee: 0.3, sand: 0.42, hardpan: 0.8 };
const TAME = 0.22; // greens and what is not listed

// Mowing stripes: metres wide, contrast along, contrast across.
const STRIPES = {
  fairway: [7, 0.055, 0.018],
  tee: [1.5, 0.04, 0],
  green: [1.8, 0.026, 0.026],
  firm_green: [1.8, 0.026, 0.026],
  soft_green: [1.8, 0.026, 0.026],
};

const LIP = 1.1; // m: how far the edge of a bunker casts its shadow
const WET = 0.22; // m above the water's level up to which the shore is wet
const DEEP = 1.6; // m below which the bottom is not seen

function unit(v) {
  const length = Math.hypot(...v);
  return v.map((x) => x / length);
}

const smooth = (a, b, x) => {
  const t = Math.min(1, Math.max(0, (x - a) / (b - a)));
  return t * t * (3 - 2 * t);
};

// The bytes of `course_data.py` as an object.
export function unpack(buffer) {
  const view = new DataView(buffer);
  if (view.getUint32(0) !== 0x474f4c46) throw new Error("these are no course data");
  const length = view.getUint32(4, true);
  const about = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 8, length)));
  const { nx, ny, mx, my, mean, step } = about.grid;
  const differences = new Int16Array(buffer, 8 + length, nx * ny);
  const heights = new Float32Array(nx * ny);
  for (let j = 0, k = 0; j < ny; j++) {
    for (let i = 0, steps = 0; i < nx; i++, k++) {
      steps += differences[k];
      heights[k] = mean + step * steps;
    }
  }
  const numbers = new Uint8Array(buffer, 8 + length + 2 * nx * ny, mx * my);
  return new Land(about, heights, numbers);
}

export class Land {
  constructor(about, heights, numbers) {
    Object.assign(this, about);
    this.heights = heights;
    this.numbers = numbers;
    this.texel = (this.grid.spacing * (this.grid.nx - 1)) / this.grid.mx;
    this.width = this.grid.spacing * (this.grid.nx - 1);
    this.depth = this.grid.spacing * (this.grid.ny - 1);
    this.center = [this.grid.x + this.width / 2, this.grid.y + this.depth / 2];
  }

  // Height of the ground, between the grid's; beyond the grid that of its rim.
  height(x, y) {
    const { nx, ny, spacing } = this.grid;
    const u = Math.min(Math.max((x - this.grid.x) / spacing, 0), nx - 1.001);
    const v = Math.min(Math.max((y - this.grid.y) / spacing, 0), ny - 1.001);
    const i = u | 0, j = v | 0, s = u - i, t = v - j, k = j * nx + i, z = this.heights;
    return (z[k] * (1 - s) + z[k + 1] * s) * (1 - t) + (z[k + nx] * (1 - s) + z[k + nx + 1] * s) * t;
  }

  // Name of the material at a place, or that of the rim beyond the grid.
  material(x, y) {
    const { mx, my } = this.grid;
    const i = Math.min(Math.max(Math.floor((x - this.grid.x) / this.texel), 0), mx - 1);
    const j = Math.min(Math.max(Math.floor((y - this.grid.y) / this.texel), 0), my - 1);
    return this.materials[this.numbers[j * mx + i]]?.name ?? "";
  }

  color({ name, color }) {
    return LOOK[name] ?? color.map((c) => 255 * Math.min(1, 0.08 + c));
  }

  // The picture of the ground, RGBA bytes, row by row from the least y.
  paint() {
    const { mx, my } = this.grid;
    const picture = new Uint8Array(4 * mx * my);
    const kinds = this.materials.map((material) => ({
      rgb: this.color(material),
      wild: 255 * (WILD[material.name] ?? TAME),
      stripes: STRIPES[material.name],
      sand: material.name === "sand",
    }));
    const nothing = { rgb: [70, 84, 60], wild: 255 };
    const bands = this.bands(kinds);
    for (let j = 0, k = 0; j < my; j++) {
      for (let i = 0; i < mx; i++, k++) {
        const number = this.numbers[k], kind = kinds[number] ?? nothing;
        let g = 1;
        if (kind.stripes) g += bands[number].along[i] + bands[number].across[j];
        if (kind.sand) g *= this.lip(kinds, i, j);
        const at = 4 * k;
        picture[at] = Math.min(255, kind.rgb[0] * g);
        picture[at + 1] = Math.min(255, kind.rgb[1] * g);
        picture[at + 2] = Math.min(255, kind.rgb[2] * g);
        picture[at + 3] = kind.wild;
      }
    }
    this.soften(picture);
    for (const pond of this.water) this.flood(picture, pond);
    return picture;
  }

  // Blend colours across the edges between materials, which else are steps of a texel.
  soften(picture) {
    const { mx, my } = this.grid, { numbers } = this, edges = [], sums = [];
    for (let j = 1; j < my - 1; j++) {
      for (let i = 1, k = j * mx + 1; i < mx - 1; i++, k++) {
        const own = numbers[k];
        if (numbers[k - 1] === own && numbers[k + 1] === own && numbers[k - mx] === own && numbers[k + mx] === own
          && numbers[k - mx - 1] === own && numbers[k - mx + 1] === own && numbers[k + mx - 1] === own && numbers[k + mx + 1] === own) continue;
        edges.push(k);
        for (let c = 0; c < 4; c++) {
          const at = 4 * k + c, row = 4 * mx;
          sums.push((4 * picture[at] + 2 * (picture[at - 4] + picture[at + 4] + picture[at - row] + picture[at + row])
            + picture[at - row - 4] + picture[at - row + 4] + picture[at + row - 4] + picture[at + row + 4]) / 16);
        }
      }
    }
    edges.forEach((k, n) => {
      for (let c = 0; c < 4; c++) picture[4 * k + c] = sums[4 * n + c];
    });
  }

  // Brightness of the stripes of each material, by column and by row.
  bands(kinds) {
    const { mx, my } = this.grid;
    const wave = (place, width) => Math.max(-1, Math.min(1, 9 * Math.sin((Math.PI * place) / width)));
    return kinds.map(({ stripes }) => {
      if (!stripes) return null;
      const [width, along, across] = stripes;
      return {
        along: Float32Array.from({ length: mx }, (_, i) => along * wave(this.grid.x + i * this.texel, width)),
        across: Float32Array.from({ length: my }, (_, j) => across * wave(this.grid.y + j * this.texel, width)),
      };
    });
  }

  // How the lip of a bunker shades sand: dark where the grass stands between it and the sun, bright
  // on the far side that faces the sun.
  lip(kinds, i, j) {
    const { mx, my } = this.grid;
    const away = (sign) => {
      for (let way = this.texel; way <= LIP; way += this.texel) {
        const a = Math.round(i + (sign * way * SUN[0]) / this.texel);
        const b = Math.round(j + (sign * way * SUN[1]) / this.texel);
        if (a < 0 || b < 0 || a >= mx || b >= my) return 1;
        if (!kinds[this.numbers[b * mx + a]]?.sand) return way / LIP;
      }
      return 1;
    };
    return 1 - 0.42 * (1 - smooth(0, 1, away(1))) + 0.07 * (1 - smooth(0, 1, away(-1)));
  }

  // Darken what is under water, and the wet shore.
  flood(picture, { polygon, level }) {
    const { mx, my, x, y } = this.grid;
    const xs = polygon.map((p) => p[0]), ys = polygon.map((p) => p[1]);
    const clip = (value, most) => Math.min(most, Math.max(0, value));
    const left = clip(Math.floor((Math.min(...xs) - 2 - x) / this.texel), mx);
    const right = clip(Math.ceil((Math.max(...xs) + 2 - x) / this.texel), mx);
    const low = clip(Math.floor((Math.min(...ys) - 2 - y) / this.texel), my);
    const high = clip(Math.ceil((Math.max(...ys) + 2 - y) / this.texel), my);
    for (let j = low; j < high; j++) {
      for (let i = left; i < right; i++) {
        const below = level - this.height(x + (i + 0.5) * this.texel, y + (j + 0.5) * this.texel);
        if (below < -WET) continue;
        const wet = smooth(-WET, 0, below), deep = smooth(0, DEEP, below), at = 4 * (j * mx + i);
        const bottom = [38, 66, 62];
        for (let c = 0; c < 3; c++) {
          const shore = picture[at + c] * (1 - 0.38 * wet);
          picture[at + c] = shore * (1 - deep) + bottom[c] * deep;
        }
      }
    }
  }
}
