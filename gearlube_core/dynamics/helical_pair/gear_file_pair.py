"""From a gear file to the parameters of the pair's vibration."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from gearlube_core.dynamics.helical_pair.parameters import HelicalPairParameters
from gearlube_core.dynamics.helical_pair.supports import Bearing, ShaftSupport
from gearlube_core.errors import ParameterError
from gearlube_core.film_model.chosen_model import chosen_model
from gearlube_core.film_model.model import LINE, FilmModel
from gearlube_core.helical_geometry.contact_line import line_count
from gearlube_core.helical_geometry.gear_file import HelicalGearFile, Role
from gearlube_core.helical_geometry.iso_6336_stiffness import iso_line_density, tangential_line_load
from gearlube_core.helical_geometry.pair import HelicalPair
from gearlube_core.mesh_table.line_mesh import LineMesh, uniform_line_mesh
from gearlube_core.oil.lubricant import Lubricant
from gearlube_core.oil.oil_file import read_oil_file
from gearlube_core.units import celsius_to_kelvin

USUAL_OIL = "mohammadpour_2015"  # of the library, where a gear file names none
_ALIKE = 0.1  # relative, of the viscosities of one oil in two places
_APART = 20.0  # K, between the two points of a viscosity line
_NEWTONIAN = 1e9  # Pa, Eyring stress that no film reaches


def gear_file_support(file: HelicalGearFile, role: Role) -> ShaftSupport:
    """Return the bearings of the "pinion" or the "gear" on a rigid shaft.

    Raises
    ------
    ParameterError
        The file has no bearings.
    """
    springs = file.body(role).supports
    if len(springs) != 2:
        raise ParameterError(
            f"{role} must have two bearings, but the gear file has {len(springs)}. Both members "
            f"need them to vibrate: add [{role}.bearing_1] and [{role}.bearing_2], each with "
            "distance_mm, stiffness_x_n_per_um, stiffness_y_n_per_um and stiffness_z_n_per_um."
        )
    first, second = (Bearing(**spring._asdict()) for spring in springs)
    return ShaftSupport(first=first, second=second)


def gear_file_oil(file: HelicalGearFile) -> Lubricant:
    """Return the oil of a gear file's friction: of its oil file, of [oil], or `USUAL_OIL`.

    Raises
    ------
    ParameterError
        The oil file is missing or wrong, or says another viscosity than [oil].
    """
    named = file.film.oil_file
    if named is None:
        return stated_oil(file) or Lubricant.named(USUAL_OIL)
    oil = read_oil_file(Path(named)).lubricant
    own = file.oil
    if own is not None:
        degc, eta0 = own.viscosity_temperature_degc, own.viscosity_pa_s
        found = oil.dynamic_viscosity(celsius_to_kelvin(degc))
        if abs(found / eta0 - 1.0) > _ALIKE:
            raise ParameterError(
                f"The gear file must name one oil, got two: film.oil_file {named} has {found:.4g} "
                f"Pa s at {degc:g} degC, [oil] has viscosity_pa_s = {eta0:g} there. Leave one out, "
                f"or make them agree within {100.0 * _ALIKE:g} %."
            )
    return oil


def stated_oil(file: HelicalGearFile) -> Lubricant | None:
    """Return the oil that the section [oil] of a gear file states; None without it.

    Viscosity at one temperature, pressure coefficient and Eyring stress are the section's; the
    slope of the viscosity and all else are those of `USUAL_OIL`.
    """
    own = file.oil
    if own is None:
        return None
    usual, at = Lubricant.named(USUAL_OIL), celsius_to_kelvin(own.viscosity_temperature_degc)
    ends = at, at + _APART
    by = own.viscosity_pa_s / usual.dynamic_viscosity(at)
    nu = [by * usual.dynamic_viscosity(end) / usual.density for end in ends]
    oil = usual.with_two_viscosities(nu[0], ends[0], nu[1], ends[1], name=f"[oil] of {file.name}")
    stress = own.eyring_stress_mpa
    return replace(
        oil,
        source=file.source,
        alpha=1e-9 * own.pressure_viscosity_per_gpa,
        alpha_temperature=at,
        eyring_stress=_NEWTONIAN if stress is None else 1e6 * stress,
    )


def named_oil(oil: str | Lubricant) -> Lubricant:
    """Return an oil of the library by its name, or the oil itself."""
    return Lubricant.named(oil) if isinstance(oil, str) else oil


def gear_file_film_model(file: HelicalGearFile) -> FilmModel | None:
    """Return the film model of lines that a gear file names; None: the one in the package.

    Raises
    ------
    FileError, ParameterError
        It is missing, damaged or of another kind.
    """
    named = file.film.line_model
    return None if named is None else chosen_model(named, LINE, "film.line_model")


def helical_pair_parameters(
    file: HelicalGearFile,
    *,
    pinion_torque: float,
    mu: float = 0.0,
    mesh: LineMesh | None = None,
    pair: HelicalPair | None = None,
) -> HelicalPairParameters:
    """Return the parameters of a helical pair from its gear file, for `periodic_response`.

    The contact of the teeth is linear.

    Parameters
    ----------
    file
        Gear file with bearings, and with one damping ratio for translation and tilt.
    pinion_torque
        Torque on the pinion [N.m].
    mu
        Constant coefficient of friction [-].
    mesh
        Contact lines of the pair with their stiffness; by default that of ISO 6336-1 at the
        torque, see `iso_mesh`.
    pair
        Another geometry, to be used with the same bodies and bearings.

    Raises
    ------
    ParameterError
        The file lacks bearings, or its damping ratios of translation and tilt differ.

    Examples
    --------
    >>> file = HelicalGearFile.named("he_2007")
    >>> parameters = helical_pair_parameters(file, pinion_torque=200.0, mu=0.05)
    >>> round(parameters.pinion_mass, 2)  # kg
    2.21
    """
    if file.damping.translation != file.damping.tilt:
        raise ParameterError(
            "damping.tilt must equal damping.translation, because the model has one ratio for "
            f"both; got {file.damping.tilt:g} and {file.damping.translation:g}. Give one value."
        )
    pinion, gear = file.body("pinion"), file.body("gear")
    geometry = file.helical_pair() if pair is None else pair
    return HelicalPairParameters(
        pair=geometry,
        mesh=iso_mesh(geometry, pinion_torque) if mesh is None else mesh,
        pinion_torque=pinion_torque,
        pinion_mass=pinion.mass,
        pinion_inertia=pinion.diametral_inertia,
        pinion_polar_inertia=pinion.polar_inertia,
        gear_mass=gear.mass,
        gear_inertia=gear.diametral_inertia,
        gear_polar_inertia=gear.polar_inertia,
        pinion_support=gear_file_support(file, "pinion"),
        gear_support=gear_file_support(file, "gear"),
        support_damping_ratio=file.damping.translation,
        mesh_damping_ratio=file.damping.mesh,
        friction="constant",
        friction_coefficient=mu,
    )


def constant_density_mesh(pair: HelicalPair, density: float, source: str) -> LineMesh:
    """Return one stiffness density [N/m2] along all contact lines: [he_2007 (2)]."""
    return uniform_line_mesh(
        name=f"{pair.name}, constant density",
        source=source,
        pinion_teeth=pair.pinion_teeth,
        gear_teeth=pair.gear_teeth,
        base_pitch=pair.base_pitch,
        lines=int(line_count(pair.plane)),
        density=density,
    )


def iso_mesh(pair: HelicalPair, pinion_torque: float | None = None) -> LineMesh:
    """Return contact lines of the density of ISO 6336-1, see `iso_line_density`.

    Parameters
    ----------
    pair
        Pair of two external gears.
    pinion_torque
        [N.m]; None: one at which the standard's density does not depend on it.
    """
    if pinion_torque is None:
        density = iso_line_density(pair)
    else:
        density = iso_line_density(pair, tangential_line_load(pair, pinion_torque))
    return constant_density_mesh(pair, density, "ISO 6336-1 and He et al. 2007 eq. (2)")
