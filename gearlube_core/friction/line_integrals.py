"""Friction along all contact lines of a helical pair over a mesh period: film, loss, efficiency."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_positive
from gearlube_core.contact.greenwood_tripp_1971 import SurfaceParameters
from gearlube_core.contact.solid import SolidParameters
from gearlube_core.errors import ParameterError
from gearlube_core.film.line_film import minimum_line_film_thickness
from gearlube_core.film_model.model import MOST_OUTSIDE
from gearlube_core.friction.line_points import LINE_LOAD_FLOOR, LinePoints
from gearlube_core.friction.solved_line import bounded_line_friction
from gearlube_core.helical_geometry.contact_line import ContactPlane, line_kinematics
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.lubricant import Lubricant
from gearlube_core.oil.lubricant_state import LubricantState

_QUANTITIES = 10


class SmallestFilm(NamedTuple):
    """The smallest film of a mesh period and its position."""

    thickness: float  # [m]
    phase: float  # [mesh periods]
    line: int  # as in `line_position`
    x: float  # [m]
    z: float  # [m]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LineFrictionCycle:
    """Friction on the lines of a mesh period; arrays of shape (N, lines, M) of `points`.

    Parameters
    ----------
    points : LinePoints
        Places, phases and weights.
    pinion_speed, pinion_torque : float
        [rad/s], [N.m]; the torque is that of the line loads without friction.
    line_load : ndarray
        w [N/m].
    coefficient : ndarray
        mu with the sign of sliding, negative before the pitch line [-].
    central_film, minimum_film : ndarray
        [dowson_toyoda_1979] or solved, and [dowson_1968] [m]; also given where nothing presses.
    film_ratio : ndarray
        Central film over composite roughness [-].
    temperature_rise : ndarray
        Mean of the film over the oil [K].
    mean_pressure : ndarray
        [Pa].
    entrainment, sliding : ndarray
        Across the line [m/s].
    outside, coefficient_bound : ndarray
        Of solved films: share that lies outside the domain of the film model, and bound of mu [-];
        zeros with the formulas.
    """

    points: LinePoints
    pinion_speed: float
    pinion_torque: float
    line_load: Array
    coefficient: Array
    central_film: Array
    minimum_film: Array
    film_ratio: Array
    temperature_rise: Array
    mean_pressure: Array
    entrainment: Array
    sliding: Array
    outside: Array
    coefficient_bound: Array

    @property
    def power_loss(self) -> Array:
        """Friction power of all lines at each phase [W], shape (N,): sum of mu w u_s dl."""
        return self._sum(self.coefficient * self.line_load * self.sliding)

    @property
    def mean_power_loss(self) -> float:
        """Mean over the mesh period [W]."""
        return float(self.power_loss.mean())

    @property
    def power_loss_bound(self) -> float:
        """Bound of `mean_power_loss` as if all errors had one sign [W]; 0 with the formulas."""
        return float(self._sum(self.coefficient_bound * self.line_load * abs(self.sliding)).mean())

    @property
    def share_outside(self) -> float:
        """Share of the load outside the domain of the film model [-]; 0 with the formulas."""
        return float(
            self._sum(self.outside * self.line_load).sum() / self._sum(self.line_load).sum()
        )

    @property
    def by_formulas(self) -> bool:
        """Whether too much load is outside the film model, so that formulas have to stand in."""
        return self.share_outside > MOST_OUTSIDE

    @property
    def efficiency(self) -> float:
        """1 - lost power over pinion torque times speed [-]; sliding friction alone."""
        return 1.0 - self.mean_power_loss / (self.pinion_torque * self.pinion_speed)

    @property
    def loss_factor(self) -> float:
        """Sum of w |u_s| dl over transmitted power [-]: H_V of gear practice, for these loads."""
        rubbed = self._sum(self.line_load * abs(self.sliding)).mean()
        return float(rubbed / (self.pinion_torque * self.pinion_speed))

    @property
    def mean_coefficient(self) -> float:
        """The constant mu that loses the same power [-]: lost power = mu H_V T w."""
        power = self.pinion_torque * self.pinion_speed
        return self.mean_power_loss / (self.loss_factor * power)

    @property
    def smallest_film(self) -> SmallestFilm:
        """Smallest `minimum_film` of all loaded points."""
        pressed = (self.points.length > 0.0) & (self.line_load > 0.0)
        film = np.where(pressed, self.minimum_film, np.inf)
        n, i, m = np.unravel_index(int(film.argmin()), film.shape)
        return SmallestFilm(
            float(film[n, i, m]),
            float(self.points.phase[n]),
            int(i),
            float(self.points.x[n, i, m]),
            float(self.points.z[n, i, m]),
        )

    def _sum(self, density: Array) -> Array:
        return np.asarray((density * self.points.length).sum(axis=(1, 2)))


@kernel
def _friction_at_points(
    x: Array,
    line_load: Array,
    pinion_speed: float,
    plane: ContactPlane,
    lubricant: LubricantState,
    surface: SurfaceParameters,
    solid: SolidParameters,
    film_model: Array,
    result: Array,
) -> None:
    for j in range(x.size):
        motion = line_kinematics(x[j], pinion_speed, plane)
        R, u, slip = motion.R, motion.entrainment, motion.sliding
        film = bounded_line_friction(
            line_load[j], R, u, slip, lubricant, surface, solid, film_model
        )
        state = film.state
        result[0, j] = state.signed_coefficient
        result[1, j] = state.film_thickness
        result[2, j] = minimum_line_film_thickness(
            motion.R,
            lubricant.eta0,
            lubricant.alpha,
            motion.entrainment,
            max(line_load[j], LINE_LOAD_FLOOR),
            2.0 * solid.contact_modulus,
        )
        result[3, j] = state.film_ratio
        result[4, j] = state.temperature_rise
        result[5, j] = state.mean_pressure
        result[6, j] = motion.entrainment
        result[7, j] = motion.sliding
        result[8, j] = film.outside
        result[9, j] = film.coefficient_bound


def friction_along_lines(
    points: LinePoints,
    line_load: Array,
    *,
    pinion_speed: float,
    pinion_torque: float,
    lubricant: Lubricant,
    oil_temperature: float,
    surface: SurfaceParameters,
    solid: SolidParameters,
    film_model: Array | None = None,
) -> LineFrictionCycle:
    """Return friction, film and loss on all lines of a mesh period.

    Parameters
    ----------
    points : LinePoints
        From `line_points`.
    line_load : ndarray of shape (N, lines, M)
        w at the points [N/m], from `uniform_line_load`, `table_line_load` or elsewhere.
    pinion_speed : float
        [rad/s].
    pinion_torque : float
        That the line loads carry [N.m].
    lubricant : Lubricant
        Oil.
    oil_temperature : float
        [K].
    surface : SurfaceParameters
        Roughness of the pair.
    solid : SolidParameters
        Of the pair.
    film_model : ndarray, optional
        Numbers of a film model of lines, whose scratch is written into; by default the formulas.

    Returns
    -------
    LineFrictionCycle

    Raises
    ------
    ParameterError
        Speed or torque not above zero, oil out of its range, line loads of another shape.

    Notes
    -----
    Quasi-steady: every point has the film of its own speed, radius and load.
    """
    check_positive("pinion_speed", pinion_speed, "rad/s", "Give the magnitude.")
    check_positive("pinion_torque", pinion_torque, "N.m", "Give the magnitude.")
    lubricant.check_temperature(oil_temperature, "oil_temperature")
    load = np.ascontiguousarray(line_load, dtype=np.float64)
    if load.shape != points.x.shape or not np.isfinite(load).all():
        raise ParameterError(
            f"line_load must be finite and of shape {points.x.shape} [N/m], got shape "
            f"{load.shape}. Take it at the same points."
        )
    result = np.empty((_QUANTITIES, load.size))
    _friction_at_points(
        points.x.ravel(),
        load.ravel(),
        float(pinion_speed),
        points.pair.plane,
        lubricant.state(float(oil_temperature)),
        surface,
        solid,
        np.empty(0) if film_model is None else film_model,
        result,
    )
    fields = result.reshape(_QUANTITIES, *load.shape)
    return LineFrictionCycle(
        points=points,
        pinion_speed=float(pinion_speed),
        pinion_torque=float(pinion_torque),
        line_load=load,
        coefficient=fields[0],
        central_film=fields[1],
        minimum_film=fields[2],
        film_ratio=fields[3],
        temperature_rise=fields[4],
        mean_pressure=fields[5],
        entrainment=fields[6],
        sliding=fields[7],
        outside=fields[8],
        coefficient_bound=fields[9],
    )
