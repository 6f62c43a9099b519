"""Elastic contact of a periodic rough patch with a plane, without oil."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_positive
from gearlube_core.contact.unilateral import solve_torque
from gearlube_core.contact.unilateral_problem import UnilateralProblem
from gearlube_core.surface.heights import HeightMap, check_closed, check_plausible


@dataclass(frozen=True, eq=False, slots=True, kw_only=True)
class PatchContact:
    """A patch pressed on a plane.

    Parameters
    ----------
    mean_pressure
        Load over the whole area [Pa].
    film
        Mean distance of both bent surfaces [m]. Pressure that is spread evenly bends none of them,
        so it is the distance of the mean planes too.
    contact_share
        Share of the points that press [-].
    pressure
        [Pa], shape (nx, ny).
    gap
        [m], shape (nx, ny).
    """

    mean_pressure: float
    film: float
    contact_share: float
    pressure: Array
    gap: Array


def press_patch(
    patch: HeightMap,
    mean_pressure: float,
    contact_modulus: float,
    start: Array | None = None,
    *,
    tolerance: float = 1e-6,
) -> PatchContact:
    """Return the dry, frictionless elastic contact of a rough patch with a smooth plane.

    u_k = 2 p_k/(E* |k|) for each wave k of the pressure, k = 0 left out

    Parameters
    ----------
    patch
        Periodic heights of both surfaces together [m]; their mean is subtracted.
    mean_pressure
        Mean pressure [Pa], above zero.
    contact_modulus
        E* [Pa].
    start
        Pressure to start from [Pa], shape (nx, ny), e.g. that at a lower load.
    tolerance
        Largest root mean square error of the pressure over the mean pressure [-].

    Raises
    ------
    ParameterError
        The patch is not periodic, or a number is not above zero.
    ConvergenceError
        No contact was found.

    Notes
    -----
    Half-spaces, small slopes, no plastic flow: at light loads the mean pressure over the contact is
    near E* times half of the rms slope, which steel with slopes above 0.05 cannot bear.
    Published theories and solutions have areas of 1.6 to 2.5 times p/(E* rms slope)
    [campana_mueser_2007] and p ~ exp(-film/(0.48 sigma)) [almqvist_2011].
    Source of the compliance: [johnson_1985 sec. 13.2]; of the solver: [polonsky_keer_1999].

    Examples
    --------
    >>> crests = np.cos(2.0 * np.pi * np.arange(64) / 64)[:, None] + np.zeros(8)
    >>> wave = HeightMap(height=1e-7 * crests, spacing=(1e-6, 1e-6), periodic=(True, True))
    >>> round(press_patch(wave, 2.3e8, 1e11).contact_share, 2)
    0.48
    """
    check_positive("mean_pressure", mean_pressure, "Pa")
    check_positive("contact_modulus", contact_modulus, "Pa")
    check_closed(patch)
    check_plausible(patch)
    shape, (dx, dy) = patch.height.shape, patch.spacing
    area = dx * dy
    k_x = 2.0 * math.pi * np.fft.fftfreq(shape[0], dx)
    k_y = 2.0 * math.pi * np.fft.rfftfreq(shape[1], dy)
    wave = np.hypot(k_x[:, None], k_y)
    # an even pressure gets the softness of the longest wave; it only moves the approach
    wave[0, 0] = min(wave[1, 0], wave[0, 1])
    softness = 2.0 / (contact_modulus * area * wave)

    def compliance(forces: Array) -> Array:
        waves = np.fft.rfft2(forces.reshape(shape))
        return np.fft.irfft2(waves * softness, shape).ravel()

    height = (patch.height - patch.height.mean()).ravel()
    problem = UnilateralProblem(
        compliance=compliance,
        gap=-height,
        arm=np.ones(height.size),
        cell_area=np.full(height.size, area),
    )
    found = solve_torque(
        problem,
        mean_pressure * area * height.size,
        tolerance=tolerance,
        start=None if start is None else (start * area).ravel(),
    )
    gap = found.separation.reshape(shape)
    return PatchContact(
        mean_pressure=mean_pressure,
        film=float(gap.mean()),
        contact_share=float(found.touching.mean()),
        pressure=found.pressure.reshape(shape),
        gap=gap,
    )
