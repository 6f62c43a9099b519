"""Fracture and fatigue under the surface of flanks: along contact lines, and over depth.

The stress is that of a Hertz line load with the pressure and half width of the place, and friction
across the line. Residual stress is left out.
"""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np

from gearlube.damage.settings import DamageSettings
from gearlube_core.arrays import Array
from gearlube_core.contact.dang_van import FatigueLimits, dang_van_number
from gearlube_core.contact.half_space_stress import greatest_shear
from gearlube_core.friction.flank_states import FlankStates
from gearlube_core.rating.subsurface import (
    PASSAGE_DEPTHS,
    CaseHardening,
    FlankFracture,
    flank_fracture,
    hardness_profile,
    line_passage,
    line_shear_amplitude,
)

_STEP = 0.01  # of the friction coefficient; one changes the greatest shear by 0.1 %
_WITHIN, _LAYERS = 3.0, 24  # how deep fracture is sought [case depths], and at how many depths
# of the variables over depth: the deepest, in half widths without a case; over the first; how many
_DEEPEST, _FINEST, _DEPTHS = 3.0, 300.0, 150
_LEAST = 1e-6  # of the load at the ends of a line
_AT = ("side", "depth")


def under_surface(
    states: FlankStates, settings: DamageSettings, across: Array
) -> dict[str, tuple[Array, Array]]:
    """Return A_FF as "fracture" and Dang Van's number as "fatigue", the greatest over depth.

    Each at the places `across` of all N lines, -1 to 1, shape (N, across.size); and of the worst
    line number, pressure [Pa], half width [m] and friction coefficient. Compression does not help
    in Dang Van's number. Without hardness or limits in the settings the key is missing.
    """
    friction = float(_STEP * np.ceil((states.friction / states.load).max() / _STEP))
    profile = np.sqrt(np.maximum(1.0 - across**2, _LEAST)) ** (0.0 if states.strips else 1.0)
    p, a = states.pressure[:, None] * profile, states.semi_minor[:, None] * profile
    numbers, case = {}, settings.case
    if case is not None:
        z = a[..., None] + _WITHIN * case.case_depth * np.linspace(0.0, 1.0, _LAYERS) ** 2
        _, found = _fracture(z, p[..., None], a[..., None], friction, case)
        numbers["fracture"] = found.utilisation.max(axis=-1)
    if settings.fatigue is not None:
        numbers["fatigue"] = p * _over_pressure(friction, settings.fatigue)[2].max()
    worst = {name: int(one.max(axis=1).argmax()) for name, one in numbers.items()}
    return {
        name: (one, np.array([one[i].max(), states.pressure[i], states.semi_minor[i], friction]))
        for i, (name, one) in zip(worst.values(), numbers.items(), strict=True)
    }


def depth_variables(places: dict[str, Array], settings: DamageSettings) -> dict[str, Any]:
    """Return variables over depth at the worst places, and the depths themselves.

    `places` by "fracture" and "fatigue", (2, 4): the worst of `under_surface` on the drive and the
    coast side, all 0 where nothing loads a side.
    """
    case, limits = settings.case, settings.fatigue
    if not places:
        return {}
    deepest = _DEEPEST * max(float(at[:, 2].max()) for at in places.values())
    if case is not None:
        deepest = max(deepest, _WITHIN * case.case_depth)
    # flank fracture is often greatest where it begins, at the half width
    begins = [a for _, _, a, _ in places.get("fracture", ()) if a > 0.0]
    z = np.unique([*np.geomspace(deepest / _FINEST, deepest, _DEPTHS), *begins])
    found: dict[str, Any] = {"depth": ("depth", 1e3 * z, "mm", "below the surface")}
    for name, at in places.items():
        found[f"{name}_pressure"] = "side", 1e-9 * at[:, 1], "GPa", f"pressure, worst of {name}"
        found[f"{name}_half_width"] = "side", 1e3 * at[:, 2], "mm", f"half width, worst of {name}"
    rows = np.full((5, 2, z.size), np.nan)
    if case is not None:
        for side, (_, p, a, mu) in enumerate(places["fracture"]):
            if p > 0.0:
                rows[0, side], of_side = _fracture(z, p, a, mu, case)
                rows[1, side], strength = of_side.utilisation, of_side.strength
        found["shear_amplitude"] = _AT, 1e-6 * rows[0], "MPa", "amplitude of shear"
        found["shear_strength"] = "depth", 1e-6 * strength, "MPa", "shear strength by hardness"
        found["fracture_profile"] = _AT, rows[1], "1", "flank fracture: utilisation A_FF"
    if limits is not None:
        for side, (_, p, a, mu) in enumerate(places["fatigue"]):
            for row, one in zip(rows[2:, side], _over_pressure(mu, limits), strict=True):
                if p > 0.0:
                    row[:] = p * np.interp(z / a, PASSAGE_DEPTHS, one, np.nan, np.nan)
        found["greatest_shear"] = _AT, 1e-6 * rows[2], "MPa", "greatest shear"
        found["fatigue_profile"] = _AT, rows[3], "1", "Dang Van's number, compression helps"
        found["fatigue_bound_profile"] = _AT, rows[4], "1", "the same, compression does not help"
    return found


def _fracture(
    z: Array, p: Any, a: Any, friction: float, case: CaseHardening
) -> tuple[Array, FlankFracture]:
    tau = line_shear_amplitude(z, p, a, friction=friction)
    return tau, flank_fracture(z, tau, hardness_profile(z, **case._asdict()), half_width=a)


@cache
def _over_pressure(friction: float, limits: FatigueLimits) -> Array:
    """Return greatest shear [-] and Dang Van's numbers [1/Pa] over the pressure, (3, depths).

    Compression helps in the second, and does not in the third.
    """
    history = line_passage(friction)
    shear = greatest_shear(np.moveaxis(history, 1, 0)).max(axis=0)
    each = (dang_van_number(history, limits, compression=helps) for helps in (True, False))
    return np.array([shear, *each])
