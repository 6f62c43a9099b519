"""What figures call the losses of an axle, and the colour of each source."""

from __future__ import annotations

from collections.abc import Collection

from gearlube.plotting.style import GREY, PARTS

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
SOURCE_COLOURS = dict(zip(SOURCE_WORDS, PARTS, strict=True))  # the same in every figure
NEVER_MODELLED = ("bearings and grease of the wheel ends", "windage")
_SAID = (
    "bearing_torque",
    "churning",
    "seals",
    "friction_rolling",
)  # missing where they lose nothing


def source_words(source: str) -> str:
    """Return the words for a source of loss.

    >>> source_words("bearing_torque")
    'bearing drag'
    """
    return SOURCE_WORDS.get(source, source.replace("_", " "))


def source_colour(source: str) -> str:
    """Return the colour of a source of loss.

    >>> source_colour("bearing_torque") == source_colour("churning")
    False
    """
    return SOURCE_COLOURS.get(source, GREY)


def not_modelled(losing: Collection[str]) -> tuple[str, ...]:
    """Return what is left out where only the sources `losing` lose power.

    >>> not_modelled({"friction_viscous", "bearing_torque"})[:2]
    ('churning', 'seals')
    """
    return (*(source_words(one) for one in _SAID if one not in losing), *NEVER_MODELLED)
