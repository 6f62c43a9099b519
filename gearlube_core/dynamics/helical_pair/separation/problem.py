"""Periodic motions of the pair with backlash and tooth separation as a system of equations.

    problem = SeparationProblem(parameters)
    problem.over_speed()                  PeriodicProblem, parameter: pinion speed [rad/s]
    problem.over_torque(speed)            the same over the pinion torque [N.m]
    problem.initial_guess()               z of the static deflection
    problem.orbit(z, speed)               samples of the motion

Unknowns z = (q, dq/dt), the n free relative coordinates of `linear_system` (psi last) [m, rad] and
their rates at mesh phase zero; residual z(end) - z. The mean speed is prescribed: mesh phase runs
with it, so that the system is not autonomous and needs no phase condition.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_positive, check_within
from gearlube_core.dynamics.flank_force import DAMPING_BUILD_UP
from gearlube_core.dynamics.helical_pair.kernel_parameters import MeshArrays
from gearlube_core.dynamics.helical_pair.linear.linear_system import RELATIVE, linear_system
from gearlube_core.dynamics.helical_pair.parameters import HelicalPairParameters, pack_lines
from gearlube_core.dynamics.helical_pair.separation.march import (
    CONTACT_SHARE,
    DAMPING_FORCE,
    DRAG_FORCE,
    FORCE,
    N_EXTRA,
    march_separating,
    march_work,
)
from gearlube_core.dynamics.helical_pair.separation.system import (
    N_BY,
    N_ROWS,
    SeparationPoints,
    mesh_mode_frequency,
    separation_points,
    separation_system,
    static_state,
)
from gearlube_core.dynamics.helical_pair.supports import bearing_forces
from gearlube_core.errors import ParameterError
from gearlube_core.periodic.problem import PeriodicProblem


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _SeparationOrbit:
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


_STEP = 1e-4  # of the torque, in the difference of mesh data that are linear between levels
_DIVERGED = 1e3  # static deflections


class SeparationProblem:
    """Equations of a periodic motion with one-sided line contact.

    Parameters
    ----------
    parameters : HelicalPairParameters
        With `contact` "one_sided" and the pair's backlash; `line_divisions` sets in how many points
        a line lifts off.
    periods : int
        Mesh periods in one period of the motion.
    steps_per_mesh_period : int
        Time steps, at least; none spans a kink or jump of the mesh. Lines of spur pairs touch all
        at once: 512 keep their branches free of corners.
    damping_build_up : float
        Penetration over which a point's share of mesh damping builds up [m].

    Notes
    -----
    Forces do not jump when points touch, that of `mesh_damping` included. The speed only turns the
    lines: friction takes the sign of nominal sliding, and gear torque follows the pinion's by the
    base radii.
    """

    def __init__(
        self,
        parameters: HelicalPairParameters,
        *,
        periods: int = 1,
        steps_per_mesh_period: int = 128,
        damping_build_up: float = DAMPING_BUILD_UP,
    ) -> None:
        if parameters.contact != "one_sided" or parameters.mesh_sign != "compression":
            raise ParameterError(
                'contact must be "one_sided" and mesh_sign "compression", got '
                f'"{parameters.contact}" and "{parameters.mesh_sign}". `periodic_response` solves '
                "linear contact."
            )
        self.parameters = parameters
        check_within("periods", periods, 1, 1024)
        check_within("steps_per_mesh_period", steps_per_mesh_period, 8, 65536)
        check_positive("damping_build_up", damping_build_up, "m", "0.5 micrometres is usual.")
        self.periods, self.steps_per_mesh_period = periods, steps_per_mesh_period
        linear = linear_system(parameters)
        self._linear, self.names = linear, linear.names
        self.size = 2 * len(linear.names)
        self.system = separation_system(parameters, linear, damping_build_up)
        self.natural_frequency = mesh_mode_frequency(parameters, linear)
        self._torque = float(parameters.pinion_torque)
        self._table = self._points(self._torque)
        self._work = march_work(self.size // 2, self.size + 3)
        self._small = np.zeros((N_ROWS, N_BY))
        self._nothing = np.zeros((0, 0))
        self.scales: Array = self._scales()

    @property
    def natural_speed(self) -> float:
        """Pinion speed at which the mesh frequency is `natural_frequency` [rad/s]."""
        return 2.0 * np.pi * self.natural_frequency / self.parameters.pair.pinion_teeth

    def _scales(self) -> Array:
        size = abs(float(self.initial_guess()[self.size // 2 - 1]))
        tilt = size / self.parameters.pair.pinion_base_radius
        q = np.array([tilt if name.startswith("th") else size for name in self.names])
        return np.concatenate((q, 2.0 * np.pi * self.natural_frequency * q))

    def _points(self, torque: float) -> SeparationPoints:
        p, plane = self.parameters, self.parameters.pair.plane
        mesh = pack_lines(p.mesh, torque, p.line_divisions)
        rates = MeshArrays(np.zeros_like(mesh.density), np.zeros_like(mesh.offset), mesh.station)
        if p.mesh.torque.size > 1:
            below = max((1.0 - _STEP) * torque, float(p.mesh.torque[0]))
            above = min((1.0 + _STEP) * torque, float(p.mesh.torque[-1]))
            low, high = (pack_lines(p.mesh, end, p.line_divisions) for end in (below, above))
            width = above - below
            rates = MeshArrays(
                (high.density - low.density) / width,
                (high.offset - low.offset) / width,
                mesh.station,
            )
        return separation_points(plane, mesh, rates, p.mu, self.steps_per_mesh_period)

    def _table_at(self, torque: float) -> SeparationPoints:
        if torque != self._torque and self.parameters.mesh.torque.size > 1:
            self._table, self._torque = self._points(torque), torque
        return self._table

    @property
    def table(self) -> SeparationPoints:
        """Contact points of the last torque marched, those of the parameters at first."""
        return self._table

    def initial_guess(self, torque: float | None = None) -> Array:
        """Return z of the static deflection on the mean mesh, shape (size,).

        Parameters
        ----------
        torque
            Of the pinion [N.m]; that of the parameters if left out.
        """
        return static_state(self._linear, self.system.f * self._torque_or(torque))

    def _march(
        self, z: Array, speed: float, torque: float, periods: int, columns: int, record: Array
    ) -> tuple[Array, Array]:
        n = self.size // 2
        q, v = np.zeros((n, columns)), np.zeros((n, columns))
        q[:, -1], v[:, -1] = z[:n], z[n:]
        march_separating(
            q, v, periods, float(torque), float(speed),
            1.0 / self.parameters.pair.mesh_frequency(speed), self._table_at(float(torque)),
            self.system, np.ascontiguousarray(self._work[:, :columns]), self._small, record,
        )  # fmt: skip
        return q, v

    def _torque_or(self, torque: float | None) -> float:
        return float(self.parameters.pinion_torque if torque is None else torque)

    def march(self, z: Array, speed: float, *, periods: int, torque: float | None = None) -> Array:
        """Return the state after some mesh periods from phase zero, shape (size,).

        Parameters
        ----------
        z : ndarray of shape (size,)
        speed
            Of the pinion [rad/s].
        periods
            Number of mesh periods.
        torque
            Of the pinion [N.m]; that of the parameters if left out.
        """
        q, v = self._march(z, speed, self._torque_or(torque), periods, 1, self._nothing)
        return np.concatenate((q[:, 0], v[:, 0]))

    def flow(
        self, z: Array, speed: float, torque: float | None = None
    ) -> tuple[Array, Array, Array, Array]:
        """Return the state after the motion's period and its derivatives.

        Returns
        -------
        ndarray of shape (size,)
            NaN where the motion has left all bounds.
        ndarray of shape (size, size), ndarray of shape (size,), ndarray of shape (size,)
            By the start, the pinion torque [N.m] and the pinion speed [rad/s].
        """
        m = self.size
        q, v = self._march(
            np.asarray(z, dtype=np.float64), speed, self._torque_or(torque), self.periods, m + 3,
            self._nothing,
        )  # fmt: skip
        both = np.concatenate((q, v))
        end = both[:, -1].copy()
        if not np.abs(end / self.scales).max() < _DIVERGED:
            end[:] = np.nan
        return end, both[:, :m], both[:, m], both[:, m + 1]

    def residual(self, z: Array, speed: float) -> tuple[Array, Array, Array, Array]:
        """Return the residual, its derivatives by z and by the speed, and the monodromy matrix."""
        end, monodromy, _, by_speed = self.flow(z, speed)
        return end - z, monodromy - np.eye(self.size), by_speed, monodromy

    def over_speed(self) -> PeriodicProblem:
        """Return the problem for shooting and continuation over the pinion speed [rad/s]."""
        return PeriodicProblem(
            residual=self.residual, unknown_scale=self.scales, parameter_scale=self.natural_speed
        )

    def over_torque(self, speed: float) -> PeriodicProblem:
        """Return the problem at a pinion speed [rad/s] over the pinion torque [N.m].

        Scales are those of the torque in the parameters. A line mesh with several levels follows
        the torque; branches have slight corners at its levels and no motions beyond them.
        """
        check_positive("speed", speed, "rad/s")
        levels = self.parameters.mesh.torque

        def residual(z: Array, torque: float) -> tuple[Array, Array, Array, Array]:
            if levels.size > 1 and not levels[0] <= torque <= levels[-1]:
                empty = np.full((self.size, self.size), np.nan)
                return empty[0], empty, empty[0], empty
            end, monodromy, by_torque, _ = self.flow(z, speed, torque)
            return end - z, monodromy - np.eye(self.size), by_torque, monodromy

        return PeriodicProblem(
            residual=residual,
            unknown_scale=self.scales,
            parameter_scale=self.parameters.pinion_torque,
        )

    def orbit(self, z: Array, speed: float, torque: float | None = None) -> _SeparationOrbit:
        """Return the motion over the period that starts at z, at a speed [rad/s], torque [N.m]."""
        n, torque = self.size // 2, self._torque_or(torque)
        table = self._table_at(torque)
        record = np.zeros((self.periods * table.width.size, self.size + N_EXTRA))
        self._march(np.asarray(z, dtype=np.float64), speed, torque, self.periods, 1, record)
        places = [RELATIVE.index(name) for name in self.names]
        displacement, rate = np.zeros((2, record.shape[0], len(RELATIVE)))
        displacement[:, places], rate[:, places] = record[:, :n], record[:, n : 2 * n]
        extra = record[:, self.size :]
        return _SeparationOrbit(
            parameters=self.parameters,
            pinion_torque=torque,
            pinion_speed=speed,
            phase=(np.arange(self.periods)[:, None] + table.phase).ravel(),
            weight=np.tile(table.width, self.periods) / self.periods,
            displacement=displacement,
            rate=rate,
            flank_force=extra[:, FORCE],
            friction_force=extra[:, DRAG_FORCE],
            damping_force=self.parameters.effective_mass * extra[:, DAMPING_FORCE],
            contact_share=extra[:, CONTACT_SHARE],
        )
