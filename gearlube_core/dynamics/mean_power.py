"""Mean power over a communication step, from an energy that is integrated with the state."""

from __future__ import annotations

from gearlube_core.arrays import Array
from gearlube_core.kernels.jit import kernel

# s; below, the difference of two energies is lost in their rounding: after 1e4 s at constant power
# the mean over 1e-7 s is known to 2e-5. A shorter step leaves all means as they were.
LEAST_WINDOW = 1e-7


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
        Length of the step [s]; 0 before the first one of at least LEAST_WINDOW, then the present
        rate is returned.
    """
    if duration > 0.0:
        return (s[energy] - s[mark]) * (1.0 / duration)
    return rates[energy]
