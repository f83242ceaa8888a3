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

"""What theory says: closed forms and independent equations, none of them taken from the package.

A solid sphere has k = I / (m r^2) = 2/5. In formulas of contact, `spin` is the speed r w that the
surface of the ball has by its spin: positive as in rolling forward; in rolling v = spin.
"""

from math import atan, cos, cosh, exp, expm1, log, log1p, pi, sin, sqrt, tanh

G = 9.80665  # m/s^2, CGPM 1901
MASS = 0.04593  # kg, R&A and USGA Equipment Rules part 4: at most
RADIUS = 0.021335  # m, the same rules: half of 42.67 mm, at least
K = 0.4  # of a uniform sphere


# Flight


def vacuum_flight(speed, angle):
    """Range, height and time over level ground: v^2 sin 2a / g, (v sin a)^2 / 2g, 2v sin a / g."""
    up = speed * sin(angle)
    return speed * speed * sin(2 * angle) / G, up * up / (2 * G), 2 * up / G


def linear_drag_path(velocity, rate, time):
    """Way after `time` with v' = -b v - g: integrate v = (v0 + g/b) e^(-b t) - g/b."""
    fade = -expm1(-rate * time) / rate
    return (
        velocity[0] * fade,
        velocity[1] * fade,
        (velocity[2] + G / rate) * fade - G * time / rate,
    )


def terminal_speed(push, drag):
    """Speed at which drag K v^2 holds gravity, K = rho A CD / 2m = `push` times CD."""
    return sqrt(G / (push * drag))


def quadratic_rise(speed, terminal):
    """Height and time of a rise against K v^2: dv/dt = -g (1 + v^2/vt^2) by separation."""
    ratio = speed / terminal
    return terminal * terminal / (2 * G) * log1p(ratio * ratio), terminal / G * atan(ratio)


def quadratic_fall(time, terminal):
    """Way and speed of a fall from rest against K v^2: v = vt tanh(g t / vt)."""
    turns = G * time / terminal
    return terminal * terminal / G * log(cosh(turns)), terminal * tanh(turns)


def quadratic_return_speed(speed, terminal):
    """Speed back at the start, from rise and fall of equal height: v0 / sqrt(1 + v0^2 / vt^2)."""
    return speed / sqrt(1 + (speed / terminal) ** 2)


def quadratic_coast(speed, rate, time):
    """Way and speed with v' = -K v^2 alone: ln(1 + K v0 t) / K, v0 / (1 + K v0 t)."""
    return log1p(rate * speed * time) / rate, speed / (1 + rate * speed * time)


def spin_after(spin, path):
    """Spin left after a path of that length in air of 1.18 kg/m^3.

    d ln w / ds = -2e-5 / r (Smits, Smith).
    """
    return spin * exp(-2e-5 * path / RADIUS)


def drag_coefficient(s, re):
    """Drag coefficient by spin ratio and Reynolds number: a fit, its numbers the package's own."""
    spun = s**2 / (s**2 + 0.2114**2)
    turbulent = 0.1319 + 0.1209 * re**2 / (re**2 + 1.672e5**2) + 0.2242 * spun
    laminar = 0.4507 + 0.0682 * spun
    part = 1 / (1 + (re / 6.531e4) ** 8)
    return (1 - part) * turbulent + part * laminar


def lift_coefficient(s, re):
    """Lift coefficient likewise."""
    return s / sqrt(s**2 + 0.02**2) * 0.07761 * (
        1 - 0.4113 / (1 + (re / 1.267e5) ** 4)
    ) + 0.3755 * s / sqrt(s**2 + 0.3335**2)


def golf_ball_rates(density, viscosity):
    """Right-hand side f(t, y) of a golf ball's flight in still air, y' = f.

    y is position, velocity, spin. Drag against the velocity, lift along spin x velocity by the
    spin across the path, spin decay after Smits and Smith 1994.
    """
    push = density * pi * RADIUS * RADIUS / (2 * MASS)
    decay = 2e-5 * density / 1.18 / RADIUS

    def rates(_, y):
        u, v, w, p, q, r = map(float, y[3:])
        speed = sqrt(u * u + v * v + w * w)
        re = 2 * RADIUS * speed * density / viscosity
        drag = push * drag_coefficient(RADIUS * sqrt(p * p + q * q + r * r) / speed, re) * speed
        lx, ly, lz = q * w - r * v, r * u - p * w, p * v - q * u
        across = sqrt(lx * lx + ly * ly + lz * lz)
        lift = push * speed * speed * lift_coefficient(RADIUS * across / (speed * speed), re)
        lift = lift / across if across > 0 else 0.0
        fade = -decay * speed
        return (
            u,
            v,
            w,
            lift * lx - drag * u,
            lift * ly - drag * v,
            lift * lz - drag * w - G,
            fade * p,
            fade * q,
            fade * r,
        )

    return rates


