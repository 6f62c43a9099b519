"""Checked parameters of the helical pair."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Literal

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_within
from gearlube_core.dynamics.helical_pair.kernel_parameters import (
    COORDINATES,
    SIX_DOF,
    MeshArrays,
    PairConstants,
    SupportArrays,
)
from gearlube_core.dynamics.helical_pair.mesh.film_friction import FilmFriction
from gearlube_core.dynamics.helical_pair.supports import (
    ShaftSupport,
    printed_support_stiffness,
    support_damping,
    support_stiffness,
)
from gearlube_core.errors import ParameterError
from gearlube_core.helical_geometry.contact_line import line_count
from gearlube_core.helical_geometry.gear_body import DAMPING_RATIO
from gearlube_core.helical_geometry.pair import HelicalPair
from gearlube_core.mesh_table.line_mesh import LineMesh
from gearlube_core.number import Number, Positive, check_fields

_SAME = 1e-6  # of the base pitch
Form = Literal["twelve_dof", "six_dof"]
Contact = Literal["linear", "one_sided"]
Friction = Literal["off", "constant", "film"]
BearingMoments = Literal["consistent", "as_printed"]
SupportDamping = Literal["total", "as_printed"]
MeshSign = Literal["compression", "as_printed"]
_MOST_LINES = 100
FRICTION = Number("1", 0.0, 1.0)


def pack_lines(mesh: LineMesh, torque: float, divisions: int) -> MeshArrays:
    """Return density and offset at a pinion torque [N.m], stations spanning each whole line.

    Linear between torque levels; a mesh with one level serves all. Stations 0, 1 and those that cut
    the line into `divisions` equal parts are added: separation is resolved to a quadrature point.

    Raises
    ------
    ParameterError
        The torque lies outside the mesh's levels.
    """
    if mesh.torque.size > 1:
        low, high = float(mesh.torque[0]), float(mesh.torque[-1])
        check_within("pinion_torque", torque, low, high, "N.m", "The line mesh holds no other.")
    grid = np.linspace(0.0, 1.0, divisions + 1)
    station = np.unique(np.concatenate((grid, mesh.station if mesh.station.size > 1 else [])))

    def at_torque(values: Array) -> Array:
        flat = values.reshape(mesh.torque.size, -1)
        rows = np.array([np.interp(torque, mesh.torque, column) for column in flat.T])
        lines = rows.reshape(-1, mesh.station.size)
        packed = np.array([np.interp(station, mesh.station, line) for line in lines])
        return np.ascontiguousarray(packed.reshape(mesh.phase.size, mesh.lines, station.size))

    return MeshArrays(at_torque(mesh.density), at_torque(mesh.offset), station)


def check_line_mesh(mesh: LineMesh, pair: HelicalPair, most_lines: int) -> None:
    """Raise ParameterError unless the mesh is one of the pair with enough lines, not too many."""
    if (mesh.pinion_teeth, mesh.gear_teeth) != (pair.pinion_teeth, pair.gear_teeth):
        raise ParameterError(
            f"mesh must belong to the pair of {pair.pinion_teeth} and {pair.gear_teeth} "
            f"teeth, got {mesh.pinion_teeth} and {mesh.gear_teeth}. Compute it for this pair."
        )
    close = pair.base_pitch * (1.0 - _SAME), pair.base_pitch * (1.0 + _SAME)
    check_within("mesh.base_pitch", mesh.base_pitch, *close, "m", "Compute it for this pair.")
    check_within("mesh.lines", mesh.lines, line_count(pair.plane), most_lines, "", "Add lines.")


def effective_mass(pair: HelicalPair, pinion_inertia: float, gear_inertia: float) -> float:
    """Return m_e of the relative rotation along the line of action [kg].

    1/m_e = r_bp^2/J_zp + r_bg^2/J_zg

    Parameters
    ----------
    pair
        Pair that gives the base radii.
    pinion_inertia, gear_inertia
        Polar [kg m2].
    """
    r_bp, r_bg = pair.pinion_base_radius, pair.gear_base_radius
    return 1.0 / (r_bp**2 / pinion_inertia + r_bg**2 / gear_inertia)


@dataclass(frozen=True, slots=True, kw_only=True)
class HelicalPairParameters:
    """Everything that defines one pair at a mean torque.

    Parameters
    ----------
    pair : HelicalPair
        Macro geometry, backlash included.
    mesh : LineMesh
        Stiffness density and offset along the contact lines, read at `pinion_torque`.
    pinion_torque : float
        Mean driving torque [N.m]; the gear's is r_bg/r_bp times as large.
    pinion_mass, gear_mass : float
        [kg]
    pinion_inertia, gear_inertia : float
        About a diameter [kg m2].
    pinion_polar_inertia, gear_polar_inertia : float
        About the axis [kg m2].
    pinion_support, gear_support : ShaftSupport
    support_damping_ratio, mesh_damping_ratio : float
        zeta [-].
    friction : {"off", "constant", "film"}
        None; Coulomb with one coefficient; mixed friction of the oil film at each point.
    friction_coefficient : float
        mu of "constant" [-].
    film : FilmFriction, optional
        Oil and surfaces of "film".
    form : {"twelve_dof", "six_dof"}
        Six keeps u_x, u_y and th_z of both members and holds the rest.
    contact : {"linear", "one_sided"}
        Springs that also pull, as in the paper; or flanks that separate, with backlash.
    line_divisions : int
        Parts of a line, each with two quadrature points; one is exact for linear contact.
    bearing_moments, support_damping, mesh_sign
        The paper's equations where they run as printed: `printed_support_stiffness`,
        `supports.support_damping` per bearing, and the sign of [he_2007 (4)], which is
        unstable.

    References
    ----------
    [he_2007]
    """

    pair: HelicalPair
    mesh: LineMesh
    pinion_torque: Annotated[float, Positive("N.m")]
    pinion_mass: Annotated[float, Positive("kg")]
    pinion_inertia: Annotated[float, Positive("kg m2")]
    pinion_polar_inertia: Annotated[float, Positive("kg m2")]
    gear_mass: Annotated[float, Positive("kg")]
    gear_inertia: Annotated[float, Positive("kg m2")]
    gear_polar_inertia: Annotated[float, Positive("kg m2")]
    pinion_support: ShaftSupport
    gear_support: ShaftSupport
    support_damping_ratio: Annotated[float, DAMPING_RATIO]
    mesh_damping_ratio: Annotated[float, DAMPING_RATIO]
    friction: Friction
    friction_coefficient: Annotated[float, FRICTION]
    film: FilmFriction | None = None
    form: Form = "twelve_dof"
    contact: Contact = "linear"
    line_divisions: Annotated[int, Number("1", 1, 64)] = 1
    bearing_moments: BearingMoments = "consistent"
    support_damping: SupportDamping = "total"
    mesh_sign: MeshSign = "compression"

    def __post_init__(self) -> None:
        check_fields(self)
        if self.friction == "film" and self.film is None:
            raise ParameterError(
                'film must be given with friction "film", got None. Give a FilmFriction.'
            )
        check_line_mesh(self.mesh, self.pair, _MOST_LINES)
        pack_lines(self.mesh, self.pinion_torque, 1)

    @property
    def mu(self) -> float:
        """Constant coefficient of friction [-]; zero with other friction."""
        return self.friction_coefficient if self.friction == "constant" else 0.0

    @property
    def gear_torque(self) -> float:
        """Mean load torque [N.m]: T_p r_bg/r_bp."""
        return self.pinion_torque * self.pair.gear_base_radius / self.pair.pinion_base_radius

    @property
    def effective_mass(self) -> float:
        """m_e of the relative rotation along the line of action [kg]."""
        return effective_mass(self.pair, self.pinion_polar_inertia, self.gear_polar_inertia)

    def kernel_parameters(self) -> PairConstants:
        """Return the arguments that the kernels take by value."""
        return PairConstants(
            plane=self.pair.plane,
            m_p=self.pinion_mass,
            J_p=self.pinion_inertia,
            J_zp=self.pinion_polar_inertia,
            m_g=self.gear_mass,
            J_g=self.gear_inertia,
            J_zg=self.gear_polar_inertia,
            m_e=self.effective_mass,
            zeta_mesh=self.mesh_damping_ratio,
            T_p=self.pinion_torque,
            T_g=self.gear_torque,
            backlash=self.pair.backlash,
            one_sided=float(self.contact == "one_sided"),
            mesh_sign=1.0 if self.mesh_sign == "compression" else -1.0,
        )

    def mesh_arrays(self) -> MeshArrays:
        """Return the contact lines at the mean torque."""
        return pack_lines(self.mesh, self.pinion_torque, self.line_divisions)

    def support_arrays(self) -> SupportArrays:
        """Return the supports' matrices and which coordinates move."""
        printed = self.bearing_moments == "as_printed"
        stiffness = printed_support_stiffness if printed else support_stiffness
        per_bearing = self.support_damping == "as_printed"
        members = (
            (self.pinion_support, self.pinion_mass, self.pinion_inertia),
            (self.gear_support, self.gear_mass, self.gear_inertia),
        )
        held = self.form == "six_dof"
        return SupportArrays(
            stiffness=np.array([stiffness(support) for support, _, _ in members]),
            damping=np.array(
                [
                    support_damping(support, mass, inertia, self.support_damping_ratio, per_bearing)
                    for support, mass, inertia in members
                ]
            ),
            free=np.array([float(not held or name in SIX_DOF) for name in COORDINATES]),
        )
