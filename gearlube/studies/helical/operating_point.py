"""Steady vibration at the operating point for chosen coefficients of friction; labels."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import xarray as xr

from gearlube.report.inputs import remark_attributes
from gearlube.report.page import command_line
from gearlube.studies.helical.settings import HARMONICS, HelicalSettings
from gearlube_core import __version__
from gearlube_core.dynamics.helical_pair.linear.linear_system import (
    RELATIVE,
    linear_system,
    mean_mesh_stiffness,
    natural_frequencies,
)
from gearlube_core.dynamics.helical_pair.linear.periodic_response import (
    COMPOSITES,
    harmonics,
    periodic_response,
    with_friction,
)
from gearlube_core.dynamics.helical_pair.parameters import HelicalPairParameters
from gearlube_core.dynamics.helical_pair.supports import BEARING_FORCES
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.units import labelled

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


def study_attributes(settings: HelicalSettings) -> dict[str, Any]:
    """Return the settings of a study in SI units, and the sources of the pair's data."""
    attributes: dict[str, Any] = {
        "name": settings.file.name,
        "source": settings.file.source,
        "command_line": command_line(),
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


def operating_point(
    parameters: HelicalPairParameters, pinion_speed: float, coefficients: Sequence[float]
) -> xr.Dataset:
    """Return histories over a mesh period, their harmonics and the loss.

    Parameters
    ----------
    parameters : HelicalPairParameters
        With `film`, the last case has the friction of the oil film.
    pinion_speed : float
        [rad/s]
    coefficients : sequence of float
        mu of each case [-].

    Returns
    -------
    xarray.Dataset
        Dimensions `case`, `phase`, `harmonic`; one variable per coordinate, composite, bearing
        force and moment, and more with the suffixes `_rate` and `_harmonic`.

    Raises
    ------
    ConvergenceError
        The pair is unstable at this speed.
    """
    cases = [
        periodic_response(with_friction(parameters, float(mu)), pinion_speed) for mu in coefficients
    ]
    labels, values_of_mu = [f"{mu:g}" for mu in coefficients], list(coefficients)
    if parameters.film is not None:
        cases.append(periodic_response(replace(parameters, friction="film"), pinion_speed))
        labels.append("film")
        values_of_mu.append(np.nan)
    variables: Variables = {}

    def add(name: str, values: Any, unit: str, words: str) -> None:
        values = np.array(values)
        variables[name] = (("case", "phase"), values, {"units": unit, "long_name": words})
        amplitude = np.array([harmonics(one, HARMONICS) for one in values])
        label = {"units": unit, "long_name": f"amplitude of a mesh order: {words}"}
        variables[f"{name}_harmonic"] = (("case", "harmonic"), amplitude, label)

    for names, unit in ((LENGTHS, "m"), (TILTS, "rad")):
        for name in names:
            words = description_of(name)
            add(name, [case.signal(name) for case in cases], unit, words)
            rate = [case.signal_rate(name) for case in cases]
            add(f"{name}_rate", rate, f"{unit}/s", f"rate of {words}")
    forces = np.array([case.bearing_force for case in cases])
    for names, unit in ((FORCES, "N"), (MOMENTS, "N.m")):
        for name in names:
            add(name, forces[:, :, BEARING_FORCES.index(name)], unit, description_of(name))
    for name, values, unit, words in (
        ("friction_power", [c.friction_power for c in cases], "W", "power that friction takes"),
        (
            "stability_margin",
            [1.0 - abs(c.multipliers[0]) for c in cases],
            "1",
            "one less the largest modulus of a Floquet multiplier",
        ),
    ):
        variables[name] = (("case",), np.array(values), {"units": unit, "long_name": words})
    variables["case_mu"] = (("case",), np.array(values_of_mu), MU_LABEL)
    frequencies = natural_frequencies(linear_system(parameters)) / (2.0 * np.pi)
    variables["natural_frequency"] = labelled(
        ("mode",), frequencies, "Hz", "natural frequency with the mean mesh, without damping"
    )
    dataset = xr.Dataset(
        variables,
        coords={
            "case": (
                "case",
                np.array(labels, dtype="U8"),
                {"units": "", "long_name": "constant coefficient of friction, or oil film"},
            ),
            "phase": ("phase", cases[0].phase, {"units": "1", "long_name": "mesh phase"}),
            "harmonic": ("harmonic", np.arange(1, HARMONICS + 1), HARMONIC_LABEL),
        },
    )
    dataset.attrs["mesh_frequency"] = parameters.pair.mesh_frequency(pinion_speed)
    dataset.attrs["mesh_frequency_units"] = "Hz"
    return dataset


MU_LABEL = {"units": "1", "long_name": "coefficient of friction"}
HARMONIC_LABEL = {"units": "1", "long_name": "mesh order"}