# Impact


def time_of_all_bounces(speed, e):
    """Time from a launch upward at `speed` to rest: the sum of 2 v e^n / g."""
    return 2 * speed / (G * (1 - e))


def height_after(height, e, bounces):
    """Height that a ball dropped from `height` reaches after so many bounces: e^(2n) h."""
    return height * e ** (2 * bounces)


def gripping_bounce(v, spin, ex):
    """Velocity and spin after a bounce with grip: slip u = v - spin becomes -ex u.

    v + k spin is kept. ex = 0 leaves rolling, 5/7 v + 2/7 spin; ex = 1 is Garwin's superball (Am.
    J. Phys. 37 (1969) 88).
    """
    return (
        ((1 - K * ex) * v + K * (1 + ex) * spin) / (1 + K),
        ((1 + ex) * v + (K - ex) * spin) / (1 + K),
    )


def slipping_bounce(v, spin, mu, e, approach):
    """Return the same when the friction mu (1 + e) vn is too weak to stop the slip (Coulomb)."""
    loss = mu * (1 + e) * approach * (1 if v > spin else -1)
    return v - loss, spin + loss / K


def grips(v, spin, mu, e, approach):
    """Whether friction can stop the slip in a bounce: |u| <= (1 + 1/k) mu (1 + e) vn."""
    return abs(v - spin) <= (1 + 1 / K) * mu * (1 + e) * approach


# Sliding and rolling


def slide_to_roll(v, spin, mu):
    """Velocity when rolling begins, when and where: v' = -mu g, slip falls at 7/2 mu g."""
    slip = v - spin
    time = 2 * abs(slip) / (7 * mu * G)
    sign = 1 if slip > 0 else -1
    return (5 * v + 2 * spin) / 7, time, v * time - sign * mu * G * time * time / 2


def rolling_down(angle, time):
    """Way of a ball that rolls from rest down a slope: gravity along it times 1 / (1 + k)."""
    return G * sin(angle) / (1 + K) * time * time / 2


def stimp_distance(feet):
    """How far a ball rolls that leaves the stimpmeter, by definition of the reading [m]."""
    return 0.3048 * feet


def break_of_putt(side, decel, way, left):
    """Sideways deviation of a putt after `way`, with `left` still to go, by a `side` acceleration.

    The acceleration is small.

    Friction acts along the velocity: y'' = B - (a / v) y'. With v^2 = 2 a (distance left) this
    integrates to B/a (D/2 - R/2 ln((D + R) / R)).
    """
    return side / decel * (way / 2 - left / 2 * log((way + left) / left))


def sliding_ball_rates(mu, tilt):
    """Right-hand side f(t, y) of a ball sliding on a plane that falls by `tilt` towards +x.

    `tilt` is an angle; y' = f.

    y is (x, y, u, v, p, q): place and velocity along the plane and the spin's components there,
    x down the slope. Coulomb friction mu g cos(tilt) acts against the slip.
    """

    def rates(_, y):
        u, v, p, q = y[2:]
        slip_x, slip_y = u - RADIUS * q, v + RADIUS * p
        slip = sqrt(slip_x * slip_x + slip_y * slip_y)
        fx = -mu * G * cos(tilt) * slip_x / slip
        fy = -mu * G * cos(tilt) * slip_y / slip
        return u, v, G * sin(tilt) + fx, fy, fy / (K * RADIUS), -fx / (K * RADIUS)

    return rates


def rolling_ball_rates(resistance, tilt):
    """Right-hand side f(t, y) of a ball rolling on such a plane.

    y' = f, y = (x, y, u, v); the ball is braked by resistance times g cos.
    """

    def rates(_, y):
        u, v = y[2:]
        brake = resistance * G * cos(tilt) / sqrt(u * u + v * v)
        return u, v, G * sin(tilt) / (1 + K) - brake * u, -brake * v

    return rates
