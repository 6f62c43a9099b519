"""From a gear file to the parameters of the pair's vibration."""

from __future__ import annotations

import math

from gearlube_core.dynamics.helical_pair.parameters import HelicalPairParameters
from gearlube_core.dynamics.helical_pair.shaft_support import Bearing, ShaftSupport
from gearlube_core.errors import ParameterError
from gearlube_core.helical_geometry.contact_line import line_count
from gearlube_core.helical_geometry.gear_body import SupportStiffness
from gearlube_core.helical_geometry.gear_file import HelicalGearFile, Role
from gearlube_core.helical_geometry.iso_6336_stiffness import iso_stiffness
from gearlube_core.helical_geometry.pair import HelicalPair
from gearlube_core.mesh_table.line_mesh import LineMesh, uniform_line_mesh

_RACK_DEDENDUM = 1.2  # h_fP/m_n, whose factor in C_B is one


def iso_density(pair: HelicalPair, pinion_torque: float) -> float:
    """Return the stiffness per length of contact line [N/m2] that ISO 6336-1 implies.

    k = c_gamma_alpha W/(L_mean cos(b)^2)

    Parameters
    ----------
    pair : HelicalPair
    pinion_torque : float
        [N.m]; below 100 N per mm of face width the teeth count as softer.

    Notes
    -----
    c_gamma_alpha is felt along the line of action, k normal to the flanks. With the basic rack's
    dedendum of 1.2 modules and solid discs; see `iso_stiffness` for the range of the fit.
    """
    load = pinion_torque / pair.pinion_base_radius / pair.face_width
    stiffness = iso_stiffness(pair, line_load=load, rack_dedendum=_RACK_DEDENDUM)
    normal = math.cos(pair.base_helix_angle) ** 2
    return stiffness.mesh * pair.face_width / (pair.mean_contact_length * normal)


def density_mesh(pair: HelicalPair, density: float, source: str) -> LineMesh:
    """Return one stiffness density [N/m2] along all contact lines: He et al. 2007 eq. (2)."""
    return uniform_line_mesh(
        name=f"{pair.name}, constant density",
        source=source,
        pinion_teeth=pair.pinion_teeth,
        gear_teeth=pair.gear_teeth,
        base_pitch=pair.base_pitch,
        lines=int(line_count(pair.plane)),
        density=density,
    )


def pair_parameters(
    file: HelicalGearFile, mesh: LineMesh, pinion_torque: float, mu: float = 0.0
) -> HelicalPairParameters:
    """Return the vibrating pair of a gear file.

    Parameters
    ----------
    file : HelicalGearFile
        With bearings and one damping ratio for translation and tilt.
    mesh : LineMesh
        Of the file's pair.
    pinion_torque : float
        [N.m]
    mu : float
        Constant coefficient of friction [-].

    Raises
    ------
    ParameterError
        The file lacks bearings, or its damping ratios of translation and tilt differ.
    """
    if file.damping.translation != file.damping.tilt:
        raise ParameterError(
            "damping.tilt must equal damping.translation, the model has one ratio for both; got "
            f"{file.damping.tilt:g} and {file.damping.translation:g}. Give one value."
        )
    pinion, gear = file.body("pinion"), file.body("gear")
    return HelicalPairParameters(
        pair=file.helical_pair(),
        mesh=mesh,
        pinion_torque=pinion_torque,
        pinion_mass=pinion.mass,
        pinion_inertia=pinion.diametral_inertia,
        pinion_polar_inertia=pinion.polar_inertia,
        gear_mass=gear.mass,
        gear_inertia=gear.diametral_inertia,
        gear_polar_inertia=gear.polar_inertia,
        pinion_support=_support("pinion", pinion.supports),
        gear_support=_support("gear", gear.supports),
        support_damping_ratio=file.damping.translation,
        mesh_damping_ratio=file.damping.mesh,
        friction="constant",
        friction_coefficient=mu,
    )


def _support(role: Role, springs: tuple[SupportStiffness, ...]) -> ShaftSupport:
    if len(springs) != 2:
        raise ParameterError(
            f"{role} must have two bearings to vibrate in, the gear file has {len(springs)}. Add "
            f"[{role}.bearing_1] and [{role}.bearing_2], or ask for --parts contact."
        )
    first, second = (
        Bearing(
            position=spring.position,
            K_xx=spring.K_xx,
            K_yy=spring.K_yy,
            K_zz=spring.K_zz,
            K_theta_x=spring.K_theta_x,
            K_theta_y=spring.K_theta_y,
            K_x_theta_y=spring.K_x_theta_y,
            K_y_theta_x=spring.K_y_theta_x,
        )
        for spring in springs
    )
    return ShaftSupport(first=first, second=second)
