"""Mesh of a hypoid pinion and its gear."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, ClassVar, NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.contact.solid import contact_modulus
from gearlube_core.dynamics.flank_force import backlash_deflection
from gearlube_core.dynamics.hypoid_axle.flanks import FILMS, N_FRICTION, flank_sum
from gearlube_core.dynamics.hypoid_axle.integrate import (
    LOAD_FILTER_TIME,
    LOAD_REACH,
    REAL_AXIS_LIMIT,
    contact_parts,
)
from gearlube_core.dynamics.hypoid_axle.mesh_at_load import (
    MeshAtLoad,
    MeshLevels,
    blend_mesh,
    follow_flank,
)
from gearlube_core.dynamics.hypoid_axle.mesh_force import (
    MeshForceConstants,
    MeshMotion,
    mesh_force,
    reference_frequency,
)
from gearlube_core.dynamics.hypoid_axle.parameters import HypoidAxleParameters
from gearlube_core.dynamics.hypoid_axle.state import MICRO, N_FILMS
from gearlube_core.dynamics.hypoid_axle.tooth_pair import BETWEEN_NODES, EXACT
from gearlube_core.dynamics.packed_mesh import N_CHANNELS, PackedMesh, pack_mesh
from gearlube_core.dynamics.train.element import RATE, RZ, W
from gearlube_core.dynamics.train.part import Element
from gearlube_core.friction.flank_law import FlankLaw
from gearlube_core.kernels.array_part import part
from gearlube_core.kernels.inlining import inside
from gearlube_core.kernels.jit import kernel
from gearlube_core.mesh_table.kernels import K_M
from gearlube_core.number import Output
from gearlube_core.oil.lubricant import LubricantState

# places of `at` behind both bodies
_X, _VISCOUS, _BOUNDARY, _ROLLING, _DAMPING, _KEPT, _PORT = range(2, 9)
_LEVELS, _ORDERS, _NODES, _SERIES, _FILM = range(9, 14)
_LEAST = 1e-9  # m, deflection
# what is kept: load that selects the level [N.m], side, films at the nodes with a film model
_LOAD, _SIDE, _OWN_FILMS = range(3)
# places in the memory: load and side of the data in use, torque on the pinion [N.m], rate of the
# transmission error [m/s] in the last stage, 1 while tractions are to be found again, the table
_AT_LOAD, _AT_SIDE, _TORQUE, _RATE, _ANEW, _TABLE = range(6)


class _HypoidMesh(NamedTuple):
    mesh: MeshForceConstants
    lateral_sign: float
    friction: float
    rolling: float
    ratio: float
    reduced_modulus: float
    steps_per_period: float
    compliance: float  # of both members along the line of action [1/kg]
    pinion_radius: float  # mean, without load [m]
    flank_law: FlankLaw

    @kernel
    def at_rest(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> None:
        load, kept = s[at[_X]], at[_KEPT]
        s[kept + _LOAD] = abs(load * self.pinion_radius)
        s[kept + _SIDE] = -1.0 if load < 0.0 else 1.0
        if at[_FILM] > 0:
            for i in range(N_FILMS):
                s[kept + _OWN_FILMS + i] = 0.0
        _blend(at, memory, s)
        deflection = load / _now(at, memory).series[K_M]
        deflection = deflection if abs(deflection) > _LEAST else _LEAST
        s[at[_X]] = deflection - (self.mesh.backlash if load < 0.0 else 0.0)

    @kernel
    def begin(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> None:
        _blend(at, memory, s)
        now = _now(at, memory)
        memory[_RATE] = mesh_force(_motion(at, s), now.series, now.n_orders, self.mesh).x_rate
        memory[_ANEW] = 1.0
        if at[_FILM] > 0:
            friction = _friction(at, memory)
            for i in range(N_FILMS):
                friction[FILMS + i] = s[at[_KEPT] + _OWN_FILMS + i]

    @kernel
    def finish(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> None:
        if at[_FILM] > 0:
            friction = _friction(at, memory)
            for i in range(N_FILMS):
                s[at[_KEPT] + _OWN_FILMS + i] = friction[FILMS + i]

    @kernel
    def each_step(self, at: Any, memory: Array, s: Array, oil: LubricantState, h: float) -> float:
        load, before = s[at[_KEPT] + _LOAD], memory[_AT_LOAD]
        if abs(load - before) > LOAD_REACH * (1.0 + max(before, abs(_torque(at, memory, s)))):
            _blend(at, memory, s)
        return 1.0

    @kernel
    def add_forces(
        self, at: Any, memory: Array, s: Array, oil: LubricantState, stage: int, ds: Array
    ) -> None:
        m, now = _motion(at, s), _now(at, memory)
        mesh = mesh_force(m, now.series, now.n_orders, self.mesh)
        # tractions of the first middle and the last stage serve those behind them
        asked = 0.0
        if stage == 0:
            asked = EXACT
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

    @kernel
    def after_step(self, at: Any, memory: Array, s: Array, oil: LubricantState, h: float) -> float:
        memory[_ANEW] = 0.0
        load, side = at[_KEPT] + _LOAD, at[_KEPT] + _SIDE
        s[load] += -math.expm1(-h / LOAD_FILTER_TIME) * (abs(_torque(at, memory, s)) - s[load])
        table = _table(at, memory)
        if table.levels[0] < 0.0:
            x, other = follow_flank(
                _motion(at, s), memory[_AT_LOAD], s[side], table, self.mesh, _now(at, memory)
            )
            if other != s[side]:
                s[at[_X]], s[side], memory[_AT_SIDE] = x, other, other
        return 0.0

    @kernel
    def time_to_jump(
        self, at: Any, memory: Array, s: Array, oil: LubricantState, h: float
    ) -> float:
        change = h * memory[_RATE] * MICRO
        return h / contact_parts(s[at[_X]] * MICRO, change, self.mesh.backlash * MICRO)

    @kernel
    def stored_energy(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> float:
        now = _now(at, memory)
        mesh = mesh_force(_motion(at, s), now.series, now.n_orders, self.mesh)
        f = backlash_deflection(s[at[_X]], self.mesh.backlash)
        return 0.5 * mesh.stiffness * f * f

    @kernel
    def step_rate(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> float:
        w, mean_stiffness = s[at[0] + W], _now(at, memory).series[K_M]
        c = self.mesh.modal_damping
        if c == 0.0:
            c = self.mesh.hysteretic_loss * mean_stiffness / reference_frequency(self.mesh, w)
        frequency = self.mesh.z_p * abs(w) / (2.0 * math.pi)
        return max(frequency * self.steps_per_period, c * self.compliance / REAL_AXIS_LIMIT)

    @kernel
    def write(
        self, at: Any, memory: Array, s: Array, oil: LubricantState, out: Array, first: int
    ) -> None:
        now = _now(at, memory)
        mesh = mesh_force(_motion(at, s), now.series, now.n_orders, self.mesh)
        out[first], out[first + 1], out[first + 2] = s[at[_X]], mesh.force, mesh.stiffness
        out[first + 3] = s[at[_KEPT] + _LOAD]


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
    return s[at[_PORT]] if at[_PORT] >= 0 else memory[_TORQUE]


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


@dataclass(frozen=True, slots=True, kw_only=True)
class HypoidMesh(Element):
    """Mesh of a hypoid pair: that of the axle of [mohammadpour_2015], between any two bodies.

    Displacements of both bodies are those of the axle's frame; rz of a body is its rotation about
    its own axis in the drive direction.

    Parameters
    ----------
    name, pinion, gear : str
        Of the mesh, and of the bodies that carry its gears.
    parameters : HypoidAxleParameters
        Mesh table, damping, friction and films; masses for the limit of the step alone.
    torque_of : str, optional
        Port whose torque selects the level of the mesh table; default: that of the mesh.

    Examples
    --------
    >>> from gearlube_core.dynamics.hypoid_axle import mohammadpour_2015_axle
    >>> axle = mohammadpour_2015_axle()
    >>> mesh = HypoidMesh(name="mesh", pinion="pinion", gear="gear", parameters=axle)
    >>> mesh.losses[:2]
    ('friction_viscous', 'friction_boundary')
    """

    name: str
    pinion: str
    gear: str
    parameters: HypoidAxleParameters
    torque_of: str | None = None
    kind: ClassVar = "hypoid_mesh"
    on: ClassVar = ("pinion", "gear")
    beside: ClassVar = ("torque_of",)
    states: ClassVar = ("transmission_error",)
    losses: ClassVar = ("friction_viscous", "friction_boundary", "friction_rolling", "mesh_damping")
    outputs: ClassVar = (
        Output("dte", "m", "dynamic transmission error", 1e-5, "um"),
        Output("force", "N", "normal mesh force", 1e3),
        Output("stiffness", "N/m", "mesh stiffness", 1e8),
        Output("load_torque", "N.m", "torque that selects the mesh data", 100.0),
    )

    def variants(self) -> tuple[type, ...]:
        """Return the class of the friction law."""
        return (type(self.parameters.kernel_parameters().flank_law),)

    def sizes(self) -> tuple[int, ...]:
        """Return the sizes of the mesh table and of the film model."""
        packed = _packed(self.parameters)
        film = self.parameters.film_model().size
        return packed.levels.size, packed.orders, packed.nodes, packed.series_size, film

    def numbers(self) -> _HypoidMesh:
        """Return the constants of the kernels."""
        given, p = self.parameters, self.parameters.kernel_parameters()
        R_p = given.mean_pinion_radius
        R_g = R_p * p.ratio
        return _HypoidMesh(
            p.mesh,
            p.lateral_sign,
            p.friction,
            p.rolling,
            p.ratio,
            p.reduced_modulus,
            float(given.steps_per_mesh_period),
            R_p * R_p / p.I_p + R_g * R_g / p.I_g + 1.0 / p.m_p + 1.0 / p.m_g,
            R_p,
            p.flank_law,
        )

    def memory(self) -> Array:
        """Return the mesh table, its data at the present load, friction and the film model."""
        packed = _packed(self.parameters)
        table = packed.levels, packed.series.ravel(), packed.windows.ravel()
        now = packed.series_size + packed.window_size + N_FRICTION + N_CHANNELS
        head = np.array([np.nan, 0.0, 0.0, 0.0, 1.0])
        return np.concatenate([head, *table, np.zeros(now), self.parameters.film_model()])

    def kept_size(self) -> int:
        """Return the places of load level, side and films."""
        return _OWN_FILMS + (N_FILMS if self.parameters.film == "solved" else 0)


def _packed(given: HypoidAxleParameters) -> PackedMesh:
    modulus = contact_modulus(given.solid, given.solid)
    law = given.friction_law
    return pack_mesh(given.mesh, modulus, given.radii, given.mesh_stiffness, law.pressure)
