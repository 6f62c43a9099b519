"""Tip relief: material taken off the flank near the tip, as a function of the radius."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from gearlube_core.arrays import Array
from gearlube_core.checks import check_positive, check_within

_METRES = "Give metres, not micrometres or millimetres."
_DEEPEST, _WIDEST = 1.0e-3, 0.1


def _check_size(amount: float, extent: float) -> None:
    check_within("amount", amount, 0.0, _DEEPEST, "m", _METRES)
    check_positive("extent", extent, "m", _METRES)
    check_within("extent", extent, 0.0, _WIDEST, "m", _METRES)


@dataclass(frozen=True, slots=True, kw_only=True)
class TipRelief:
    """Relief that begins as a parabola and continues as its tangent.

    r_ce = r_start + k (r_tip - r_start),  c_e = (r_ce - r_start)/(2 r_tip - r_ce - r_start) c_t
    r <= r_ce: ((r - r_start)/(r_ce - r_start))^2 c_e
    r >= r_ce: c_e + (c_t - c_e)/(r_tip - r_ce) (r - r_ce)

    Parameters
    ----------
    amount : float
        c_t, at the tip in the transverse plane, normal to the profile [m]; 0 to 1 mm.
    extent : float
        r_tip - r_start, radial [m].
    k : float
        Share of the extent that is parabola [-]: 0 linear, 1 parabolic.

    Raises
    ------
    ParameterError
        A field out of range.

    Notes
    -----
    Source: [jamali_2015 (5.1)] [jamali_2015 (5.2)] [jamali_2015 (5.3)] [jamali_2015 (5.4)]
    [jamali_2015 (5.5)]
    The slope is continuous for k > 0; with k = 0 it steps at r_start. Past the tip, where no flank
    is left, the tangent goes on.
    """

    amount: float
    extent: float
    k: float

    def __post_init__(self) -> None:
        _check_size(self.amount, self.extent)
        check_within("k", self.k, 0.0, 1.0, "", "0 is linear relief, 1 parabolic.")

    @property
    def parabola_end_removal(self) -> float:
        """c_e: removal where the parabola ends [m]."""
        return self.k / (2.0 - self.k) * self.amount

    @property
    def tip_slope(self) -> float:
        """Removal over radius at the tip [-]: 2 c_t/((2 - k)(r_tip - r_start))."""
        return 2.0 * self.amount / ((2.0 - self.k) * self.extent)

    def removal(self, r: ArrayLike, tip_radius: float) -> Array:
        """Return the removal [m] at radius `r` [m], any shape; zero below r_start."""
        depth = np.maximum(np.asarray(r, dtype=float) - (tip_radius - self.extent), 0.0)
        parabola = self.k * self.extent
        line = self.tip_slope * (depth - 0.5 * parabola)
        if parabola == 0.0:
            return line
        return np.where(depth < parabola, 0.5 * self.tip_slope * depth**2 / parabola, line)


@dataclass(frozen=True, slots=True, kw_only=True)
class PowerTipRelief:
    """Relief by a power of the radial depth.

    z_t' = c_t ((r - r_start)/(r_tip - r_start))^beta

    Parameters
    ----------
    amount : float
        c_t, at the tip in the transverse plane, normal to the profile [m]; 0 to 1 mm.
    extent : float
        r_tip - r_start, radial [m].
    beta : float
        [-], 1 (linear) to 10; Jamali uses 1 to 4.

    Raises
    ------
    ParameterError
        A field out of range.

    Notes
    -----
    Source: [jamali_2015 (5.6)]. Past the tip, where no flank is left, the power goes on.
    """

    amount: float
    extent: float
    beta: float

    def __post_init__(self) -> None:
        _check_size(self.amount, self.extent)
        check_within("beta", self.beta, 1.0, 10.0, "", "1 is linear relief, 2 parabolic.")

    def removal(self, r: ArrayLike, tip_radius: float) -> Array:
        """Return the removal [m] at radius `r` [m], any shape; zero below r_start."""
        depth = np.maximum(np.asarray(r, dtype=float) - (tip_radius - self.extent), 0.0)
        return np.asarray(self.amount * (depth / self.extent) ** self.beta)
