"""Strength under the surface of a flank: hardness over depth, and fracture of the flank."""

from __future__ import annotations

from functools import cache
from typing import NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_positive, check_within
from gearlube_core.contact.dang_van import passage_history
from gearlube_core.contact.half_space_stress import HalfSpaceStress
from gearlube_core.errors import ParameterError

_PLANES = 90
_SHARE, OFFSET = 0.4, 0.04  # of the shear strength over hardness [MPa], and on the utilisation
# of a passing line load, over its half width: way to both sides, nodes, depths
_FAR, _NODES = 16.0, 769
PASSAGE_DEPTHS = np.geomspace(0.1, 8.0, 60)


class CaseHardening(NamedTuple):
    """Hardness over depth of a case-hardened flank, see `hardness_profile`.

    >>> CaseHardening(surface=720.0, core=342.0, case_depth=0.8e-3).core
    342.0
    """

    surface: float  # HV [-]
    core: float  # HV [-]
    case_depth: float  # at 550 HV [m]


def hardness_profile(depth: Array, *, surface: float, core: float, case_depth: float) -> Array:
    """Return the hardness HV of a case-hardened flank over depth, after Lang.

    HV = core + (surface - core) 10^(-0.0381 x - 0.2662 x^2), x = depth/case_depth

    Parameters
    ----------
    depth
        Below the surface [m].
    surface, core
        HV of both [-].
    case_depth
        CHD at 550 HV [m].

    Notes
    -----
    Source: [iso_6336_4].

    Examples
    --------
    >>> at = hardness_profile(np.array([1.1e-3]), surface=720.0, core=342.0, case_depth=0.5e-3)
    >>> round(float(at[0]), 1)
    358.0
    """
    check_within("case_depth", case_depth, 1e-5, 0.02, "m", "0.5 mm is 5e-4 m.")
    check_within("core", core, 100.0, 800.0, "HV", "300 to 450 is usual.")
    check_within("surface", surface, core, 1200.0, "HV", "650 to 800 is usual.")
    x = np.asarray(depth, dtype=float) / case_depth
    return core + (surface - core) * 10.0 ** (-0.0381 * x - 0.2662 * x * x)


def shear_amplitude(history: Array) -> Array:
    """Return the greatest amplitude of shear of any plane along the line of contact [Pa].

    Half of the range over time, the greatest over planes that turn about y. Under a Hertz line load
    without friction it is 0.25 p0 at a depth of half of the half width.

    Parameters
    ----------
    history
        Stress over time in the material [Pa]: xx, yy, zz, xy, yz, xz, shape (steps, 6, ...), x
        along the motion and z into the depth, as `passage_history` returns it.

    Examples
    --------
    >>> turn = np.linspace(0.0, 2.0 * np.pi, 25)
    >>> history = np.zeros((25, 6))
    >>> history[:, 5] = 100e6 * np.cos(turn)
    >>> round(1e-6 * float(shear_amplitude(history)))
    100
    """
    stress = np.asarray(history, dtype=float)
    if stress.ndim < 2 or stress.shape[1] != 6 or stress.shape[0] < 2:
        raise ParameterError(f"history must have the shape (steps, 6, ...), got {stress.shape}.")
    half, shear = 0.5 * (stress[:, 2] - stress[:, 0]), stress[:, 5]
    found = np.zeros(stress.shape[2:])
    for turned in np.linspace(0.0, np.pi, _PLANES, endpoint=False):
        on_plane = half * np.sin(turned) + shear * np.cos(turned)
        found = np.maximum(found, 0.5 * np.ptp(on_plane, axis=0))
    return found


@cache
def line_passage(friction: float) -> Array:
    """Return stress over time under a Hertz line load that passes, over its largest pressure.

    At `PASSAGE_DEPTHS`, (steps, 6, depths), for Poisson's ratio 0.3. `friction` is the shear on the
    surface across the line over the pressure [-]. Not to be written into.
    """
    x = np.linspace(-_FAR, _FAR, _NODES)
    pressure = np.sqrt(np.maximum(1.0 - x * x, 0.0))[:, None] + np.zeros(2)
    stress = HalfSpaceStress(
        pressure=pressure, spacing=(float(x[1] - x[0]), 1.0), poisson_ratio=0.3,
        traction_x=friction * pressure, periodic=(False, True),
    )  # fmt: skip
    return passage_history(np.stack([stress(float(z))[:, :, 0] for z in PASSAGE_DEPTHS], axis=-1))


