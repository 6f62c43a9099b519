"""Steady vibration at the operating point for chosen coefficients of friction."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import xarray as xr

from gearlube.studies.helical.labels import (
    FORCES,
    LENGTHS,
    MOMENTS,
    TILTS,
    Variables,
    description_of,
)
from gearlube.studies.helical.settings import HARMONICS
from gearlube_core.dynamics.helical_pair.linear.linear_system import (
    linear_system,
    natural_frequencies,
)
from gearlube_core.dynamics.helical_pair.linear.periodic_response import (
    harmonics,
    periodic_response,
    with_friction,
)
from gearlube_core.dynamics.helical_pair.parameters import HelicalPairParameters
from gearlube_core.dynamics.helical_pair.supports import BEARING_FORCES


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
    variables["natural_frequency"] = (
        ("mode",),
        frequencies,
        {"units": "Hz", "long_name": "natural frequency with the mean mesh, without damping"},
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
