"""One hypoid tooth pair through its engagement: contact, window of the film, and the film."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_option, check_within
from gearlube_core.ehl.point.contact_domain import elliptical_contact
from gearlube_core.ehl.point.problem import EllipticParaboloid, PointContactProblem
from gearlube_core.ehl.transient.level import FilmConditions
from gearlube_core.ehl.transient.problem import MovingFilm
from gearlube_core.errors import ParameterError
from gearlube_core.mesh_table.kernels import LoadBracket, load_bracket
from gearlube_core.mesh_table.sliding_direction import pair_sliding_direction
from gearlube_core.mesh_table.table import PAIRS, MeshTable
from gearlube_core.oil.film_oil import FilmOil

_MIDDLE = 0.5 * PAIRS  # of a pair's window [mesh periods]
FLOWS = ("eyring", "newtonian")

# along the major axis, in its semi-axis: oil enters across the minor one. What is carried farther
# out is that of the oil beyond
_Y_REACH = (-1.5, 1.3)


class PairContact(NamedTuple):
    """Contact of one pair at N phases, per unit pinion speed.

    x is the minor axis of the contact ellipse, y its major one, both turned so that entrainment
    points to larger x and y.
    """

    share: Array  # of the mesh force [-], (N,)
    R_x: Array  # relative radii [m], (N,)
    R_y: Array
    entrainment: Array  # mean surface velocity over pinion speed [m], (N, 2)
    sliding: Array  # of the pinion's surface over the gear's, over pinion speed [m], (N, 2)


def phase_of(table: MeshTable, angle: Array) -> Array:
    """Return the phase of a pair at pinion angles [rad]: mesh periods from its window's middle."""
    turned = table.pinion_teeth * np.asarray(angle) / (2.0 * np.pi)
    return np.asarray(turned % PAIRS - _MIDDLE)


def pair_contact(table: MeshTable, torque: float, phase: Array) -> PairContact:
    """Return the contact of a pair, interpolated linearly in load and phase as the axle does.

    Parameters
    ----------
    table
        Of the gear pair.
    torque
        On the pinion, its sign chooses the flank [N m].
    phase : ndarray, shape (N,)
        Mesh periods from the middle of the pair's window.
    """
    bracket = load_bracket(abs(torque), float(np.sign(torque)), table.torque, table.torque.size)
    levels = [_at_level(table, level) for level in (bracket.lower, bracket.upper)]
    position = (np.asarray(phase, dtype=np.float64) + _MIDDLE) % PAIRS / PAIRS * table.nodes
    node = np.minimum(position.astype(int), table.nodes - 1)
    after, weight = (node + 1) % table.nodes, position - node

    def blended(lower: Array, upper: Array) -> Array:
        values = _blend(lower, upper, bracket)
        t = weight if values.ndim == 1 else weight[:, None]
        return np.asarray(values[node] + t * (values[after] - values[node]))

    return PairContact(*(blended(*pair) for pair in zip(*levels, strict=True)))


def _blend(lower: Array, upper: Array, bracket: LoadBracket) -> Array:
    return lower + bracket.weight * (upper - lower)


def _at_level(table: MeshTable, level: int) -> PairContact:
    w = {key: values[level] for key, values in table.windows.items()}
    pinion, gear = w["friction_arm_p"], w["friction_arm_g"] / table.ratio
    direction = pair_sliding_direction(w, table.ratio)
    return PairContact(
        w["share"],
        w["R_x"],
        w["R_y"],
        _vectors(w["entrainment_arm"], w["psi"]),
        _vectors(pinion - gear, direction),
    )


def _vectors(length: Array, angle: Array) -> Array:
    return np.stack([length * np.cos(angle), length * np.sin(angle)], axis=1)


