"""Temperature in a sliding contact by a moving band of heat, and the probability of scuffing."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from scipy.special import ndtr

from gearlube_core.arrays import Array
from gearlube_core.checks import check_positive
from gearlube_core.errors import ParameterError

STEEL_EFFUSIVITY = 13_780.0  # sqrt(k rho c) [W s^0.5/(m2 K)]
STEEL_DIFFUSIVITY = 12e-6  # k/(rho c) [m2/s]
_LEAST_PECLET = 5.0
_SPREAD = 0.15  # of the scuffing temperature [degC], standard deviation
_ZERO = 273.15


class ContactTemperature(NamedTuple):
    """Temperature along the way through a contact."""

    x: Array  # ends of the cells [m]
    temperature: Array  # of both surfaces [K]
    bulk: float  # that a contact without friction has [K]
    peclet: float  # the smaller u a/(2 kappa)
    outside: tuple[str, ...]

    @property
    def flash(self) -> float:
        """Greatest rise above `bulk` [K]."""
        return float(self.temperature.max() - self.bulk)


def contact_temperature(
    x: Array,
    heat: Array,
    speeds: tuple[float, float],
    bulk: tuple[float, float],
    *,
    effusivity: tuple[float, float] = (STEEL_EFFUSIVITY, STEEL_EFFUSIVITY),
    diffusivity: float = STEEL_DIFFUSIVITY,
) -> ContactTemperature:
    """Return the temperature of two surfaces that pass a band of heat.

    T(x) = T_M + 1/(pi^(1/2) (b1 u1^(1/2) + b2 u2^(1/2))) int q(s)/(x - s)^(1/2) ds
    T_M = (b1 u1^(1/2) T1 + b2 u2^(1/2) T2)/(b1 u1^(1/2) + b2 u2^(1/2))

    Parameters
    ----------
    x
        Borders of cells along the speeds [m], increasing, shape (n + 1,).
    heat
        Friction power per area in the cells, mu p |u1 - u2| or that of a solved film, of hypoid
        gears with the whole sliding speed [W/m2], shape (n,).
    speeds
        u1, u2 of both surfaces across the line of contact, relative to it, of one sign [m/s].
    bulk
        T1, T2 of both bodies before the contact [K].
    effusivity
        b1, b2 = (k rho c)^(1/2) [W s^0.5/(m2 K)].
    diffusivity
        k/(rho c), for the Peclet number [m2/s].

    Raises
    ------
    ParameterError

    Notes
    -----
    Exact for heat constant in cells that flows into the depth alone: for a Peclet number above 5.
    Heat divides so that both surfaces have one temperature at every place.
    Source: [blok_1937], [jaeger_1942].

    Examples
    --------
    >>> x = np.linspace(-1e-4, 1e-4, 401)  # Hertz: 0.786 of Blok's unit
    >>> q = np.sqrt(1.0 - (x[:-1] + x[1:]) ** 2 / 4e-8)
    >>> found = contact_temperature(x, q, (4.0, 1.0), (350.0, 350.0))
    >>> unit = (math.pi / 2.0) * 1e-4 / (3.0 * STEEL_EFFUSIVITY * 1e-4**0.5)
    >>> round(found.flash / unit, 3)
    0.786
    """
    x, heat = np.asarray(x, dtype=float), np.asarray(heat, dtype=float)
    if x.ndim != 1 or heat.shape != (x.size - 1,) or not (np.diff(x) > 0.0).all():
        raise ParameterError(
            f"x must increase and have one more place than heat, got {x.shape} and {heat.shape}."
        )
    u1, u2 = speeds
    if not u1 * u2 > 0.0:
        raise ParameterError(
            f"Both speeds must have one sign and not be 0, got {u1:g} and {u2:g} m/s. Take them "
            "relative to the line of contact."
        )
    if u1 < 0.0:
        turned = contact_temperature(
            -x[::-1], heat[::-1], (-u1, -u2), bulk, effusivity=effusivity, diffusivity=diffusivity
        )
        return turned._replace(x=x, temperature=turned.temperature[::-1])
    takes = effusivity[0] * math.sqrt(u1), effusivity[1] * math.sqrt(u2)
    T_M = (takes[0] * bulk[0] + takes[1] * bulk[1]) / sum(takes)
    reach = np.sqrt(np.maximum(x[:, None] - x, 0.0))
    rise = 2.0 * (reach[:, :-1] - reach[:, 1:]) @ heat / (math.sqrt(math.pi) * sum(takes))
    peclet = min(u1, u2) * 0.25 * (x[-1] - x[0]) / diffusivity
    outside = () if peclet > _LEAST_PECLET else (f"Peclet number above 5, got {peclet:.2g}",)
    return ContactTemperature(x, T_M + rise, T_M, peclet, outside)


def scuffing_probability(contact: float, scuffing: float, *, spread: float = _SPREAD) -> float:
    """Return the probability of scuffing of a greatest contact temperature [-].

    A normal distribution whose deviation is a share of the scuffing temperature in degC. Below 0.1
    the risk is called low, above 0.3 high; the share is not checked against the source [agma_2003].

    Parameters
    ----------
    contact, scuffing
        Greatest temperature in the contact, and the mean at which the oil scuffs [K].
    spread
        Standard deviation over the scuffing temperature in degC [-].

    Examples
    --------
    >>> round(scuffing_probability(500.0, 500.0), 2), round(scuffing_probability(450.0, 560.0), 3)
    (0.5, 0.005)
    """
    check_positive("contact", contact, "K", "Give kelvin.")
    mean = check_positive("scuffing - 273.15", scuffing - _ZERO, "K", "Give kelvin.")
    return float(ndtr((contact - scuffing) / (spread * mean)))
