"""Bearings and shaft ends that carry one member, in engineering words."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal, get_args

from gearlube_core.checks import check_finite, check_option, check_positive, check_within
from gearlube_core.dynamics.helical_pair.supports.support_kernels import coupling_limit

Series = Literal["beam", "term_by_term"]
COUPLING_CURE = "A larger coupling would give energy away; raise the stiffness against tilting."
_STIFF = 1e13  # N/m, no bearing is as stiff


@dataclass(frozen=True, slots=True, kw_only=True)
class Bearing:
    """Linear stiffness of one bearing and where it sits.

    Parameters
    ----------
    position : float
        z of the bearing from the gear's mid-face [m]: +l1 or -l2.
    K_xx, K_yy, K_zz : float
        Along the line of action, off it and axial [N/m].
    K_theta_x, K_theta_y : float
        Against tilting [N.m/rad].
    K_x_theta_y, K_y_theta_x : float
        Coupling [N/rad].

    References
    ----------
    [he_2007 (26)]; its K_xz and K_z_theta_y drop out of (27) and are left out here.
    """

    position: float
    K_xx: float
    K_yy: float
    K_zz: float
    K_theta_x: float = 0.0
    K_theta_y: float = 0.0
    K_x_theta_y: float = 0.0
    K_y_theta_x: float = 0.0

    def __post_init__(self) -> None:
        check_within("position", self.position, -10.0, 10.0, "m", "Give metres, not millimetres.")
        for name in ("K_xx", "K_yy", "K_zz"):
            check_within(name, getattr(self, name), 0.0, _STIFF, "N/m")
        for name in ("K_theta_x", "K_theta_y"):
            check_within(name, getattr(self, name), 0.0, _STIFF, "N.m/rad")
        for name in ("K_x_theta_y", "K_y_theta_x"):
            check_finite(name, getattr(self, name), "N/rad")
        for a, b, c in (("xx", "theta_y", "x_theta_y"), ("yy", "theta_x", "y_theta_x")):
            limit = coupling_limit(float(getattr(self, f"K_{a}")), float(getattr(self, f"K_{b}")))
            check_within(f"K_{c}", getattr(self, f"K_{c}"), -limit, limit, "N/rad", COUPLING_CURE)


@dataclass(frozen=True, slots=True, kw_only=True)
class ShaftEnds:
    """Two stretches of a solid round shaft, from the gear body to each bearing.

    Parameters
    ----------
    radius : float
        [m]
    youngs_modulus : float
        [Pa]
    series : {"beam", "term_by_term"}
        Flexibilities of shaft end and bearing added as matrices; or term by term, [he_2007 (27)].

    References
    ----------
    [he_2007 (25)], taken per side: 3 E I/l^3, 3 E I/l^2, 3 E I/l, A E/l.
    """

    radius: float
    youngs_modulus: float
    series: Series = "beam"

    def __post_init__(self) -> None:
        check_positive("radius", self.radius, "m", "Give metres, not millimetres.")
        check_within("youngs_modulus", self.youngs_modulus, 1e9, 1e12, "Pa", "Steel: 2.07e11 Pa.")
        check_option("series", self.series, get_args(Series))

    @property
    def bending(self) -> float:
        """E I [N m2]."""
        return self.youngs_modulus * math.pi * self.radius**4 / 4.0

    @property
    def extension(self) -> float:
        """E A [N]."""
        return self.youngs_modulus * math.pi * self.radius**2


@dataclass(frozen=True, slots=True, kw_only=True)
class ShaftSupport:
    """Two bearings and, between them and the gear body, an elastic shaft or none.

    Parameters
    ----------
    first, second : Bearing
        At z = +l1 and z = -l2.
    shaft : ShaftEnds, optional
        Rigid without.
    """

    first: Bearing
    second: Bearing
    shaft: ShaftEnds | None = None

    def __post_init__(self) -> None:
        cure = "Bearing 1 sits at z = +l1, bearing 2 at z = -l2."
        check_positive("first.position", self.first.position, "m", cure)
        check_positive("-second.position", -self.second.position, "m", cure)


def symmetric_support(
    *, K_xx: float, K_yy: float, K_zz: float, distance: float, shaft: ShaftEnds | None = None
) -> ShaftSupport:
    """Return two equal bearings at +-`distance` [m] that share the totals K [N/m] evenly."""
    halves = {"K_xx": 0.5 * K_xx, "K_yy": 0.5 * K_yy, "K_zz": 0.5 * K_zz}
    return ShaftSupport(
        first=Bearing(position=distance, **halves),
        second=Bearing(position=-distance, **halves),
        shaft=shaft,
    )
