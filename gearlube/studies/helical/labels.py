"""Names, units and attributes shared by the datasets of a study."""

from __future__ import annotations

from typing import Any

from gearlube.report.inputs import remark_attributes
from gearlube.studies.helical.settings import HelicalSettings
from gearlube_core import __version__
from gearlube_core.dynamics.helical_pair.linear.linear_system import RELATIVE, mean_mesh_stiffness
from gearlube_core.dynamics.helical_pair.linear.periodic_response import COMPOSITES
from gearlube_core.dynamics.helical_pair.parameters import HelicalPairParameters
from gearlube_core.dynamics.helical_pair.supports import BEARING_FORCES
from gearlube_core.helical_geometry.gear_file import HelicalGearFile

Variables = dict[str, tuple[tuple[str, ...], Any, dict[str, str]]]

TRANSLATIONS = tuple(name for name in RELATIVE if name.startswith("u_"))
TILTS = tuple(name for name in RELATIVE if name.startswith("th_"))
LENGTHS = (*TRANSLATIONS, "psi", *COMPOSITES)
FORCES = tuple(name for name in BEARING_FORCES if name.startswith("F"))
MOMENTS = tuple(name for name in BEARING_FORCES if name.startswith("M"))

_AXES = {"x": "along the line of action", "y": "off the line of action", "z": "axial"}
_COMPOSITE_WORDS = {
    "psi": "r_bp th_zp + r_bg th_zg",
    "delta_x": "r_bp th_xp + r_bg th_xg + u_zp - u_zg",
    "delta_y": "r_bp th_yp + r_bg th_yg + u_zp - u_zg",
    "delta_z": "r_bp th_zp + r_bg th_zg - u_xp + u_xg, dynamic transmission error",
}


def description_of(name: str) -> str:
    """Return a description of a coordinate, composite displacement or bearing force.

    >>> description_of("u_xp")
    'displacement of the pinion along the line of action'
    """
    if name in _COMPOSITE_WORDS:
        return _COMPOSITE_WORDS[name]
    kind, axis, member = name.split("_")[0], name[-2], "pinion" if name[-1] == "p" else "gear"
    if kind == "u":
        return f"displacement of the {member} {_AXES[axis]}"
    if kind == "th":
        return f"tilt of the {member} about {axis}"
    if kind == "F":
        return f"force of the bearings on the {member} {_AXES[axis]}"
    return f"moment of the bearings on the {member} about {axis}"


def study_attributes(settings: HelicalSettings, command_line: str) -> dict[str, Any]:
    """Return the settings of a study in SI units, and the sources of the pair's data."""
    attributes: dict[str, Any] = {
        "name": settings.file.name,
        "source": settings.file.source,
        "command_line": command_line,
        "gearlube_version": __version__,
        "pinion_torque": settings.pinion_torque,
        "pinion_torque_units": "N.m",
        "pinion_speed": settings.pinion_speed,
        "pinion_speed_units": "rad/s",
        "mesh": settings.mesh,
        "friction": settings.friction,
    }
    return attributes | remark_attributes(settings.file) | _provenance(settings.file)


def _provenance(file: HelicalGearFile) -> dict[str, str]:
    """Return a sentence for each field that the source only implies or does not give."""
    return {
        f"{origin}_fields": " ".join(f"{field}: {why}" for field, why in found.items())
        for origin, found in (("inferred", file.inferred), ("completed", file.completed))
        if found
    }


def pair_attributes(parameters: HelicalPairParameters) -> dict[str, Any]:
    """Return the parameters that determine the pair's vibration, in SI units."""
    return {
        "pinion_teeth": parameters.pair.pinion_teeth,
        "gear_teeth": parameters.pair.gear_teeth,
        "total_contact_ratio": parameters.pair.total_contact_ratio,
        "mesh_name": parameters.mesh.name,
        "mesh_source": parameters.mesh.source,
        "mean_mesh_stiffness": mean_mesh_stiffness(parameters),
        "mean_mesh_stiffness_units": "N/m",
        "effective_mass": parameters.effective_mass,
        "effective_mass_units": "kg",
        "mesh_damping_ratio": parameters.mesh_damping_ratio,
        "support_damping_ratio": parameters.support_damping_ratio,
    }
