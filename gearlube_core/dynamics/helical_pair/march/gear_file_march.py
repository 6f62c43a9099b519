"""The marching model of a gear file."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from gearlube_core.dynamics.helical_pair.gear_file_pair import (
    constant_density_mesh,
    gear_file_film_model,
    gear_file_oil,
    iso_mesh,
    named_oil,
)
from gearlube_core.dynamics.helical_pair.march.parameters import Body, HelicalMarchParameters
from gearlube_core.dynamics.helical_pair.supports import Bearing, ShaftSupport, replaced_bearing
from gearlube_core.errors import ParameterError
from gearlube_core.film_model.model import FilmModel
from gearlube_core.helical_geometry.gear_body import POSITION, STIFFNESS, SupportStiffness
from gearlube_core.helical_geometry.gear_file import HelicalGearFile, Role
from gearlube_core.mesh_table.line_mesh import LineMesh
from gearlube_core.number import Checked, Number
from gearlube_core.oil.lubricant import Lubricant

DENSITY_WITH_MESH_WORDS = "stiffness_density must be 0 with a line mesh"
_NO_BEARING = SupportStiffness(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
_ZERO = "0 takes the value of the gear file."
_STIFFNESS = STIFFNESS._replace(cure=_ZERO)
STIFFNESS_DENSITY = Number("N/m2", 0.0, 1e12, _ZERO)  # along contact lines


@dataclass(frozen=True, slots=True, kw_only=True)
class ReplacedBearings(Checked):
    """Bearing stiffnesses and distances used instead of those of the gear file, for both members.

    Parameters
    ----------
    radial_stiffness, axial_stiffness : float
        Stiffness of both bearings of a member together [N/m], 0 to 1e13; 0: those of the file.
    bearing_distance : float
        Distance from mid-face to each bearing [m], 0 to 10; 0: that of the file.

    Raises
    ------
    ParameterError
        A value is out of range.

    Examples
    --------
    >>> gear = HelicalGearFile.named("he_2007")
    >>> stiff = ReplacedBearings(axial_stiffness=1e9)
    >>> helical_march_parameters(gear, bearings=stiff).gear.support.second.K_zz  # N/m, half of it
    500000000.0
    """

    radial_stiffness: Annotated[float, _STIFFNESS] = 0.0
    axial_stiffness: Annotated[float, _STIFFNESS] = 0.0
    bearing_distance: Annotated[float, POSITION._replace(low=0.0, cure=_ZERO)] = 0.0


def helical_march_parameters(
    gear: HelicalGearFile,
    *,
    line_mesh: LineMesh | None = None,
    stiffness_density: float = 0.0,
    oil: str | Lubricant | None = None,
    bearings: ReplacedBearings | None = None,
    line_film_model: FilmModel | None = None,
) -> HelicalMarchParameters:
    """Return the parameters of `HelicalPairModel` from a gear file.

    Backlash and film model are those of the file. Other options of the model have the defaults of
    `HelicalMarchParameters`; change them with `replace`.

    Parameters
    ----------
    gear : HelicalGearFile
        Geometry, bodies and bearings.
    line_mesh : LineMesh, optional
        Stiffness along its contact lines; by default one constant stiffness density.
    stiffness_density : float
        This density [N/m2], 0 to 1e12; 0: that of ISO 6336-1. With a line mesh it must be 0.
    oil : str or Lubricant, optional
        Oil, or its name in the lubricant library; by default that of the file, see
        `gear_file_oil`.
    bearings : ReplacedBearings, optional
        Bearings used instead of those of the file.
    line_film_model : FilmModel, optional
        Of solved films of lines; by default the one that the file names.

    Raises
    ------
    FileError
        The file's film model is missing or damaged.
    ParameterError
        A value is out of range, the mesh is of another pair, or there are no bearings at all.

    Examples
    --------
    >>> from dataclasses import replace
    >>> gear = HelicalGearFile.named("he_2007")
    >>> parameters = helical_march_parameters(gear, bearings=ReplacedBearings(radial_stiffness=2e9))
    >>> dry = replace(parameters, friction="off", backlash=50e-6)
    >>> dry.pinion.support.first.K_xx  # N/m, half of both bearings together
    1000000000.0
    """
    STIFFNESS_DENSITY.check("stiffness_density", stiffness_density)
    instead = bearings or ReplacedBearings()
    pair = gear.helical_pair()
    if line_mesh is None:
        line_mesh = iso_mesh(pair)
        if stiffness_density > 0.0:
            line_mesh = constant_density_mesh(pair, stiffness_density, "given")
    elif stiffness_density > 0.0:
        raise ParameterError(
            f"{DENSITY_WITH_MESH_WORDS}, got {stiffness_density:g} N/m2. Choose one of them."
        )

    def body(role: Role) -> Body:
        given = gear.body(role)
        return Body(
            mass=given.mass,
            inertia=given.diametral_inertia,
            polar_inertia=given.polar_inertia,
            support=_support(gear, role, instead),
        )

    return HelicalMarchParameters(
        pair=pair,
        mesh=line_mesh,
        pinion=body("pinion"),
        gear=body("gear"),
        backlash=pair.backlash,
        film=gear.film.model,
        line_film_model=line_film_model or gear_file_film_model(gear),
        oil=gear_file_oil(gear) if oil is None else named_oil(oil),
    )


def _support(gear: HelicalGearFile, role: Role, instead: ReplacedBearings) -> ShaftSupport:
    """Return the file's bearings with what is not zero in their place."""
    radial, axial = instead.radial_stiffness, instead.axial_stiffness
    distance = instead.bearing_distance
    springs = gear.body(role).supports
    if not springs and 0.0 in (radial, axial, distance):
        raise ParameterError(
            f"the {role} must have bearings, but {role}.bearing_1 is missing in the gear file. Add "
            "them, or give radial and axial stiffness and the bearings' distance."
        )
    first, second = springs or 2 * (_NO_BEARING,)

    def bearing(spring: SupportStiffness, side: float) -> Bearing:
        taken = replaced_bearing(spring, side, float(radial), float(axial), float(distance))
        return Bearing(**taken._asdict())

    return ShaftSupport(first=bearing(first, 1.0), second=bearing(second, -1.0))
