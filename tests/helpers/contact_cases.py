"""Flank pairs that several tests of tooth contact share."""

from functools import cache

import numpy as np

from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_contact.placement import Misalignment
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile

SIDES = ("drive", "coast")
# gear angles [pitches] between which the shipped pair's path lies on both teeth
ON_TEETH = {"drive": (-0.44, 1.40), "coast": (-1.03, 0.80)}


@cache
def shipped_file():
    return HypoidGearFile.named("mohammadpour_2015")


@cache
def shipped_pair(side):
    return FlankPair.from_file(shipped_file(), side)


def displaced(side, **displacement):
    return shipped_pair(side).misaligned(Misalignment(**displacement))


def angles_on_teeth(side, count):
    """Gear angles [rad] at which the unloaded contact lies on both teeth."""
    return np.linspace(*ON_TEETH[side], count) * shipped_pair(side).gear_pitch
