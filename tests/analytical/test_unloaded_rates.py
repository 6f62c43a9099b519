"""Derivatives of the unloaded contact against differences of the plain analysis."""

from functools import cache

import numpy as np
import pytest

from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_contact.contact_path import contact_path
from gearlube_core.hypoid_contact.ease_off import ease_off
from gearlube_core.hypoid_contact.placement import ALIGNED
from gearlube_core.hypoid_contact.sensitivity.analysis import error_rates
from gearlube_core.hypoid_contact.sensitivity.parameter import (
    Parameter,
    Variations,
    usual_parameters,
)
from gearlube_core.hypoid_contact.sensitivity.unloaded_rates import ease_off_rates, path_rates
from gearlube_core.hypoid_contact.unloaded_error import unloaded_error
from tests.helpers.contact_cases import SIDES, angles_on_teeth, shipped_file, shipped_pair
from tests.helpers.differences import apart, changed_pair, extrapolated
from tests.helpers.each import each

# each kind of number: displacement, lengths and angles of both machines, roll, blade edge
NAMES = (
    "misalignment.pinion_axial",
    "misalignment.shaft_angle",
    "pinion.machine.radial_setting_mm",
    "pinion.machine.tilt_angle_deg",
    "pinion.machine.ratio_of_roll",
    "gear.machine.horizontal_setting_mm",
    "gear.cutter.blade_edge_radius_mm",
)
PLACES = np.array([0.3, 0.6, 1.0]), np.array([0.1, 0.5, 0.8])
# differences of twice and four times the step; larger ones leave the cubic range of the path,
# which runs a face height for half a millimetre of some settings
LIMIT = 1e-6


@cache
def variations(side):
    return Variations.of(shipped_file(), shipped_pair(side), NAMES)


def reference(side, k, quantity):
    """Return the extrapolated difference of a quantity of pairs built again."""
    parameter = variations(side).parameters[k]
    return extrapolated(
        lambda change: quantity(
            changed_pair(shipped_file(), shipped_pair(side), parameter, change)
        ),
        2.0 * parameter.step,
    )


@cache
def rates_of_path(side):
    path = contact_path(shipped_pair(side), angles_on_teeth(side, 5))
    return path_rates(variations(side), path)


# the coast flanks differ by signs alone
CASES = [("drive", k) for k in range(len(NAMES))] + [("coast", 0), ("coast", 4)]


@each(("side", "k"), CASES)
def test_path_and_error_move_as_those_of_changed_pairs(side, k):
    path = rates_of_path(side)
    pair, angles = path.path.pair, path.path.gear_angle
    names = ("transmission_error", "gear_s", "gear_t", "pinion_s", "pinion_t", "r")

    def quantities(changed):
        there = contact_path(changed, angles)
        return np.stack([*(getattr(there, name) for name in names[:-1]), *there.r.T])

    expected = reference(pair.side, k, quantities)
    for row, name in enumerate(names[:-1]):
        assert apart(getattr(path, name)[k], expected[row]) < LIMIT
    assert apart(path.r[k].T, expected[5:]) < LIMIT


@pytest.mark.parametrize("side", SIDES)
def test_error_moves_by_an_axial_displacement_as_by_virtual_work(side):
    # a displacement along a unit vector a turns the pinion by n.a / R_p, exactly, at each contact:
    # here n from the pinion, and its axis, from which the pinion moves away
    path = rates_of_path(side)
    pair = path.path.pair
    axis, point = pair.pinion_axis_placed
    arm = np.einsum("ni,ni->n", np.cross(axis, path.path.r - point), path.path.normal)
    expected = path.path.normal @ axis / arm
    # rounding of 1e-17 m over steps of 1e-6 m
    np.testing.assert_allclose(path.transmission_error[0], expected, rtol=1e-8)


def test_peak_to_peak_error_and_mean_contact_move_as_those_of_changed_pairs():
    side, k = "coast", 1
    rates = error_rates(variations(side), unloaded_error(shipped_pair(side), 9))

    def quantities(changed):
        error = unloaded_error(changed, 3)
        mean = contact_path(changed, np.array([error.extreme_angle]))
        size = abs(error.angular[0])
        return size, error.gear_angle[0], error.extreme_angle, mean.gear_s[0], mean.gear_t[0]

    found = [
        getattr(rates, name)[k]
        for name in ("peak_to_peak", "handover_angle", "extreme_angle", "s", "t")
    ]
    # roots are found to 1e-13 rad, of steps of 2e-3 deg or 2e-5 rad
    np.testing.assert_allclose(found, reference(side, k, quantities), rtol=LIMIT)


@pytest.mark.parametrize("side", SIDES)
def test_ease_off_moves_as_that_of_changed_pairs(side):
    rates = ease_off_rates(variations(side), *PLACES)
    for k in (1, 5) if side == "drive" else (2,):
        expected = reference(
            side,
            k,
            lambda pair: ease_off_rates(Variations.of(shipped_file(), pair, ()), *PLACES).gap,
        )
        assert apart(rates.rate[k], expected) < LIMIT


@pytest.mark.parametrize("side", SIDES)
def test_ease_off_is_that_of_the_search_over_all_angles(side):
    s, t = np.linspace(0.0, 1.0, 5), np.linspace(0.0, 1.0, 5)
    found = ease_off_rates(Variations.of(shipped_file(), shipped_pair(side), ()), s, t).gap
    # cubic interpolation between twelve angles a pitch is right to some nanometres
    np.testing.assert_allclose(
        found, ease_off(shipped_pair(side), s_count=5, t_count=5).normal_gap(), atol=2e-8
    )


def test_usual_parameters_are_all_misalignments_and_settings_once():
    names = usual_parameters(shipped_file())
    assert len(set(names)) == len(names)
    assert {"misalignment.pinion_offset", "pinion.machine.ratio_of_roll"} <= set(names)
    assert not [name for name in names if "correction" in name or "basic_cradle" in name]
    for name in names:
        assert Parameter.named(name, shipped_file(), ALIGNED).step > 0.0


@each(
    ("name", "reason"),
    [
        ("misalignment.offset", "pinion_offset"),
        ("pinion.machine.radial", "docs/gear_file.md"),
        ("pinion.cutter.blade_groups", "Counts"),
        ("pinion.cutter.convex_flank_edge_radius_mm", "does not give it"),
    ],
)
def test_what_cannot_be_differentiated_is_refused_by_its_name(name, reason):
    with pytest.raises(ParameterError, match=reason):
        Parameter.named(name, shipped_file(), ALIGNED)
