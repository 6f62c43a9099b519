"""Branches of motions with backlash and tooth separation over speed."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import xarray as xr

from gearlube.studies.helical.operating_point import Variables
from gearlube.studies.helical.stability import LIGHT_DAMPING
from gearlube_core.dynamics.helical_pair.linear.linear_system import RELATIVE
from gearlube_core.dynamics.helical_pair.linear.periodic_response import periodic_response
from gearlube_core.dynamics.helical_pair.parameters import HelicalPairParameters
from gearlube_core.dynamics.helical_pair.separation.problem import SeparationProblem
from gearlube_core.errors import ConvergenceError
from gearlube_core.periodic import Branch, follow
from gearlube_core.units import labelled

DIVISIONS = 2  # parts of a line that can lift off by themselves
RANGE = (0.3, 1.3)  # mesh frequency over that of the mesh's own mode
_SETTLING = 500  # mesh periods
_ROW = {
    "speed": ("rad/s", "pinion speed"),
    "relative_frequency": ("1", "mesh frequency over that of the mesh's own mode"),
    "peak_to_peak": ("m", "dynamic transmission error, peak to peak"),
    "separation_share": ("1", "share of the time without any contact"),
    "lift_off_share": ("1", "share of the time in which part of the lines is off"),
    "segment": ("1", "0 from the lowest speed, 1 from the highest where 0 does not reach it"),
    "stable": ("1", "1 stable, 0 unstable, NaN no row"),
}


def separation_dataset(
    parameters: HelicalPairParameters,
    speeds: int,
    observe: Callable[[float], None] = lambda share: None,
) -> xr.Dataset:
    """Return branches of periodic motions with one-sided contact, and linear ones to compare.

    Parameters
    ----------
    parameters : HelicalPairParameters
        With constant friction; their contact is replaced by flanks that separate.
    speeds : int
        Rows asked for; a branch adds its own between them.
    observe : callable
        Called with the share that is done [-].

    Returns
    -------
    xarray.Dataset
        Dimensions `damping` (the pair's ratio, and `LIGHT_DAMPING` where that is lower), `row`
        along the branch, padded with NaN, `linear_speed`, `special`.
    """
    ratios = [parameters.mesh_damping_ratio]
    if ratios[0] > LIGHT_DAMPING:
        ratios.append(LIGHT_DAMPING)
    found: list[dict[str, Any]] = []
    for ratio in ratios:

        def report_share(share: float) -> None:
            observe((len(found) + share) / len(ratios))

        damped = replace(parameters, mesh_damping_ratio=ratio, support_damping_ratio=ratio)
        found.append(_branch(damped, speeds, report_share))
    length = max(one["speed"].size for one in found)
    specials = max(len(one["special"]) for one in found)
    variables: Variables = {
        name: labelled(
            ("damping", "row"), np.stack([_padded(one[name], length) for one in found]), unit, words
        )
        for name, (unit, words) in _ROW.items()
    }
    variables["linear_peak_to_peak"] = (
        ("damping", "linear_speed"),
        np.stack([one["linear"] for one in found]),
        {"units": "m", "long_name": "transmission error with springs that also pull"},
    )
    for name, at, unit, words in (
        ("special_speed", 1, "rad/s", "speed of a fold or bifurcation"),
        ("special_peak_to_peak", 2, "m", "transmission error there, peak to peak"),
    ):
        values = [_padded(np.array([s[at] for s in one["special"]]), specials) for one in found]
        variables[name] = labelled(("damping", "special"), np.stack(values), unit, words)
    kinds = [[s[0] for s in one["special"]] for one in found]
    variables["special_kind"] = (
        ("damping", "special"),
        np.array([row + [""] * (specials - len(row)) for row in kinds], dtype="U24").reshape(
            len(found), specials
        ),
        {"units": "", "long_name": "what it is"},
    )
    dataset = xr.Dataset(
        variables,
        coords={
            "damping": labelled(
                "damping", np.array(ratios), "1", "damping ratio of mesh and supports"
            ),
            "linear_speed": labelled(
                "linear_speed", found[0]["linear_speed"], "rad/s", "pinion speed"
            ),
        },
    )
    problem = found[0]["problem"]
    dataset.attrs |= {
        "mu": parameters.mu,
        "line_divisions": DIVISIONS,
        "endings": ", ".join(one["ending"] for one in found),
        "natural_frequency": problem.natural_frequency,
        "natural_frequency_units": "Hz",
        "natural_speed": problem.natural_speed,
        "natural_speed_units": "rad/s",
        "backlash": parameters.pair.backlash,
        "backlash_units": "m",
    }
    return dataset


def _branch(
    linear: HelicalPairParameters, speeds: int, report_share: Callable[[float], None]
) -> dict[str, Any]:
    problem = SeparationProblem(replace(linear, contact="one_sided", line_divisions=DIVISIONS))
    low, high = (share * problem.natural_speed for share in RANGE)
    asked = np.linspace(low, high, speeds)

    def along(speed: float, heading: float) -> Branch:
        def walk(start: np.ndarray) -> Branch:
            return follow(
                problem.over_speed(),
                start,
                speed,
                limits=(low, high),
                heading=heading,
                at=asked,
                progress=lambda _, now: report_share(min(abs(now - speed) / (high - low), 1.0)),
            )

        start = _start(problem, linear, speed)
        try:
            found = walk(start)
        except ConvergenceError:  # impacts already there: let them settle
            found = walk(problem.march(start, speed, periods=_SETTLING))
        if found.ending == "interrupted":
            raise KeyboardInterrupt
        return found

    branches = [along(low, 1.0)]
    if branches[0].parameter[-1] < high:
        branches.append(along(high, -1.0))
    parameter = np.concatenate([branch.parameter for branch in branches])
    unknowns = np.concatenate([branch.unknowns for branch in branches])
    sizes = [branch.parameter.size for branch in branches]
    orbits = [problem.orbit(z, float(speed)) for z, speed in zip(unknowns, parameter, strict=True)]
    free = [periodic_response(linear, float(speed), throw=False) for speed in asked]
    return {
        "problem": problem,
        "ending": " and ".join(branch.ending for branch in branches),
        "speed": parameter,
        "relative_frequency": parameter / problem.natural_speed,
        "peak_to_peak": np.array([orbit.peak_to_peak for orbit in orbits]),
        "separation_share": np.array([orbit.separation_share for orbit in orbits]),
        "lift_off_share": np.array([orbit.lift_off_share for orbit in orbits]),
        "stable": np.concatenate([branch.stable for branch in branches]).astype(float),
        "segment": np.repeat(np.arange(len(branches)), sizes).astype(float),
        "linear_speed": asked,
        "linear": np.array([np.ptp(response.signal("delta_z")) for response in free]),
        "special": [
            (
                point.kind,
                point.parameter,
                problem.orbit(point.unknowns, point.parameter).peak_to_peak,
            )
            for branch in branches
            for point in branch.special
        ],
    }


def _start(problem: SeparationProblem, linear: HelicalPairParameters, speed: float) -> np.ndarray:
    """Return the state at mesh phase zero of the motion whose mesh springs also pull."""
    response = periodic_response(linear, speed, throw=False)
    places = [RELATIVE.index(name) for name in problem.names]
    return np.concatenate((response.displacement[0, places], response.rate[0, places]))


def _padded(values: np.ndarray, length: int) -> np.ndarray:
    return np.pad(values.astype(float), (0, length - values.size), constant_values=np.nan)
