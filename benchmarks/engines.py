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

"""MuJoCo and PyBullet on the same scenes, at 250 steps a second.

Skipped where they are not installed.

So that nothing of theirs is held back: no damping of the air (PyBullet's linear and angular
damping 0), no spin or rolling friction, Coulomb friction and restitution as ours as far as they
can. PyBullet takes both as they are, of a pair by multiplication, with its 50 iterations. MuJoCo
has springs in place of restitution: `solref` is its own time constant and the damping ratio of
that restitution, but no less than it can take; friction of a pair is the greater. None of the two
lets anything sleep here. Ours does: what is calm in a pile sleeps, so the pour is timed while the
balls fall and heap up, and not after.
"""

from math import log, pi, sqrt
import tempfile

from golf_sim_ros.physics import Ball, Course, Material, Patch, Plane, Restitution, World
from golf_sim_ros.study.measure import Stage
from golf_sim_ros.study.sizes import rolling
import numpy as np
from timing import clocked, Row

STEP = 1 / 250  # s
BALLS, SIDE, POUR = 1000, 0.5, 2.0  # balls, m, s
TRIANGLES, ROLL = 100_000, 9.0  # of the terrain; s
RESTITUTION, FRICTION = 0.5, 0.3
SPRING, LEAST_RATIO = 0.02, 0.2  # s, of MuJoCo's springs: others explode, or let a ball sink
RADIUS, MASS = Ball().radius, Ball().mass


