"""Closed-form Hertz contact, of nothing that the package has."""

from __future__ import annotations

import math
from dataclasses import dataclass

from scipy.optimize import brentq
from scipy.special import ellipe, ellipk


@dataclass(frozen=True, slots=True, kw_only=True)
class HertzContact:
    """Elliptical contact of two smooth elastic solids.

    Parameters
    ----------
    R_x, R_y
        Relative principal radii of curvature [m].
    contact_modulus
        E* [Pa].
    load
        Normal load [N].

    Notes
    -----
    Source: Johnson 1985 sec. 4.2. Radius ratios up to 1e8.
    """

    R_x: float
    R_y: float
    contact_modulus: float
    load: float

    @property
    def ellipticity(self) -> float:
        """Major over minor semi-axis [-]."""
        ratio = max(self.R_x, self.R_y) / min(self.R_x, self.R_y)
        if ratio - 1.0 < 1e-6:
            return ratio ** (2.0 / 3.0)  # limit for nearly circular contacts

        def residual(k: float) -> float:
            m = 1.0 - 1.0 / k**2
            curvature = (k**2 * ellipe(m) - ellipk(m)) / (ellipk(m) - ellipe(m))
            return float(math.log(curvature / ratio))

        return float(brentq(residual, ratio**0.5, ratio ** (2.0 / 3.0), xtol=1e-14, rtol=1e-14))

    @property
    def semi_major(self) -> float:
        """Semi-axis a = (3 k^2 E R W / (pi E*))^(1/3) [m]."""
        k = self.ellipticity
        R = 1.0 / (1.0 / self.R_x + 1.0 / self.R_y)
        E = float(ellipe(1.0 - 1.0 / k**2))
        return (3.0 * k**2 * E * R * self.load / (math.pi * self.contact_modulus)) ** (1.0 / 3.0)

    @property
    def semi_minor(self) -> float:
        """Semi-axis b = a/k [m]."""
        return self.semi_major / self.ellipticity

    @property
    def mean_pressure(self) -> float:
        """Load over area [Pa]."""
        return self.load / (math.pi * self.semi_major * self.semi_minor)

    @property
    def maximum_pressure(self) -> float:
        """Pressure in the centre, 3/2 of the mean [Pa]."""
        return 1.5 * self.mean_pressure

    @property
    def approach(self) -> float:
        """Approach of distant points, delta = 3 W K / (2 pi a E*) [m]."""
        K = float(ellipk(1.0 - 1.0 / self.ellipticity**2))
        return 3.0 * self.load * K / (2.0 * math.pi * self.semi_major * self.contact_modulus)
