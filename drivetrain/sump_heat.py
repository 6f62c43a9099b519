"""Oil temperature of an axle: one body of oil and housing that losses heat and air cools."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_within

_FAST = 100.0 / 3.6  # m/s, where `conductance_at_100_kmh` holds
_EXPONENT = 0.8  # of turbulent flow along a plate
# assumed, for the axle of a car: 1 to 1.5 kg of oil and 25 to 35 kg of metal; a surface of 0.3 to
# 0.5 m2 with 15 to 20 W/(m2 K) at rest and 30 to 60 at 100 km/h
CAPACITIES = 15e3, 20e3  # J/K
AT_REST = 4.5, 10.0  # W/K
AT_100_KMH = 9.0, 30.0  # W/K


@dataclass(frozen=True, slots=True, kw_only=True)
class SumpHeat:
    """Heat capacity and cooling of an axle's oil and housing, which have one temperature T.

    C dT/dt = P_loss(T) - hA(V) (T - T_air). hA grows with V^0.8 from its value at standstill to
    that at 100 km/h.

    Parameters
    ----------
    capacity : float
        C [J/K]. Default: assumed, within 15 to 20 kJ/K.
    conductance_at_rest, conductance_at_100_kmh : float
        hA [W/K]. Default: assumed, within 4.5 to 10 and 9 to 30 W/K.

    Examples
    --------
    >>> SumpHeat().conductance(100.0 / 3.6)  # W/K
    18.0
    """

    capacity: float = 18e3
    conductance_at_rest: float = 7.0
    conductance_at_100_kmh: float = 18.0

    def __post_init__(self) -> None:
        check_within("capacity", self.capacity, 10.0, 1e8, "J/K", "18 kJ/K is 18e3.")
        for name in ("conductance_at_rest", "conductance_at_100_kmh"):
            check_within(name, getattr(self, name), 0.0, 1e5, "W/K", "For cars 5 to 30 W/K.")

    def conductance(self, speed: float) -> float:
        """Return hA [W/K] at a vehicle speed [m/s]."""
        rest, fast = self.conductance_at_rest, self.conductance_at_100_kmh
        return rest + (fast - rest) * (speed / _FAST) ** _EXPONENT

    @property
    def corners(self) -> tuple[SumpHeat, ...]:
        """The four ends of the assumed intervals; a value that was given stays as it is."""
        usual = SumpHeat()
        capacities = CAPACITIES if self.capacity == usual.capacity else (self.capacity,)
        rest, fast = self.conductance_at_rest, self.conductance_at_100_kmh
        pairs = list(
            zip(
                AT_REST if rest == usual.conductance_at_rest else (rest, rest),
                AT_100_KMH if fast == usual.conductance_at_100_kmh else (fast, fast),
                strict=True,
            )
        )
        return tuple(
            replace(self, capacity=c, conductance_at_rest=at_rest, conductance_at_100_kmh=moving)
            for c in capacities
            for at_rest, moving in pairs
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class Warming:
    """Temperatures over a cycle.

    Parameters
    ----------
    temperature : ndarray of shape (n + 1,)
        At the ends of the steps [K].
    mean : ndarray of shape (n,)
        Mean of each step [K].
    """

    temperature: Array
    mean: Array


def warm(
    heat: SumpHeat,
    *,
    steps: Array,
    speeds: Array,
    power: Array,
    nodes: Array,
    start: float,
    air: float,
) -> Warming:
    """Return the temperatures over the steps of a cycle.

    Parameters
    ----------
    steps, speeds : ndarray of shape (n,)
        Durations [s] and vehicle speeds [m/s].
    power : ndarray of shape (n, k)
        Loss of each step at the temperatures `nodes` [W]; a straight line between them. Above the
        last and below the first node the line goes on.
    nodes : ndarray of shape (k,)
        [K], rising; two or more.
    start, air : float
        [K]

    Notes
    -----
    In each step the loss is a straight line over temperature and the speed does not change. The
    exact solution of that linear equation is taken, so any step is stable, and what is lost less
    what is stored is what the air takes.
    """
    count = len(steps)
    temperature, mean = np.empty(count + 1), np.empty(count)
    temperature[0] = now = start
    slopes = np.diff(power, axis=1) / np.diff(nodes)
    cells = nodes[1:-1]
    for i in range(count):
        cell = int(np.searchsorted(cells, now))
        slope = slopes[i, cell]
        lost = power[i, cell] + slope * (now - nodes[cell])
        cooling = heat.conductance(float(speeds[i]))
        rate = (lost - cooling * (now - air)) / heat.capacity
        z = (slope - cooling) / heat.capacity * steps[i]
        first, second = _phi(z)
        mean[i] = now + rate * steps[i] * second
        now += rate * steps[i] * first
        temperature[i + 1] = now
    return Warming(temperature=temperature, mean=mean)


def _phi(z: float) -> tuple[float, float]:
    """Return (e^z - 1)/z and ((e^z - 1)/z - 1)/z."""
    if abs(z) < 1e-3:
        return 1.0 + z / 2.0 * (1.0 + z / 3.0 * (1.0 + z / 4.0)), 0.5 + z / 6.0 * (
            1.0 + z / 4.0 * (1.0 + z / 5.0)
        )
    first = math.expm1(z) / z
    return first, (first - 1.0) / z