class FlankInstant(NamedTuple):
    """The contact at one time; vectors in the axes of its ellipse, x the minor one."""

    time: float  # [s]
    angle: float  # of the pinion [rad]
    phase: float  # [mesh periods]
    load: float  # [N]
    R_x: float  # [m]
    R_y: float  # [m]
    entrainment: tuple[float, float]  # [m/s]
    sliding: tuple[float, float]  # of the pinion's surface over the gear's [m/s]

    @property
    def psi(self) -> float:
        """Return the angle of entrainment from the minor axis [rad]."""
        return math.atan2(self.entrainment[1], self.entrainment[0])

    @property
    def chi(self) -> float:
        """Return the angle of sliding from the minor axis towards the major one [rad]."""
        return math.atan2(self.sliding[1], self.sliding[0])

    @property
    def speed(self) -> float:
        """Return the entrainment speed [m/s]."""
        return math.hypot(*self.entrainment)

    @property
    def slip(self) -> float:
        """Return the sliding speed [m/s]."""
        return math.hypot(*self.sliding)

    @property
    def gap(self) -> EllipticParaboloid:
        """Return the gap of the undeformed flanks."""
        return EllipticParaboloid(self.R_x, self.R_y)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class FlankCycle:
    """Contact of one tooth pair over the loaded part of its engagement, N times.

    Parameters
    ----------
    time, angle, phase : ndarray, shape (N,)
        Time [s], pinion angle [rad] and phase [mesh periods]; all rise.
    load : ndarray, shape (N,)
        Normal to the flanks [N], above zero.
    R_x, R_y : ndarray, shape (N,)
        Relative radii along the minor and the major axis of the contact ellipse [m].
    entrainment : ndarray, shape (N, 2)
        Mean surface velocity against the point of contact [m/s], above zero along x and not
        below along y.
    sliding : ndarray, shape (N, 2)
        Velocity of the pinion's surface over the gear's [m/s].

    Raises
    ------
    ParameterError
        A shape differs or a value is out of range.

    Notes
    -----
    Axes turn and move with the ellipse. Between times everything is linear.
    """

    time: Array
    angle: Array
    phase: Array
    load: Array
    R_x: Array
    R_y: Array
    entrainment: Array
    sliding: Array

    def __post_init__(self) -> None:
        count = self.time.size
        if count < 2:
            raise ParameterError(f"a flank's cycle must have at least 2 times, got {count}.")
        for name in self.__dataclass_fields__:
            values = getattr(self, name)
            shape = (count, 2) if name in ("entrainment", "sliding") else (count,)
            if values.shape != shape or not np.isfinite(values).all():
                raise ParameterError(
                    f"{name} of a flank's cycle must be finite and of shape {shape}, got shape "
                    f"{values.shape}."
                )
        for name in ("time", "angle", "phase"):
            if not (np.diff(getattr(self, name)) > 0.0).all():
                raise ParameterError(f"{name} of a flank's cycle must rise.")
        for name, unit in (("load", "N"), ("R_x", "m"), ("R_y", "m")):
            lowest = float(getattr(self, name).min())
            if not lowest > 0.0:
                raise ParameterError(
                    f"{name} of a flank's cycle must be above 0 {unit}, got {lowest:g} {unit}. "
                    "Leave times without contact out."
                )
        u, v = self.entrainment.min(axis=0)
        if not (u > 0.0 and v >= 0.0):
            raise ParameterError(
                "entrainment of a flank's cycle must be above 0 m/s along x and not below along "
                f"y, got down to {u:g} and {v:g} m/s. Turn the axes."
            )

    def at(self, time: float) -> FlankInstant:
        """Return the contact at a time [s]; held outside the cycle."""

        def value(values: Array) -> float:
            return float(np.interp(time, self.time, values))

        return FlankInstant(
            time,
            value(self.angle),
            value(self.phase),
            value(self.load),
            value(self.R_x),
            value(self.R_y),
            (value(self.entrainment[:, 0]), value(self.entrainment[:, 1])),
            (value(self.sliding[:, 0]), value(self.sliding[:, 1])),
        )

    def instants(self) -> list[FlankInstant]:
        """Return the contact at all times of the cycle."""
        return [self.at(float(time)) for time in self.time]


