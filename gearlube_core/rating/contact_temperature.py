"""Temperature in a sliding contact by a moving band of heat, and the probability of scuffing."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from scipy.special import ndtr

from gearlube_core.arrays import Array
from gearlube_core.checks import check_positive
from gearlube_core.errors import ParameterError
from gearlube_core.units import ZERO_CELSIUS

STEEL_EFFUSIVITY = 13_780.0  # sqrt(k rho c) [W s^0.5/(m2 K)]
STEEL_DIFFUSIVITY = 12e-6  # k/(rho c) [m2/s]
_Number = Array | float


class ContactTemperature(NamedTuple):
    """Temperature along the way through contacts."""

    temperature: Array  # of both surfaces at the borders of the cells [K], shape (n + 1, ...)
    bulk: Array  # that the contact without friction has [K], shape (...)
    peclet: Array  # the smaller u a/(2 kappa)
    outside: tuple[str, ...]

    @property
    def flash(self) -> Array:
        """Greatest rise above `bulk` [K]."""
        return self.temperature.max(axis=0) - self.bulk


def contact_temperature(
    x: Array, heat: Array, speeds: tuple[_Number, _Number], bulk: tuple[_Number, _Number], *,
    half_width: _Number = 1.0, diffusivity: float = STEEL_DIFFUSIVITY,
    effusivity: tuple[float, float] = (STEEL_EFFUSIVITY, STEEL_EFFUSIVITY),
) -> ContactTemperature:  # fmt: skip
    """Return the temperature of two surfaces that pass a band of heat, of one contact or many.

    T(x) = T_M + 1/(pi^(1/2) (b1 u1^(1/2) + b2 u2^(1/2))) int q(s)/(x - s)^(1/2) ds
    T_M = (b1 u1^(1/2) T1 + b2 u2^(1/2) T2)/(b1 u1^(1/2) + b2 u2^(1/2))

    Exact for heat constant in cells that flows into the depth alone: for a Peclet number above 5.
    Heat divides so that both surfaces have one temperature at every place. ParameterError where
    x does not increase or the speeds differ in sign. Source: [blok_1937], [jaeger_1942].

    Parameters
    ----------
    x
        Borders of cells along the speeds over `half_width`, increasing, shape (n + 1,).
    heat
        Friction power per area in the cells, mu p |u1 - u2| or that of a solved film, of hypoid
        gears with the whole sliding speed [W/m2], shape (n, ...).
    speeds
        u1, u2 of both surfaces across the line of contact, relative to it, all of one sign [m/s];
        numbers or shape (...), as the next two.
    bulk, half_width
        T1, T2 of both bodies before the contact [K]; a [m], 1: x is in m.
    effusivity, diffusivity
        b1, b2 = (k rho c)^(1/2) [W s^0.5/(m2 K)]; k/(rho c), for the Peclet number [m2/s].

    Examples
    --------
    >>> x = np.linspace(-1.0, 1.0, 401)  # Hertz: 0.786 of Blok's unit
    >>> q = np.sqrt(1.0 - (x[:-1] + x[1:]) ** 2 / 4.0)
    >>> found = contact_temperature(x, q, (4.0, 1.0), (350.0, 350.0), half_width=1e-4)
    >>> unit = (math.pi / 2.0) * 1e-4 / (3.0 * STEEL_EFFUSIVITY * 1e-4**0.5)
    >>> round(float(found.flash / unit), 3)
    0.786
    """
    x, heat = np.asarray(x, dtype=float), np.asarray(heat, dtype=float)
    if x.ndim != 1 or heat.shape[:1] != (x.size - 1,) or not (np.diff(x) > 0.0).all():
        raise ParameterError(
            f"x must increase and have one more place than heat, got {x.shape} and {heat.shape}."
        )
    u1, u2 = (np.asarray(u, dtype=float) for u in speeds)
    backwards = bool((u1 < 0.0).all() and (u2 < 0.0).all())
    if backwards:
        x, heat, u1, u2 = -x[::-1], heat[::-1], -u1, -u2
    if not ((u1 > 0.0).all() and (u2 > 0.0).all()):
        raise ParameterError(
            f"All speeds must have one sign and not be 0, got {u1} and {u2} m/s. Take them "
            "relative to the line of contact."
        )
    a = np.asarray(half_width)
    first, second = effusivity[0] * np.sqrt(u1), effusivity[1] * np.sqrt(u2)
    T_M = (first * bulk[0] + second * bulk[1]) / (first + second)
    reach = np.sqrt(np.maximum(x[:, None] - x, 0.0))
    integral = 2.0 * np.tensordot(reach[:, :-1] - reach[:, 1:], heat, axes=1) * np.sqrt(a)
    rise = integral / (math.sqrt(math.pi) * (first + second))
    peclet = np.minimum(u1, u2) * 0.25 * (x[-1] - x[0]) * a / diffusivity
    least = float(peclet.min())
    outside = () if least > 5.0 else (f"Peclet number above 5, got {least:.2g}",)
    found = T_M + rise
    return ContactTemperature(found[::-1] if backwards else found, T_M, peclet, outside)


def scuffing_probability(contact: float, scuffing: float, *, spread: float = 0.15) -> float:
    """Return the probability of scuffing of a greatest contact temperature [-].

    Of the greatest temperature in the contact and the mean at which the oil scuffs [K], by a normal
    distribution whose deviation over the scuffing temperature in degC is `spread`. Below 0.1 the
    risk is called low, above 0.3 high; 0.15 is not checked against the source [agma_2003].

    >>> round(scuffing_probability(500.0, 500.0), 2), round(scuffing_probability(450.0, 560.0), 3)
    (0.5, 0.005)
    """
    check_positive("contact", contact, "K", "Give kelvin.")
    mean = check_positive("scuffing - 273.15", scuffing - ZERO_CELSIUS, "K", "Give kelvin.")
    return float(ndtr((contact - scuffing) / (spread * mean)))
