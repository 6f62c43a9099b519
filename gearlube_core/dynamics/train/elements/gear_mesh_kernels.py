"""Kernels of a mesh between any two bodies, with stations across the face.

    F_i = k_i(theta) max(delta_i, 0) + damping,  delta_i = h_1i.q_1 - h_2i.q_2 - e_i(theta)

q are displacements and tilts in axes that turn with the carrier; turning about z is an own state.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from gearlube_core.arrays import Array
from gearlube_core.dynamics.train.element import RATE, RZ, W
from gearlube_core.dynamics.train.elements.checks import MOST
from gearlube_core.dynamics.train.elements.turned_moves import (
    Moves,
    add_turned,
    swept,
    turned_moves,
    turned_rates,
)
from gearlube_core.kernels.checked_numbers import all_finite
from gearlube_core.kernels.inlining import inside
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.lubricant_state import LubricantState

# places of `at` behind both bodies and the carrier
_ROTATION, _FRICTION, _DAMPING, _STATIONS, _WAVES = range(3, 8)
_SLOW = 1e-3  # m/s, sliding below which friction fades
_TOUCH = 1e-6  # m, compression at which all stations touch
_MICRO = 1e6  # um per m: indicators of order 1, which solvers with a tolerance for roots expect


class Line(NamedTuple):
    """A direction n at the pitch point, its moment r x n, and the change of that along the face.

    That of sliding has the tooth's direction, and at last the axis about which the gears roll.
    """

    n_x: float
    n_y: float
    n_z: float
    h_x: float  # [m]
    h_y: float
    h_z: float
    m_x: float
    m_y: float
    m_z: float


class Member(NamedTuple):
    """Lines of one gear, in the axes of its body."""

    drive: Line
    coast: Line
    sliding: Line


class FlankLoad(NamedTuple):
    """Load of one flank."""

    force: float  # [N]
    moment: float  # sum of forces times places along the face [N.m]
    turning: float  # work of stiffness and gap that change, per angle of the mesh cycle [J/rad]
    heat: float  # [W]
    energy: float  # [J]
    stiffness: float  # of what touches [N/m]
    deepest: float  # compression [m]
    low: float  # force of the first station [N]
    high: float  # of the last one


class Act(NamedTuple):
    """The mesh in a state."""

    one: Moves
    two: Moves
    cos: float
    sin: float
    closing: float  # rate of the rotation [m/s]
    drive: FlankLoad
    coast: FlankLoad
    tooth: float  # friction along the teeth [N]
    couple: float  # friction against rolling [N.m]
    friction: float  # [W]


class GearMeshKernels(NamedTuple):
    """Constants of a mesh, and its kernels: see `GearMesh` and `element.Kernels`."""

    first: Member
    second: Member
    face_gain: float  # change of the rotation along the face [1/m], of bevel gears
    stiffness: float  # mean [N/m]
    damping: float  # [N s/m]
    backlash: float  # normal, of the whole gap [m]
    friction: float  # coefficient
    sliding_arm: float  # mean distance of contact from the pitch point [m]
    cycle: float  # teeth of the first gear, negative where the drive flank pushes about -z
    drive_phase: float  # [rad]
    coast_phase: float
    steps_per_period: float

    @kernel
    def at_rest(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> None:
        """See `Kernels.at_rest`."""
        load, place = s[at[_ROTATION]], at[_ROTATION]
        least, most = _gaps(at, memory)
        if load == 0.0:  # where drive flanks just touch, of all places between the flanks
            rotation = max(least, -0.5 * self.backlash)
            s[place] = rotation if rotation != 0.0 else _TOUCH
        else:
            pressed = abs(load) / self.stiffness + most
            s[place] = pressed if load > 0.0 else -pressed - self.backlash

    @kernel
    def full_contact(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> None:
        """See `Kernels.full_contact`."""
        act, (least, most) = mesh_act(self, at, memory, s), _gaps(at, memory)
        deepest = max(act.drive.deepest, act.coast.deepest)
        lacking = max(most - least + _TOUCH - deepest, 0.0)
        s[at[_ROTATION]] += -lacking if act.coast.deepest > act.drive.deepest else lacking

    @inside
    def add_forces(
        self, at: Any, memory: Array, s: Array, oil: LubricantState, stage: int, ds: Array
    ) -> None:
        """See `Kernels.add_forces`."""
        act = mesh_act(self, at, memory, s)
        turning = _turning(self, act)
        one, two = _wrench(self.first, act, -1.0), _wrench(self.second, act, 1.0)
        add_turned(ds, at[0], one, act.cos, act.sin)
        add_turned(ds, at[1], two, act.cos, act.sin)
        ds[at[0] + RATE + RZ] += turning
        # its lines turn with the carrier, which moves them against the displacements
        ds[at[2] + RATE + RZ] -= turning + swept(act.one, one) + swept(act.two, two)
        ds[at[_ROTATION]] = act.closing
        ds[at[_FRICTION]] += act.friction
        ds[at[_DAMPING]] += act.drive.heat + act.coast.heat

    @kernel
    def stored_energy(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> float:
        """See `Kernels.stored_energy`."""
        act = mesh_act(self, at, memory, s)
        return act.drive.energy + act.coast.energy

    @kernel
    def step_rate(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> float:
        """See `Kernels.step_rate`."""
        if at[_WAVES] == 0:
            return 0.0
        return self.steps_per_period * abs(_frequency(self, at, s))

    @kernel
    def write(
        self, at: Any, memory: Array, s: Array, oil: LubricantState, out: Array, first: int
    ) -> None:
        """See `Kernels.write`."""
        act = mesh_act(self, at, memory, s)
        drive, coast, rotation = act.drive, act.coast, s[at[_ROTATION]]
        loaded = coast if coast.force > drive.force else drive
        one, two = (self.first.drive, self.second.drive)
        tilt = _tilt(one, act.one) - _tilt(two, act.two)
        if coast.force > drive.force:
            tilt = _tilt(self.first.coast, act.one) - _tilt(self.second.coast, act.two)
        w = _wrench(self.first, act, -1.0)
        share = at[_STATIONS] / loaded.force if loaded.force > 0.0 else 0.0
        out[first] = rotation + _along(one, act.one) - _along(two, act.two)
        out[first + 1] = drive.stiffness + coast.stiffness
        out[first + 2] = 1.0 if drive.stiffness == 0.0 and coast.stiffness == 0.0 else 0.0
        out[first + 3] = 1.0 if coast.stiffness > 0.0 else 0.0
        out[first + 4] = _frequency(self, at, s)
        out[first + 5] = act.friction
        out[first + 6] = drive.force - coast.force
        out[first + 7] = act.cos * w.x - act.sin * w.y
        out[first + 8] = act.sin * w.x + act.cos * w.y
        out[first + 9] = w.z
        out[first + 10] = tilt
        out[first + 11], out[first + 12] = share * loaded.low, share * loaded.high

    @kernel
    def exchange(
        self, at: Any, memory: Array, s: Array, oil: LubricantState, out: Array, first: int
    ) -> None:
        """See `Kernels.exchange`."""
        act = mesh_act(self, at, memory, s)
        out[first], out[first + 1] = act.drive.deepest * _MICRO, act.coast.deepest * _MICRO

    @kernel
    def check(self, at: Any, memory: Array, s: Array, oil: LubricantState, kept: int) -> float:
        """See `Kernels.check`."""
        stations, waves, most = at[_STATIONS], at[_WAVES], int(MOST)
        fits = 1 <= stations <= most and waves <= most and self.stiffness > 0.0
        fits = fits and memory.size == memory_size(stations, waves)
        return 1.0 if fits and all_finite(memory, 0, memory.size) else 0.0


@kernel
def memory_size(stations: int, waves: int) -> int:
    """Return how many numbers a mesh has: places, then stiffness and gaps with their waves."""
    return stations + 2 * stations * (1 + 2 * waves)


@inside
def _gaps(at: Any, memory: Array) -> tuple[float, float]:
    """Return about the least and the largest unloaded gap [m]."""
    stations, waves = at[_STATIONS], at[_WAVES]
    least, most = math.inf, -math.inf
    for i in range(stations):
        first = stations + (stations + i) * (1 + 2 * waves)
        swing = 0.0
        for j in range(1, 1 + 2 * waves):
            swing += abs(memory[first + j])
        least, most = min(least, memory[first] - swing), max(most, memory[first] + swing)
    return least, most


@inside
def _along(line: Line, u: Moves) -> float:
    moved = line.n_x * u.x + line.n_y * u.y + line.n_z * u.z
    return moved + line.h_x * u.rx + line.h_y * u.ry


@inside
def _tilt(line: Line, u: Moves) -> float:
    return line.m_x * u.rx + line.m_y * u.ry


@inside
def _frequency(self: GearMeshKernels, at: Any, s: Array) -> float:
    return abs(self.cycle) * (s[at[0] + W] - s[at[2] + W]) / (2.0 * math.pi)


@inside
def _turning(self: GearMeshKernels, act: Act) -> float:
    """Return the torque on the first gear of stiffness and gaps that move with it [N.m]."""
    return self.cycle * (act.drive.turning - act.coast.turning)


@inside
def _wrench(member: Member, act: Act, sense: float) -> Moves:
    """Return forces and moments on a body, in axes that turn with the carrier."""
    d, c, t = member.drive, member.coast, member.sliding
    f, g = sense * act.drive.force, sense * act.drive.moment
    p, q = sense * act.coast.force, sense * act.coast.moment
    a, b = sense * act.tooth, sense * act.couple
    return Moves(
        f * d.n_x + p * c.n_x + a * t.n_x,
        f * d.n_y + p * c.n_y + a * t.n_y,
        f * d.n_z + p * c.n_z + a * t.n_z,
        f * d.h_x + g * d.m_x + p * c.h_x + q * c.m_x + a * t.h_x + b * t.m_x,
        f * d.h_y + g * d.m_y + p * c.h_y + q * c.m_y + a * t.h_y + b * t.m_y,
        f * d.h_z + g * d.m_z + p * c.h_z + q * c.m_z + a * t.h_z + b * t.m_z,
    )


@inside
def _wave(memory: Array, first: int, waves: int, cos: float, sin: float) -> tuple[float, float]:
    """Return a periodic series without its mean, and its change with the angle."""
    value = change = 0.0
    c, s = 1.0, 0.0
    for j in range(waves):
        c, s = c * cos - s * sin, s * cos + c * sin
        a, b = memory[first + 2 * j], memory[first + 2 * j + 1]
        value += a * c + b * s
        change += (j + 1.0) * (b * c - a * s)
    return value, change


@inside
def _flank(
    self: GearMeshKernels,
    at: Any,
    memory: Array,
    depth: tuple[float, float],
    rate: tuple[float, float],
    angle: float,
    turning: float,
) -> FlankLoad:
    """Return the loads of a flank, from its compression and tilt without gaps, and their rates."""
    stations, waves = at[_STATIONS], at[_WAVES]
    cos = sin = 0.0
    if waves > 0:
        cos, sin = math.cos(angle), math.sin(angle)
    share = 1.0 / stations
    force = moment = change = heat = energy = touching = low = high = 0.0
    deepest = -math.inf
    for i in range(stations):
        of_k = stations + i * (1 + 2 * waves)
        of_gap = of_k + stations * (1 + 2 * waves)
        k, k_change, gap, e_change = memory[of_k], 0.0, memory[of_gap], 0.0
        if waves > 0:
            k_wave, k_change = _wave(memory, of_k + 1, waves, cos, sin)
            e_wave, e_change = _wave(memory, of_gap + 1, waves, cos, sin)
            k += k_wave
            gap += e_wave
        k *= self.stiffness * share
        place = memory[i]
        pressed = depth[0] + place * depth[1] - gap
        deepest = max(deepest, pressed)
        one = 0.0
        if pressed > 0.0 and k > 0.0:
            closing = rate[0] + place * rate[1] - e_change * turning
            elastic = k * pressed
            one = max(elastic + self.damping * share * closing, 0.0)
            force += one
            moment += one * place
            heat += (one - elastic) * closing
            energy += 0.5 * elastic * pressed
            touching += k
            change += one * e_change - 0.5 * self.stiffness * share * k_change * pressed * pressed
        low, high = (one if i == 0 else low), one
    return FlankLoad(force, moment, change, heat, energy, touching, deepest, low, high)


@kernel
def mesh_act(self: GearMeshKernels, at: Any, memory: Array, s: Array) -> Act:
    """Return motion and loads of a mesh in a state."""
    one, two, carrier = at[0], at[1], at[2]
    w_c, cos, sin = s[carrier + W], 1.0, 0.0
    if s[carrier + RZ] != 0.0:
        cos, sin = math.cos(s[carrier + RZ]), math.sin(s[carrier + RZ])
    u_1, u_2 = turned_moves(s, one, cos, sin), turned_moves(s, two, cos, sin)
    v_1 = turned_rates(s, one, u_1, cos, sin, w_c)
    v_2 = turned_rates(s, two, u_2, cos, sin, w_c)
    a, b = self.first, self.second
    rotation, gain = s[at[_ROTATION]], self.face_gain
    closing = a.drive.h_z * v_1.rz - b.drive.h_z * v_2.rz
    angle = self.cycle * (s[one + RZ] - s[carrier + RZ])
    drive = _flank(
        self, at, memory,
        (rotation + _along(a.drive, u_1) - _along(b.drive, u_2),
         gain * rotation + _tilt(a.drive, u_1) - _tilt(b.drive, u_2)),
        (closing + _along(a.drive, v_1) - _along(b.drive, v_2),
         gain * closing + _tilt(a.drive, v_1) - _tilt(b.drive, v_2)),
        self.drive_phase + angle, self.cycle * v_1.rz,
    )  # fmt: skip
    coast = _flank(
        self, at, memory,
        (_along(a.coast, u_1) - _along(b.coast, u_2) - rotation - self.backlash,
         _tilt(a.coast, u_1) - _tilt(b.coast, u_2) - gain * rotation),
        (_along(a.coast, v_1) - _along(b.coast, v_2) - closing,
         _tilt(a.coast, v_1) - _tilt(b.coast, v_2) - gain * closing),
        self.coast_phase - angle, -self.cycle * v_1.rz,
    )  # fmt: skip
    tooth = couple = heat = 0.0
    if self.friction > 0.0:
        t_1, t_2 = a.sliding, b.sliding
        along = _along(t_1, v_1) + t_1.h_z * v_1.rz - _along(t_2, v_2) - t_2.h_z * v_2.rz
        rolling = _tilt(t_1, v_1) + t_1.m_z * v_1.rz - _tilt(t_2, v_2) - t_2.m_z * v_2.rz
        across = self.sliding_arm * rolling
        speed = math.sqrt(along * along + across * across + _SLOW * _SLOW)
        of_speed = self.friction * (drive.force + coast.force) / speed
        tooth, couple = of_speed * along, of_speed * self.sliding_arm * across
        heat = tooth * along + couple * rolling
    return Act(u_1, u_2, cos, sin, closing, drive, coast, tooth, couple, heat)
