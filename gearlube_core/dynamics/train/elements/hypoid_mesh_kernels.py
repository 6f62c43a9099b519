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
from gearlube_core.dynamics.hypoid_mesh.flanks import BOUND_POWER, FILMS, N_FRICTION, flank_sum
from gearlube_core.dynamics.hypoid_mesh.mesh_at_load import (
    MeshAtLoad,
    MeshLevels,
    blend_mesh,
    follow_flank,
    gap_rotation,
)
from gearlube_core.dynamics.hypoid_mesh.mesh_force import (
    MeshForceConstants,
    MeshMotion,
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
from gearlube_core.dynamics.train.elements.mesh_outputs import OWN, MeshValues, write_mesh
from gearlube_core.friction.flank_film import N_FLANK_MODEL
from gearlube_core.friction.flank_law import FlankLaw, takes_film_model
from gearlube_core.kernels.array_part import part
from gearlube_core.kernels.inlining import inside
from gearlube_core.kernels.jit import kernel
from gearlube_core.mesh_table.kernels import K_M, R_P, mesh_series
from gearlube_core.mesh_table.table import PAIRS
from gearlube_core.oil.lubricant import LubricantState

# places of `at` behind both bodies
_X, _VISCOUS, _BOUNDARY, _ROLLING, _DAMPING, _BOUND, _KEPT, _PORT = range(2, 10)
_LEVELS, _ORDERS, _NODES, _SERIES, _FILM = range(10, 15)
_BOUNDS = len(FLANK_OUTPUTS)  # place of the bounds behind the outputs of the flanks
_LEAST = 1e-9  # m, deflection
_ALL_TOUCH = 1e-6  # m, deflection that no difference of a linearisation ends
# what is kept: load that selects the level [N.m], side, mean stiffness at the start [N/m], films at
# the nodes with a film model
_LOAD, _SIDE, _STIFFNESS, OWN_FILMS = range(4)
# places in the memory: load and side of the data in use, torque on the pinion [N.m], rate of the
# transmission error [m/s] in the last stage, 1 while tractions are to be found again, length of
# the last step [s], how much of a difference the load level follows in it, how films are asked for
# outputs, the table
_AT_LOAD, _AT_SIDE, _TORQUE, _RATE, _ANEW, _STEP, _FOLLOWS, _ASKED, _TABLE = range(9)


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
        load, kept = s[at[_X]], at[_KEPT]
        s[kept + _LOAD] = abs(load * self.pinion_radius)
        s[kept + _SIDE] = -1.0 if load < 0.0 else 1.0
        if at[_FILM] > 0:
            for i in range(N_FILMS):
                s[kept + OWN_FILMS + i] = 0.0
        _blend(at, memory, s)
        deflection = load / _now(at, memory).series[K_M]
        deflection = deflection if abs(deflection) > _LEAST else _LEAST
        s[at[_X]] = deflection - (self.mesh.backlash if load < 0.0 else 0.0)

    @kernel
    def full_contact(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> None:
        """See `Kernels.full_contact`."""
        on_coast, x = s[at[_KEPT] + _SIDE] < 0.0, s[at[_X]]
        s[at[_KEPT] + _STIFFNESS] = _now(at, memory).series[K_M]
        if on_coast:
            s[at[_X]] = min(x, -self.mesh.backlash - _ALL_TOUCH)
        else:
            s[at[_X]] = max(x, _ALL_TOUCH)

    @kernel
    def begin(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> None:
        """See `Kernels.begin`."""
        _blend(at, memory, s)
        now = _now(at, memory)
        memory[_RATE] = mesh_force(_motion(at, s), now.series, now.n_orders, self.mesh).x_rate
        memory[_ANEW] = 1.0
        if at[_FILM] > 0:
            friction = _friction(at, memory)
            for i in range(N_FILMS):
                friction[FILMS + i] = s[at[_KEPT] + OWN_FILMS + i]

    @kernel
    def finish(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> None:
        """See `Kernels.finish`."""
        if at[_FILM] > 0:
            friction = _friction(at, memory)
            for i in range(N_FILMS):
                s[at[_KEPT] + OWN_FILMS + i] = friction[FILMS + i]

    @kernel
    def each_step(self, at: Any, memory: Array, s: Array, oil: LubricantState, h: float) -> float:
        """See `Kernels.each_step`."""
        load, before = s[at[_KEPT] + _LOAD], memory[_AT_LOAD]
        if abs(load - before) > LOAD_REACH * (1.0 + max(before, abs(_torque(at, memory, s)))):
            _blend(at, memory, s)
        return 1.0

    @kernel
    def add_forces(
        self, at: Any, memory: Array, s: Array, oil: LubricantState, stage: int, ds: Array
    ) -> None:
        """See `Kernels.add_forces`."""
        m, now = _motion(at, s), _now(at, memory)
        mesh = mesh_force(m, now.series, now.n_orders, self.mesh)
        # tractions of the first middle and the last stage serve those behind them
        asked = 0.0
        if stage == 0 or stage == AFTER_STEP:
            asked = EXACT if stage == 0 else BETWEEN_NODES
            memory[_ASKED] = asked
        elif stage == 2 or stage == 4 or (stage == 1 and memory[_ANEW] != 0.0):
            asked = BETWEEN_NODES
        channels = part(memory, _friction_at(at) + N_FRICTION, N_CHANNELS)
        friction = flank_sum(
            m,
            mesh.force,
            now.window,
            now.n_nodes,
            oil,
            self,  # type: ignore[arg-type]  # it has the fields of the axle that are read
            asked,
            _friction(at, memory),
            channels,
            now.film_model,
        )
        memory[_TORQUE] = -mesh.torque_p
        memory[_RATE] = mesh.x_rate
        shared = self.mesh.consistent
        lateral = self.lateral_sign * mesh.force
        f_x = -mesh.n_x * lateral + shared * friction.f_x
        f_y = -mesh.n_y * lateral + shared * friction.f_y
        f_z = -mesh.n_z * lateral + shared * friction.f_z
        p, g = at[0] + RATE, at[1] + RATE
        ds[p] += f_x
        ds[p + 1] += f_y
        ds[p + 2] += f_z
        ds[g] -= f_x
        ds[g + 1] -= f_y
        ds[g + 2] -= f_z
        ds[p + RZ] = ds[p + RZ] + mesh.torque_p + friction.torque_p
        ds[g + RZ] = ds[g + RZ] + mesh.torque_g + friction.torque_g
        ds[at[_X]] = mesh.x_rate
        ds[at[_VISCOUS]] += friction.viscous_power
        ds[at[_BOUNDARY]] += friction.boundary_power
        ds[at[_ROLLING]] += friction.rolling_power
        ds[at[_DAMPING]] += mesh.damping_power
        ds[at[_BOUND]] += _friction(at, memory)[BOUND_POWER]

    @kernel
    def after_part(self, at: Any, memory: Array, s: Array, oil: LubricantState, h: float) -> float:
        """See `Kernels.after_part`."""
        memory[_ANEW] = 0.0
        load = at[_KEPT] + _LOAD
        if h != memory[_STEP]:
            memory[_STEP], memory[_FOLLOWS] = h, -math.expm1(-h / LOAD_FILTER_TIME)
        s[load] += memory[_FOLLOWS] * (abs(_torque(at, memory, s)) - s[load])
        _follow(self, at, memory, s)
        return 0.0

    @kernel
    def exchange(
        self, at: Any, memory: Array, s: Array, oil: LubricantState, out: Array, first: int
    ) -> None:
        """See `Kernels.exchange`."""
        load, x, gap = s[at[_KEPT] + _LOAD], s[at[_X]], self.mesh.backlash
        out[first] = (abs(_torque(at, memory, s)) - load) / LOAD_FILTER_TIME
        out[first + 1] = x * MICRO
        out[first + 2] = (x + gap) * MICRO
        out[first + 3] = 1.0
        if _table(at, memory).levels[0] < 0.0:
            now, m = _now(at, memory), _motion(at, s)
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
        change = h * memory[_RATE] * MICRO
        return h / contact_parts(s[at[_X]] * MICRO, change, self.mesh.backlash * MICRO)

    @kernel
    def stored_energy(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> float:
        """See `Kernels.stored_energy`."""
        now = _now(at, memory)
        mesh = mesh_force(_motion(at, s), now.series, now.n_orders, self.mesh)
        f = backlash_deflection(s[at[_X]], self.mesh.backlash)
        return 0.5 * mesh.stiffness * f * f

    @kernel
    def step_rate(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> float:
        """See `Kernels.step_rate`."""
        w, mean_stiffness = s[at[0] + W], _now(at, memory).series[K_M]
        c = self.mesh.modal_damping
        if c == 0.0:
            c = self.mesh.hysteretic_loss * mean_stiffness / reference_frequency(self.mesh, w)
        frequency = self.mesh.z_p * abs(w) / (2.0 * math.pi)
        return max(frequency * self.steps_per_period, c * self.compliance / REAL_AXIS_LIMIT)

    @kernel
    def stiffening(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> float:
        """See `Kernels.stiffening`; modes rise at most with the root of the mean stiffness."""
        before = s[at[_KEPT] + _STIFFNESS]
        return math.sqrt(_now(at, memory).series[K_M] / before) if before > 0.0 else 1.0

    @kernel
    def write(
        self, at: Any, memory: Array, s: Array, oil: LubricantState, out: Array, first: int
    ) -> None:
        """See `Kernels.write`."""
        now, m, x = _now(at, memory), _motion(at, s), s[at[_X]]
        mesh = mesh_force(m, now.series, now.n_orders, self.mesh)
        at_film = _friction_at(at) + N_FRICTION + N_CHANNELS
        channels, friction = part(memory, at_film - N_CHANNELS, N_CHANNELS), _friction(at, memory)
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
            memory[_ASKED],
            part(friction, FILMS, N_FILMS),
            flanks,
            flanks + _BOUNDS,
            channels,
            out,
        )
        lost = flank_sum(
            m,
            mesh.force,
            now.window,
            now.n_nodes,
            oil,
            self,  # type: ignore[arg-type]
            memory[_ASKED],
            friction,
            channels,
            now.film_model,
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
            s[at[_KEPT] + _LOAD],
            lost.viscous_power + lost.boundary_power,
            friction[BOUND_POWER],
            thinnest if thinnest < math.inf else 0.0,
            found.outside,
        )
        torque = max(abs(s[at[_KEPT] + _LOAD]), abs(mesh.force) * now.series[R_P])
        torque = -torque if s[at[_KEPT] + _SIDE] < 0.0 else torque
        write_mesh(values, torque, found, self.ranges, first, out)
        out[first + OWN] = mesh.force

    @kernel
    def check(self, at: Any, memory: Array, s: Array, oil: LubricantState, kept: int) -> float:
        """See `Kernels.check`."""
        sizes = at[_LEVELS], at[_ORDERS], at[_NODES], at[_SERIES]
        film, end = at[_FILM], _friction_at(at)
        at_film, solved = end + N_FRICTION + N_CHANNELS, takes_film_model(self.flank_law)
        fits = fits_sizes(sizes) and memory.size == at_film + film
        fits = fits and film == (N_FLANK_MODEL if solved else 0)
        fits = fits and kept == OWN_FILMS + (N_FILMS if film > 0 else 0)
        return 1.0 if fits and fits_table(memory, _TABLE, end, at_film, sizes) else 0.0


@kernel
def _follow(self: HypoidMeshKernels, at: Any, memory: Array, s: Array) -> None:
    """Change the side of the mesh data where teeth have crossed the middle of the gap."""
    table, side = _table(at, memory), at[_KEPT] + _SIDE
    if table.levels[0] < 0.0:
        x, other = follow_flank(
            _motion(at, s), memory[_AT_LOAD], s[side], table, self.mesh, _now(at, memory)
        )
        if other != s[side]:
            s[at[_X]], s[side], memory[_AT_SIDE] = x, other, other


@inside
def _motion(at: Any, s: Array) -> MeshMotion:
    p, g = at[0], at[1]
    return MeshMotion(
        s[p + RZ], s[at[_X]], s[p + W], s[g + W],
        s[p] - s[g], s[p + 1] - s[g + 1], s[p + 2] - s[g + 2],
        s[p + 6] - s[g + 6], s[p + 7] - s[g + 7], s[p + 8] - s[g + 8],
    )  # fmt: skip


@inside
def _torque(at: Any, memory: Array, s: Array) -> float:
    return s[at[_PORT]] if at[_PORT] > 0 else memory[_TORQUE]


@inside
def _window_size(at: Any) -> int:
    return (at[_NODES] + 1) * N_CHANNELS


@inside
def _friction_at(at: Any) -> int:
    # behind the table at all loads, and at the present one
    return _TABLE + at[_LEVELS] + (at[_LEVELS] + 1) * (at[_SERIES] + _window_size(at))


@inside
def _friction(at: Any, memory: Array) -> Array:
    return part(memory, _friction_at(at), N_FRICTION)


@inside
def _table(at: Any, memory: Array) -> MeshLevels:
    levels = at[_LEVELS]
    at_series = _TABLE + levels
    at_windows = at_series + levels * at[_SERIES]
    at_film = _friction_at(at) + N_FRICTION + N_CHANNELS
    return MeshLevels(
        part(memory, _TABLE, levels),
        part(memory, at_series, levels * at[_SERIES]),
        at[_ORDERS],
        part(memory, at_windows, levels * _window_size(at)),
        at[_NODES],
        part(memory, at_film, at[_FILM]),
        part(memory, at_film, 0),
    )


@inside
def _now(at: Any, memory: Array) -> MeshAtLoad:
    at_friction = _friction_at(at)
    at_window = at_friction - _window_size(at)
    at_film = at_friction + N_FRICTION + N_CHANNELS
    return MeshAtLoad(
        part(memory, at_window - at[_SERIES], at[_SERIES]),
        at[_ORDERS],
        part(memory, at_window, _window_size(at)),
        at[_NODES],
        part(memory, at_film, at[_FILM]),
        part(memory, at_film, 0),
    )


@kernel
def _blend(at: Any, memory: Array, s: Array) -> None:
    memory[_AT_LOAD], memory[_AT_SIDE] = s[at[_KEPT] + _LOAD], s[at[_KEPT] + _SIDE]
    blend_mesh(memory[_AT_LOAD], memory[_AT_SIDE], _table(at, memory), _now(at, memory))
