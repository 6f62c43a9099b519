"""Oil pressure around a point contact: far outside it, and at the border of a grid."""

from __future__ import annotations

import math
from functools import lru_cache
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.oil.film_oil import FilmOil, pressure_viscosity

_CUT = 0.01  # share of the largest pressure worth a word
_OFF = 0.02  # likewise of what it is off the oil beyond; 1.7 % go with films 0.7 % off
_END = 20.0  # film on the border over the film beside it, from where solids end there
_ANGLES = 240
_ALONG, _OUTWARD = 16, 8  # Gauss points along a side of the domain and from it to infinity
_LEAST_GAP = 0.25  # of the undeformed gap: the film far away is taken no thinner
_THICKEST = 0.5  # reduced pressure times alpha, taken no larger; from 1 on there is no pressure


class BorderPressure(NamedTuple):
    """Largest pressure one node from the border.

    Parameters
    ----------
    share
        Over the largest pressure of all [-].
    side
        Of the domain: "small x", "large x", "small y" or "large y".
    open
        Oil goes on beyond the border: the share is what the pressure is off that of the oil.
    """

    share: float
    side: str
    open: bool = False

    @property
    def sentence(self) -> str:
        """Return a warning if the domain cuts the contact, else an empty string."""
        if not self.share > (_OFF if self.open else _CUT):
            return ""
        words = "off that of the oil beyond by" if self.open else "is"
        return (
            f" The domain cuts the contact: pressure one node from the border at {self.side} "
            f"{words} {100.0 * self.share:.2g} % of the largest. Widen the domain there."
        )


def border_pressure(
    pressure: Array, film: Array, beyond: Array | None = None, *, closed: bool = False
) -> BorderPressure:
    """Return the largest pressure one node from the border, and the side it lies on.

    A border where the film is twenty times that of the node beside it is an end of the solids,
    such as the side face of a tooth: pressure beside it is no sign of a cut.

    Parameters
    ----------
    pressure, film : ndarray
        Of any unit, shape (nx, ny), 3 nodes and more either way.
    beyond : ndarray, shape (nx, ny), or None
        Pressure one node from the border of oil that goes on beyond it; None: it does not.
    closed
        The sides along y are closed: pressure there is no sign of a cut.
    """
    off = pressure if beyond is None else abs(pressure - beyond)
    sides = {
        "small x": (off[1], film[1], film[0]),
        "large x": (off[-2], film[-2], film[-1]),
        "small y": (off[:, 1], film[:, 1], film[:, 0]),
        "large y": (off[:, -2], film[:, -2], film[:, -1]),
    }
    if closed:
        sides = {name: side for name, side in sides.items() if name.endswith("x")}
    highest = float(pressure.max())
    found = BorderPressure(0.0, "", beyond is not None)
    for side, (beside, thin, thick) in sides.items():
        largest = float(np.where(thick < _END * thin, beside, 0.0).max())
        if largest > found.share * highest:
            found = found._replace(share=largest / highest, side=side)
    return found


def _gauss(count: int) -> tuple[Array, Array]:
    # nodes and weights from 0 to 1
    nodes, weights = np.polynomial.legendre.leggauss(count)
    return 0.5 + 0.5 * nodes, 0.5 * weights


@lru_cache(maxsize=64)  # every grid and step of a problem asks for the same
def angular_flow(R_x: float, R_y: float, velocity: tuple[float, float]) -> tuple[Array, Array]:
    """Return angles and G = p h^2/(12 eta0 r) far away.

    With h = kappa r^2 and p = 12 eta0 g(theta)/r^3: (kappa^3 g')' - 9 kappa^3 g = velocity
    grad(h)/r where g > 0, the left side not above the right where g = 0: the film is broken.

    Parameters
    ----------
    R_x, R_y
        Relative radii of curvature [m].
    velocity
        Of entrainment along x and y [m/s].

    Returns
    -------
    tuple of ndarray, shape (240,), read-only
        theta [rad] from -pi on, G [m/s].
    """
    theta = np.linspace(-math.pi, math.pi, _ANGLES, endpoint=False)
    step = theta[1] - theta[0]

    def curvature(angle: Array) -> Array:
        return np.asarray(0.5 * (np.cos(angle) ** 2 / R_x + np.sin(angle) ** 2 / R_y))

    face = curvature(theta + 0.5 * step) ** 3 / step**2  # behind every angle
    before, here = np.roll(face, 1), np.arange(_ANGLES)
    matrix = np.zeros((_ANGLES, _ANGLES))
    matrix[here, here] = -(face + before) - 9.0 * curvature(theta) ** 3
    matrix[here, (here + 1) % _ANGLES] = face
    matrix[here, here - 1] = before
    right = velocity[0] * np.cos(theta) / R_x + velocity[1] * np.sin(theta) / R_y
    pressed, g = right < 0.0, np.zeros(_ANGLES)
    for _ in range(_ANGLES):
        g[:] = 0.0
        g[pressed] = np.linalg.solve(matrix[np.ix_(pressed, pressed)], right[pressed])
        wanted = np.where(pressed, g > 0.0, matrix @ g > right)
        if (wanted == pressed).all():
            break
        pressed = wanted
    flow = np.maximum(g, 0.0) * curvature(theta) ** 2
    theta.setflags(write=False)
    flow.setflags(write=False)
    return theta, flow


