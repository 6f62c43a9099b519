"""Whine of an axle over a run-up, and how torques and oil change it: the gradient by casadi.

casadi integrates the equations of HypoidAxle.fmu, and differentiates along the run by the FMU's
directional derivatives, which are exact. Differences of two runs depend on their step. Takes the
path of a HypoidAxle.fmu of FMI 2.0; by default one of the paper's axle is built.
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path
from typing import Any

import casadi
import numpy as np
from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Model

import gearlube as gl

INPUTS = {"pinion.torque": 90.0, "wheel.torque": 160.0, "oil.temperature": 333.15}  # N.m, N.m, K
VIBRATION = "pinion.velocity.x"  # its rate is the acceleration of the pinion across its axis
STEP, STEPS = 1e-5, 3000  # s
SHARE = 1e-6  # of an input, in differences


def states_at_start(folder: str, names: list[str]) -> list[float]:
    """Return the states of the FMU after the start with INPUTS."""
    description = read_model_description(folder)
    references = {v.name: v.valueReference for v in description.modelVariables}
    fmu = FMU2Model(
        guid=description.guid,
        unzipDirectory=folder,
        modelIdentifier=description.modelExchange.modelIdentifier,
        instanceName="start",
    )
    fmu.instantiate()
    fmu.setupExperiment()
    fmu.enterInitializationMode()
    fmu.setReal([references[name] for name in INPUTS], list(INPUTS.values()))
    fmu.exitInitializationMode()
    return fmu.getReal([references[name] for name in names])  # type: ignore[no-any-return]


def run_up(folder: str) -> Any:
    """Return the casadi function from inputs to the acceleration, by RK4 steps."""
    axle = casadi.DaeBuilder("axle", folder, {})
    names = axle.x()
    rates = axle.create("rates", ["x", "u"], ["ode"])
    x, u = casadi.MX.sym("x", len(names)), casadi.MX.sym("u", len(axle.u()))
    k1 = rates(x, u)
    k2 = rates(x + 0.5 * STEP * k1, u)
    k3 = rates(x + 0.5 * STEP * k2, u)
    k4 = rates(x + STEP * k3, u)
    after = x + STEP / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)
    step = casadi.Function("step", [x, u], [after, k1[names.index(VIBRATION)] ** 2])
    changed = casadi.MX.sym("changed", len(INPUTS))
    own = {name: changed[i] for i, name in enumerate(INPUTS)}
    given = casadi.vertcat(*(own.get(name, axle.start(name)[0]) for name in axle.u()))
    start = states_at_start(folder, names)
    _, squares = step.mapaccum("run", STEPS)(start, casadi.repmat(given, 1, STEPS))
    return casadi.Function("whine", [changed], [casadi.sqrt(casadi.sum2(squares) / STEPS)])


def main(fmu: Path) -> tuple[float, np.ndarray, np.ndarray]:
    """Return the acceleration, root mean square [m/s2], and its gradient, exact and otherwise."""
    whine = run_up(str(extract(str(fmu), tempfile.mkdtemp())))
    u = np.array(list(INPUTS.values()))
    level = float(whine(u))
    exact = np.array(whine.forward(len(u))(u, level, np.eye(len(u)))).ravel()
    steps = np.diag(SHARE * u)
    differences = [float(whine(u + h) - whine(u - h)) / (2.0 * h.max()) for h in steps]
    return level, exact, np.array(differences)


if __name__ == "__main__":
    level, gradient, differences = main(
        Path(sys.argv[1]) if sys.argv[1:] else gl.cached_hypoid_axle()
    )
    print(f"acceleration {level:.3f} m/s2")
    for name, exact, other in zip(INPUTS, gradient, differences, strict=True):
        print(f"by {name}: {exact:+.8f}, by differences {other:+.8f}")
