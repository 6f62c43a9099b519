"""Words and colours of figures and reports: losses, varied parameters, sharp edges."""

from __future__ import annotations

import textwrap
from collections.abc import Callable, Collection, Iterable
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlube.plotting.style import GREY, INK, OLIVE, PURPLE, SAND, SKY, WINE, YELLOW
from gearlube_core.arrays import Array
from gearlube_core.tooth_contact.sharp_edge import EDGE_PRESSURE, EDGE_WORDS

if TYPE_CHECKING:
    from gearlube_core.dynamics.hypoid_mesh.parameters import HypoidAxleParameters

_LESS = 1.1  # times, above which an amplitude is said to be less
_WORDS = {
    "misalignment.pinion_offset": "misalignment E (offset)",
    "misalignment.pinion_axial": "misalignment P (pinion)",
    "misalignment.gear_axial": "misalignment G (gear)",
    "misalignment.shaft_angle": "misalignment Σ (shaft angle)",
}
_NAMED, NAMED_SHARE = 3, 0.005  # sources of loss that are named, if they are not smaller
_ROOM = 1.45  # height over the highest value, for the words
SOURCE_WORDS = {
    "friction_viscous": "flank friction (fluid)",
    "friction_boundary": "flank friction (asperities)",
    "mesh_damping": "mesh damping",
    "bearing_damping": "roller hysteresis",
    "bearing_torque": "bearing drag",
    "churning": "churning",
    "seals": "seals",
    "friction_rolling": "rolling of the flanks",
}
# the same in every figure, and none of those of preloads and orders
_INKS = (SKY, PURPLE, INK, GREY, SAND, OLIVE, WINE, YELLOW)
SOURCE_COLOURS = dict(zip(SOURCE_WORDS, _INKS, strict=True))
_HUBS = "bearings of the wheel ends ({} their torque in seals.hub_torque_n_m)"
_SAID = (
    "bearing_torque",
    "churning",
    "seals",
    "friction_rolling",
)  # missing where they lose nothing


def parameter_words(name: str) -> str:
    """Return a parameter's name as labels show it: without unit and section."""
    if name in _WORDS:
        return _WORDS[name]
    role, *_, field = name.split(".")
    for unit in ("_mm_per_rad", "_mm", "_deg", "_um"):
        field = field.removesuffix(unit)
    return f"{role}: {field.replace('_', ' ')}"


def tolerance_words(tolerance: float, unit: str) -> str:
    """Return a tolerance as labels show it, lengths in mm and angles in degrees."""
    if unit == "m":
        return f"{1e3 * tolerance:.3g} mm"
    if unit == "rad":
        return f"{np.degrees(tolerance):.3g}°"
    if unit == "deg":
        return f"{tolerance:.3g}°"
    return f"{tolerance:.3g}" + ("" if unit == "1" else f" {unit}")


def mark_edge_pressure(axes: Any) -> None:
    """Shade what lies above `EDGE_PRESSURE` in axes of GPa, and say what such a pressure is."""
    drawn = [np.ravel(line.get_ydata()).astype(float) for line in axes.lines]
    top = float(np.nanmax(np.concatenate([np.zeros(1), *drawn])))
    limit = 1e-9 * EDGE_PRESSURE
    if top <= limit:
        return
    above = max(axes.get_ylim()[1], _ROOM * top)
    # far beyond the top: axes that share it may be stretched later
    axes.axhspan(limit, 100.0 * above, color="0.92", zorder=0)
    axes.set_ylim(0.0, above)
    axes.text(
        0.5,
        0.97,
        textwrap.fill(EDGE_WORDS, 56),
        transform=axes.transAxes,
        ha="center",
        va="top",
        fontsize=7.0,
    )


def source_words(source: str) -> str:
    """Return the words for a source of loss.

    >>> source_words("bearing_torque")
    'bearing drag'
    """
    return SOURCE_WORDS.get(source, source.replace("_", " "))


def largest_losses(
    sources: Iterable[Any], loss: Array, words: Callable[[str], str] = source_words
) -> str:
    """Return the three largest losses and their shares; parts below 0.5 % are left out.

    >>> largest_losses(["seals", "churning"], np.array([1.0, 3.0]))
    'churning 75 %, seals 25 %'
    """
    names = [words(str(one)) for one in sources]
    return ", ".join(
        f"{names[i]} {100.0 * loss[i] / loss.sum():.0f} %"
        for i in np.argsort(loss)[::-1][:_NAMED]
        if loss[i] > NAMED_SHARE * loss.sum()
    )


def source_colour(source: str) -> str:
    """Return the colour of a source of loss.

    >>> source_colour("bearing_torque") == source_colour("churning")
    False
    """
    return SOURCE_COLOURS.get(source, GREY)


def held_words(size: str, ratio: float) -> str:
    """Return what a mesh order is without the car; `ratio`: it is with the car, over that.

    >>> held_words("20 N", 3.0)
    'Without the car, at held speed, the order has 20 N there, 3.0 times less.'
    >>> held_words("0.332 N", 174.3)
    'Without the car, at held speed, the order has 0.332 N there, 174 times less.'
    """
    less = f", {ratio:.{0 if ratio >= 10.0 else 1}f} times less" if ratio >= _LESS else ""
    return f"Without the car, at held speed, the order has {size} there{less}."


def not_modelled(losing: Collection[str]) -> tuple[str, ...]:
    """Return what is left out where only the sources `losing` lose power, of an unknown axle.

    >>> not_modelled({"friction_viscous", "bearing_torque"})[:2]
    ('churning', 'seals')
    """
    missing = (source_words(one) for one in _SAID if one not in losing)
    return (*missing, _HUBS.format("unless the axle file gives"), "windage")


def left_out(axle: HypoidAxleParameters) -> tuple[str, ...]:
    """Return the losses that an axle leaves out."""
    found = {
        "churning": axle.churning == "none",
        "pinion seal": axle.pinion_seal_torque == 0.0,
        "wheel seals": axle.wheel_seal_torque == 0.0,
        "bearing drag": axle.bearing_torque_loss == "none",
        "flank friction": not axle.friction_law.rubs,
        "rolling of the flanks": axle.rolling == "none",
        _HUBS.format("give"): axle.hub_torque == 0.0,
        "windage": True,
    }
    return tuple(words for words, missing in found.items() if missing)