class FarField:
    """Pressure of the oil outside a domain around the contact of two paraboloids.

    Parameters
    ----------
    R_x, R_y
        Relative radii of curvature [m].
    entrainment
        Mean surface velocity along x and y [m/s].
    load
        W [N].
    contact_modulus
        E* [Pa].
    lubricant
        Oil of the contact, in SI.
    x_limits, y_limits
        Of the domain [m]; zero lies inside.

    Notes
    -----
    Between rigid solids with h = h_0 + kappa(theta) r^2 pressure is 12 eta0 G(theta) r/h^2, with
    the Reynolds condition where the film breaks: exact towards the inlet, where it is that of
    [kapitza_1955], elsewhere where h_0 is small beside h. Solids that flatten add to h what a
    point force displaces, W/(pi E* r). The reduced pressure of oil that thickens as
    exp(alpha p) is the same. What else comes from the middle of the contact falls by three more
    powers of distance.
    """

    def __init__(
        self,
        *,
        R_x: float,
        R_y: float,
        entrainment: tuple[float, float],
        load: float,
        contact_modulus: float,
        lubricant: FilmOil,
        x_limits: tuple[float, float],
        y_limits: tuple[float, float],
    ) -> None:
        self._radii = R_x, R_y
        self._alpha = pressure_viscosity(lubricant)
        self._pull = load / (math.pi * contact_modulus)
        along, across = map(float, entrainment)
        self._theta, flow = angular_flow(R_x, R_y, (along, across))
        self._flow = 12.0 * lubricant.eta0 * flow
        (x0, x1), (y0, y1) = x_limits, y_limits
        corners = np.array([(x0, y0), (x1, y0), (x1, y1), (x0, y1), (x0, y0)])
        sides, shares = _gauss(_ALONG)
        out, out_shares = _gauss(_OUTWARD)
        places, areas = [], []
        for start, end in pairwise(corners):
            side = end - start
            points = start + sides[:, None] * side
            spread = abs(points[:, 0] * side[1] - points[:, 1] * side[0]) * shares
            places.append((points[:, None, :] / out[None, :, None]).reshape(-1, 2))
            areas.append((spread[:, None] * (out_shares / out**3)[None, :]).ravel())
        self._places, self._areas = np.concatenate(places).T, np.concatenate(areas)

    def pressure(
        self, x: Array, y: Array, approach: float, thickening: float = 1.0
    ) -> tuple[Array, Array]:
        """Return the pressure [Pa] at points far from the middle and its slope by h_0 [Pa/m].

        Parameters
        ----------
        x, y : ndarray
            Of the points [m], one shape.
        approach
            h_0 [m].
        thickening
            Multiple of the viscosity [-].
        """
        r = np.hypot(x, y)
        undeformed = 0.5 * (x * x / self._radii[0] + y * y / self._radii[1])
        film = np.maximum(approach + undeformed + self._pull / r, _LEAST_GAP * undeformed)
        flow = np.interp(np.arctan2(y, x), self._theta, self._flow, period=2.0 * math.pi)
        reduced = thickening * flow * r / film**2
        slope = np.where(film > _LEAST_GAP * undeformed, -2.0 * reduced / film, 0.0)
        if self._alpha == 0.0:
            return reduced, slope
        thin = 1.0 - np.minimum(self._alpha * reduced, _THICKEST)
        slope[thin == 1.0 - _THICKEST] = 0.0
        return -np.log(thin) / self._alpha, slope / thin

    def load(self, approach: float, thickening: float = 1.0) -> tuple[float, float]:
        """Return the load [N] that the oil outside the domain carries and its slope [N/m]."""
        x, y = self._places
        pressure, slope = self.pressure(x, y, approach, thickening)
        return float(pressure @ self._areas), float(slope @ self._areas)
