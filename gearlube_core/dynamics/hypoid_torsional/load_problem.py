"""Periodic motions of the torsional pair at a given speed, over the pinion torque."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_positive
from gearlube_core.dynamics.hypoid_torsional.parameters import HypoidTorsionalParameters
from gearlube_core.dynamics.hypoid_torsional.period_problem import Orbit, PeriodProblem
from gearlube_core.dynamics.packed_mesh import PackedMesh
from gearlube_core.periodic.problem import PeriodicProblem

_LEAST, _MOST = 0.11, 9.9e3  # N.m, inside the range of the parameters
_STEP = 1e-5  # of the torque, in the central difference by it


class LoadProblem:
    """Equations of a periodic motion whose parameter is the mean pinion torque [N.m].

    Everything that depends on the load follows it: stiffness, radii and transmission error of the
    mesh table, load shares, load torque. Unknowns as in `PeriodProblem`; scales are those of the
    torque in `parameters`.

    Parameters
    ----------
    parameters : HypoidTorsionalParameters
    speed : float
        Mean pinion speed [rad/s].
    periods, steps_per_mesh_period : int
        As in `PeriodProblem`.

    Notes
    -----
    Mesh data are linear between the levels of the table: branches have slight corners there.
    """

    def __init__(
        self,
        parameters: HypoidTorsionalParameters,
        speed: float,
        *,
        periods: int = 1,
        steps_per_mesh_period: int = 256,
    ) -> None:
        self.speed = check_positive("speed", speed, "rad/s")
        self.parameters = parameters
        self.periods = periods
        self._options = {"periods": periods, "steps_per_mesh_period": steps_per_mesh_period}
        self._packed: PackedMesh | None = None
        self._start = self.at(parameters.pinion_torque)
        self._packed = self._start.model.packed
        self._states = 3 if parameters.form == "two_dof" else 2

    def at(self, torque: float) -> PeriodProblem:
        """Return the problem over the speed at pinion torque `torque` [N.m]."""
        parameters = replace(self.parameters, pinion_torque=float(torque))
        return PeriodProblem(parameters, packed=self._packed, **self._options)

    def initial_guess(self, torque: float) -> Array:
        """Return z of the static deflection at pinion torque `torque` [N.m], shape (size,)."""
        return self.at(torque).initial_guess(self.speed)

    def residual(self, z: Array, torque: float) -> tuple[Array, Array, Array, Array]:
        """Return the residual, its derivatives by z and by the torque, and the monodromy."""
        if not _LEAST <= torque <= _MOST:  # a trial step that leaves the range finds no motion
            n, m = z.size, self._states
            nothing = np.full((n, n), np.nan)
            return nothing[0], nothing, nothing[0], np.full((m, m), np.nan)
        residual, jacobian, _, monodromy = self.at(torque).residual(z, self.speed)
        step = _STEP * torque
        above, below = (
            self.at(torque + way * step).residual(z, self.speed)[0] for way in (1.0, -1.0)
        )
        return residual, jacobian, (above - below) / (2.0 * step), monodromy

    def equations(self) -> PeriodicProblem:
        """Return the problem for shooting and continuation over the pinion torque."""
        over_speed = self._start.equations()
        return PeriodicProblem(
            residual=self.residual,
            unknown_scale=over_speed.unknown_scale,
            residual_scale=over_speed.residual_scale,
            parameter_scale=self.parameters.pinion_torque,
        )

    def orbit(self, z: Array, torque: float) -> Orbit:
        """Return the motion over the period that starts at z."""
        return self.at(torque).orbit(z, self.speed)
