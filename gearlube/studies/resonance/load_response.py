"""Response of the torsional pair over the pinion torque at one speed."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from gearlube.studies.resonance.settings import ResonanceSettings
from gearlube_core.dynamics.hypoid_torsional.load_problem import LoadProblem
from gearlube_core.dynamics.hypoid_torsional.model import HypoidTorsional
from gearlube_core.periodic import follow

FORMS = ("two_dof", "one_dof")
SPAN = (0.3, 2.0)  # of the pinion torque asked for
_STEPS = 256  # a mesh period

_UNITS = {
    "torque": ("N.m", "pinion torque"),
    "peak_to_peak": ("m", "transmission error, peak to peak"),
    "minimum": ("m", "least transmission error"),
    "separation_share": ("1", "time without contact"),
    "stable": ("1", "1 where the motion is stable"),
    "special_torque": ("N.m", "folds and bifurcations"),
}


def load_response(settings: ResonanceSettings, relative: float) -> xr.Dataset:
    """Return stable and unstable motions of the dry pair over the pinion torque.

    Parameters
    ----------
    settings : ResonanceSettings
    relative : float
        Mesh frequency over the natural frequency at the torque asked for [-]; the speed stays.

    Returns
    -------
    xarray.Dataset
        Each variable of dimensions (form, row), rows along the branch, padded with NaN.
    """
    rows: dict[str, list[Any]] = {name: [] for name in _UNITS}
    low, high = (factor * settings.pinion_torque for factor in SPAN)
    for form in FORMS:
        parameters = settings.parameters(form)
        model = HypoidTorsional(parameters)
        speed = model.pinion_speed(relative * model.natural_frequency)
        problem = LoadProblem(parameters, speed, steps_per_mesh_period=_STEPS)
        branch = follow(
            problem.equations(),
            problem.initial_guess(high),
            high,
            limits=(low, high),
            heading=-1.0,
        )
        orbits = [
            problem.orbit(z, torque)
            for z, torque in zip(branch.unknowns, branch.parameter, strict=True)
        ]
        rows["torque"].append(branch.parameter)
        rows["peak_to_peak"].append([np.ptp(orbit.x) for orbit in orbits])
        rows["minimum"].append([orbit.x.min() for orbit in orbits])
        rows["separation_share"].append([orbit.separation_share for orbit in orbits])
        rows["stable"].append(branch.stable.astype(float))
        rows["special_torque"].append([point.parameter for point in branch.special])
    length = max(len(values) for kept in rows.values() for values in kept)
    data = {
        name: (
            ("form", "row"),
            np.stack(
                [
                    np.pad(np.asarray(v, float), (0, length - len(v)), constant_values=np.nan)
                    for v in rows[name]
                ]
            ),
            {"units": unit, "long_name": text},
        )
        for name, (unit, text) in _UNITS.items()
    }
    return xr.Dataset(data, coords={"form": list(FORMS)}, attrs={"relative_frequency": relative})
