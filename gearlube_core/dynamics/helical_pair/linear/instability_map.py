"""Parametric instability of the pair from its varying mesh stiffness."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Literal, get_args

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_option, check_positive
from gearlube_core.dynamics.helical_pair.linear.linear_system import (
    linear_system,
    natural_frequencies,
)
from gearlube_core.dynamics.helical_pair.linear.period_march import march_period
from gearlube_core.dynamics.helical_pair.linear.periodic_response import with_friction
from gearlube_core.dynamics.helical_pair.parameters import HelicalPairParameters
from gearlube_core.periodic.floquet import floquet_multipliers

Axis = Literal["stiffness_variation", "damping_ratio", "mu"]
_SAMPLES = 16  # the march adds the mesh's own kinks


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class InstabilityMap:
    """Floquet multipliers against mesh frequency and a second axis.

    Parameters
    ----------
    axis : {"stiffness_variation", "damping_ratio", "mu"}
        Factor on the mesh's deviation from its mean; one ratio for supports and mesh; friction.
    values : ndarray of shape (V,)
        [-]
    mesh_frequency : ndarray of shape (F,)
        [Hz]
    growth : ndarray of shape (V, F)
        ln of the largest modulus of a multiplier over the period [1/s]; positive where unstable.
    multiplier : ndarray of complex, shape (V, F)
        The largest one: near -1 where a mode grows at half the mesh frequency.
    natural_frequencies : ndarray of shape (n,)
        Of the undamped pair with its mean mesh [Hz].
    """

    axis: Axis
    values: Array
    mesh_frequency: Array
    growth: Array
    multiplier: np.ndarray
    natural_frequencies: Array

    @property
    def unstable(self) -> np.ndarray:
        """Where disturbances grow, (V, F): from 2 f_i/k on [nayfeh_mook_1979 sec. 5.3]."""
        return np.asarray(self.growth > 0.0)


def instability_map(
    parameters: HelicalPairParameters,
    mesh_frequency: Array,
    axis: Axis,
    values: Array,
    *,
    steps_per_oscillation: int = 20,
) -> InstabilityMap:
    """Return the map over mesh frequencies [Hz] and values of an axis.

    Parameters
    ----------
    parameters
        The pair, with linear contact.
    mesh_frequency, values
        Axes.
    axis
        What the values are.
    steps_per_oscillation
        Of the march over a period.
    """
    check_option("axis", axis, get_args(Axis))
    check_option("parameters.friction", parameters.friction, ("off", "constant"))
    mesh_frequency = np.array(mesh_frequency, dtype=np.float64)
    values = np.array(values, dtype=np.float64)
    for frequency in mesh_frequency:
        check_positive("mesh_frequency", frequency, "Hz")
    multiplier = np.empty((values.size, mesh_frequency.size), dtype=np.complex128)
    for i, value in enumerate(values):
        if axis == "stiffness_variation":
            system = linear_system(parameters, variation=float(value))
        else:
            system = linear_system(_changed(parameters, axis, float(value)))
        for j, frequency in enumerate(mesh_frequency):
            march = march_period(system, 1.0 / frequency, _SAMPLES, steps_per_oscillation)
            multiplier[i, j] = floquet_multipliers(march.transition[-1])[0]
    return InstabilityMap(
        axis=axis,
        values=values,
        mesh_frequency=mesh_frequency,
        growth=np.log(np.abs(multiplier)) * mesh_frequency,
        multiplier=multiplier,
        natural_frequencies=natural_frequencies(linear_system(parameters)) / (2.0 * math.pi),
    )


def _changed(parameters: HelicalPairParameters, axis: Axis, value: float) -> HelicalPairParameters:
    if axis == "mu":
        return with_friction(parameters, value)
    return replace(parameters, support_damping_ratio=value, mesh_damping_ratio=value)
