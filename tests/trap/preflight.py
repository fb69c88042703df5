#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Compares the warnings before a run with the run, on random scenes.

`oiler play --trace` steps each scene. The true motion is integrated here, by the embedded pairs of
Dormand and Prince with an error of 1e-9; bouncing balls have a closed form. A run is bad if

- it explodes: it ends with exit code 5, or moves ten times as far as the true motion;
- it grows: it moves four times as far; a driven body, ten per cent farther or less far; an orbit's
  energy changes by half;
- it reverses: a step turns the velocity relative to the air, and the true motion from the same
  state does not in two steps; bodies on overdamped springs move against their true velocity in 2 %
  of the first 64 steps;
- it freezes: it rests although the true motion moves on, a body lies inside a plane, or a ball has
  less than a quarter of the energy of the next bounce while one has a quarter of the first one's;
- it dies: in the last quarter of a run of springs, its kinetic energy is less than a third;
- an orbit's farthest point is wrong by 30 %;
- rounding changes its motion by 2 %, or an oscillation by a fifth of its extent.

A bad run without a warning is missed. A warning of a run that is not bad, nor in ten times as many
steps and 10,000 more, is a false alarm, unless a driven body is 5 % of its reach away from its
place, springs have lost 30 % of their kinetic energy, or half of their energy as the warning says,
springs have gained more than their largest kinetic energy, an orbit's farthest point is wrong by
15 % or an oscillation in float by 5 %. Exits with 1 if more than 1 % are missed or more than 5 %
are false."""

import argparse
import collections
import math
import operator
import random
import re
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

METHODS = """explicit_euler semi_implicit_euler semi_implicit_euler_drift_kick implicit_euler
implicit_midpoint velocity_verlet position_verlet rk2_midpoint rk2_heun rk3_kutta rk4 rk4_38 ruth3
mclachlan_atela2 forest_ruth4 suzuki4_kdk pefrl mclachlan_sb3a_4 blanes_moan_srkn6b
yoshida6a_kdk kahan_li6_kdk blanes_moan_srkn14a kahan_li8_kdk""".split()
USUAL = ["semi_implicit_euler", "velocity_verlet", "rk4", "implicit_midpoint"]


def rounded(number):
    return float(f"{number:.4g}")


def in_float(number):
    return struct.unpack("f", struct.pack("f", number))[0]


class Dice(random.Random):
    def log(self, low, high):
        return rounded(math.exp(self.uniform(math.log(low), math.log(high))))

    def number(self, low, high):
        return rounded(self.uniform(low, high))

    def chance(self, part):
        return self.random() < part


class Scene:
    """The forces on some bodies, as text for the program and as accelerations for the truth."""

    def __init__(self, kind, axes):
        self.kind, self.axes, self.rate, self.ticks = kind, axes, 60, 600
        self.method, self.precision, self.damping = "velocity_verlet", "double", ""
        self.gravity = [0.0] * axes
        self.bodies, self.springs, self.drives, self.winds = [], [], [], []
        self.attractors, self.planes = [], []
        self.left, self.wrong, self.departure, self.turned = 1.0, 0.0, 0.0, 0.0

    def body(self, x, v, mass=1.0, linear=0.0, quadratic=0.0, contact=None):
        pad = [0.0] * self.axes
        at, speed = (list(x) + pad)[: self.axes], (list(v) + pad)[: self.axes]
        self.bodies.append((at, speed, mass, linear, quadratic, contact))
        return len(self.bodies) - 1

    def spring(self, body, end, k, b=0.0, length=0.0):
        if not isinstance(end, int):
            end = (list(end) + [0.0] * self.axes)[: self.axes]
        self.springs.append((body, end, k, b, length))

    def text(self):
        lines = ["[scene]", f"axes = {self.axes}", f"rate = {self.rate}",
                 f'method = "{self.method}"', f'precision = "{self.precision}"']
        if self.damping:
            lines.append(f'damping = "{self.damping}"')
        if any(self.gravity):
            lines += ["[gravity]", f"acceleration = {self.gravity}"]
        for i, (x, v, mass, linear, quadratic, contact) in enumerate(self.bodies):
            lines += ["[[body]]", f'name = "b{i}"', f"position = {x}", f"velocity = {v}",
                      f"mass = {mass}", f"linear_drag = {linear}", f"quadratic_drag = {quadratic}"]
            if contact is not None:
                lines.append(f"contact = {contact}")
        for body, end, k, b, length in self.springs:
            other = f'to = "b{end}"' if isinstance(end, int) else f"anchor = {end}"
            lines += ["[[spring]]", f'body = "b{body}"', other, f"stiffness = {k}",
                      f"damping = {b}", f"rest_length = {length}"]
        for body, amplitude, frequency, phase in self.drives:
            lines += ["[[drive]]", f'body = "b{body}"', f"amplitude = {amplitude}",
                      f"frequency = {frequency}", f"phase = {phase}"]
        for body, velocity, drag in self.winds:
            lines += ["[[wind]]", f'body = "b{body}"', f"velocity = {velocity}", f"drag = {drag}"]
        for at, gm in self.attractors:
            lines += ["[[attractor]]", f"position = {at}", f"gm = {gm}"]
        for normal, offset, restitution in self.planes:
            lines += ["[[plane]]", f"normal = {normal}", f"offset = {offset}",
                      f"restitution = {restitution}"]
        return "\n".join(lines) + "\n"

    def accelerations(self, t, x, v):
        """Of all bodies, body by body; x and v are flat lists."""
        axes = range(self.axes)
        n = self.axes
        force = []
        for i, (_, _, mass, linear, quadratic, _) in enumerate(self.bodies):
            speed = math.hypot(*v[n * i: n * i + n]) if quadratic else 0.0
            c = linear + quadratic * speed
            force += [mass * self.gravity[a] - c * v[n * i + a] for a in axes]
        for body, end, k, b, length in self.springs:
            linked = isinstance(end, int)
            d = [x[n * body + a] - (x[n * end + a] if linked else end[a]) for a in axes]
            u = [v[n * body + a] - (v[n * end + a] if linked else 0.0) for a in axes]
            if length:
                size = math.hypot(*d)
                if size == 0:
                    continue
                along = sum(d[a] * u[a] for a in axes) / size
                pull = [(-k * (size - length) - b * along) * d[a] / size for a in axes]
            else:
                pull = [-k * d[a] - b * u[a] for a in axes]
            for a in axes:
                force[n * body + a] += pull[a]
                if linked:
                    force[n * end + a] -= pull[a]
        for body, amplitude, frequency, phase in self.drives:
            sine = math.sin(2 * math.pi * frequency * t + phase)
            for a in axes:
                force[n * body + a] += amplitude[a] * sine
        for body, velocity, drag in self.winds:
            u = [v[n * body + a] - velocity[a] for a in axes]
            for a in axes:
                force[n * body + a] -= drag * math.hypot(*u) * u[a]
        for at, gm in self.attractors:
            for i, one in enumerate(self.bodies):
                d = [at[a] - x[n * i + a] for a in axes]
                size = math.hypot(*d)
                for a in axes:
                    force[n * i + a] += one[2] * gm * d[a] / size**3
        return [f / self.bodies[i // n][2] for i, f in enumerate(force)]


# Dormand & Prince 1980, RK5(4)7M.
NODES = [0, 1 / 5, 3 / 10, 4 / 5, 8 / 9, 1]
ROWS = [[], [1 / 5], [3 / 40, 9 / 40], [44 / 45, -56 / 15, 32 / 9],
        [19372 / 6561, -25360 / 2187, 64448 / 6561, -212 / 729],
        [9017 / 3168, -355 / 33, 46732 / 5247, 49 / 176, -5103 / 18656]]
WEIGHTS = [35 / 384, 0, 500 / 1113, 125 / 192, -2187 / 6784, 11 / 84]
ERRORS = [71 / 57600, 0, -71 / 16695, 71 / 1920, -17253 / 339200, 22 / 525, -1 / 40]


class TooLong(Exception):
    """The true motion needs too many steps."""


class Truth:
    def __init__(self, scene, tolerance=1e-9):
        self.scene, self.t, self.tolerance = scene, 0.0, tolerance
        self.y = [a for body in scene.bodies for a in body[0]]
        self.y += [a for body in scene.bodies for a in body[1]]
        self.size = len(self.y) // 2
        self.k = self.slope(0.0, self.y)
        self.h = 1e-3 / scene.rate
        self.budget = 400_000

    def slope(self, t, y):
        v = y[self.size:]
        return v + self.scene.accelerations(t, y[: self.size], v)

    def advance(self, until):
        """Integrates to a time; the last step ends there."""
        while self.t < until * (1 - 1e-14):
            self.budget -= 1
            if self.budget < 0:
                raise TooLong
            h = min(self.h, until - self.t)
            ks = [self.k]
            for node, row in zip(NODES[1:], ROWS[1:]):
                y = [one + h * sum(w * k[i] for w, k in zip(row, ks) if w)
                     for i, one in enumerate(self.y)]
                ks.append(self.slope(self.t + node * h, y))
            y = [one + h * sum(w * k[i] for w, k in zip(WEIGHTS, ks) if w)
                 for i, one in enumerate(self.y)]
            ks.append(self.slope(self.t + h, y))
            scales = [max(map(abs, y[: self.size] + self.y[: self.size])) + 1e-6,
                      max(map(abs, y[self.size:] + self.y[self.size:])) + 1e-6]
            error = max(abs(h * sum(e * k[i] for e, k in zip(ERRORS, ks) if e))
                        / scales[i >= self.size] for i in range(len(y))) / self.tolerance
            if error <= 1:
                self.t, self.y, self.k = self.t + h, y, ks[-1]
            if error > 1 or h == self.h:
                self.h = h * min(4.0, max(0.2, 0.9 * max(error, 1e-10) ** -0.2))
        return self.y


# ---- kinds of scenes

def anchored(dice, scene, omega, size):
    """A body on a spring without a rest length; returns the body."""
    mass = dice.log(0.1, 10)
    k = rounded(mass * omega * omega)
    choice = dice.randrange(5)
    critical = 2 * math.sqrt(mass * k)
    b = 0.0 if choice < 3 else rounded(critical * dice.log(1e-3, 1)) if choice == 3 else \
        rounded(critical * dice.log(1, 30))
    x = [dice.number(-size, size) for _ in range(scene.axes)]
    v = [dice.number(-size, size) * omega if dice.chance(0.5) else 0.0 for _ in range(scene.axes)]
    body = scene.body(x, v, mass)
    scene.spring(body, [0.0], k, b)
    return body


def springs(dice):
    scene = Scene("springs", dice.randint(1, 3))
    if dice.chance(0.3):
        scene.gravity[-1] = -9.81
    for _ in range(dice.randint(1, 4)):
        anchored(dice, scene, scene.rate * dice.log(0.03, 4), dice.log(0.1, 10))
    scene.ticks = 1500
    return scene


def edge(dice):
    """Exactly at the limit of velocity_verlet and semi-implicit Euler, or close to it."""
    scene = Scene("edge", 1)
    scene.rate = 2 ** dice.randint(3, 8)
    omega = scene.rate * 2 * (1 if dice.chance(0.5) else 1 + dice.choice([-1, 1]) * 0.05)
    scene.body([1.0], [0.0])
    scene.spring(0, [0.0], omega * omega)
    scene.method = dice.choice(["velocity_verlet", "position_verlet", "semi_implicit_euler",
                                "semi_implicit_euler_drift_kick"])
    return scene


def pendulum(dice):
    scene = Scene("pendulum", 2)
    scene.gravity[1] = -9.81
    length, angle = dice.number(0.5, 3), dice.uniform(0.2, 2.5)
    mass = dice.log(0.1, 10)
    k = rounded(mass * (scene.rate * dice.log(0.05, 3)) ** 2 + 20 * mass / length)
    scene.body([rounded(length * math.sin(angle)), rounded(-length * math.cos(angle))], [0.0],
               mass)
    damping = 0.0 if dice.chance(0.6) else rounded(math.sqrt(k) * dice.log(0.01, 1))
    scene.spring(0, [0.0], k, damping, length)
    scene.ticks = 2000
    return scene


def net(dice):
    """Coils between neighbours of a small net, hung or free, stretched or not."""
    scene = Scene("net", 2)
    columns, rows = dice.randint(2, 4), dice.randint(1, 4)
    scene.gravity[1] = -9.81 if dice.chance(0.7) else 0.0
    mass = dice.log(0.1, 2)
    k = rounded(mass * (scene.rate * dice.log(0.1, 1.5)) ** 2)
    rest = rounded(1 / dice.uniform(0.8, 1.3))
    b = 0.0 if dice.chance(0.7) else rounded(math.sqrt(k * mass) * dice.log(1e-3, 0.3))
    for j in range(rows):
        for i in range(columns):
            scene.body([i + dice.number(-0.05, 0.05), -j + dice.number(-0.05, 0.05)],
                       [dice.number(-2, 2), dice.number(-2, 2)] if dice.chance(0.5) else [0.0],
                       mass)
    for j in range(rows):
        for i in range(columns):
            one = j * columns + i
            if i + 1 < columns:
                scene.spring(one, one + 1, k, b, rest)
            if j + 1 < rows:
                scene.spring(one, one + columns, k, b, rest)
    for i in {0, columns - 1}:
        scene.spring(i, [float(i), 1.0], k, b, rest)
    scene.ticks = 1500
    return scene


def linked(dice):
    scene = Scene("linked", dice.randint(1, 2))
    count = dice.randint(2, 5)
    omega = scene.rate * dice.log(0.05, 2)
    b = 0.0 if dice.chance(0.5) else omega * dice.log(0.01, 2)
    for i in range(count):
        scene.body([float(i), dice.number(-1, 1)], [dice.number(-3, 3)], dice.log(0.3, 3),
                   linear=0.0 if dice.chance(0.7) else dice.log(0.1, 20))
    for i in range(1, count):
        scene.spring(i, i - 1, rounded(omega * omega), rounded(b))
    scene.spring(0, [0.0], rounded(omega * omega * dice.log(0.1, 3)))
    scene.ticks = 1500
    return scene


def thrown(dice, kind, ticks, add_body):
    """One to three bodies, each with its mass, with gravity or without."""
    scene = Scene(kind, dice.randint(1, 3))
    if dice.chance(0.5):
        scene.gravity[-1] = -9.81
    for _ in range(dice.randint(1, 3)):
        add_body(scene, dice.log(0.1, 10))
    scene.ticks = ticks
    return scene


def linear_drag(dice):
    def add_body(scene, mass):
        scene.body([0.0], [dice.number(-30, 30) for _ in range(3)], mass,
                   linear=rounded(mass * scene.rate * dice.log(0.02, 4)))
    return thrown(dice, "linear drag", 200, add_body)


def quadratic_drag(dice):
    def add_body(scene, mass):
        speed = dice.log(1, 300)
        scene.body([0.0], [speed] + [dice.number(-1, 1)] * 2, mass,
                   quadratic=rounded(mass * scene.rate / speed * dice.log(0.02, 8)))
    return thrown(dice, "quadratic drag", 300, add_body)


def wind(dice):
    scene = Scene("wind", 2)
    scene.gravity[1] = -9.81 if dice.chance(0.5) else 0.0
    speed = dice.log(1, 50)
    scene.body([0.0], [dice.number(-5, 5)])
    scene.winds.append((0, [speed, 0.0], rounded(scene.rate / speed * dice.log(0.02, 8))))
    if dice.chance(0.4):
        scene.spring(0, [1.0, 1.0], rounded((scene.rate * dice.log(0.02, 0.5)) ** 2))
    scene.ticks = 300
    return scene


def drive(dice):
    scene = Scene("drive", 1)
    scene.body([0.0 if dice.chance(0.6) else dice.number(-1, 1)], [0.0],
               linear=dice.choice([0.0, 0.2]))
    if dice.chance(0.8):
        k = rounded((2 * math.pi * dice.log(0.2, 4)) ** 2)
        scene.spring(0, [0.0], k, dice.choice([0.0, 0.5]))
    frequency = rounded(scene.rate * dice.log(0.01, 3)) if dice.chance(0.7) else \
        scene.rate + dice.number(-3, 3)
    scene.drives.append((0, [dice.log(0.1, 100)], frequency, dice.choice([0.0, dice.number(0, 6)])))
    scene.ticks = 600
    return scene


def orbit(dice):
    scene = Scene("orbit", 2)
    gm, r, e = dice.log(0.1, 100), dice.log(0.5, 5), dice.choice([0.0, dice.number(0, 0.9)])
    near = dice.chance(0.5)
    speed = math.sqrt(gm / r * (1 + e if near else 1 - e))
    scene.attractors.append(([0.0, 0.0], gm))
    scene.body([r, 0.0], [0.0, rounded(speed)])
    a = r / (1 - e) if near else r / (1 + e)
    closest = a * (1 - e)
    # ω·dt at the closest point.
    scene.rate = max(1, round(math.sqrt(2 * gm / closest**3) / dice.log(0.01, 1.5)))
    period = 2 * math.pi * math.sqrt(a**3 / gm)
    scene.ticks = int(min(dice.choice([20, 60, 100]) * period * scene.rate, 20_000))
    scene.period = period
    return scene


def passages(dice):
    """Bodies among two attractors, or on an orbit with drag."""
    scene = Scene("passages", 2)
    gm = dice.log(1, 50)
    scene.attractors.append(([0.0, 0.0], gm))
    if dice.chance(0.5):
        scene.attractors.append(([dice.number(4, 8), dice.number(-4, 4)], rounded(gm / 2)))
    r = dice.number(1, 3)
    scene.body([r, 0.0], [0.0, rounded(math.sqrt(gm / r) * dice.uniform(0.8, 1.1))],
               linear=0.0 if len(scene.attractors) > 1 else dice.log(1e-3, 0.1))
    scene.rate = max(4, round(math.sqrt(2 * gm / r**3) / dice.log(0.02, 1)))
    scene.ticks = 1000
    return scene


def bounce(dice):
    scene = Scene("bounce", 2)
    scene.gravity[1] = -9.81
    scene.rate = dice.choice([30, 60, 120, 240])
    e = dice.choice([1.0, 1.0, 0.95, 0.9, 0.6, 0.0])
    scene.planes.append(([0.0, 1.0], 0.0, e))
    scene.body([0.0, dice.number(0, 2)], [dice.number(-1, 1), dice.number(0, 4)],
               contact=0.0)
    scene.ticks = 20 * scene.rate
    return scene


def room(dice):
    """A resting ball between two planes, with or without room, or on a wedge."""
    scene = Scene("room", 2)
    scene.gravity[1] = -9.81
    radius, height = dice.log(0.1, 2), dice.log(0.2, 4)
    if abs(radius * 2 / height - 1) < 0.02:
        height = rounded(height * 1.1)
    angle = dice.choice([0.0, dice.uniform(0, 6)])
    if angle:
        scene.gravity = [0.0, 0.0]
    normal = [math.sin(angle), math.cos(angle)]
    scene.planes.append((normal, 0.0, 0.0))
    scene.planes.append(([-one for one in normal], -height, 0.0))
    scene.body([one * radius for one in normal], [0.0], contact=radius)
    scene.room = 2 * radius <= height
    scene.ticks = 10
    return scene


def far(dice):
    scene = Scene("far", 2)
    scene.precision = "float"
    x = dice.log(10, 1e8)
    scene.body([x, 0.0], [dice.log(1e-4, 1e3)])
    scene.ticks = 600
    if dice.chance(0.5):
        scene.bodies.clear()
        omega = scene.rate * dice.log(0.01, 0.2)
        anchor = in_float(x)
        start = in_float(anchor + max(dice.log(0.01, 100), anchor * 2**-22))
        scene.body([start, 0.0], [0.0])
        scene.spring(0, [anchor, 0.0], rounded(omega * omega))
        scene.ticks = 512
    return scene


def point(dice):
    scene = Scene("point", 2)
    at = [dice.number(-3, 3), dice.number(-3, 3)]
    moves = dice.randrange(3)
    if moves == 1:
        scene.gravity[1] = -9.81
    scene.body(at, [dice.number(1, 2) if moves == 2 else 0.0], 1.0)
    if dice.chance(0.5):
        scene.spring(0, at, dice.log(1, 100), 0.0, 1.0)
    else:
        scene.body(at, [0.0], 1.0)
        scene.spring(0, 1, dice.log(1, 100), 0.0, 1.0)
        if moves == 1:
            scene.spring(1, [at[0] + 1, at[1]], 50.0)
    scene.stays = moves == 0
    scene.ticks = 200
    return scene


KINDS = [springs, springs, edge, pendulum, net, net, linked, linear_drag, quadratic_drag, wind,
         drive, drive, orbit, orbit, orbit, passages, bounce, bounce, room, far, point]


def make(seed):
    dice = Dice(seed)
    scene = KINDS[seed % len(KINDS)](dice)
    if scene.kind not in ("edge",):
        scene.method = dice.choice(USUAL if dice.chance(0.4) else METHODS)
    if dice.chance(0.15) and scene.kind not in ("far", "edge"):
        scene.precision = "float"
    if dice.chance(0.1) and scene.method not in USUAL[2:]:
        scene.damping = dice.choice(["kick", "drift"])
    return scene


# ---- runs

class Run:
    """A run of `oiler play`: states per tick as flat lists x and v, and the warnings."""

    def __init__(self, oiler, path, scene, ticks, wants_trace=True):
        command = [oiler, "play", path, "--steps", str(ticks)]
        done = subprocess.run(command + (["--trace", "-"] if wants_trace else ["--json", "-"]),
                              capture_output=True, text=True, timeout=300)
        self.exit = done.returncode
        lines = [line for line in done.stderr.splitlines() if line.strip()]
        self.message = lines[-1] if self.exit and lines else ""
        self.warnings = lines[:-1] if self.message else lines
        self.usage = self.exit == 2
        self.states = []
        if not wants_trace:
            return
        n = scene.axes
        for line in done.stdout.splitlines()[1:]:
            cells = line.split(",")
            if int(cells[2]) == 0:
                self.states.append(([], []))
            if len(cells) == 3 + 2 * n:
                self.states[-1][0].extend(map(float, cells[3: 3 + n]))
                self.states[-1][1].extend(map(float, cells[3 + n:]))


def distance(a, b):
    return max((abs(one - other) for one, other in zip(a, b)), default=0.0)


def reach(states, start):
    """The largest distance of a coordinate from its start."""
    return max((distance(x, start) for x, _ in states), default=0.0)


def true_states(scene):
    truth = Truth(scene)
    size = truth.size
    states = [(truth.y[:size], truth.y[size:])]
    for tick in range(1, scene.ticks + 1):
        y = truth.advance(tick / scene.rate)
        states.append((y[:size], y[size:]))
    return states


def true_velocity(scene, tick, state, ticks):
    """The velocities so many ticks after a state at a tick."""
    truth = Truth(scene)
    truth.t, truth.y = tick / scene.rate, state[0] + state[1]
    truth.k = truth.slope(truth.t, truth.y)
    return truth.advance(truth.t + ticks / scene.rate)[truth.size:]


def reversal(scene, run):
    n = scene.axes
    for i, (_, _, _, linear, quadratic, _) in enumerate(scene.bodies):
        air = [0.0] * n
        for body, velocity, _ in scene.winds:
            if body == i and not linear and not quadratic:
                air = velocity
        if not linear and not quadratic and not any(air):
            continue

        def relative(v):
            return [a - b for a, b in zip(v[n * i: n * i + n], air)]

        def turns(u, w):
            return sum(a * b for a, b in zip(u, w)) < 0

        first = math.hypot(*relative(run.states[0][1]))
        for tick, (before, after) in enumerate(zip(run.states, run.states[1:])):
            u, w = relative(before[1]), relative(after[1])
            if turns(u, w) and min(math.hypot(*u), math.hypot(*w)) > 0.01 * first and \
                    not turns(u, relative(true_velocity(scene, tick, before, 2))):
                return f"reverses body {i}"
    return ""


def turned_back(scene, run, truth):
    """The part of the first 64 ticks in which a body moves against its true velocity."""
    n = scene.axes
    worst = 0.0
    for i in range(len(scene.bodies)):
        part = slice(n * i, n * i + n)
        pairs = [(v[part], t[part]) for (_, v), (_, t) in zip(run.states[:65], truth)]
        fastest = max(math.hypot(*t) for _, t in pairs)
        against = sum(sum(a * b for a, b in zip(v, t)) < 0 and math.hypot(*v) > 0.01 * fastest
                      for v, t in pairs)
        worst = max(worst, against / len(pairs))
    return worst


def is_overdamped(scene):
    """Whether the springs of bodies without links let none of them oscillate."""
    return scene.springs and all(
        not isinstance(end, int) and b * b >= 4 * k * scene.bodies[body][2]
        for body, end, k, b, _ in scene.springs)


def bounce_energies(scene, count):
    """The true energies of a ball over a floor at the first ticks, by the closed form."""
    g, e = -scene.gravity[1], scene.planes[0][2]
    height, speed = scene.bodies[0][0][1], scene.bodies[0][1][1]
    now = impact = math.sqrt(speed * speed + 2 * g * height)
    t = (speed + impact) / g  # of the next impact, at the speed `now`
    energies = []
    for tick in range(count):
        while now > 1e-3 * impact and tick / scene.rate >= t:
            now *= e
            t += 2 * now / g
        energies.append(now * now / 2 if now > 1e-3 * impact else 0.0)
    return energies


def judge_bounce(scene, run):
    """Whether a ball is at rest, or has lower bounces than the true one, or higher ones at last."""
    g, e = -scene.gravity[1], scene.planes[0][2]
    energies = bounce_energies(scene, len(run.states))
    visible = (g / scene.rate * 4) ** 2 / 2  # bounces of eight steps
    for (x, v), true in zip(run.states, energies):
        energy = v[1] * v[1] / 2 + g * x[1]
        # Of the next bounce, because a run may be one bounce ahead.
        if true > max(visible, energies[0] / 4) and energy < true * e * e / 4:
            return "freezes"
    return "grows" if energy > 2 * true + visible else ""


def orbital_energy(scene, state):
    (x, v), gm = state, scene.attractors[0][1]
    return (v[0] * v[0] + v[1] * v[1]) / 2 - gm / math.hypot(*x)


def kinetic(scene, states, bodies=None):
    """The mean kinetic energy of some bodies, or of all, J."""
    masses = [body[2] * (bodies is None or i in bodies)
              for i, body in enumerate(scene.bodies) for _ in range(scene.axes)]
    return sum(m * v * v for _, vs in states for m, v in zip(masses, vs)) / (2 * len(states))


def potential(scene, x):
    """The energy of springs and gravity, J."""
    n = scene.axes
    places = [x[i: i + n] for i in range(0, len(x), n)]
    energy = -sum(body[2] * sum(map(operator.mul, scene.gravity, at))
                  for body, at in zip(scene.bodies, places))
    for body, end, k, _, length in scene.springs:
        far = math.dist(places[body], places[end] if isinstance(end, int) else end)
        energy += k * (far - length) ** 2 / 2
    return energy


def gains_energy(scene, run):
    """Whether springs and gravity alone add energy, by more than the motion has at first."""
    if scene.drives or scene.winds or scene.attractors or scene.planes:
        return False
    energies = [(kinetic(scene, [state]), potential(scene, state[0])) for state in run.states]
    largest = max(moving for moving, _ in energies[: scene.ticks])
    return max(map(sum, energies)) - sum(energies[0]) > largest


def energy_of_one(scene, state, body):
    """The energy of a body alone on a spring, above that of its rest."""
    n = scene.axes
    _, anchor, k, _, _ = next(one for one in scene.springs if one[0] == body)
    mass = scene.bodies[body][2]
    rest = [at + mass * g / k for at, g in zip(anchor, scene.gravity)]
    x, v = (part[n * body: n * body + n] for part in state)
    return mass * sum(one * one for one in v) / 2 + k * math.dist(x, rest) ** 2 / 2


def halves_energy(run, truth, energy):
    """Whether a motion has half of its true energy or less, while that is a fifth of its start."""
    first = energy(truth[0])
    return any(energy(true) > first / 5 and energy(state) <= 0.55 * energy(true)
               for state, true in zip(run.states, truth))


def energy_left(scene, run, truth, bodies):
    """The kinetic energy in the last quarter, relative to the first and the truth; 1 if the truth
    has little."""
    quarter = len(truth) // 4
    last, first = (kinetic(scene, part, bodies) for part in (truth[-quarter:], truth[:quarter]))
    if not last > 0.05 * first:
        return 1.0
    before = kinetic(scene, run.states[:quarter], bodies)
    return kinetic(scene, run.states[-quarter:], bodies) / before * first / last if before else 0.0


def judge_loss(scene, run, truth):
    """Whether bodies lose their energy: each by itself, or all that links connect."""
    rows = range(len(scene.bodies))
    groups = [[i] for i in rows] if scene.kind == "springs" else [rows]
    scene.left = min(energy_left(scene, run, truth, group) for group in groups)
    return f"dies: {scene.left:.2g} of the energy is left" if scene.left < 1 / 3 else ""


def is_true_loss(scene, run, told):
    """Whether half of the energy is lost as the warning says. Links without lengths rest at 0."""
    said = re.match(r"(spring|link) of .*?(\d+).*: \S+ takes half of the energy of its", told)
    if not said or scene.kind not in ("springs", "linked"):
        return False

    def energy(state):
        if scene.kind == "springs":
            return energy_of_one(scene, state, int(said[2]))
        return kinetic(scene, [state]) + potential(scene, state[0])

    return halves_energy(run, true_states(scene), energy)


def departure(oiler, path, scene, run):
    """The largest distance from a run in double, relative to its extent."""
    text = path.read_text()
    path.write_text(text.replace('precision = "float"', 'precision = "double"'))
    other = Run(oiler, path, scene, scene.ticks)
    path.write_text(text)
    return max(distance(x, y) for (x, _), (y, _) in zip(run.states, other.states)) / \
        reach(other.states, other.states[0][0])


def judge_orbit(scene, run):
    """The energy at the farthest point of each revolution, where its error is small."""
    first, gm = orbital_energy(scene, run.states[0]), scene.attractors[0][1]
    x, v = run.states[0]
    h = x[0] * v[1] - x[1] * v[0]
    farthest = -gm / (2 * first) * (1 + math.sqrt(max(1 + 2 * first * h * h / (gm * gm), 0)))
    period = max(1, math.ceil(scene.period * scene.rate))
    for i in range(0, len(run.states) - period, period):
        state = max(run.states[i: i + period + 1], key=lambda one: math.hypot(*one[0]))
        if math.hypot(*state[0]) < farthest / 2:
            return f"falls in, revolution {i // period + 1}"
        if abs(orbital_energy(scene, state) / first - 1) > 0.5:
            return f"loses its orbit, revolution {i // period + 1}"
    first_round = run.states[: period + period // 4 + 1]
    scene.wrong = abs(max(math.hypot(*x) for x, _ in first_round) / farthest - 1)
    return f"its farthest point is {100 * scene.wrong:.2g} % wrong" if scene.wrong > 0.3 else ""


def judge(scene, run):
    """Why the run is bad; empty if it is not."""
    if run.exit == 5:
        return "explodes"
    start = run.states[0][0]
    if scene.kind == "bounce":
        return judge_bounce(scene, run)
    if scene.kind == "room":
        normal = scene.planes[0][0]
        height = sum(a * b for a, b in zip(normal, run.states[-1][0]))
        radius = scene.bodies[0][5]
        inside = max(radius - height, radius + scene.planes[1][1] + height)
        return "inside a plane" if inside > 1e-3 * radius else ""
    if scene.kind == "point":
        return "freezes" if scene.stays and reach(run.states, start) == 0 else ""
    if scene.kind == "far" and scene.springs:
        scene.reach = 2 * (start[0] - scene.springs[0][1][0])
        if reach(run.states, start) > 4 * scene.reach:
            return "grows"
        return f"departs by {100 * scene.departure:.2g} %" if scene.departure > 0.2 else ""
    if scene.kind == "far":
        moved = run.states[-1][0][0] - start[0]
        true = scene.bodies[0][1][0] * scene.ticks / scene.rate
        error = moved / true - 1
        return f"moves by {100 * error:.2g} % wrongly" if abs(error) > 0.02 else ""
    if scene.kind == "orbit":
        return judge_orbit(scene, run)
    truth = true_states(scene)
    scene.reach = reach(truth, start)
    scene.error = max(distance(x, y) for (x, _), (y, _) in zip(run.states, truth))
    if scene.kind == "edge" and max(abs(v[0]) for _, v in run.states) > 100 * scene.rate:
        return "grows in speed"
    ratio = reach(run.states, start) / max(scene.reach, 1e-12)
    if ratio > 10:
        return f"explodes: {ratio:.3g} times as far"
    if ratio > 4:
        return f"grows: {ratio:.3g} times as far"
    if scene.kind == "drive" and not 0.9 < ratio < 1.1:
        return f"follows its drive {ratio:.3g} times as far"
    if scene.kind in ("linear drag", "quadratic drag", "wind"):
        return reversal(scene, run)
    if scene.kind in ("springs", "linked", "net"):
        scene.turned = turned_back(scene, run, truth)
        if is_overdamped(scene) and scene.turned > 0.02:
            return f"moves against its true velocity, in {100 * scene.turned:.2g} % of the ticks"
    if scene.kind in ("springs", "edge", "pendulum", "net", "linked"):
        return judge_loss(scene, run, truth)
    return ""


def is_bad_later(oiler, path, scene):
    """Whether ten times as many steps explode, or move farther than the true motion did."""
    if scene.left < 0.7 or scene.wrong > 0.15 or scene.departure > 0.05:
        return True
    if scene.kind == "point":
        scene.reach = reach(true_states(scene), scene.bodies[0][0] * len(scene.bodies))
    if scene.kind == "drive" and scene.error > 0.05 * scene.reach:
        return True
    later = Run(oiler, path, scene, min(10 * scene.ticks, 50_000) + 10_000)
    if later.exit == 5:
        return True
    if scene.kind in ("linear drag", "quadratic drag", "wind", "room"):
        return False
    if scene.kind == "far" and not scene.springs:
        return False
    if scene.kind == "orbit":
        return bool(judge_orbit(scene, later))
    if scene.kind == "bounce":
        return bool(judge_bounce(scene, later))
    if gains_energy(scene, later):
        return True
    return reach(later.states, later.states[0][0]) > 2 * scene.reach


def examine(oiler, folder, seed):
    """Returns (kind, verdict, words)."""
    scene = make(seed)
    path = folder / f"{seed}.toml"
    path.write_text(scene.text())
    run = Run(oiler, path, scene, scene.ticks)
    words = f"{scene.method} {scene.precision} {scene.rate} Hz"
    if run.usage:
        return scene.kind, "refused", f"{words}: {run.message}"
    if run.exit not in (0, 5):
        return scene.kind, "crash", f"{words}: exit {run.exit}: {run.message}"
    if scene.kind == "far" and scene.springs and run.exit == 0:
        scene.departure = departure(oiler, path, scene, run)
    try:
        bad = judge(scene, run)
    except TooLong:
        return scene.kind, "no truth", words
    told = run.warnings[0] if run.warnings else ""
    if bad:
        return scene.kind, "warned" if told else "missed", f"{words}: {bad}: {told}"
    if not told:
        return scene.kind, "quiet", words
    try:
        later = "turns it back" in told and scene.turned > 0 or \
            is_true_loss(scene, run, told) or is_bad_later(oiler, path, scene)
    except TooLong:
        return scene.kind, "no truth", words
    return scene.kind, "warned" if later else "false", f"{words}: {told}"


VERDICTS = ["warned", "quiet", "missed", "false", "refused", "no truth", "crash"]


def print_table(counts):
    print(f"\n{'':<16}" + "".join(f"{one:>9}" for one in VERDICTS))
    for kind in sorted({kind for kind, _ in counts}) + ["all"]:
        row = [sum(n for (k, v), n in counts.items() if v == verdict and kind in (k, "all"))
               for verdict in VERDICTS]
        print(f"{kind:<16}" + "".join(f"{n:>9}" for n in row))
    return dict(zip(VERDICTS, row))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=300, help="number of scenes")
    parser.add_argument("--seed", type=int, default=1, help="seed of the first; the others follow")
    parser.add_argument("--only", type=int, help="the scene of this seed alone, with its file")
    parser.add_argument("--oiler", default="build/bin/oiler", help="the program")
    options = parser.parse_args()
    seeds = [options.only] if options.only is not None else \
        range(options.seed, options.seed + options.count)
    counts = collections.Counter()
    with tempfile.TemporaryDirectory() as folder:
        for seed in seeds:
            if options.only is not None:
                print(make(seed).text())
            kind, verdict, words = examine(options.oiler, Path(folder), seed)
            counts[kind, verdict] += 1
            if verdict not in ("warned", "quiet") or options.only is not None:
                print(f"{seed:>5} {kind:<15} {verdict:<8} {words}", flush=True)
    totals = print_table(counts)
    judged = sum(totals[one] for one in ("warned", "quiet", "missed", "false"))
    return totals["missed"] > 0.01 * judged or totals["false"] > 0.05 * judged or totals["crash"]


if __name__ == "__main__":
    sys.exit(bool(main()))
