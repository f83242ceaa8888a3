# Copyright 2026 golf_sim_ros maintainers
#
# Licensed under the Apache License, Version 2.0 (the "License");
# you may not use this file except in compliance with the License.
# You may obtain a copy of the License at
#
#     http://www.apache.org/licenses/LICENSE-2.0
#
# Unless required by applicable law or agreed to in writing, software
# distributed under the License is distributed on an "AS IS" BASIS,
# WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
# See the License for the specific language governing permissions and
# limitations under the License.

"""Verification of the solver against closed forms and published figures.

``python -m golf_sim_ros.wind.verification CASE`` prints a table; the last lines of each say how
far it is from what it should be. Cases: ``taylor_green``, ``cavity``, ``ridge``, ``hill``,
``flat``, ``trees``.
"""

import argparse
from collections.abc import Sequence
from math import exp, log, log2, pi
import sys

import numpy as np

from ..physics.jit import Unavailable

try:
    from . import momentum
    from .boundary_conditions import Inflow
    from .grid import Grid, layers, with_buffer
    from .laminar_flow import drags, LaminarFlow, slides, sticks, Walls
    from .march import March
    from .pressure_solver import PressureSolver, Velocity
    from .steady_flow import SteadyFlow, Terrain
except Unavailable as error:
    sys.exit(str(error))

# Ghia, Ghia and Shin, J. Comput. Phys. 48 (1982) 387-411, table I: u on the vertical centre line.
GHIA_HEIGHTS = (
    *(0.0547, 0.0625, 0.0703, 0.1016, 0.1719, 0.2813, 0.4531, 0.5),
    *(0.6172, 0.7344, 0.8516, 0.9531, 0.9609, 0.9688, 0.9766),
)
GHIA = {
    100: (
        *(-0.03717, -0.04192, -0.04775, -0.06434, -0.10150, -0.15662, -0.21090, -0.20581),
        *(-0.13641, 0.00332, 0.23151, 0.68717, 0.73722, 0.78871, 0.84123),
    ),
    400: (
        *(-0.08186, -0.09266, -0.10338, -0.14612, -0.24299, -0.32726, -0.17119, -0.11477),
        *(0.02135, 0.16256, 0.29093, 0.55892, 0.61756, 0.68439, 0.75837),
    ),
    1000: (
        *(-0.18109, -0.20196, -0.22220, -0.29730, -0.38289, -0.27805, -0.10648, -0.06080),
        *(0.05702, 0.18719, 0.33304, 0.46604, 0.51117, 0.57492, 0.65928),
    ),
}
HEIGHTS = np.array([2.0, 5.0, 10.0, 20.0])  # m, where hills are looked at
ROUGHNESS = 0.03  # m, of grass


def taylor_green(cells: int, viscosity: float = 0.01, end: float = 0.5) -> tuple[float, float]:
    """Greatest error of a decaying Taylor-Green vortex at time `end`, and its divergence.

    u = sin x cos z exp(-2 nu t), w = -cos x sin z exp(-2 nu t), in a box of pi that slides.
    """
    flow = LaminarFlow(np.linspace(0.0, pi, cells + 1), viscosity, Walls(slides, slides, slides))
    grid = flow.grid
    u = np.sin(grid.x)[:, None, None] * np.cos(grid.zc)
    w = -np.cos(grid.xc)[:, None, None] * np.sin(grid.zeta)
    flow.velocity.u[:], flow.velocity.w[:] = u, w
    flow.march_in_time(end, max(1, round(end * cells / (0.25 * pi))), momentum.QUICK)
    left = exp(-2.0 * viscosity * end)
    error = max(abs(flow.velocity.u - left * u).max(), abs(flow.velocity.w - left * w).max())
    return float(error), flow.divergence


def cavity(reynolds: float, cells: int) -> tuple[np.ndarray, np.ndarray, float]:
    """Heights and u on the centre line of a lid-driven cavity, walls included, and its divergence.

    Where cells alike would be too thick for the layers at the walls, they are thinner there.
    """
    thin = 1.0 / (3.0 * reynolds**0.5)
    crowding = min(max(1.0 - thin * cells, 0.0), 0.8)
    even = np.linspace(0.0, 1.0, cells + 1)
    faces = even - crowding / (2.0 * pi) * np.sin(2.0 * pi * even)
    flow = LaminarFlow(faces, 1.0 / reynolds, Walls(sticks, drags, sticks))
    flow.march_to_rest(1.5 / cells, 1e-6, 400 * cells)
    u, middle = flow.velocity.u[:, 0], cells // 2
    line = u[middle] if cells % 2 == 0 else 0.5 * (u[middle] + u[middle + 1])
    return np.array([0.0, *flow.grid.zc, 1.0]), np.array([0.0, *line, 1.0]), flow.divergence


