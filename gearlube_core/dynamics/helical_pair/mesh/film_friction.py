"""Mixed friction of the oil film at the points of the contact lines, for the periodic response."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal, NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_option
from gearlube_core.contact.greenwood_tripp_1971 import ROUGHNESS, SurfaceParameters, gear_flanks
from gearlube_core.contact.solid import Solid, SolidParameters, solid_parameters
from gearlube_core.dynamics.helical_pair.kernel_parameters import MeshArrays
from gearlube_core.dynamics.helical_pair.mesh.contact_points import (
    DENSITY,
    MU,
    OFFSET,
    X,
    Z,
    contact_points,
)
from gearlube_core.dynamics.helical_pair.mesh.mesh_wrench import point_moments
from gearlube_core.film_model.chosen_model import of_kind
from gearlube_core.film_model.model import LINE, FilmModel, shipped_model
from gearlube_core.friction.flank_laws import FILM_MODELS, AranaShare
from gearlube_core.friction.line_integrals import LineFrictionCycle, friction_along_lines
from gearlube_core.friction.line_points import LinePoints
from gearlube_core.friction.solved_line import bounded_line_friction
from gearlube_core.helical_geometry.contact_line import ContactPlane, line_kinematics
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.lubricant import Lubricant
from gearlube_core.oil.lubricant_state import LubricantState


class FilmConstants(NamedTuple):
    """Oil at its temperature, and the flanks."""

    lubricant: LubricantState
    surface: SurfaceParameters
    solid: SolidParameters
    film_model: Array  # numbers of a film model of lines, shape (N_ARRAY,); empty: formulas


@dataclass(frozen=True, slots=True, kw_only=True)
class FilmFriction:
    """Inputs of the film-based coefficient of friction besides load and speeds.

    Parameters
    ----------
    oil : Lubricant
    oil_temperature : float
        [K]
    solid : Solid
        Both flanks.
    roughness_rms : float
        Composite root-mean-square roughness of the flanks [m].
    asperities : AranaShare, optional
        Their law; default: that of Greenwood and Tripp.
    film : {"formula", "solved"}
        As in `HelicalMarchParameters`.
    line_film_model : FilmModel, optional
        Likewise.
    """

    oil: Lubricant
    oil_temperature: float
    solid: Solid
    roughness_rms: float
    asperities: AranaShare | None = None
    film: Literal["formula", "solved"] = "formula"
    line_film_model: FilmModel | None = None

    def __post_init__(self) -> None:
        check_option("film", self.film, FILM_MODELS)
        if self.line_film_model is not None:
            of_kind(self.line_film_model, LINE, "line_film_model")
        self.oil.check_temperature(self.oil_temperature, "oil_temperature")
        ROUGHNESS.check("roughness_rms", self.roughness_rms)

    def constants(self) -> FilmConstants:
        """Return the arguments of the kernels."""
        flanks = gear_flanks(self.roughness_rms)
        return FilmConstants(
            self.oil.state(self.oil_temperature),
            flanks if self.asperities is None else self.asperities.flanks(flanks),
            solid_parameters(self.solid, self.solid),
            self.film_models[LINE].copied_numbers() if self.film == "solved" else np.empty(0),
        )

    @property
    def formulas(self) -> FilmFriction:
        """The same by the formulas."""
        return replace(self, film="formula", line_film_model=None)

    def cycle(
        self, points: LinePoints, line_load: Array, pinion_speed: float, pinion_torque: float
    ) -> LineFrictionCycle:
        """Return friction on the lines of a mesh period, see `friction_along_lines`."""
        constants = self.constants()
        return friction_along_lines(
            points,
            line_load,
            pinion_speed=pinion_speed,
            pinion_torque=pinion_torque,
            lubricant=self.oil,
            oil_temperature=self.oil_temperature,
            surface=constants.surface,
            solid=constants.solid,
            film_model=constants.film_model,
        )

    def covered_cycle(
        self, points: LinePoints, line_load: Array, pinion_speed: float, pinion_torque: float
    ) -> LineFrictionCycle:
        """Return `cycle`, all by the formulas where the film model covers too little of the load.

        There `by_formulas` is true, `outside` says how much is outside, and no bound is known.
        """
        found = self.cycle(points, line_load, pinion_speed, pinion_torque)
        if not found.by_formulas:
            return found
        formulas = self.formulas.cycle(points, line_load, pinion_speed, pinion_torque)
        unknown = np.full_like(found.coefficient_bound, np.nan)
        return replace(formulas, outside=found.outside, coefficient_bound=unknown)

    @property
    def film_models(self) -> dict[str, FilmModel]:
        """The model of solved films that is taken, by kind: "line"; empty with the formulas."""
        return {LINE: self.line_film_model or shipped_model(LINE)} if self.film == "solved" else {}


class FilmField(NamedTuple):
    """Film friction along a known motion: strains of the plane of contact against phase."""

    constants: FilmConstants
    pinion_speed: float  # [rad/s]
    phase: Array  # rising from 0 to 1, shape (B,)
    strain: Array  # y0 [m], y1 [rad] of `mesh_strain`, shape (B, 2)


@kernel
def film_coefficients(
    y0: float,
    y1: float,
    pinion_speed: float,
    plane: ContactPlane,
    film: FilmConstants,
    points: Array,
    n: int,
) -> None:
    """Give the first `n` points their coefficients of friction, of `bounded_line_friction`.

    Parameters
    ----------
    y0, y1
        Strains of the plane of contact [m, rad].
    pinion_speed
        [rad/s]
    """
    for i in range(n):
        p = points[i, X] * plane.sin_b + points[i, Z] * plane.cos_b
        load = points[i, DENSITY] * (y0 + p * y1 - points[i, OFFSET])
        motion = line_kinematics(points[i, X], pinion_speed, plane)
        R, u, slip = motion.R, motion.entrainment, motion.sliding
        points[i, MU] = bounded_line_friction(
            load, R, u, slip, film.lubricant, film.surface, film.solid, film.film_model
        ).state.friction_coefficient


@kernel
def film_moments(
    phases: Array,
    field: FilmField,
    plane: ContactPlane,
    mesh: MeshArrays,
    points: Array,
    moments: Array,
) -> None:
    """Fill the moments of `point_moments` at many phases, shape (phases, 5, 3)."""
    for i in range(phases.size):
        phase = phases[i]
        low, top = 1, field.phase.size - 1
        while low < top:
            middle = (low + top) // 2
            if field.phase[middle] < phase:
                low = middle + 1
            else:
                top = middle
        width = field.phase[low] - field.phase[low - 1]
        share = (phase - field.phase[low - 1]) / width
        y0 = (1.0 - share) * field.strain[low - 1, 0] + share * field.strain[low, 0]
        y1 = (1.0 - share) * field.strain[low - 1, 1] + share * field.strain[low, 1]
        n = contact_points(phase, field.pinion_speed, plane, mesh, points)
        film_coefficients(y0, y1, field.pinion_speed, plane, field.constants, points, n)
        point_moments(plane, points, n, moments[i])
