"""Kernels of a mesh of a hypoid pinion and its gear in a train."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from gearlube_core.arrays import Array
from gearlube_core.dynamics.flank_force import backlash_deflection
from gearlube_core.dynamics.hypoid_mesh.flank_outputs import (
    FILM_THICKNESS,
    FLANK_OUTPUTS,
    LOAD,
    N_FLANK_QUANTITIES,
    write_flanks,
)
from gearlube_core.dynamics.hypoid_mesh.flanks import (
    BOUND_POWER,
    FILMS,
    N_FRICTION,
    flank_sum,
    force_on_pinion,
)
from gearlube_core.dynamics.hypoid_mesh.mesh_at_load import follow_flank, gap_rotation
from gearlube_core.dynamics.hypoid_mesh.mesh_force import (
    MeshForceConstants,
    mesh_force,
    reference_frequency,
)
from gearlube_core.dynamics.hypoid_mesh.node_films import N_FILMS
from gearlube_core.dynamics.hypoid_mesh.step_parts import (
    LOAD_FILTER_TIME,
    LOAD_REACH,
    MICRO,
    REAL_AXIS_LIMIT,
    contact_parts,
)
from gearlube_core.dynamics.hypoid_mesh.tooth_pair import BETWEEN_NODES, EXACT
from gearlube_core.dynamics.packed_mesh import N_CHANNELS
from gearlube_core.dynamics.ranges import RangeLimits
from gearlube_core.dynamics.train.element import AFTER_STEP, RATE, RZ, W
from gearlube_core.dynamics.train.elements.checks import fits_sizes, fits_table
from gearlube_core.dynamics.train.elements.hypoid_mesh_places import (
    ASKED,
    AT_BOUND,
    AT_BOUNDARY,
    AT_DAMPING,
    AT_KEPT,
    AT_PORT,
    AT_ROLLING,
    AT_VISCOUS,
    AT_X,
    FOLLOWS,
    KEPT_LOAD,
    KEPT_SIDE,
    KEPT_STIFFNESS,
    LAST_STEP,
    N_FILM,
    N_LEVELS,
    N_NODES,
    N_ORDERS,
    N_SERIES_AT,
    OF_LOAD,
    OF_SIDE,
    OWN_FILMS,
    RENEWED,
    TABLE,
    TORQUE,
    X_RATE,
    blend,
    friction_at,
    friction_in,
    mesh_motion,
    now_in,
    table_in,
    torque_of,
)
from gearlube_core.dynamics.train.elements.mesh_outputs import FRICTION, OWN, MeshValues, write_mesh
from gearlube_core.friction.flank_film import N_FLANK_MODEL
from gearlube_core.friction.flank_law import FlankLaw, takes_film_model
from gearlube_core.kernels.array_part import part
from gearlube_core.kernels.jit import kernel
from gearlube_core.mesh_table.kernels import K_M, R_P, mesh_series
from gearlube_core.mesh_table.table import PAIRS
from gearlube_core.oil.lubricant_state import LubricantState

_BOUNDS = len(FLANK_OUTPUTS)  # place of the bounds behind the outputs of the flanks
_LEAST = 1e-9  # m, deflection
_ALL_TOUCH = 1e-6  # m, deflection that no difference of a linearisation ends


class HypoidMeshKernels(NamedTuple):
    """Constants of a mesh, and its kernels: see `HypoidMesh` and `element.Kernels`."""

    mesh: MeshForceConstants
    lateral_sign: float
    friction: float
    rolling: float
    ratio: float
    reduced_modulus: float
    steps_per_period: float
    compliance: float  # of both members along the line of action [1/kg]
    pinion_radius: float  # mean, without load [m]
    ranges: RangeLimits
    flank_law: FlankLaw

    @kernel
    def at_rest(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> None:
        """See `Kernels.at_rest`."""
        load, kept = s[at[AT_X]], at[AT_KEPT]
        s[kept + KEPT_LOAD] = abs(s[at[AT_PORT]] if at[AT_PORT] > 0 else load * self.pinion_radius)
        s[kept + KEPT_SIDE] = -1.0 if load < 0.0 else 1.0
        if at[N_FILM] > 0:
            for i in range(N_FILMS):
                s[kept + OWN_FILMS + i] = 0.0
        blend(at, memory, s)
        pressed = max(abs(load) / now_in(at, memory).series[K_M], _LEAST)
        s[at[AT_X]] = -self.mesh.backlash - pressed if load < 0.0 else pressed

    @kernel
    def full_contact(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> None:
        """See `Kernels.full_contact`."""
        on_coast, x = s[at[AT_KEPT] + KEPT_SIDE] < 0.0, s[at[AT_X]]
        s[at[AT_KEPT] + KEPT_STIFFNESS] = now_in(at, memory).series[K_M]
        if on_coast:
            s[at[AT_X]] = min(x, -self.mesh.backlash - _ALL_TOUCH)
        else:
            s[at[AT_X]] = max(x, _ALL_TOUCH)

    @kernel
    def begin(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> None:
        """See `Kernels.begin`."""
        blend(at, memory, s)
        now = now_in(at, memory)
        memory[X_RATE] = mesh_force(mesh_motion(at, s), now.series, now.n_orders, self.mesh).x_rate
        memory[RENEWED] = 1.0
        if at[N_FILM] > 0:
            friction = friction_in(at, memory)
            for i in range(N_FILMS):
                friction[FILMS + i] = s[at[AT_KEPT] + OWN_FILMS + i]

    @kernel
    def finish(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> None:
        """See `Kernels.finish`."""
        if at[N_FILM] > 0:
            friction = friction_in(at, memory)
            for i in range(N_FILMS):
                s[at[AT_KEPT] + OWN_FILMS + i] = friction[FILMS + i]

    @kernel
    def each_step(self, at: Any, memory: Array, s: Array, oil: LubricantState, h: float) -> float:
        """See `Kernels.each_step`."""
        load, before = s[at[AT_KEPT] + KEPT_LOAD], memory[OF_LOAD]
        if abs(load - before) > LOAD_REACH * (1.0 + max(before, abs(torque_of(at, memory, s)))):
            blend(at, memory, s)
        return 1.0

    @kernel
    def add_forces(
        self, at: Any, memory: Array, s: Array, oil: LubricantState, stage: int, ds: Array
    ) -> None:
        """See `Kernels.add_forces`."""
        m, now = mesh_motion(at, s), now_in(at, memory)
        mesh = mesh_force(m, now.series, now.n_orders, self.mesh)
        # tractions of the first middle and the last stage serve those behind them
        asked = 0.0
        if stage == 0 or stage == AFTER_STEP:
            asked = EXACT if stage == 0 else BETWEEN_NODES
            memory[ASKED] = asked
        elif stage == 2 or stage == 4 or (stage == 1 and memory[RENEWED] != 0.0):
            asked = BETWEEN_NODES
        channels = part(memory, friction_at(at) + N_FRICTION, N_CHANNELS)
        friction = flank_sum(
            m,
            mesh.force,
            now.window,
            now.n_nodes,
            oil,
            self,  # type: ignore[arg-type]  # it has the fields of the axle that are read
            asked,
            friction_in(at, memory),
            channels,
            now.film_model,
        )
        memory[TORQUE] = -mesh.torque_p
        memory[X_RATE] = mesh.x_rate
        f_x, f_y, f_z = force_on_pinion(mesh, friction, self.lateral_sign, self.mesh.consistent)
        p, g = at[0] + RATE, at[1] + RATE
        ds[p] += f_x
        ds[p + 1] += f_y
        ds[p + 2] += f_z
        ds[g] -= f_x
        ds[g + 1] -= f_y
        ds[g + 2] -= f_z
        ds[p + RZ] = ds[p + RZ] + mesh.torque_p + friction.torque_p
        ds[g + RZ] = ds[g + RZ] + mesh.torque_g + friction.torque_g
        ds[at[AT_X]] = mesh.x_rate
        ds[at[AT_VISCOUS]] += friction.viscous_power
        ds[at[AT_BOUNDARY]] += friction.boundary_power
        ds[at[AT_ROLLING]] += friction.rolling_power
        ds[at[AT_DAMPING]] += mesh.damping_power
        ds[at[AT_BOUND]] += friction_in(at, memory)[BOUND_POWER]

    @kernel
    def after_part(self, at: Any, memory: Array, s: Array, oil: LubricantState, h: float) -> float:
        """See `Kernels.after_part`."""
        memory[RENEWED] = 0.0
        load = at[AT_KEPT] + KEPT_LOAD
        if h != memory[LAST_STEP]:
            memory[LAST_STEP], memory[FOLLOWS] = h, -math.expm1(-h / LOAD_FILTER_TIME)
        s[load] += memory[FOLLOWS] * (abs(torque_of(at, memory, s)) - s[load])
        _follow(self, at, memory, s)
        return 0.0

    @kernel
    def exchange(
        self, at: Any, memory: Array, s: Array, oil: LubricantState, out: Array, first: int
    ) -> None:
        """See `Kernels.exchange`."""
        load, x, gap = s[at[AT_KEPT] + KEPT_LOAD], s[at[AT_X]], self.mesh.backlash
        out[first] = (abs(torque_of(at, memory, s)) - load) / LOAD_FILTER_TIME
        out[first + 1] = x * MICRO
        out[first + 2] = (x + gap) * MICRO
        out[first + 3] = 1.0
        if table_in(at, memory).levels[0] < 0.0:
            now, m = now_in(at, memory), mesh_motion(at, s)
            series = mesh_series(now.series, now.n_orders, self.mesh.z_p, m.angle)
            rotation = gap_rotation(m, series, self.mesh, now.series, now.n_orders)
            out[first + 3] = rotation * MICRO

    @kernel
    def event(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> None:
        """See `Kernels.event`."""
        _follow(self, at, memory, s)

    @kernel
    def time_to_jump(
        self, at: Any, memory: Array, s: Array, oil: LubricantState, h: float
    ) -> float:
        """See `Kernels.time_to_jump`."""
        change = h * memory[X_RATE] * MICRO
        return h / contact_parts(s[at[AT_X]] * MICRO, change, self.mesh.backlash * MICRO)

    @kernel
    def stored_energy(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> float:
        """See `Kernels.stored_energy`."""
        now = now_in(at, memory)
        mesh = mesh_force(mesh_motion(at, s), now.series, now.n_orders, self.mesh)
        f = backlash_deflection(s[at[AT_X]], self.mesh.backlash)
        return 0.5 * mesh.stiffness * f * f

    @kernel
    def step_rate(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> float:
        """See `Kernels.step_rate`."""
        w, mean_stiffness = s[at[0] + W], now_in(at, memory).series[K_M]
        c = self.mesh.modal_damping
        if c == 0.0:
            c = self.mesh.hysteretic_loss * mean_stiffness / reference_frequency(self.mesh, w)
        frequency = self.mesh.z_p * abs(w) / (2.0 * math.pi)
        return max(frequency * self.steps_per_period, c * self.compliance / REAL_AXIS_LIMIT)

    @kernel
    def stiffening(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> float:
        """See `Kernels.stiffening`; modes rise at most with the root of the mean stiffness."""
        before = s[at[AT_KEPT] + KEPT_STIFFNESS]
        return math.sqrt(now_in(at, memory).series[K_M] / before) if before > 0.0 else 1.0

    @kernel
    def show(
        self,
        at: Any,
        memory: Array,
        s: Array,
        oil: LubricantState,
        stage: int,
        out: Array,
        first: int,
    ) -> None:
        """See `Kernels.show`: all but the power lost in friction."""
        _show(self, at, memory, s, oil, EXACT if stage == 0 else BETWEEN_NODES, out, first)

    @kernel
    def write(
        self, at: Any, memory: Array, s: Array, oil: LubricantState, out: Array, first: int
    ) -> None:
        """See `Kernels.write`."""
        _show(self, at, memory, s, oil, memory[ASKED], out, first)
        now, friction = now_in(at, memory), friction_in(at, memory)
        lost = flank_sum(
            mesh_motion(at, s),
            out[first + OWN],
            now.window,
            now.n_nodes,
            oil,
            self,  # type: ignore[arg-type]
            0.0,  # as in the rates of this state, which come before
            friction,
            part(memory, friction_at(at) + N_FRICTION, N_CHANNELS),
            now.film_model,
        )
        out[first + FRICTION] = lost.viscous_power + lost.boundary_power
        out[first + FRICTION + 1] = friction[BOUND_POWER]

    @kernel
    def check(self, at: Any, memory: Array, s: Array, oil: LubricantState, kept: int) -> float:
        """See `Kernels.check`."""
        sizes = at[N_LEVELS], at[N_ORDERS], at[N_NODES], at[N_SERIES_AT]
        film, end = at[N_FILM], friction_at(at)
        at_film, solved = end + N_FRICTION + N_CHANNELS, takes_film_model(self.flank_law)
        fits = fits_sizes(sizes) and memory.size == at_film + film
        fits = fits and film == (N_FLANK_MODEL if solved else 0)
        fits = fits and kept == OWN_FILMS + (N_FILMS if film > 0 else 0)
        return 1.0 if fits and fits_table(memory, TABLE, end, at_film, sizes) else 0.0


@kernel
def _follow(self: HypoidMeshKernels, at: Any, memory: Array, s: Array) -> None:
    """Change the side of the mesh data where teeth have crossed the middle of the gap."""
    table, side = table_in(at, memory), at[AT_KEPT] + KEPT_SIDE
    if table.levels[0] < 0.0:
        x, other = follow_flank(
            mesh_motion(at, s), memory[OF_LOAD], s[side], table, self.mesh, now_in(at, memory)
        )
        if other != s[side]:
            s[at[AT_X]], s[side], memory[OF_SIDE] = x, other, other


@kernel
def _show(
    self: HypoidMeshKernels,
    at: Any,
    memory: Array,
    s: Array,
    oil: LubricantState,
    asked: float,
    out: Array,
    first: int,
) -> None:
    """Write all outputs but the power lost in friction; `asked`: how a film model is asked."""
    now, m, x = now_in(at, memory), mesh_motion(at, s), s[at[AT_X]]
    mesh = mesh_force(m, now.series, now.n_orders, self.mesh)
    flanks = first + OWN + 1
    found = write_flanks(
        m,
        mesh.force,
        now.window,
        now.n_nodes,
        oil.temperature,
        oil,
        self,  # type: ignore[arg-type]  # it has the fields of the axle that are read
        now.film_model,
        asked,
        part(friction_in(at, memory), FILMS, N_FILMS),
        flanks,
        flanks + _BOUNDS,
        part(memory, friction_at(at) + N_FRICTION, N_CHANNELS),
        out,
    )
    thinnest = math.inf
    for pair in range(PAIRS):
        here = flanks + pair * N_FLANK_QUANTITIES
        if out[here + LOAD] > 0.0:
            thinnest = min(thinnest, out[here + FILM_THICKNESS])
    values = MeshValues(
        x,
        mesh.stiffness,
        1.0 if -self.mesh.backlash < x < 0.0 else 0.0,
        1.0 if x <= -self.mesh.backlash else 0.0,
        self.mesh.z_p * s[at[0] + W] / (2.0 * math.pi),
        s[at[AT_KEPT] + KEPT_LOAD],
        0.0,
        0.0,
        thinnest if thinnest < math.inf else 0.0,
        found.outside,
    )
    torque = max(abs(s[at[AT_KEPT] + KEPT_LOAD]), abs(mesh.force) * now.series[R_P])
    torque = -torque if s[at[AT_KEPT] + KEPT_SIDE] < 0.0 else torque
    write_mesh(values, torque, found, self.ranges, first, out)
    out[first + OWN] = mesh.force
