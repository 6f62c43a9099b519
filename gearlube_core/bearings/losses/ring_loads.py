"""Load of each roller between rigid rings, from the axial and the radial load of the bearing."""

from __future__ import annotations

import math

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.bearings.bearing_type import ShaftMotion
from gearlube_core.bearings.parameters import BearingParameters
from gearlube_core.bearings.roller_loads import roller_loads
from gearlube_core.kernels.jit import kernel

LARGEST_RATIO = 0.8  # of F_r tan(a)/F_a, where about half of the rollers carry load
_APPROACH = 1e-5  # m; the share of each roller is free of it
_HALVINGS = 60


@kernel
def _shares(angle: float, p: BearingParameters, out: Array) -> tuple[float, float]:
    # rollers under an axial and a radial approach in the ratio cos : sin; sums of w and w cos psi
    motion = ShaftMotion(
        _APPROACH * math.sin(angle) / p.cos_contact,
        0.0,
        _APPROACH * math.cos(angle) / p.sin_contact,
        0.0,
        0.0,
        0.0,
        0.0,
        0.0,
    )
    roller_loads(motion, 1.0, 1.0, 1.0, p, 1.0, out)
    total = radial = 0.0
    count = int(p.n_rollers)
    for i in range(count):
        total += out[i]
        radial += out[i] * math.cos(2.0 * math.pi * i / count)
    return total, radial


@kernel
def ring_loads(axial_load: float, radial_load: float, p: BearingParameters, out: Array) -> int:
    """Write the load of every roller on the outer race into `out`, the most loaded first.

    sum Q sin(a) = F_a,  sum Q cos(a) cos(psi) = F_r,
    Q ~ max(0, d_a sin(a) + d_r cos(a) cos(psi))^(10/9)

    Parameters
    ----------
    axial_load, radial_load
        F_a, F_r of the row, not negative [N].
    p
        Bearing without film, preload and loss, as `BearingGeometry.dry_rollers` returns it.
    out : ndarray, shape (>= n_rollers,)
        Receives Q [N].

    Returns
    -------
    int
        0; 1 where F_r tan(a)/F_a is above LARGEST_RATIO or F_a is not above 0: `out` is all zero.

    Notes
    -----
    Rigid, coaxial rings; the rollers are those of `roller_loads`, which the axle uses too. A roller
    stands under the load. All rollers carry load until F_r tan(a)/F_a is about 0.5.
    """
    count = int(p.n_rollers)
    wanted = radial_load * p.sin_contact / p.cos_contact
    if axial_load <= 0.0 or wanted > LARGEST_RATIO * axial_load:
        for i in range(count):
            out[i] = 0.0
        return 1
    low = 0.0
    high = 0.75 * math.pi
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        total, radial = _shares(middle, p, out)
        if radial < wanted / axial_load * total:
            low = middle
        else:
            high = middle
    total, _ = _shares(low, p, out)
    scale = axial_load / (p.sin_contact * total)
    for i in range(count):
        out[i] *= scale
    return 0


def roller_loads_between_rings(
    axial_load: float, radial_load: float, p: BearingParameters
) -> Array:
    """Return what `ring_loads` writes, shape (n_rollers,) [N]; nan where it finds none."""
    out = np.zeros(int(p.n_rollers))
    if ring_loads(axial_load, radial_load, p, out):
        out[:] = np.nan
    return out