def ridge(steepness: float, cells: int = 192) -> tuple[float, float, float]:
    """Speed-up of potential flow at the crest of a ridge H / (1 + (x/L)^2), and its divergence.

    The mass-consistent model of a uniform wind is potential flow. In a lowest cell of L / 50; to
    first order in `steepness`, H/L, it is H/L / (1 + z/L)^2.
    """
    length = 50.0
    grid = Grid(
        np.linspace(-20.0 * length, 20.0 * length, cells + 1),
        np.array([0.0, length]),
        layers(length / 50.0, 1.1, 20.0 * length),
        lambda x, y: steepness * length / (1.0 + (x / length) ** 2),
    )
    velocity = Velocity.zeros(grid.shape)
    velocity.u[:] = 1.0
    solver = PressureSolver(grid)
    solver.project(velocity, 1e-12, 100)
    height = grid.zc[0] * grid.metric.jx[cells // 2, 0]
    linear = steepness / (1.0 + height / length) ** 2
    return float(velocity.u[cells // 2, 0, 0] - 1.0), linear, solver.divergence(velocity)


def hill(steepness: float, cell: float = 20.0) -> tuple[np.ndarray, np.ndarray, float]:
    """Speed-up at `HEIGHTS` above the top of a round hill, beside the estimate of Taylor and Lee.

    Half its height at L = 100 m; `steepness` is h/L. Taylor and Lee, Climatological Bulletin 18
    (1984) 3-32: 1.6 h/L exp(-4 z/L). Also the divergence.
    """
    length = 100.0

    def heights(x: np.ndarray, y: np.ndarray) -> np.ndarray:
        return steepness * length * np.exp(-log(2.0) * (x * x + y * y) / length**2)

    faces = with_buffer(-2.0 * length - 0.5 * cell, 2.0 * length + 0.5 * cell, cell, 1.25, 900.0)
    grid = Grid(faces, faces, layers(0.8, 1.2, 10.0 * length), heights)
    flow = SteadyFlow(grid, Terrain.bare(grid, ROUGHNESS), Inflow(0.0, ROUGHNESS))
    flow.run(March(change=3e-5))
    middle = len(grid.xc) // 2
    found = profile(flow, middle, middle, HEIGHTS) / flow.inflow.at(HEIGHTS) - 1.0
    return found, 1.6 * steepness * np.exp(-4.0 * HEIGHTS / length), flow.divergence


def flat(angle: float = 0.0, disturbed: float = 0.05) -> tuple[float, float, float]:
    """Greatest relative deviation from the logarithmic profile over level ground, and divergence.

    Of the profile as it flows in, and of one that was `disturbed` at the start by that share of
    it, 2 km downstream. Below 150 m.
    """
    grid = Grid(np.linspace(0.0, 2000.0, 81), np.linspace(0.0, 400.0, 17), layers(0.6, 1.2, 300.0))
    found, divergences = [], []
    for share in (0.0, disturbed):
        flow = SteadyFlow(grid, Terrain.bare(grid, ROUGHNESS), Inflow(angle, ROUGHNESS))
        waves = np.cos(grid.x / 90.0)[:, None, None] * np.cos(0.05 * grid.zc)
        flow.velocity.u[1:-1] *= 1.0 + share * waves[1:-1]
        flow.run(March(change=1e-5, steps=400))
        u, v, _ = flow.centred()
        low = grid.zc < 150.0
        speed = np.hypot(u, v)[-1][:, low]
        found.append(float(abs(speed / flow.inflow.at(grid.zc[low]) - 1.0).max()))
        divergences.append(flow.divergence)
    return found[0], found[1], max(divergences)


def trees(
    height: float = 10.0, width: float = 4.0, drag: float = 1.2
) -> tuple[np.ndarray, np.ndarray, float]:
    """Distances behind a row of trees, in heights, and the wind at 2 m there over that without.

    A row without end across the wind, `height` and `width` [m]; `drag` is Cd a times its width.
    Also the divergence.
    """
    grid = Grid(
        with_buffer(-150.0, 300.0, 2.0, 1.2, 800.0),
        np.array([0.0, 10.0]),
        layers(0.5, 1.12, 300.0),
    )
    across = overlap(grid.x, -0.5 * width, 0.5 * width)
    foliage = drag / width * across[:, None, None] * overlap(grid.zeta, 0.0, height)
    land = Terrain.bare(grid, ROUGHNESS)._replace(foliage=foliage)
    flow = SteadyFlow(grid, land, Inflow(0.0, ROUGHNESS))
    flow.run(March(steps=500, change=3e-5))
    low = np.array([2.0])
    speeds = [profile(flow, i, 0, low)[0] for i in range(len(grid.xc))]
    return grid.xc / height, np.array(speeds) / flow.inflow.at(2.0), flow.divergence


def overlap(faces: np.ndarray, low: float, high: float) -> np.ndarray:
    """Share of each cell between `faces` that lies between `low` and `high`."""
    inside = np.minimum(faces[1:], high) - np.maximum(faces[:-1], low)
    return np.clip(inside / np.diff(faces), 0.0, 1.0)


def profile(flow: SteadyFlow, i: int, j: int, heights: np.ndarray) -> np.ndarray:
    """Level wind [m/s] at `heights` over the ground of a column, straight in their logarithm."""
    roughness = flow.land.roughness[i, j]
    u, v, _ = flow.centred()
    own = np.log1p(flow.grid.zc * flow.grid.metric.j[i, j] / roughness)
    return np.interp(
        np.log1p(heights / roughness), [0.0, *own], [0.0, *np.hypot(u[i, j], v[i, j])]
    )


def show_taylor_green(options: argparse.Namespace) -> None:
    """Print errors of the Taylor-Green vortex and the orders between them."""
    print('cells  largest error  order  divergence')
    errors: list[float] = []
    for number, cells in enumerate(options.grids):
        error, divergence = taylor_green(cells)
        finer = cells / options.grids[number - 1] if errors else 1.0
        order = f'{log2(errors[-1] / error) / log2(finer):.2f}' if errors else '-'
        print(f'{cells:5}  {error:13.3e}  {order:>5}  {divergence:.1e}')
        errors.append(error)
    whole = log2(errors[0] / errors[-1]) / log2(options.grids[-1] / options.grids[0])
    print(
        f'order {whole:.3f} from {options.grids[0]} to {options.grids[-1]} cells; it should be 2'
    )


def show_cavity(options: argparse.Namespace) -> None:
    """Print u on the centre line of the lid-driven cavity."""
    z, u, divergence = cavity(options.reynolds, options.cells)
    print('z u')
    for height, speed in zip(z, u):
        print(f'{height:.6f} {speed:.6f}')
    known = GHIA.get(options.reynolds)
    if known:
        error = abs(np.interp(GHIA_HEIGHTS, z, u) - known)
        where = GHIA_HEIGHTS[int(error.argmax())]
        print(f'# largest difference from Ghia 1982: {error.max():.4f} at z = {where}')
    print(f'# divergence {divergence:.1e}')


def show_ridge(options: argparse.Namespace) -> None:
    """Print the speed-up of potential flow over ridges."""
    print('H/L   crest   linear theory  ratio  divergence')
    for steepness in (0.05, 0.1):
        found, linear, divergence = ridge(steepness)
        print(
            f'{steepness:4}  {found:.4f}  {linear:13.4f}  {found / linear:.3f}  {divergence:.1e}'
        )


def show_hill(options: argparse.Namespace) -> None:
    """Print the speed-up over round hills, on two grids."""
    print('h/L     cells, z:  ' + '  '.join(f'{z:6.0f} m' for z in HEIGHTS) + '  divergence')
    for steepness in (0.1, 0.3):
        for cell in (20.0, 10.0):
            found, expected, divergence = hill(steepness, cell)
            row = '  '.join(f'{value:8.4f}' for value in found)
            print(f'{steepness:3}  {f"{cell:.0f} m":>11}  {row}  {divergence:.1e}')
        row = '  '.join(f'{value:8.4f}' for value in expected)
        print(f'{steepness:3}  Taylor, Lee  {row}')


def show_flat(options: argparse.Namespace) -> None:
    """Print how the logarithmic profile is kept over level ground."""
    print('angle  kept within  disturbed by 5 %, after 2 km  divergence')
    for angle in (0.0, 0.3):
        kept, disturbed, divergence = flat(angle)
        print(f'{angle:5.1f}  {kept:11.1e}  {disturbed:28.2e}  {divergence:.1e}')


def show_trees(options: argparse.Namespace) -> None:
    """Print the wind at 2 m behind a row of trees."""
    x, ratio, divergence = trees()
    print('heights behind  U/U0 at 2 m')
    for place in (-5, -2, 0, 1, 2, 3, 4, 5, 6, 8, 10, 12, 15, 20, 25, 30):
        print(f'{place:14}  {np.interp(place, x, ratio):.3f}')
    least = int(ratio.argmin())
    print(f'# least {ratio[least]:.3f} at {x[least]:.1f} heights; divergence {divergence:.1e}')


CASES = {
    'taylor_green': show_taylor_green,
    'cavity': show_cavity,
    'ridge': show_ridge,
    'hill': show_hill,
    'flat': show_flat,
    'trees': show_trees,
}


def main(args: Sequence[str] | None = None) -> int:
    """Print one case; return the exit code."""
    parser = argparse.ArgumentParser(
        prog='python -m golf_sim_ros.wind.verification',
        description='A case with a known solution.',
    )
    cases = parser.add_subparsers(dest='case', required=True, metavar='CASE')
    for name, show in CASES.items():
        case = cases.add_parser(name, help=show.__doc__, description=show.__doc__)
        if name == 'cavity':
            case.add_argument('--reynolds', type=positive, default=100, help='100')
            case.add_argument('--cells', type=positive, default=32, help='along a side: 32')
        if name == 'taylor_green':
            case.add_argument('--grids', type=positive, nargs='+', default=[16, 32, 64, 128])
    options = parser.parse_args(args)
    CASES[options.case](options)
    return 0


def positive(text: str) -> int:
    """Whole number over 1 of `text`."""
    number = int(text)
    if number < 2:
        raise ValueError
    return number


if __name__ == '__main__':
    sys.exit(main())
