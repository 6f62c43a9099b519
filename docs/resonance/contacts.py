"""Flank contacts along periodic motions, with the paper's choices for film and temperature."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from gearlube.studies.resonance.flank_cycle import FlankCycle, flank_cycle
from gearlube.studies.resonance.response import motion_near
from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_torsional.parameters import karagiannis_2012_pair
from gearlube_core.dynamics.hypoid_torsional.period_problem import PeriodProblem
from gearlube_core.errors import ConvergenceError

COLD, HOT = 313.15, 373.15  # K
STEPS = 256
PRINTED = {"film": "as_printed", "film_temperature": "effective"}
CARRIES = 0.1  # share of the static load above which a contact counts


@dataclass(frozen=True, slots=True)
class Contacts:
    """A flank cycle and the numbers that statements need."""

    cycle: FlankCycle
    static_load: float  # N
    pinion_torque: float  # N.m

    def loaded(self, name: str, share: float = CARRIES) -> Array:
        """Return a quantity where a pair carries more than a share of the static load."""
        load = np.nan_to_num(self.cycle.values["load"])
        return np.asarray(self.cycle.values[name][load > share * self.static_load])

    def course(self, name: str) -> Array:
        """Return a quantity of one pair along its mesh, 0 without load, shape (samples,)."""
        return np.nan_to_num(self.cycle.values[name]).ravel()

    def total(self, name: str) -> Array:
        """Return the sum over the pairs, shape (samples of a mesh period,)."""
        return np.asarray(np.nansum(self.cycle.values[name], axis=0))

    def at_hardest(self, name: str) -> float:
        """Return a quantity of the contact with the highest load."""
        return float(self.cycle.values[name][self.cycle.hardest])


def contacts(
    relative: float, oil_temperature: float, eyring_stress: float | None = None, **options: Any
) -> Contacts:
    """Return the contacts of the shipped pair on its motion at a frequency.

    Parameters
    ----------
    relative : float
        Mesh over natural frequency [-].
    oil_temperature : float
        [K]
    eyring_stress : float, optional
        tau0 [Pa], which the paper does not print; by default that of the lubricant.
    **options
        Of the pair, in place of the paper's choices.

    Raises
    ------
    ConvergenceError
        No stable motion found from static deflection.
    """
    parameters = replace(
        karagiannis_2012_pair(),
        friction="thermal_eyring",
        oil_temperature=oil_temperature,
        **{**PRINTED, **options},
    )
    if eyring_stress is not None:
        parameters = replace(parameters, oil=replace(parameters.oil, eyring_stress=eyring_stress))
    problem = PeriodProblem(parameters, steps_per_mesh_period=STEPS)
    unit = problem.model.pinion_speed(problem.model.natural_frequency)
    start = problem.initial_guess(relative * unit)
    motion = motion_near("two_dof_lubricated", problem, start, relative)
    if motion is None or not motion.stable:
        raise ConvergenceError(f"no stable motion at {relative:g} of the natural frequency")
    R_p0 = problem.model.kernel_parameters.R_p0
    return Contacts(
        flank_cycle(motion, parameters), parameters.pinion_torque / R_p0, parameters.pinion_torque
    )
