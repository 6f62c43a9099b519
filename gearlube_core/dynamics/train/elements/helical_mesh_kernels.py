"""Kernels of the mesh of two helical or spur gears."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from gearlube_core.arrays import Array
from gearlube_core.dynamics.helical_pair.march.flanks import (
    FLANK_POINTS,
    LINES_MAX,
    N_FRICTION,
    MarchConstants,
    PairMotion,
    coast_deepest,
    coast_view,
    deepest,
    drive_view,
    friction_direction,
)
from gearlube_core.dynamics.helical_pair.march.jumps import (
    LOAD_FILTER_TIME,
    LOAD_REACH,
    REFRESH_COST,
    SOLVED_REFRESH_COST,
    STATIONS,
    time_to_jump,
)
from gearlube_core.dynamics.helical_pair.march.line_outputs import LINE_OUTPUTS, write_lines
from gearlube_core.dynamics.helical_pair.march.line_points import refresh_friction
from gearlube_core.dynamics.helical_pair.march.line_sums import LineSums, line_sums
from gearlube_core.dynamics.helical_pair.march.mesh_data import (
    FILM_AT,
    LEAST_OFFSET,
    LEVEL,
    STATIONS_AT,
    data_size,
    largest_offset,
    mean_density,
    mesh_at_torque,
)
from gearlube_core.dynamics.helical_pair.march.pair_forces import (
    flank_wrench,
    friction_heat,
    pair_forces,
    turned_friction_heat,
    turned_wrench,
)
from gearlube_core.dynamics.train.element import (
    RATE,
    Axes,
    W,
    add_wrench,
    seen,
    seen_turn,
    unseen,
    unseen_turn,
)
from gearlube_core.dynamics.train.elements.checks import MOST, fits_model
from gearlube_core.dynamics.train.elements.mesh_outputs import OWN, MeshValues, write_mesh
from gearlube_core.film_model.net import N_ARRAY
from gearlube_core.friction.flank_laws import SOLVED
from gearlube_core.kernels.array_part import part
from gearlube_core.kernels.array_rows import rows
from gearlube_core.kernels.checked_numbers import all_finite, is_whole
from gearlube_core.kernels.flat_tuples import tuple_from_array, tuple_to_array
from gearlube_core.kernels.inlining import inside
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.lubricant_state import LubricantState

# places of `at` behind both bodies, the relative rotation, and both losses
_PSI, _HEAT, _DAMPING, _KEPT, _PORT, _LEVELS, _SIZE, _DATA, _DATA_SIZE = range(2, 11)
_LINES, _BOUNDS = 6, len(LINE_OUTPUTS)  # places of the lines behind own outputs, of their bounds
_LEAST_PRESSED = 1e-9  # m
_ALL_TOUCH = 1e-5  # m, compression at which all lines touch
_MICRO = 1e6  # um per m: indicators of order 1, which solvers with a tolerance for roots expect
# places in the memory: torque on the pinion in the last stage [N.m], length of the last step [s],
# how much of a difference the load level follows in it, sums of both flanks for `write`
_TORQUE, _STEP, _FOLLOWS, _DRIVE = range(4)
_N_SUMS = len(LineSums._fields)
_COAST = _DRIVE + _N_SUMS
TABLE = _COAST + _N_SUMS  # torque levels, then density and offset at each, then the pair data


class HelicalMeshKernels(NamedTuple):
    """Constants of a mesh, and its kernels: see `HelicalMesh` and `element.Kernels`."""

    axes: Axes
    arm_p: float  # of the mesh along z from the centre of the pinion's body [m]
    arm_g: float
    steps_per_period: float
    aligned: float  # 1 where axes and centres of train and mesh are the same: less to compute

    @kernel
    def at_rest(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> None:
        """See `Kernels.at_rest`."""
        constants: MarchConstants = tuple_from_array(_data(at, memory), MarchConstants)
        flanks, load, kept = constants.flanks, s[at[_PSI]], at[_KEPT]
        plane, table = flanks.plane, _table(at, memory)
        level = s[at[_PORT]] if at[_PORT] > 0 else load * plane.r_bp
        s[kept], s[kept + 1] = abs(level), -1.0
        for i in range(1, N_FRICTION):
            s[kept + 1 + i] = constants.mu
        # the relative rotation at which all lines touch
        pressed = 2.0 * abs(load) / (plane.W * mean_density(table)) + largest_offset(table)
        pressed = max(pressed, _LEAST_PRESSED)
        rotation = pressed if load > 0.0 else -pressed - flanks.backlash
        if load == 0.0:  # where drive flanks just touch, of all places between the flanks
            _follow_level(at, memory, s[kept])
            rotation = max(_data(at, memory)[LEAST_OFFSET], -0.5 * flanks.backlash)
        s[at[_PSI]] = rotation / plane.cos_b

    @kernel
    def full_contact(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> None:
        """See `Kernels.full_contact`."""
        constants: MarchConstants = tuple_from_array(_data(at, memory), MarchConstants)
        flanks, table = constants.flanks, _table(at, memory)
        plane = flanks.plane
        if s[at[_KEPT]] < plane.r_bp * plane.W * mean_density(table) * _ALL_TOUCH:
            pressed = (_ALL_TOUCH + largest_offset(table)) / plane.cos_b
            on_coast = s[at[_PSI]] * plane.cos_b < -0.5 * flanks.backlash
            s[at[_PSI]] += -pressed if on_coast else pressed

    @kernel
    def begin(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> None:
        """See `Kernels.begin`."""
        _follow_level(at, memory, s[at[_KEPT]])

    @kernel
    def each_step(self, at: Any, memory: Array, s: Array, oil: LubricantState, h: float) -> float:
        """See `Kernels.each_step`."""
        data = _data(at, memory)
        p: MarchConstants = tuple_from_array(data, MarchConstants)
        level, before = s[at[_KEPT]], data[LEVEL]
        if abs(level - before) > LOAD_REACH * (1.0 + before):
            _follow_level(at, memory, level)
        cost = max(1.0, p.flanks.stations / STATIONS)
        if p.friction_form > 0.0:
            kept = part(s, at[_KEPT] + 1, N_FRICTION)
            if refresh_friction(_motion(self, at, s), kept, data, oil):
                cost += SOLVED_REFRESH_COST if p.film == SOLVED else REFRESH_COST
        return cost

    @inside
    def add_forces(
        self, at: Any, memory: Array, s: Array, oil: LubricantState, stage: int, ds: Array
    ) -> None:
        """See `Kernels.add_forces`."""
        data = _data(at, memory)
        constants: MarchConstants = tuple_from_array(data, MarchConstants)
        plane = constants.flanks.plane
        mesh = pair_forces(_motion(self, at, s), s, at[_KEPT] + 2, data)
        w = mesh.wrench
        # dampers act along the line of action, and the work of moving lines on the pinion alone
        on_pinion = w.M_pz + plane.r_bp * (mesh.damping + mesh.moving)
        on_gear = w.M_gz + plane.r_bg * mesh.damping
        memory[_TORQUE] = on_pinion
        f_x, f_y, f_z = w.F_x, w.F_y, w.F_z
        on_p, on_g = (w.M_px, w.M_py, on_pinion), (w.M_gx, w.M_gy, on_gear)
        if self.aligned == 0.0:
            axes = self.axes
            f_x, f_y, f_z = unseen(axes, f_x, f_y, f_z)
            on_p = unseen_turn(axes, w.M_px, w.M_py, on_pinion)
            on_g = unseen_turn(axes, w.M_gx, w.M_gy, on_gear)
        add_wrench(ds, at[0], self.arm_p, (f_x, f_y, f_z), on_p)
        add_wrench(ds, at[1], self.arm_g, (-f_x, -f_y, -f_z), on_g)
        ds[at[_PSI]] = mesh.closing
        ds[at[_HEAT]] += mesh.heat
        ds[at[_DAMPING]] += mesh.damping * mesh.closing

    @kernel
    def after_step(self, at: Any, memory: Array, s: Array, oil: LubricantState, h: float) -> float:
        """See `Kernels.after_step`."""
        level = at[_KEPT]
        if h != memory[_STEP]:
            memory[_STEP], memory[_FOLLOWS] = h, -math.expm1(-h / LOAD_FILTER_TIME)
        s[level] += memory[_FOLLOWS] * (abs(_torque(at, memory, s)) - s[level])
        return 0.0

    @kernel
    def exchange(
        self, at: Any, memory: Array, s: Array, oil: LubricantState, out: Array, first: int
    ) -> None:
        """See `Kernels.exchange`."""
        out[first] = (abs(_torque(at, memory, s)) - s[at[_KEPT]]) / LOAD_FILTER_TIME
        data = _data(at, memory)
        p: MarchConstants = tuple_from_array(data, MarchConstants)
        m, flanks = _motion(self, at, s), p.flanks
        drive = drive_view(m, flanks)
        out[first + 1] = deepest(drive, data[LEAST_OFFSET], flanks) * _MICRO
        out[first + 2] = coast_deepest(m, data[LEAST_OFFSET], flanks) * _MICRO
        out[first + 3] = 1.0
        if p.friction_form > 0.0:
            out[first + 3] = math.sin(math.pi * drive.phase * p.refreshes)

    @kernel
    def event(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> None:
        """See `Kernels.event`."""
        data = _data(at, memory)
        p: MarchConstants = tuple_from_array(data, MarchConstants)
        if p.friction_form > 0.0:
            kept = part(s, at[_KEPT] + 1, N_FRICTION)
            refresh_friction(_motion(self, at, s), kept, data, oil)

    @kernel
    def stored_energy(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> float:
        """See `Kernels.stored_energy`."""
        data = _data(at, memory)
        constants: MarchConstants = tuple_from_array(data, MarchConstants)
        m, flanks = _motion(self, at, s), constants.flanks
        mu = at[_KEPT] + 2
        drive, coast = drive_view(m, flanks), coast_view(m, flanks)
        on_drive = line_sums(drive.a, drive.tilt, drive.phase, data, s, mu)
        on_coast = line_sums(coast.a, coast.tilt, coast.phase, data, s, mu + FLANK_POINTS)
        tuple_to_array(on_drive, part(memory, _DRIVE, _N_SUMS))
        tuple_to_array(on_coast, part(memory, _COAST, _N_SUMS))
        return on_drive.energy + on_coast.energy

    @kernel
    def step_rate(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> float:
        """See `Kernels.step_rate`."""
        constants: MarchConstants = tuple_from_array(_data(at, memory), MarchConstants)
        frequency = constants.teeth * abs(s[at[0] + W]) / (2.0 * math.pi)
        return frequency * self.steps_per_period

    @kernel
    def time_to_jump(
        self, at: Any, memory: Array, s: Array, oil: LubricantState, h: float
    ) -> float:
        """See `Kernels.time_to_jump`."""
        data = _data(at, memory)
        constants: MarchConstants = tuple_from_array(data, MarchConstants)
        if constants.flanks.plane.sin_b > 0.0:  # before the motion is put together
            return math.inf
        m = _motion(self, at, s)
        return time_to_jump(m, data[LEAST_OFFSET], constants.flanks)

    @kernel
    def write(
        self, at: Any, memory: Array, s: Array, oil: LubricantState, out: Array, first: int
    ) -> None:
        """See `Kernels.write`."""
        data, mu = _data(at, memory), at[_KEPT] + 2
        p: MarchConstants = tuple_from_array(data, MarchConstants)
        m, flanks = _motion(self, at, s), p.flanks
        plane = flanks.plane
        drive, coast = drive_view(m, flanks), coast_view(m, flanks)
        on_drive: LineSums = tuple_from_array(part(memory, _DRIVE, _N_SUMS), LineSums)
        on_coast: LineSums = tuple_from_array(part(memory, _COAST, _N_SUMS), LineSums)
        direction = friction_direction(m.w_p)
        front = flank_wrench(on_drive, direction, plane)
        behind = turned_wrench(flank_wrench(on_coast, -direction, plane), flanks)
        heat = friction_heat(on_drive, direction, m, flanks)
        heat += turned_friction_heat(on_coast, -direction, m, flanks)
        back = on_coast.N > on_drive.N
        view, mu_at = (coast, mu + FLANK_POINTS) if back else (drive, mu)
        lines = first + OWN + _LINES
        bounds = lines + _BOUNDS
        found = write_lines(
            view, back, s, mu_at, m.w_p, oil.temperature, data, oil, p, lines, bounds, out
        )
        touching = on_drive.stiffness + on_coast.stiffness
        values = MeshValues(
            m.psi + m.x_p - m.x_g,
            plane.cos_b * plane.cos_b * touching,
            1.0 if on_drive.N == 0.0 and on_coast.N == 0.0 else 0.0,
            1.0 if on_coast.N > 0.0 else 0.0,
            p.teeth * m.w_p / (2.0 * math.pi),
            s[at[_KEPT]],
            heat,
            found.loss_bound * abs(heat),
            found.thinnest_film,
            found.outside,
        )
        torque = max(on_drive.N, on_coast.N) * plane.r_bp * plane.cos_b
        torque = max(abs(s[at[_KEPT]]), torque)
        write_mesh(values, -torque if back else torque, found, p.ranges, first, out)
        own = first + OWN
        out[own] = on_drive.N - on_coast.N
        force = front.F_x + behind.F_x, front.F_y + behind.F_y, front.F_z + behind.F_z
        out[own + 1], out[own + 2], out[own + 3] = unseen(self.axes, *force)
        out[own + 4] = m.ry_p - m.ry_g
        out[own + 5] = found.loss_bound

    @kernel
    def check(self, at: Any, memory: Array, s: Array, oil: LubricantState, kept: int) -> float:
        """See `Kernels.check`."""
        levels, size, data_at = at[_LEVELS], at[_SIZE], at[_DATA]
        most = int(MOST)
        if not (1 <= levels <= most and 2 <= size <= most and kept == 1 + N_FRICTION):
            return 0.0
        end = data_at + at[_DATA_SIZE]
        if not (data_at == pair_data_at(levels, size) and end == memory.size):
            return 0.0
        if at[_DATA_SIZE] < STATIONS_AT or not all_finite(memory, TABLE, data_at):
            return 0.0
        p: MarchConstants = tuple_from_array(_data(at, memory), MarchConstants)
        flanks, stations = p.flanks, p.flanks.stations
        fits = is_whole(flanks.lines, 1.0, float(LINES_MAX)) and is_whole(stations, 2.0, MOST)
        fits = fits and is_whole(flanks.phases, 1.0, MOST)
        fits = fits and flanks.lines * flanks.phases * stations == float(size)
        fits = fits and at[_DATA_SIZE] == data_size(int(stations), size)
        if fits and p.film == SOLVED:
            fits = fits_model(part(memory, data_at + FILM_AT, N_ARRAY))
        films = data_at + FILM_AT  # limits of ranges before may be infinite
        return 1.0 if fits and all_finite(memory, films, data_at + LEAST_OFFSET) else 0.0


@inside
def _torque(at: Any, memory: Array, s: Array) -> float:
    return s[at[_PORT]] if at[_PORT] > 0 else memory[_TORQUE]


@inside
def _data(at: Any, memory: Array) -> Array:
    return part(memory, at[_DATA], at[_DATA_SIZE])


@inside
def line_table(memory: Array, levels: int, size: int) -> tuple[Array, Array, Array]:
    """Return torque levels, and density and offset at each, among the memory of a mesh."""
    at_density = TABLE + levels
    return (
        part(memory, TABLE, levels),
        rows(memory, at_density, levels, size),
        rows(memory, at_density + levels * size, levels, size),
    )


@kernel
def pair_data_at(levels: int, size: int) -> int:
    """Return where the pair data begin in the memory of a mesh."""
    return TABLE + levels + 2 * levels * size


@inside
def _table(at: Any, memory: Array) -> tuple[Array, Array, Array]:
    return line_table(memory, at[_LEVELS], at[_SIZE])


@kernel
def _follow_level(at: Any, memory: Array, torque: float) -> None:
    mesh_at_torque(torque, _table(at, memory), _data(at, memory))


@inside
def _motion(self: HelicalMeshKernels, at: Any, s: Array) -> PairMotion:
    """Return the motion of both members in the axes of the mesh, where the pinion drives to -z."""
    a, p, g = self.axes, at[0], at[1]
    if self.aligned > 0.0:
        return PairMotion(
            s[at[_PSI]], -s[p + 5], -s[p + W], s[g + W],
            s[p], s[p + 1], s[p + 2], s[p + 3], s[p + 4],
            s[g], s[g + 1], s[g + 2], s[g + 3], s[g + 4],
            s[p + 6], s[p + 7], s[p + 9], s[p + 10],
            s[g + 6], s[g + 7], s[g + 9], s[g + 10],
        )  # fmt: skip
    x_p, y_p, z_p = seen(
        a, s[p] + self.arm_p * s[p + 4], s[p + 1] - self.arm_p * s[p + 3], s[p + 2]
    )
    x_g, y_g, z_g = seen(
        a, s[g] + self.arm_g * s[g + 4], s[g + 1] - self.arm_g * s[g + 3], s[g + 2]
    )
    rx_p, ry_p, rz_p = seen_turn(a, s[p + 3], s[p + 4], s[p + 5])
    rx_g, ry_g, _ = seen_turn(a, s[g + 3], s[g + 4], s[g + 5])
    vp, vg = p + RATE, g + RATE
    vx_p, vy_p, _ = seen(
        a, s[vp] + self.arm_p * s[vp + 4], s[vp + 1] - self.arm_p * s[vp + 3], s[vp + 2]
    )
    vx_g, vy_g, _ = seen(
        a, s[vg] + self.arm_g * s[vg + 4], s[vg + 1] - self.arm_g * s[vg + 3], s[vg + 2]
    )
    ox_p, oy_p, w_p = seen_turn(a, s[vp + 3], s[vp + 4], s[vp + 5])
    ox_g, oy_g, w_g = seen_turn(a, s[vg + 3], s[vg + 4], s[vg + 5])
    return PairMotion(
        s[at[_PSI]], -rz_p, -w_p, w_g,
        x_p, y_p, z_p, rx_p, ry_p, x_g, y_g, z_g, rx_g, ry_g,
        vx_p, vy_p, ox_p, oy_p, vx_g, vy_g, ox_g, oy_g,
    )  # fmt: skip
