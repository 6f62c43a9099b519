"""Pressure near the border of a domain, to check whether the domain cuts the contact."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from gearlube_core.arrays import Array

_CUT = 0.01  # share of the largest pressure worth a word
_OFF = 0.02  # likewise of what it is off the oil beyond; 1.7 % go with films 0.7 % off
_END = 20.0  # film on the border over the film beside it, from where solids end there


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
