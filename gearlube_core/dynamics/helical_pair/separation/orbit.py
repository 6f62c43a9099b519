"""One periodic motion of the pair with tooth separation, sampled."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.dynamics.helical_pair.linear.linear_system import RELATIVE
from gearlube_core.dynamics.helical_pair.parameters import HelicalPairParameters
from gearlube_core.dynamics.helical_pair.supports.bearing_forces import bearing_forces


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SeparationOrbit:
    """Samples at the start of each time step; of equal phase but at the mesh's kinks.

    Parameters
    ----------
    parameters : HelicalPairParameters
    pinion_torque, pinion_speed : float
        [N.m], [rad/s]
    phase, weight : ndarray of shape (N,)
        From 0 [mesh periods], and share of the motion's period that a sample stands for [-].
    displacement, rate : ndarray of shape (N, 11)
        Of the coordinates `RELATIVE` [m, rad] and [m/s, rad/s]; zero where held.
    flank_force : ndarray of shape (N,)
        Sum of the line loads, normal to the flanks, negative on the back flanks [N].
    friction_force : ndarray of shape (N,)
        On the pinion off the line of action [N].
    damping_force : ndarray of shape (N,)
        Of the mesh against psi, along the line of action [N].
    contact_share : ndarray of shape (N,)
        Stiffness of the lines where they touch over that of all lines [-].
    """

    parameters: HelicalPairParameters
    pinion_torque: float
    pinion_speed: float
    phase: Array
    weight: Array
    displacement: Array
    rate: Array
    flank_force: Array
    friction_force: Array
    damping_force: Array
    contact_share: Array

    def signal(self, name: str) -> Array:
        """Return the history of a coordinate of `RELATIVE`, shape (N,) [m, rad]."""
        return np.asarray(self.displacement[:, RELATIVE.index(name)])

    @property
    def delta_z(self) -> Array:
        """Dynamic transmission error psi - u_xp + u_xg, negative under load, shape (N,) [m]."""
        return self.signal("psi") - self.signal("u_xp") + self.signal("u_xg")

    @property
    def peak_to_peak(self) -> float:
        """Of `delta_z` [m]."""
        return float(np.ptp(self.delta_z))

    @property
    def separation_share(self) -> float:
        """Share of the time without any contact [-]."""
        return self._share(self.contact_share == 0.0)

    @property
    def lift_off_share(self) -> float:
        """Share of the time in which part of the lines or all of them are off [-]."""
        return self._share(self.contact_share < 1.0 - 1e-12)

    def _share(self, when: np.ndarray[Any, np.dtype[np.bool_]]) -> float:
        return float(self.weight @ when)

    @property
    def bearing_force(self) -> Array:
        """Forces and moments of both members' bearings on them, see `bearing_forces`."""
        return bearing_forces(self.parameters.support_arrays(), self.displacement, self.rate)
