"""Friction torque of radial shaft seals."""

from __future__ import annotations

import math
from typing import Literal, get_args

from gearlube_core.checks import check_option, check_within
from gearlube_core.kernels.jit import kernel

SealMaterial = Literal["fkm", "nbr"]
# N.m per mm of shaft diameter, [iso_tr_14179_1]; not compared with the printed source
_PER_MILLIMETRE = {"fkm": 3.737e-3, "nbr": 2.429e-3}
SMOOTHING_SPEED = 1.0  # rad/s, below which the torque falls to zero; choice of this library


def seal_torque(diameter: float, material: SealMaterial = "fkm") -> float:
    """Return the friction torque of a radial shaft seal [N.m], free of speed.

    Parameters
    ----------
    diameter
        Of the shaft under the lip [m], 0.005 to 0.5.
    material
        Fluorocarbon or nitrile rubber.

    Notes
    -----
    Seals of one size differ by a factor of two, with their spring, wear and the oil.

    References
    ----------
    [iso_tr_14179_1]

    Examples
    --------
    >>> round(seal_torque(0.040), 3)
    0.149
    """
    check_within("diameter", diameter, 5e-3, 0.5, "m", "40 mm is 0.04 m.")
    check_option("material", material, get_args(SealMaterial))
    return 1e3 * diameter * _PER_MILLIMETRE[material]


@kernel
def seal_drag(speed: float, torque: float) -> float:
    """Return the torque of a seal with the sign of the speed [rad/s], smooth through rest."""
    return torque * speed / math.sqrt(speed * speed + SMOOTHING_SPEED * SMOOTHING_SPEED)
