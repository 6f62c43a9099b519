"""Periodic motions of the torsional pair as a system of equations; interface: `period_map`."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_positive, check_within
from gearlube_core.dynamics.hypoid_torsional.mode_march import MARCH_WORK, N_RECORD, N_Y, OK, march
from gearlube_core.dynamics.hypoid_torsional.model import HypoidTorsional
from gearlube_core.dynamics.hypoid_torsional.parameters import HypoidTorsionalParameters
from gearlube_core.dynamics.hypoid_torsional.period_map import N_COLUMNS, WORK, period_map
from gearlube_core.dynamics.hypoid_torsional.rates import MICRO, UM
from gearlube_core.dynamics.packed_mesh import PackedMesh
from gearlube_core.periodic.problem import PeriodicProblem

_LEAST, _MOST = 0.11, 9.9e3  # N.m, inside the range of the parameters
_STEP = 1e-5  # of the torque, in the central difference by it


@dataclass(frozen=True, slots=True, kw_only=True)
class Orbit:
    """Samples of a motion over one period at equal pinion angles, all of shape (samples,).

    Parameters
    ----------
    angle : ndarray
        Of the pinion [rad].
    x : ndarray
        Dynamic transmission error [m].
    pinion_speed, gear_speed : ndarray
        [rad/s]
    force : ndarray
        Mesh force [N].
    load_torque : float
        [N.m]
    separation_share : float
        Share of the samples within the backlash [-].
    """

    angle: Array
    x: Array
    pinion_speed: Array
    gear_speed: Array
    force: Array
    load_torque: float
    separation_share: float


class PeriodProblem:
    """Equations of a periodic motion of given mean speed; see `period_map` for the interface.

    Parameters
    ----------
    parameters : HypoidTorsionalParameters
        With torque ripple, `periods` must be a multiple of the teeth of the pinion.
    periods : int
        Mesh periods in one period of the motion.
    steps_per_mesh_period : int
        Integration steps in a mesh period.
    packed : PackedMesh, optional
        See `HypoidTorsional`.
    """

    def __init__(
        self,
        parameters: HypoidTorsionalParameters,
        *,
        periods: int = 1,
        steps_per_mesh_period: int = 256,
        packed: PackedMesh | None = None,
    ) -> None:
        self.model = HypoidTorsional(parameters, packed=packed)
        p = self.model.kernel_parameters
        check_within("periods", periods, 1, 1024)
        teeth = parameters.mesh.pinion_teeth
        if parameters.torque_ripple > 0.0 and periods % teeth:
            check_within(
                "periods modulo teeth of the pinion",
                periods % teeth,
                0,
                0,
                "",
                f"Torque ripple repeats once a revolution; give {teeth}.",
            )
        self.periods = periods
        self.steps_per_mesh_period = steps_per_mesh_period
        self._rows = self.model.rows(steps_per_mesh_period)
        self._p = p
        self._work = np.zeros(WORK)
        self._two = parameters.form == "two_dof"
        self.size = 4 if self._two else 2
        x = MICRO * self.model.static_deflection
        surge = self.model.static_deflection * math.sqrt(self.model.stiffness / p.m_eq)  # m/s
        self.scales: Array = (
            np.array([x, surge / p.R_p0, surge / p.R_g0, self.model.mean_load_torque])
            if self._two
            else np.array([x, surge])
        )
        # d(states)/d(speed) at constant z
        self._per_speed = np.array([0.0, 1.0, p.R_p0 / p.R_g0]) if self._two else np.zeros(2)

    def initial_guess(self, speed: float) -> Array:
        """Return z of the static deflection at pinion speed `speed` [rad/s], shape (size,)."""
        m = self._per_speed.size
        y = self.model.initial_state(speed)[:m] - speed * self._per_speed
        return np.append(y, self.model.mean_load_torque) if self._two else y

    def state(self, z: Array, speed: float) -> tuple[Array, float]:
        """Return y0 of `mode_march` and the load torque [N.m]."""
        m = self._per_speed.size
        y = np.zeros(N_Y)
        y[:m] = z[:m] + speed * self._per_speed
        return y, float(z[m]) if self._two else self.model.mean_load_torque

    def flow(self, z: Array, speed: float) -> tuple[Array, Array]:
        """Return y at the end of the period and its derivatives.

        Returns
        -------
        ndarray of shape (N_Y,)
            NaN when the period is not finite.
        ndarray of shape (N_Y, N_COLUMNS)
            By the states at the start, the load torque and `speed` of the speed hold.
        """
        y, load_torque = self.state(np.asarray(z, dtype=np.float64), speed)
        derivatives = np.zeros((N_Y, N_COLUMNS))
        status = period_map(
            y,
            derivatives,
            load_torque,
            float(speed),
            self.periods,
            self._rows,
            self._p,
            self._work,
        )
        if status != OK:
            y[:] = np.nan
        return y, derivatives

    def residual(self, z: Array, speed: float) -> tuple[Array, Array, Array, Array]:
        """Return the residual, its derivatives by z and by the speed, and the monodromy matrix.

        Parameters
        ----------
        z : ndarray of shape (size,)
            Unknowns, see `period_map`.
        speed : float
            Mean pinion speed [rad/s].

        Returns
        -------
        residual : ndarray of shape (size,)
        jacobian : ndarray of shape (size, size)
        by_speed : ndarray of shape (size,)
        monodromy : ndarray of shape (m, m)
            d y_end/d y0 of the m states.
        """
        y_end, d = self.flow(z, speed)
        m = self._per_speed.size
        by_state = d[:, :m]
        by_speed = d[:, 4] + by_state @ self._per_speed
        y0, _ = self.state(z, speed)
        if not self._two:
            return (y_end[:m] - y0[:m], by_state[:m] - np.eye(m), by_speed[:m], by_state[:m])
        angle = 2.0 * math.pi * self.periods / self._p.z_p
        mean = angle / y_end[3]
        per_time = -mean / y_end[3]
        residual = np.append(y_end[:m] - y0[:m], mean - speed)
        jacobian = np.empty((m + 1, m + 1))
        jacobian[:m, :m] = by_state[:m] - np.eye(m)
        jacobian[:m, m] = d[:m, 3]
        jacobian[m, :m] = per_time * by_state[3]
        jacobian[m, m] = per_time * d[3, 3]
        d_speed = np.append(by_speed[:m] - self._per_speed, per_time * by_speed[3] - 1.0)
        return residual, jacobian, d_speed, by_state[:m]

    def equations(self) -> PeriodicProblem:
        """Return the problem for shooting and continuation over the pinion speed."""
        return PeriodicProblem(
            residual=self.residual,
            unknown_scale=self.scales,
            residual_scale=np.append(self.scales[:-1], self.scales[1]) if self._two else None,
            parameter_scale=self.model.pinion_speed(self.model.natural_frequency),
        )

    def orbit(self, z: Array, speed: float) -> Orbit:
        """Return the motion over the period that starts at z."""
        y, load_torque = self.state(np.asarray(z, dtype=np.float64), speed)
        record = np.zeros((self.periods * self.steps_per_mesh_period, N_RECORD))
        march(
            y,
            0,
            self.periods,
            load_torque,
            float(speed),
            self._rows,
            self._p,
            record,
            np.zeros(MARCH_WORK),
        )
        x = record[:, 1] * UM
        return Orbit(
            angle=record[:, 0],
            x=x,
            pinion_speed=record[:, 2],
            gear_speed=record[:, 3],
            force=record[:, 4],
            load_torque=load_torque,
            separation_share=float(np.mean((x < 0.0) & (x > -self._p.backlash))),
        )


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
