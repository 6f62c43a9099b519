"""Checked parameters of the marching model."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, Literal

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.contact.greenwood_tripp_1971 import ROUGHNESS
from gearlube_core.contact.solid import STEEL_MOHAMMADPOUR_2015, Solid, solid_parameters
from gearlube_core.dynamics.helical_pair.march.flanks import LINES_MAX, MarchConstants, MarchScalars
from gearlube_core.dynamics.helical_pair.march.given_pair import (
    ARANA,
    GivenBody,
    GivenOil,
    GivenPair,
    MarchChoices,
    write_constants,
)
from gearlube_core.dynamics.helical_pair.march.mesh_data import all_stations
from gearlube_core.dynamics.helical_pair.parameters import FRICTION, check_line_mesh, effective_mass
from gearlube_core.dynamics.helical_pair.supports import ShaftSupport, shaft_springs
from gearlube_core.dynamics.ranges import Range, model_ranges, range_limits
from gearlube_core.film import line_film
from gearlube_core.film_model.chosen_model import of_kind
from gearlube_core.film_model.model import LINE, FilmModel, shipped_model
from gearlube_core.film_model.net import N_ARRAY
from gearlube_core.friction.flank_laws import FILM_MODELS
from gearlube_core.helical_geometry.gear_body import DAMPING_RATIO, INERTIA, MASS
from gearlube_core.helical_geometry.pair import HelicalPair
from gearlube_core.kernels.flat_tuples import count_floats, flatten, tuple_from_array
from gearlube_core.mesh_table.line_mesh import LineMesh
from gearlube_core.number import Checked, Number, check_fields, constants_of
from gearlube_core.oil.lubricant import Lubricant

Form = Literal["twelve_dof", "six_dof"]
Friction = Literal["film", "constant", "off", "arana_2019"]
Equations = Literal["consistent", "he_2007"]
Film = Literal["formula", "solved"]

# what the constants of the march call the options
FRICTION_FORMS = {"off": -1.0, "constant": 0.0, "film": 1.0, "arana_2019": ARANA}
HELD = {"twelve_dof": 0.0, "six_dof": 1.0}
LINE_WORK = {"consistent": 1.0, "he_2007": 0.0}


@dataclass(frozen=True, slots=True, kw_only=True)
class Body(Checked):
    """One gear and what carries it.

    Parameters
    ----------
    mass : float
        [kg]
    inertia, polar_inertia : float
        About a diameter and about the axis [kg m2].
    support : ShaftSupport
    """

    mass: Annotated[float, MASS]
    inertia: Annotated[float, INERTIA]
    polar_inertia: Annotated[float, INERTIA]
    support: ShaftSupport

    def given(self) -> GivenBody:
        """Return the floats for the kernels."""
        first, second = shaft_springs(self.support)
        return GivenBody(
            mass=float(self.mass),
            inertia=float(self.inertia),
            polar_inertia=float(self.polar_inertia),
            first=first,
            second=second,
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class HelicalMarchParameters(MarchScalars):
    """Everything that defines one pair in motion.

    Its other fields are those of `flanks.MarchScalars` and of `flanks.FlankScalars`, such
    as the backlash.

    Parameters
    ----------
    pair : HelicalPair
        Its total contact ratio is at most LINES_MAX.
    mesh : LineMesh
        Stiffness density and offset; both flanks have the same.
    pinion, gear : Body
    friction : {"film", "constant", "off", "arana_2019"}
        Mixed friction of the film at every contact point, asperities by Greenwood and Tripp;
        Coulomb with one coefficient; none; "film" with the share of asperities of Arana et al.
    friction_coefficient : float
        mu of "constant" [-].
    film : {"formula", "solved"}
        Central film and friction of the oil: "formula", Dowson and Toyoda 1979 with Evans and
        Johnson 1986, or "solved", by a model of solved thermal Eyring films, see
        `solved_line.solved_line_at`; outside its domain formulas are used.
    line_film_model : FilmModel, optional
        Model of solved films of lines; default: the one in the package. `FilmModel.named` reads a
        file. Where it does not cover the oil, formulas are used; `check_oil` reports it.
    oil : Lubricant
    solid : Solid
        Both flanks.
    roughness_rms : float
        Composite root-mean-square roughness of the flanks [m].
    mesh_damping_ratio, support_damping_ratio : float
        [-]
    form : {"twelve_dof", "six_dof"}
        Six keeps x, y and rotation of both members and holds the rest.
    equations : {"consistent", "he_2007"}
        Whether the pinion feels that loaded springs enter, leave and change, as the balance of
        energy asks, or not, as in the paper; about 1e-4 of the mesh torque, see `line_sums`. The
        periodic response leaves it out, too: for the pair of He et al. at 1000 rpm its first
        harmonic of u_xp is 5 percent larger at mu = 0.01, as much smaller at 0.1; that of the
        transmission error differs by 0.01 percent.
    steps_per_mesh_period, steps_per_highest_period : int
        Integrator steps per mesh period and per period of the highest mode.

    References
    ----------
    [he_2007]
    """

    pair: HelicalPair
    mesh: LineMesh
    pinion: Body
    gear: Body
    oil: Lubricant
    friction: Friction = "film"
    friction_coefficient: Annotated[float, FRICTION] = 0.05
    film: Film = "formula"
    line_film_model: FilmModel | None = None
    roughness_rms: Annotated[float, ROUGHNESS] = 0.5e-6
    solid: Solid = STEEL_MOHAMMADPOUR_2015
    mesh_damping_ratio: Annotated[float, DAMPING_RATIO] = 0.05
    support_damping_ratio: Annotated[float, DAMPING_RATIO] = 0.05
    form: Form = "twelve_dof"
    equations: Equations = "consistent"
    steps_per_mesh_period: Annotated[int, Number("1", 16, 4096)] = 64
    steps_per_highest_period: Annotated[int, Number("1", 6, 4096)] = 8

    def __post_init__(self) -> None:
        check_fields(self)
        if self.line_film_model is not None:
            of_kind(self.line_film_model, LINE, "line_film_model")
        check_line_mesh(self.mesh, self.pair, LINES_MAX)

    @property
    def effective_mass(self) -> float:
        """m_e of the relative rotation along the line of action [kg]."""
        return effective_mass(self.pair, self.pinion.polar_inertia, self.gear.polar_inertia)

    @property
    def torque_range(self) -> tuple[float, float]:
        """Pinion torques at the ends of the line mesh [N.m]; without end for a single level."""
        high = float(self.mesh.torque[-1]) if self.mesh.torque.size > 1 else math.inf
        return -high, high

    @property
    def ranges(self) -> tuple[Range, ...]:
        """Ranges of the line mesh, the oil and the formulas of film and traction."""
        return model_ranges(
            self.torque_range,
            "Run `gearlube helical --torques` with higher torques.",
            self.oil,
            line_film.LOAD_RANGE,
            line_film.MATERIAL_RANGE,
        )

    @property
    def coast_phase(self) -> float:
        """Phase of the drive flanks plus phase of the coast flanks [mesh periods].

        With a pinion tooth in the line of centres at mid-face, both its flanks stand a quarter of
        the base pitch beyond the pitch point: teeth and gaps are taken as equal at the working
        pitch circles, less a thousandth of a pitch of backlash.
        """
        plane = self.pair.plane
        X = plane.P + 0.25 * plane.pitch + 0.5 * plane.W * math.tan(self.pair.base_helix_angle)
        return 2.0 * (X - plane.A) / plane.pitch

    def given(self) -> GivenPair:
        """Return the constants that only gear file and line mesh decide."""
        plane = self.pair.plane
        height = plane.r_bp + plane.r_bg
        square = plane.x_g**2 + height**2
        torque_low, torque_high = self.torque_range
        return GivenPair(
            plane=plane,
            effective_mass=self.effective_mass,
            coast_phase=self.coast_phase,
            turn_cos=(height**2 - plane.x_g**2) / square,
            turn_sin=2.0 * plane.x_g * height / square,
            lines=float(self.mesh.lines),
            phases=float(self.mesh.phase.size),
            stations=float(all_stations(self.mesh).size),
            teeth=float(self.pair.pinion_teeth),
            pinion=self.pinion.given(),
            gear=self.gear.given(),
            solid=solid_parameters(self.solid, self.solid),
            torque_low=torque_low,
            torque_high=torque_high,
        )

    def given_oil(self) -> GivenOil:
        """Return the oil with the ranges of the formulas."""
        return GivenOil(self.oil.parameters(), range_limits(self.ranges))

    def choices(self) -> MarchChoices:
        """Return the choices that are possible for any gear file."""
        return constants_of(
            MarchChoices,
            self,
            friction_form=FRICTION_FORMS[self.friction],
            held=HELD[self.form],
            line_work=LINE_WORK[self.equations],
            film=float(FILM_MODELS.index(self.film)),
        )

    def film_model(self) -> Array:
        """Return the numbers of the film model for one pair; zeros with the formulas."""
        if self.film == "formula":
            return np.zeros(N_ARRAY)
        return (self.line_film_model or shipped_model(LINE)).copied_numbers()

    def constants(self) -> MarchConstants:
        """Return the floats for the kernels."""
        floats = np.zeros(count_floats(MarchConstants))
        given = flatten(self.given())
        write_constants(given, flatten(self.given_oil()), flatten(self.choices()), floats)
        found: MarchConstants = tuple_from_array(floats, MarchConstants)
        return found
