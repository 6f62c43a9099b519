"""Flow factors and asperity load over the film ratio: means over patches."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import xarray as xr

from gearlube_core.arrays import Array
from gearlube_core.checks import check_positive, check_within
from gearlube_core.contact.unilateral import solve_torque
from gearlube_core.contact.unilateral_problem import UnilateralProblem
from gearlube_core.errors import ParameterError
from gearlube_core.progress import Progress, no_progress
from gearlube_core.rough_patch.flow import FlowFactors, flow_factors
from gearlube_core.surface.generator import generated_map
from gearlube_core.surface.generator_request import RoughnessRequest
from gearlube_core.surface.heights import HeightMap, check_closed, check_plausible

_WIDEST = 1000.0  # film ratio; roughness no longer matters by far
FILM_RATIOS = (0.5, 0.75, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0)
_UNIT = 1.0e11  # Pa: E* of the contact; only ratios to it come out
_LOADS = np.geomspace(5e-5, 0.8, 14)  # mean pressure over E* and the rms slope [-]
_FACTORS = ("pressure_x", "pressure_y", "pressure_xy", "shear_x", "contact_share")
_WORDS = {
    "pressure_x": "pressure flow factor along x",
    "pressure_y": "pressure flow factor along y",
    "pressure_xy": "flow along y by a slope along x",
    "shear_x": "shear flow factor along x of one rough surface",
    "contact_share": "share of the area where heights overlap",
    "mean_film": "mean local film over the rms height",
    "asperity_pressure": "mean pressure of asperities over E*",
    "asperity_area": "share of the area in elastic contact",
}


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


def gaussian_patches(
    roughness: float,
    length_x: float,
    length_y: float,
    seeds: Sequence[int],
    *,
    nodes: int = 256,
    nodes_per_length: float = 16.0,
) -> list[HeightMap]:
    """Return periodic rough patches with Gaussian heights and autocorrelation, for `patch_table`.

    Parameters
    ----------
    roughness
        RMS height [m].
    length_x, length_y
        Lengths along x and y over which the autocorrelation falls to 0.2 [m].
    seeds
        Seeds of the random numbers; one patch for each.
    nodes
        Number of nodes along each side.
    nodes_per_length
        Nodes per correlation length; each side of a patch is `nodes/nodes_per_length` correlation
        lengths long.

    Examples
    --------
    >>> patch = gaussian_patches(4e-7, 1e-5, 3e-5, [1], nodes=64)[0]
    >>> round(1e7 * float(patch.height.std()), 6), patch.spacing[1] / patch.spacing[0]
    (4.0, 3.0)
    """
    check_positive("roughness", roughness, "m")
    check_within("nodes", nodes, 16, 1024)
    check_positive("length_x", length_x, "m")
    check_positive("length_y", length_y, "m")
    request = RoughnessRequest(
        root_mean_square=roughness, correlation_length=length_x, autocorrelation="gaussian"
    )
    side, stretched = (one * nodes / nodes_per_length for one in (length_x, length_y))
    # alike along x and y, then drawn out along y
    alike = [
        generated_map(request, (side, side), (nodes, nodes), np.random.default_rng(seed)).surface
        for seed in seeds
    ]
    return [replace(one, spacing=(side / nodes, stretched / nodes)) for one in alike]


def patch_table(
    patches: Sequence[HeightMap],
    film_ratios: Sequence[float] = FILM_RATIOS,
    *,
    contact: bool = True,
    progress: Progress = no_progress,
) -> xr.Dataset:
    """Return flow factors and asperity load over the film ratio, as means over several patches.

    Parameters
    ----------
    patches
        Periodic patches of one kind: seeds of one generator or cuts of one surface.
    film_ratios
        Distance of the mean planes divided by the RMS height of each patch [-], rising.
    contact
        True: solve the dry elastic contact too; its loads are for film ratios of about 0 to 4.
    progress
        Called with the share done.

    Returns
    -------
    xr.Dataset
        Over `film_ratio` the mean of each factor and, as `..._spread`, its standard deviation over
        the patches (NaN if there is one): pressure_x, pressure_y, pressure_xy, shear_x,
        contact_share, mean_film and, with contact, asperity_pressure (over E*) and asperity_area.
        NaN outside the loads that were solved.

    Examples
    --------
    >>> patches = gaussian_patches(4e-7, 1e-5, 1e-5, [1, 2], nodes=32, nodes_per_length=8)
    >>> found = patch_table(patches, [3.0, 6.0], contact=False)
    >>> bool(found.pressure_x[0] < found.pressure_x[1] < 1.0)
    True
    """
    ratios = np.array(film_ratios, dtype=float)
    rising = ratios.size > 0 and ratios.min() > 0.0 and bool((np.diff(ratios) > 0.0).all())
    if not patches or not rising or not np.isfinite(ratios).all() or ratios.max() > _WIDEST:
        raise ParameterError(
            "patch_table must have at least one patch and rising film ratios above 0 and up to "
            f"{_WIDEST:g}, got {len(patches)} patches and {ratios.tolist()}. Typical film ratios "
            "are 0.5 to 6."
        )
    total = len(patches) * (ratios.size + (_LOADS.size if contact else 0))
    done = 0
    columns: list[dict[str, Array]] = []
    for k, patch in enumerate(patches):
        sigma = float(patch.height.std())
        rows: list[FlowFactors] = []
        for ratio in ratios:
            rows.append(flow_factors(patch, float(ratio) * sigma))
            done += 1
            progress(done / total, f"flow, patch {k + 1} of {len(patches)}")
        column = {name: np.array([getattr(row, name) for row in rows]) for name in _FACTORS}
        column["mean_film"] = np.array([row.mean_film for row in rows]) / sigma
        if contact:
            pressure, area = _asperities(patch, ratios)
            column |= {"asperity_pressure": pressure, "asperity_area": area}
            done += _LOADS.size
            progress(done / total, f"contact, patch {k + 1} of {len(patches)}")
        columns.append(column)
    data = {}
    for name in columns[0]:
        values = np.array([column[name] for column in columns])
        spread = values.std(axis=0, ddof=1) if len(patches) > 1 else np.full(ratios.size, math.nan)
        data[name] = _noted(values.mean(axis=0), _WORDS[name])
        data[f"{name}_spread"] = _noted(spread, f"standard deviation of: {_WORDS[name]}")
    coordinate = _noted(ratios, "distance of the mean planes over the rms height")
    attributes = {
        "patches": len(patches),
        "roughness": float(np.mean([one.height.std() for one in patches])),
        "rms_slope": float(np.mean([_slope(one) for one in patches])),
        "nodes": "x".join(map(str, patches[0].height.shape)),
    }
    return xr.Dataset(data, {"film_ratio": coordinate}, attributes)


def _asperities(patch: HeightMap, ratios: Array) -> tuple[Array, Array]:
    """Return mean pressure over E* and contact area at film ratios, between solved loads."""
    sigma, slope = float(patch.height.std()), _slope(patch)
    found, start = [], None
    for load in _LOADS:
        contact = press_patch(patch, float(load) * _UNIT * slope, _UNIT, start, tolerance=1e-5)
        start = contact.pressure
        found.append(
            (contact.film / sigma, math.log(load * slope), math.log(contact.contact_share))
        )
    films, pressures, areas = np.array(found[::-1]).T  # films rise
    inside = (ratios >= films[0]) & (ratios <= films[-1])
    return tuple(  # type: ignore[return-value]
        np.where(inside, np.exp(np.interp(ratios, films, one)), math.nan)
        for one in (pressures, areas)
    )


def _slope(patch: HeightMap) -> float:
    """Return the rms slope of a periodic map, of its Fourier series [-]."""
    nx, ny = patch.height.shape
    k_x = 2.0 * math.pi * np.fft.fftfreq(nx, patch.spacing[0])
    k_y = 2.0 * math.pi * np.fft.fftfreq(ny, patch.spacing[1])
    power = np.abs(np.fft.fft2(patch.height)) ** 2 * (k_x[:, None] ** 2 + k_y**2)
    return float(math.sqrt(power.sum()) / patch.height.size)


def _noted(values: Array, words: str) -> tuple[str, Array, dict[str, str]]:
    return "film_ratio", values, {"units": "1", "long_name": words}