@cache
def _line_shear(friction: float) -> Array:
    return shear_amplitude(line_passage(friction))


def line_shear_amplitude(
    depth: Array, pressure: Array, half_width: Array, *, friction: float = 0.0
) -> Array:
    """Return `shear_amplitude` under a Hertz line load that passes [Pa].

    For depth [m], largest pressure [Pa] and half width [m], whose shapes broadcast; `friction` as
    of `line_passage`. Below 8 half widths it falls as 1/depth, as under a narrow load. Above a
    tenth of the half width it is linear from 0 at the surface, where friction alone shears.

    Examples
    --------
    >>> round(1e-6 * float(line_shear_amplitude(0.25e-3, 1e9, 0.5e-3)))  # MPa
    250
    """
    ratio = np.asarray(depth) / half_width
    over = np.interp(ratio, [0.0, *PASSAGE_DEPTHS], [0.0, *_line_shear(friction)])
    return np.asarray(pressure * over * np.minimum(1.0, PASSAGE_DEPTHS[-1] / ratio))


class FlankFracture(NamedTuple):
    """Utilisation of the material over depth, in the manner of ISO/TS 6336-4:2019."""

    depth: Array  # [m]
    strength: Array  # tau_per [Pa]
    utilisation: Array  # A_FF [-]
    outside: tuple[str, ...]

    @property
    def worst(self) -> tuple[float, float]:
        """Greatest A_FF [-], and its depth [m]; 1: the shear reaches what the hardness bears.

        The risk begins at about 0.8, a number not checked against the source.
        """
        n = int(np.nanargmax(self.utilisation))
        return float(self.utilisation.flat[n]), float(self.depth.flat[n])


def flank_fracture(
    depth: Array,
    stress: Array,
    hardness: Array,
    *,
    half_width: float | Array,
    material: float = 1.0,
    residual: Array | None = None,
) -> FlankFracture:
    """Return how far the shear under a flank uses up the strength that the hardness gives.

    A_FF = tau_eff/tau_per + 0.04, tau_per = 0.4 K_mat HV [MPa]

    Parameters
    ----------
    depth
        Of the points [m], of any shape but a single number.
    stress
        Shear there [Pa], such as `shear_amplitude`; the fit of the standard was not seen, so that
        the result is in its manner only.
    hardness
        HV there, see `hardness_profile`.
    half_width
        Of the contact [m], one number or one for each point; above this depth the method does not
        hold, and A_FF is not a number.
    material
        K_mat [-].
    residual
        Shear that residual stress takes off [Pa].

    Notes
    -----
    Source: [iso_6336_4].

    Examples
    --------
    >>> found = flank_fracture(
    ...     np.array([1.1e-3]), np.array([165.518e6]), np.array([358.05]), half_width=0.67e-3,
    ...     material=1.026,
    ... )
    >>> round(found.worst[0], 2)
    1.17
    """
    z, tau, HV = (np.asarray(one, dtype=float) for one in (depth, stress, hardness))
    if not z.shape == tau.shape == HV.shape or z.ndim < 1 or not np.isfinite(HV).all():
        raise ParameterError(
            "depth, stress and hardness must have one shape (n, ...) and hardness be finite, got "
            f"{z.shape}, {tau.shape}, {HV.shape}. Without hardness over depth there is no rating."
        )
    strength = _SHARE * material * HV * 1e6
    left = tau if residual is None else np.maximum(tau - np.asarray(residual), 0.0)
    least = check_positive("half_width", float(np.min(half_width)), "m")
    below = z >= half_width
    outside = () if below.any() else (f"depths from the half width {least:.3g} m on, got none",)
    used = np.where(below, left / strength + OFFSET, np.nan)
    return FlankFracture(z, strength, used, outside)
