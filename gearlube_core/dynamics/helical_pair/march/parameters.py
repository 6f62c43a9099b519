"""Parameters of the marching model, checked, in engineering words."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, Literal, get_args

from gearlube_core.checks import check_option, check_within
from gearlube_core.contact.greenwood_tripp_1971 import gear_flanks
from gearlube_core.contact.solid import STEEL_MOHAMMADPOUR_2015, Solid, solid_parameters
from gearlube_core.dynamics.helical_pair.march.constants import (
    MarchConstants,
    MarchScalars,
    MotionConstants,
    SupportConstants,
)
from gearlube_core.dynamics.helical_pair.march.flank_views import FlankConstants
from gearlube_core.dynamics.helical_pair.march.mesh_data import all_stations
from gearlube_core.dynamics.helical_pair.march.state import LINES_MAX
from gearlube_core.dynamics.helical_pair.mesh.mesh_damping import damping_factor
from gearlube_core.dynamics.helical_pair.mesh_match import check_line_mesh, effective_mass
from gearlube_core.dynamics.helical_pair.supports.shaft_support import ShaftSupport
from gearlube_core.dynamics.helical_pair.supports.support_matrices import (
    support_damping,
    support_stiffness,
)
from gearlube_core.dynamics.model_ranges import model_ranges
from gearlube_core.dynamics.ranges import Range, range_limits
from gearlube_core.dynamics.scalars import Within, check_scalars, constants_of
from gearlube_core.film import dowson_toyoda_1979
from gearlube_core.helical_geometry.pair import HelicalPair
from gearlube_core.mesh_table.line_mesh import LineMesh
from gearlube_core.oil.lubricant import Lubricant

Form = Literal["twelve_dof", "six_dof"]
Friction = Literal["film", "constant", "off"]
Equations = Literal["consistent", "he_2007"]

_DAMPING = Within(0.0, 1.0, cure="Five percent is usual.")

FRICTION_FORMS = {"off": -1.0, "constant": 0.0, "film": 1.0}


@dataclass(frozen=True, slots=True, kw_only=True)
class Body:
    """One gear and what carries it.

    Parameters
    ----------
    mass : float
        [kg]
    inertia, polar_inertia : float
        About a diameter and about the axis [kg m2].
    support : ShaftSupport
    """

    mass: float
    inertia: float
    polar_inertia: float
    support: ShaftSupport

    def __post_init__(self) -> None:
        check_within("mass", self.mass, 1e-4, 1e6, "kg")
        for name in ("inertia", "polar_inertia"):
            check_within(name, getattr(self, name), 1e-9, 1e6, "kg m2")

    def constants(self, ratio: float, held: bool) -> SupportConstants:
        """Return the floats for the kernels; `held` takes axial motion and tilt away."""
        K = support_stiffness(self.support)
        c = support_damping(self.support, self.mass, self.inertia, ratio, False)
        free = 0.0 if held else 1.0
        return SupportConstants(
            K_xx=K[0, 0], K_yy=K[1, 1], K_zz=K[2, 2], K_ax=K[3, 3], K_ay=K[4, 4],
            K_x_ay=K[0, 4], K_y_ax=K[1, 3],
            c_x=c[0], c_y=c[1], c_z=c[2], c_ax=c[3], c_ay=c[4],
            mobility=1.0 / self.mass,
            mobility_z=free / self.mass,
            mobility_a=free / self.inertia,
            mobility_r=1.0 / self.polar_inertia,
        )  # fmt: skip


@dataclass(frozen=True, slots=True, kw_only=True)
class HelicalMarchParameters(MarchScalars):
    """Everything that defines one pair in motion.

    Its other fields are those of `constants.MarchScalars` and of `flank_views.FlankScalars`, such
    as the backlash.

    Parameters
    ----------
    pair : HelicalPair
        Its total contact ratio is at most LINES_MAX.
    mesh : LineMesh
        Stiffness density and offset; both flanks have the same.
    pinion, gear : Body
    friction : {"film", "constant", "off"}
        Mixed friction of the film at every contact point; Coulomb with one coefficient; none.
    friction_coefficient : float
        mu of "constant" [-].
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
    friction_coefficient: Annotated[float, Within(0.0, 1.0)] = 0.05
    roughness_rms: Annotated[float, Within(1e-9, 2e-5, "m", "0.5 um is 5e-7 m.")] = 0.5e-6
    solid: Solid = STEEL_MOHAMMADPOUR_2015
    mesh_damping_ratio: Annotated[float, _DAMPING] = 0.05
    support_damping_ratio: Annotated[float, _DAMPING] = 0.05
    form: Form = "twelve_dof"
    equations: Equations = "consistent"
    steps_per_mesh_period: Annotated[int, Within(16, 4096)] = 64
    steps_per_highest_period: Annotated[int, Within(6, 4096)] = 8

    def __post_init__(self) -> None:
        check_option("friction", self.friction, get_args(Friction))
        check_option("form", self.form, get_args(Form))
        check_option("equations", self.equations, get_args(Equations))
        check_scalars(self)
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
            dowson_toyoda_1979.LOAD_RANGE,
            dowson_toyoda_1979.MATERIAL_RANGE,
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

    def constants(self) -> MarchConstants:
        """Return the floats for the kernels."""
        held = self.form == "six_dof"
        constant = self.friction == "constant"
        plane = self.pair.plane
        height = plane.r_bp + plane.r_bg
        square = plane.x_g**2 + height**2
        flanks = constants_of(
            FlankConstants,
            self,
            plane=plane,
            damping=damping_factor(self.mesh_damping_ratio, self.effective_mass, plane.cos_b),
            turn_cos=(height**2 - plane.x_g**2) / square,
            turn_sin=2.0 * plane.x_g * height / square,
            line_work=1.0 if self.equations == "consistent" else 0.0,
            lines=float(self.mesh.lines),
            phases=float(self.mesh.phase.size),
            stations=float(all_stations(self.mesh).size),
        )
        return constants_of(
            MarchConstants,
            self,
            motion=MotionConstants(
                flanks=flanks,
                pinion=self.pinion.constants(self.support_damping_ratio, held),
                gear=self.gear.constants(self.support_damping_ratio, held),
            ),
            teeth=float(self.pair.pinion_teeth),
            friction_form=FRICTION_FORMS[self.friction],
            mu=self.friction_coefficient if constant else 0.0,
            refreshes=float(self.friction_updates_per_mesh_period),
            surface=gear_flanks(self.roughness_rms),
            solid=solid_parameters(self.solid, self.solid),
            oil=self.oil.parameters(),
            ranges=range_limits(self.ranges),
        )
