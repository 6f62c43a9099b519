"""A slow loop that holds a mean speed and leaves the modes of the axle alone."""

from __future__ import annotations

from gearlube_core.checks import check_positive, check_within

# Bandwidth times time while the loop learns; errors then fall with time to the power -2.5.
_LEARNING = 3.0


class SlowLoop:
    """The torque K f (w_r - w) + K_I f^2 (integral of w_r - w) that brings a shaft to a speed.

    Parameters
    ----------
    proportional_gain : float
        K [N m s/rad]. The gain is a damper K / I on the shaft.
    integral_gain : float, optional
        K_I [N m/rad]; by default K^2 / (4 I), which is critical damping.
    inertia : float
        I [kg m2].
    start_factor : float
        By which the loop is faster at the start, so that it learns what the shaft loses before a
        record begins [-]: f = 3 / (w t), at most this factor and at least 1, where w = K / (2 I)
        is the bandwidth. 1 switches it off.

    Notes
    -----
    The integral is formed from the angle, so the mean speed has no sampling error.
    """

    def __init__(
        self,
        proportional_gain: float,
        integral_gain: float | None,
        inertia: float,
        start_factor: float,
    ) -> None:
        cure = "0.05 N m s/rad leaves the mesh mode alone."
        k = check_within("proportional_gain", proportional_gain, 0.0, 100.0, "N m s/rad", cure)
        check_positive("axle_inertia", inertia, "kg m2")
        if integral_gain is None:
            integral_gain = k**2 / (4.0 * inertia)
        check_within("integral_gain", integral_gain, 0.0, 1e5, "N m/rad")
        check_within("start_factor", start_factor, 1.0, 100.0, "", "1 is no faster start.")
        self._gains = (k, integral_gain)
        self._fastest = start_factor
        # Time at which the gains have come down to those requested [s].
        self._learning = _LEARNING * 2.0 * inertia / k if k > 0.0 else 0.0
        # Elapsed time, integral torque, expected angle, started.
        self.state = (0.0, 0.0, 0.0, 0.0)

    @property
    def elapsed(self) -> float:
        """Time since the start [s]."""
        return self.state[0]

    @property
    def learnt(self) -> float:
        """Torque of the integral [N m]."""
        return self.state[1]

    def torque(self, h: float, angle: float, speed: float, wanted: float, turn: float) -> float:
        """Return the torque [N m] for the next `h` [s].

        Parameters
        ----------
        h : float
            [s]
        angle, speed : float
            Of the shaft now [rad], [rad/s].
        wanted : float
            Speed that it should have now [rad/s].
        turn : float
            Angle that it should cover in `h` [rad].
        """
        elapsed, integral, expected, started = self.state
        factor = 1.0
        if elapsed < self._learning:
            factor = min(self._fastest, self._learning / (elapsed + h))
        gain, integral_gain = self._gains
        if started:
            integral += integral_gain * factor**2 * (expected - angle)
        self.state = (elapsed + h, integral, angle + turn, 1.0)
        return integral + gain * factor * (wanted - speed)