def rows(quick):
    """`Row` of each scene and engine."""
    engines = installed()
    if not engines:
        return
    yield from pours(engines, BALLS // 10 if quick else BALLS)
    yield from rolls(engines)


def installed():
    """Those that are there: names and classes; says which is not."""
    found = {}
    for name, engine in (('MuJoCo', MuJoCo), ('PyBullet', PyBullet)):
        try:
            engine.load()
            found[name] = engine
        except ImportError:
            print(
                f'{name}: not timed, not installed: pip install "golf_sim_ros[bench]"', flush=True
            )
    return found


def pours(engines, count):
    """Rows: balls poured into a box."""
    world = poured(count)
    start = world.state()
    world.advance(POUR)
    world.restore(start)
    ours = clocked(lambda: [world.advance(STEP) for _ in range(round(POUR / STEP))])
    own = overlap(np.array([world[name].position for name in world.names]))
    yield Row(f'{count} balls poured: overlap', 1e3 * own, 'mm', most=0.1)
    for name, engine in engines.items():
        scene = engine()
        scene.box()
        scene.balls(heap(count))
        scene.build()
        time = clocked(lambda: scene.advance(round(POUR / STEP)))
        yield Row(
            f'{count} balls poured, over {name}',
            time / ours,
            least=5.0,
            times=(ours, time),
            note=f'its overlap {1e3 * overlap(scene.places()):.2g} mm',
        )


def rolls(engines):
    """Rows: one ball that bounces and rolls over a mesh."""
    game = rolling(TRIANGLES)
    stage = Stage(game, 'standard')
    stage()
    ours = clocked(lambda: stage(20)) / 20
    (mesh,) = game.course.ground
    ((_, velocity, _),) = game.strikes
    for name, engine in engines.items():
        scene = engine()
        scene.terrain(mesh.vertices, mesh.faces)
        scene.balls([stage.world[stage.world.names[0]].position])
        scene.balls_start(velocity)
        scene.build()
        time = clocked(lambda: scene.advance(round(ROLL / STEP)))
        yield Row(
            f'bouncing and rolling on {TRIANGLES:,} triangles, over {name}',
            time / ours,
            least=10.0,
            times=(ours, time),
        )


def poured(count):
    """`World` of balls that are about to fall into a box."""
    world = World(
        Course(
            box(),
            tee=(0.0, 500.0),
            ball=Ball(restitution=RESTITUTION, friction=FRICTION),
            effects=('gravity', 'ball_ball'),
        ),
        count,
    )
    for name, place in zip(world.names, heap(count)):
        world.place(name, place, velocity=(0.0, 0.0, 0.0))
    return world


def box():
    """Floor and four walls."""
    floor = Material('floor', Restitution(RESTITUTION), 0.0, FRICTION, FRICTION, 0.0)
    walls = [
        Patch((0.5 * SIDE * x, 0.5 * SIDE * y, 2.0), (-x, -y, 0), 0.0, SIDE + 0.1, 4.0, floor)
        for x, y in ((1, 0), (-1, 0), (0, 1), (0, -1))
    ]
    return (Plane(material=floor), *walls)


def heap(count):
    """Where balls begin, (n, 3) [m]: in layers, out of line."""
    jitter = np.random.default_rng(1).uniform(-5e-3, 5e-3, (count, 3)) * (1, 1, 0)
    i = np.arange(count)
    return 0.06 * np.transpose([i % 8 - 3.5, i // 8 % 8 - 3.5, i // 64]) + (0, 0, 0.1) + jitter


def overlap(places):
    """How deep [m] the two balls that overlap most do."""
    deepest = 0.0
    for i in range(len(places) - 1):
        after = i + 1
        nearest = np.linalg.norm(places[after:] - places[i], axis=1).min()
        deepest = max(deepest, 2 * RADIUS - nearest)
    return deepest


class PyBullet:
    """A scene of PyBullet's."""

    @staticmethod
    def load():
        """Import the module."""
        import pybullet

        return pybullet

    def __init__(self):
        from pybullet_utils.bullet_client import BulletClient

        self.bullet, self.p = self.load(), BulletClient(self.load().DIRECT)
        self.p.setGravity(0, 0, -9.80665)
        self.p.setTimeStep(STEP)
        self.bodies = []

    def body(
        self, shape, mass, place=(0, 0, 0), turn=(0, 0, 0, 1), material=(RESTITUTION, FRICTION)
    ):
        """Add a body; of a pair restitution and friction are multiplied, so each has the root."""
        body = self.p.createMultiBody(mass, shape, -1, list(map(float, place)), turn)
        self.p.changeDynamics(
            body,
            -1,
            restitution=sqrt(material[0]),
            lateralFriction=sqrt(material[1]),
            rollingFriction=0,
            spinningFriction=0,
            linearDamping=0,
            angularDamping=0,
        )
        return body

    def box(self):
        """Floor and walls."""
        for x, y in ((0, 0), (1, 0), (-1, 0), (0, 1), (0, -1)):
            normal = [-x, -y, 0] if x or y else [0, 0, 1]
            shape = self.p.createCollisionShape(self.bullet.GEOM_PLANE, planeNormal=normal)
            self.body(shape, 0, (0.5 * SIDE * x, 0.5 * SIDE * y, 0))

    def terrain(self, vertices, faces):
        """Triangles."""
        with tempfile.NamedTemporaryFile('w', suffix='.obj') as file:
            file.writelines(f'v {x} {y} {z}\n' for x, y, z in vertices)
            file.writelines(f'f {a} {b} {c}\n' for a, b, c in np.asarray(faces) + 1)
            file.flush()
            shape = self.p.createCollisionShape(
                self.bullet.GEOM_MESH,
                fileName=file.name,
                flags=self.bullet.GEOM_FORCE_CONCAVE_TRIMESH,
            )
        self.body(shape, 0, material=(0.8, 0.3))

    def balls(self, places):
        """Add balls."""
        shape = self.p.createCollisionShape(self.bullet.GEOM_SPHERE, radius=RADIUS)
        self.bodies = [self.body(shape, MASS, place) for place in places]

    def balls_start(self, velocity):
        """Set the balls off."""
        for body in self.bodies:
            self.p.resetBaseVelocity(body, velocity)

    def build(self):
        """Nothing is left to do."""

    def advance(self, steps):
        """Let time pass."""
        for _ in range(steps):
            self.p.stepSimulation()

    def places(self):
        """Positions (n, 3)."""
        return np.array([self.p.getBasePositionAndOrientation(body)[0] for body in self.bodies])


class MuJoCo:
    """A scene of MuJoCo's, as XML until it is built."""

    @staticmethod
    def load():
        """Import the module."""
        import mujoco

        return mujoco

    def __init__(self):
        self.world, self.asset, self.velocity, self.files = [], '', (0, 0, 0), {}
        self.restitution = RESTITUTION

    def box(self):
        """Floor and walls."""
        for x, y in ((0, 0), (1, 0), (-1, 0), (0, 1), (0, -1)):
            axis = f'{-x} {-y} 0' if x or y else '0 0 1'
            self.world.append(
                f'<geom type="plane" size="5 5 1" pos="{0.5 * SIDE * x} {0.5 * SIDE * y} 0" '
                f'zaxis="{axis}"/>'
            )

    def terrain(self, vertices, faces):
        """Heights, which are as many triangles: of a mesh MuJoCo takes the convex hull only."""
        across = round(sqrt(len(vertices)))
        z = np.asarray(vertices)[:, 2].reshape(across, across)
        half, low, high = np.abs(vertices).max(), z.min(), z.max()
        data = np.array([across, across], np.int32).tobytes() + z.astype(np.float32).tobytes()
        self.files['terrain.bin'] = data
        self.asset = (
            f'<asset><hfield name="terrain" file="terrain.bin" '
            f'size="{half} {half} {high - low} 1"/></asset>'
        )
        self.world.append(f'<geom type="hfield" hfield="terrain" pos="0 0 {low}"/>')
        self.restitution = 0.8

    def balls(self, places):
        """Add balls."""
        self.world += [
            f'<body pos="{x} {y} {z}"><freejoint/><geom size="{RADIUS}" mass="{MASS}"/></body>'
            for x, y, z in places
        ]

    def balls_start(self, velocity):
        """Set the balls off."""
        self.velocity = velocity

    def build(self):
        """Compile the scene."""
        damping = -log(self.restitution)
        ratio = damping / sqrt(pi * pi + damping * damping)
        spring = f'{SPRING} {max(ratio, LEAST_RATIO)}'
        xml = (
            f'<mujoco><option timestep="{STEP}" gravity="0 0 -9.80665"/><size memory="1G"/>'
            f'<default><geom friction="{FRICTION} 0 0" solref="{spring}"/></default>'
            f'{self.asset}<worldbody>{"".join(self.world)}</worldbody></mujoco>'
        )
        self.model = self.load().MjModel.from_xml_string(xml, self.files)
        self.data = self.load().MjData(self.model)
        self.data.qvel[:3] = self.velocity

    def advance(self, steps):
        """Let time pass."""
        self.load().mj_step(self.model, self.data, steps)

    def places(self):
        """Positions (n, 3)."""
        return self.data.xpos[1:].copy()
