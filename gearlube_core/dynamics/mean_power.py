"""Mean power over a communication step, from an energy that is integrated with the state."""

from __future__ import annotations

from gearlube_core.arrays import Array
from gearlube_core.kernels.jit import kernel


@kernel
def mean_power(s: Array, rates: Array, energy: int, mark: int, duration: float) -> float:
    """Return the mean rate of the energy s[energy] over the last communication step [W].

    Parameters
    ----------
    s, rates : ndarray
        State and its rates.
    energy : int
        Place of the energy in the state [J].
    mark : int
        Place of its value at the start of the step [J].
    duration : float
        Length of the step [s]; 0 before the first one, then the present rate is returned.
    """
    if duration > 0.0:
        return (s[energy] - s[mark]) * (1.0 / duration)
    return rates[energy]
