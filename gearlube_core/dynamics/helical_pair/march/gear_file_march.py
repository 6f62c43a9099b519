"""The marching model of a gear file."""

from __future__ import annotations

from dataclasses import replace

from gearlube_core.checks import check_within
from gearlube_core.dynamics.helical_pair.gear_file_pair import (
    constant_density_mesh,
    gear_file_support,
    iso_mesh,
)
from gearlube_core.dynamics.helical_pair.march.parameters import (
    Body,
    Equations,
    Form,
    Friction,
    HelicalMarchParameters,
)
from gearlube_core.dynamics.helical_pair.supports.shaft_support import (
    Bearing,
    ShaftSupport,
    symmetric_support,
)
from gearlube_core.errors import ParameterError
from gearlube_core.helical_geometry.gear_file import HelicalGearFile, Role
from gearlube_core.mesh_table.line_mesh import LineMesh
from gearlube_core.oil.lubricant import Lubricant


def helical_march(
    gear: HelicalGearFile,
    *,
    line_mesh: LineMesh | None = None,
    stiffness_density: float = 0.0,
    backlash: float | None = None,
    friction: Friction = "film",
    friction_coefficient: float = 0.05,
    oil: str = "mohammadpour_2015",
    roughness_rms: float = 0.5e-6,
    mesh_damping_ratio: float = 0.05,
    support_damping_ratio: float = 0.05,
    radial_stiffness: float = 0.0,
    axial_stiffness: float = 0.0,
    bearing_distance: float = 0.0,
    form: Form = "twelve_dof",
    equations: Equations = "consistent",
    steps_per_mesh_period: int = 64,
    steps_per_highest_period: int = 8,
    friction_updates_per_mesh_period: int = 16,
) -> HelicalMarchParameters:
    """Return the marching model of a gear file.

    Parameters
    ----------
    gear : HelicalGearFile
        Geometry, bodies and bearings.
    line_mesh : LineMesh, optional
        Stiffness along its contact lines; by default one density.
    stiffness_density : float
        That density [N/m2]; 0: that of ISO 6336-1. With a line mesh it must be 0.
    backlash : float, optional
        Normal [m]; by default that of the file.
    oil : str
        Name in the lubricant library.
    radial_stiffness, axial_stiffness : float
        Of both bearings of a member together [N/m]; 0: those of the file.
    bearing_distance : float
        From mid-face to each bearing [m]; 0: that of the file.

    See `HelicalMarchParameters` for the other parameters.

    Raises
    ------
    ParameterError
        A value out of range, a mesh of another pair, or no bearings anywhere.
    """
    for name, value, high, unit in (
        ("stiffness_density", stiffness_density, 1e12, "N/m2"),
        ("radial_stiffness", radial_stiffness, 1e12, "N/m"),
        ("axial_stiffness", axial_stiffness, 1e12, "N/m"),
        ("bearing_distance", bearing_distance, 10.0, "m"),
    ):
        check_within(name, value, 0.0, high, unit, "0 takes the value of the gear file.")
    pair = gear.helical_pair()
    if line_mesh is None:
        line_mesh = iso_mesh(pair)
        if stiffness_density > 0.0:
            line_mesh = constant_density_mesh(pair, stiffness_density, "given")
    elif stiffness_density > 0.0:
        raise ParameterError(
            f"stiffness_density must be 0 with a line mesh, got {stiffness_density:g} N/m2. "
            "Choose one of them."
        )

    def body(role: Role) -> Body:
        given = gear.body(role)
        return Body(
            mass=given.mass,
            inertia=given.diametral_inertia,
            polar_inertia=given.polar_inertia,
            support=_support(gear, role, radial_stiffness, axial_stiffness, bearing_distance),
        )

    return HelicalMarchParameters(
        pair=pair,
        mesh=line_mesh,
        pinion=body("pinion"),
        gear=body("gear"),
        backlash=pair.backlash if backlash is None else backlash,
        friction=friction,
        friction_coefficient=friction_coefficient,
        oil=Lubricant.named(oil),
        roughness_rms=roughness_rms,
        mesh_damping_ratio=mesh_damping_ratio,
        support_damping_ratio=support_damping_ratio,
        form=form,
        equations=equations,
        steps_per_mesh_period=steps_per_mesh_period,
        steps_per_highest_period=steps_per_highest_period,
        friction_updates_per_mesh_period=friction_updates_per_mesh_period,
    )


def _support(
    gear: HelicalGearFile, role: Role, radial: float, axial: float, distance: float
) -> ShaftSupport:
    """Return the file's bearings with what is not zero in their place."""
    if not gear.body(role).supports:
        if 0.0 in (radial, axial, distance):
            raise ParameterError(
                f"the {role} must have bearings, the gear file {role}.bearing_1 is missing. "
                "Add them, or give radial and axial stiffness and the bearings' distance."
            )
        return symmetric_support(K_xx=radial, K_yy=radial, K_zz=axial, distance=distance)

    def changed(bearing: Bearing, side: float) -> Bearing:
        if radial > 0.0:
            bearing = replace(bearing, K_xx=0.5 * radial, K_yy=0.5 * radial)
        if axial > 0.0:
            bearing = replace(bearing, K_zz=0.5 * axial)
        return replace(bearing, position=side * distance) if distance > 0.0 else bearing

    of_file = gear_file_support(gear, role)
    return ShaftSupport(first=changed(of_file.first, 1.0), second=changed(of_file.second, -1.0))
