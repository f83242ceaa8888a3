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

"""Types of what kernels are given and answer with, for annotations; numba takes no notice of them.

A record without a static type is `Any`: a structured array's row, whose fields numpy's types do
not know, and a named tuple whose type is chosen when a kernel compiles, or that a later layer
defines. So mypy checks of a kernel how it is called, its vectors and numbers, and no field of a
record.
"""

from typing import Any

# x, y, z: a vector as kernels handle it, see `mechanics.vector`
Vector = tuple[float, float, float]
# an axis-aligned box: its least and greatest x, y, z
Box = tuple[Vector, Vector]
# position, velocity and spin side by side, or their rates, as integrators handle them
MotionState = tuple[float, float, float, float, float, float, float, float, float]

# Bernstein coefficients of a segment's height over a plane
Heights = tuple[float, float, float, float, float, float]
# height of a bicubic surface, and its derivatives by x, y, xx, xy and yy
SurfacePoint = tuple[float, float, float, float, float, float]
# its derivatives by xxx, xxy, xyy, yyy, xxxy, xxyy and xyyy
HigherDerivatives = tuple[float, float, float, float, float, float, float]
# a rectangle in plan: least x and y, greatest x and y
Rectangle = tuple[float, float, float, float]

# a row of a `state.ball.BALL` array, or such an array of no dimensions
BallRecord = Any
# a row of a `collision.workspace.CONTACT` array
ContactRecord = Any
# a row of a `properties.material.MATERIAL` array
MaterialRecord = Any
# a row of another structured array, as of a kind of ground
StructRecord = Any
# an effect's record, and a model's tuple of them
EffectRecord = Any
Effects = tuple[EffectRecord, ...]
# a kind of ground, as `geometry.mesh.Meshes`
KindRecord = Any
# a shape of a course, as `geometry.plane.Plane`
ShapeRecord = Any
# an integrator, as `integrators.dormand_prince.DormandPrince`
MethodRecord = Any
# a `scene.kernel_model.GroundScene`, and a `scene.kernel_model.Model`
SceneRecord = Any
ModelRecord = Any
# a `collision.workspace.Workspace`, or a `MultiBallWorkspace`, which is one, too
WorkRecord = Any
# a `scene.course_record.Course`, where effects look at it, and its `scene.course_record.Ball`
CourseRecord = Any
BallProperties = Any
