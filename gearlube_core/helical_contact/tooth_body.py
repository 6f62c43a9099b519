"""The teeth of a helical pair as finite-element bodies, and contact positions on them."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from gearlube_core.arrays import Array
from gearlube_core.checks import check_option
from gearlube_core.contact.solid import STEEL_MOHAMMADPOUR_2015, Solid, contact_modulus
from gearlube_core.errors import ParameterError
from gearlube_core.helical_geometry.involute import MEMBERS, involute_flank
from gearlube_core.helical_geometry.pair import HelicalPair
from gearlube_core.helical_geometry.tooth_limits import involute
from gearlube_core.tooth_compliance.tooth_body import (
    FLANK_GRID,
    ToothBodySettings,
    members_compliance,
)
from gearlube_core.tooth_compliance.tooth_geometry import ToothGeometry
from gearlube_core.tooth_contact.coupled_strips import PairStiffness

# 30e6 psi, the usual steel of the rig of He et al. 2007, who do not print theirs
STEEL_HE_2007 = replace(STEEL_MOHAMMADPOUR_2015, youngs_modulus=206.8e9)

_CLEARANCE = 0.25  # normal modules over the root circle where the flank passes into its fillet
_BELOW_CONTACT = 0.5  # of the way from the root to the lowest point of contact, at most
_THINNEST = 0.1  # normal modules, tooth at its tip


@dataclass(frozen=True, slots=True, kw_only=True)
class HelicalBodySettings(ToothBodySettings):
    """The elastic body around a flank, of another steel than that of `ToothBodySettings`."""

    solid: Solid = STEEL_HE_2007


class ToothForm(NamedTuple):
    """Transverse section of one member's tooth."""

    base_radius: float  # [m]
    start_radius: float  # where the flank begins over its fillet [m]
    tip_radius: float  # [m]
    root_radius: float  # [m]
    base_half_angle: float  # half the tooth's thickness on the base circle [rad]


def tooth_form(pair: HelicalPair, member: str) -> ToothForm:
    """Return the transverse section of the teeth of the "pinion" or the "gear".

    Thickness: that of the basic rack with the profile shifts, less half the backlash. The flank
    begins a quarter of a normal module over the root circle, lower where contact begins lower.

    Raises
    ------
    ParameterError
        A pointed tooth.
    """
    check_option("member", member, MEMBERS)
    k = MEMBERS.index(member)
    flank = involute_flank(pair, member)
    root = (pair.pinion_root_radius, pair.gear_root_radius)[k]
    reference = (pair.pinion_reference_radius, pair.gear_reference_radius)[k]
    half = 0.5 * pair.tooth_thickness[k] / reference + involute(pair.transverse_pressure_angle)
    lowest = float(flank.radius(flank.roll_low))
    start = root + min(_CLEARANCE * pair.normal_module, _BELOW_CONTACT * (lowest - root))
    form = ToothForm(flank.base_radius, start, flank.tip_radius, root, half)
    land = 2.0 * flank.tip_radius * float(half_angle(form, flank.tip_radius))
    if land < _THINNEST * pair.normal_module:
        raise ParameterError(
            f"the {member}'s teeth must be at least {_THINNEST:g} normal modules thick at their "
            f"tip, got {1e3 * land:.3g} mm of {1e3 * pair.normal_module:.3g} mm. Reduce the tip "
            "radius."
        )
    return form


def half_angle(form: ToothForm, radius: ArrayLike) -> Array:
    """Return half the angular tooth thickness [rad] at a radius [m].

    psi_b - inv(acos(r_b/r)). Below the base circle, where there is no involute, the flank goes on
    radially.
    """
    roll = np.sqrt(np.maximum((np.asarray(radius) / form.base_radius) ** 2 - 1.0, 0.0))
    return np.asarray(form.base_half_angle - (roll - np.arctan(roll)))


def tooth_body(pair: HelicalPair, member: str, settings: HelicalBodySettings) -> ToothGeometry:
    """Return one tooth about its own axis, z; its left flank is the drive flank.

    The pinion's tooth points towards +y, the gear's towards -y; t runs from z = -W/2 to +W/2 and s
    evenly in the radius.
    """
    form = tooth_form(pair, member)
    radius = np.linspace(form.start_radius, form.tip_radius, FLANK_GRID[0])[:, None]
    z = np.linspace(-0.5, 0.5, FLANK_GRID[1]) * pair.face_width
    up = 1.0 if member == "pinion" else -1.0
    # both members follow the contact line towards +x where z rises
    lead = z * math.tan(pair.base_helix_angle) / form.base_radius
    half = half_angle(form, radius)

    def points(side: float) -> Array:
        angle = lead + side * half
        shape = np.broadcast_shapes(angle.shape, z.shape)
        return np.stack(
            [radius * np.sin(angle), up * radius * np.cos(angle), np.broadcast_to(z, shape)], -1
        )

    return ToothGeometry(
        left=points(up),
        right=points(-up),
        inward=np.stack([-np.sin(lead), -up * np.cos(lead), np.zeros_like(lead)], -1),
        axis_point=np.zeros(3),
        axis_direction=np.array([0.0, 0.0, 1.0]),
        teeth=pair.pinion_teeth if member == "pinion" else pair.gear_teeth,
        slot_depth=form.start_radius - form.root_radius,
        base_depth=settings.base_depth_modules * pair.normal_module,
        neighbour_pitches=settings.neighbour_pitches,
    )


def flank_position(form: ToothForm, roll: ArrayLike) -> Array:
    """Return s [-] of points at roll lengths [m]: start of the flank 0, tip 1."""
    radius = np.hypot(form.base_radius, np.asarray(roll, dtype=float))
    return np.asarray((radius - form.start_radius) / (form.tip_radius - form.start_radius))


def pair_stiffness(
    pair: HelicalPair,
    settings: HelicalBodySettings,
    *,
    cache: Path | None = None,
    jobs: int | None = None,
    keep: bool = True,
) -> PairStiffness:
    """Return the elastic data of the drive flanks; members in parallel unless `jobs` is 1.

    `keep`: whether new compliances go into the cache.
    """
    teeth = {member: tooth_body(pair, member, settings) for member in MEMBERS}
    flanks = members_compliance(teeth, settings, cache, jobs, keep)
    pinion, gear = (flanks[member] for member in MEMBERS)
    modulus = contact_modulus(settings.solid, settings.solid)
    return PairStiffness(pinion=pinion[0], gear=gear[0], contact_modulus=modulus)
