"""Solids that touch where a film vanishes: a thin layer that stiffens as it is pressed."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_positive, check_within

_STIFFEST = 0.05  # share of the layer below which its pressure rises along the tangent


@dataclass(frozen=True, slots=True, kw_only=True)
class SolidContact:
    """Layer on the solids that carries load where the film is thinner than it.

    p_s = p_half (t/h - 1)^2 where h < t, else 0

    Parameters
    ----------
    thickness
        t [m], both solids together: 0.1 nm to 1 um.
    pressure
        p_half at which the layer is half as thick [Pa], 1e6 to 1e12.

    Raises
    ------
    ParameterError
        A parameter is out of range.

    Notes
    -----
    What both solids press on each other is p = p_f + p_s: it bends them and carries the load.
    The oil has p_f alone: it flows by p_f and has the viscosity and density of p_f, as in the
    mean flow between asperities ([patir_cheng_1978]; [hu_zhu_2000]). So mass and
    load stay balanced where the solids touch. Where oil has no pressure left p = p_s.

    Greenwood and Tripp's asperities carry a bounded pressure at h = 0, less than a loaded tooth
    has; smooth solids need a law without bound, or the film would pass zero. This one is a
    barrier with a length and a pressure of its own, as boundary layers have: a pressure of 1 GPa
    leaves 5 nm of the 10 nm of the default, 9 GPa leave 2.5 nm. Thickness is a choice: films
    below it, and the area and the share of the load in contact, depend on it.

    Examples
    --------
    >>> layer = SolidContact()
    >>> round(1e9 * layer.film(1.0e9), 3)  # nm, half of the layer
    5.0
    """

    thickness: float = 10e-9
    pressure: float = 1.0e9

    def __post_init__(self) -> None:
        check_positive("thickness", self.thickness, "m")
        check_within("thickness", self.thickness, 1e-10, 1e-6, "m")
        check_within("pressure", self.pressure, 1e6, 1e12, "Pa")

    def __call__(self, film: Array) -> Array:
        """Return the pressure of the solids [Pa] at a film [m]."""
        return SolidLayer(self.thickness, self.pressure)(film)[0]

    def film(self, pressure: float) -> float:
        """Return the film [m] at which the solids carry a pressure [Pa]."""
        return float(SolidLayer(self.thickness, self.pressure).film(np.array(pressure)))


@dataclass(frozen=True, slots=True)
class SolidLayer:
    """The law of a `SolidContact` in any units of film and pressure."""

    thickness: float
    pressure: float

    def __call__(self, film: Array) -> tuple[Array, Array]:
        """Return pressure and its slope by the film, of the film's shape."""
        least = _STIFFEST * self.thickness
        h = np.clip(film, least, self.thickness)
        excess = self.thickness / h - 1.0
        slope = -2.0 * self.pressure * excess * self.thickness / (h * h)
        below = np.minimum(film - least, 0.0)
        return self.pressure * excess * excess + slope * below, slope

    def film(self, pressure: Array) -> Array:
        """Return the film at which the solids carry a pressure from zero on, of its shape."""
        return np.asarray(self.thickness / (1.0 + np.sqrt(pressure / self.pressure)))


@dataclass(frozen=True, slots=True)
class SolidLoad:
    """How far solids touch.

    Parameters
    ----------
    share
        Of the load that the solids carry [-].
    area
        Over which the film is thinner than the layer [m^2].
    largest
        Pressure of the solids [Pa].
    """

    share: float
    area: float
    largest: float

    @classmethod
    def of(cls, solids: SolidContact | None, film: Array, cells: Array, load: float) -> SolidLoad:
        """Return the load of the solids.

        Parameters
        ----------
        solids
            None: they carry nothing.
        film : ndarray
            [m].
        cells : ndarray
            Areas of the nodes [m^2], to be broadcast to the film.
        load
            [N].
        """
        if solids is None or not float(film.min()) < solids.thickness:
            return NO_CONTACT
        pressure = solids(film)
        area = float(((film < solids.thickness) * cells).sum())
        return cls(float((pressure * cells).sum()) / load, area, float(pressure.max()))

    @property
    def sentence(self) -> str:
        """Return a warning if the solids touch, else an empty string."""
        if self.area == 0.0:
            return ""
        return (
            f" The solids touch over {1e6 * self.area:.2g} mm2 and carry "
            f"{100.0 * self.share:.2g} % of the load, at most {1e-9 * self.largest:.2g} GPa."
        )


NO_CONTACT = SolidLoad(0.0, 0.0, 0.0)