def flank_contact(
    instant: FlankInstant,
    contact_modulus: float,
    lubricant: FilmOil,
    nodes: tuple[int, int],
    oil_beyond: bool = True,
) -> PointContactProblem:
    """Return the steady contact of one instant on a domain of its own.

    Parameters
    ----------
    instant
        Load, radii and motion.
    contact_modulus
        E* [Pa].
    lubricant
        Oil with its laws of flow.
    nodes
        Along the minor and along the major axis.
    oil_beyond
        As in `PointContactProblem`. False takes a larger inlet where films are thick.
    """
    problem = elliptical_contact(
        R_x=instant.R_x,
        R_y=instant.R_y,
        entrainment=instant.entrainment,
        load=instant.load,
        contact_modulus=contact_modulus,
        lubricant=lubricant,
        nodes=nodes,
        sliding=instant.sliding,
        oil_beyond=oil_beyond,
    )
    semi_axis = problem.hertz_contact[1]
    low, high = (reach * semi_axis for reach in _Y_REACH)
    return replace(problem, y_limits=(low, high))


@dataclass(frozen=True, slots=True, kw_only=True)
class HypoidFilm:
    """Film of one tooth pair through its engagement.

    Parameters
    ----------
    cycle : FlankCycle
        Load, radii and motion of the contact.
    lubricant : FilmOil
        Its Eyring stress, if it has one, acts on the traction, and on the flow as `flow` says.
    contact_modulus
        E* [Pa].
    nodes
        Along the minor and along the major axis of the ellipse.
    flow
        "eyring": the oil flows as it shears, along and across sliding; "newtonian": as an oil
        without an Eyring stress.

    Raises
    ------
    ParameterError
        An input is out of range.

    Notes
    -----
    Film x is the minor axis, y the major one. Entrainment has components along both, steady and
    in time. The axes move with the contact: what the flanks' frame sees of the ellipse's slow
    turning is left out.
    """

    cycle: FlankCycle
    lubricant: FilmOil
    contact_modulus: float
    nodes: tuple[int, int] = (257, 65)
    flow: str = "eyring"

    def __post_init__(self) -> None:
        check_option("flow", self.flow, FLOWS)
        for axis, count in zip(("minor", "major"), self.nodes, strict=True):
            check_within(f"nodes along the {axis} axis", count, 17, 2049)

    def problem(self, instant: FlankInstant) -> PointContactProblem:
        """Return the steady contact of one instant on a domain of its own."""
        return flank_contact(instant, self.contact_modulus, self._flowing(), self.nodes)

    def domain(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """Return limits along x and y [m] that contain the contact of all instants."""
        contact = (self.contact_modulus, self._flowing(), self.nodes, False)
        problems = [flank_contact(instant, *contact) for instant in self.cycle.instants()]
        limits = np.array([[*problem.x_limits, *problem.y_limits] for problem in problems])
        low, high = limits.min(axis=0), limits.max(axis=0)
        return (float(low[0]), float(high[1])), (float(low[2]), float(high[3]))

    def conditions(self, x: Array, y: Array, time: float) -> FilmConditions:
        """Return gap, load and speeds of the film at a time [s]."""
        now = self.cycle.at(time)
        u, v = now.entrainment
        slip, side_slip = now.sliding
        return FilmConditions(
            gap=now.gap(x[:, None], y[None, :]),
            load=now.load,
            speed_1=np.full(y.size, u - 0.5 * slip),
            speed_2=np.full(y.size, u + 0.5 * slip),
            slope=v / u,
            side_sliding=side_slip,
        )

    def moving_film(self) -> MovingFilm:
        """Return the film in time with the scales of the largest load."""
        most = self.cycle.at(float(self.cycle.time[self.cycle.load.argmax()]))
        x_limits, y_limits = self.domain()
        return MovingFilm(
            conditions=self.conditions,
            lubricant=self._flowing(),
            contact_modulus=self.contact_modulus,
            x_limits=x_limits,
            y_limits=y_limits,
            nodes=self.nodes,
            hertz=most.gap,
            load=most.load,
            speed=most.entrainment[0],
        )

    def _flowing(self) -> FilmOil:
        return self.lubricant if self.flow == "eyring" else self.lubricant.newtonian()
