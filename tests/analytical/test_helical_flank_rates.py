"""Derivatives of loaded helical contact by modifications of its flanks."""

from dataclasses import replace
from functools import partial

import numpy as np
import pytest

from gearlube_core.errors import ParameterError
from gearlube_core.helical_contact.flank_rates import flank_rates
from gearlube_core.helical_contact.loaded_contact import (
    LoadedSettings,
    MeshPosition,
    coupled_strip,
)
from gearlube_core.helical_contact.strips import StripSettings, normal_gap
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.tooth_contact.coupled_strips import solve_coupled
from tests.helpers.differences import apart, extrapolated
from tests.helpers.each import each
from tests.helpers.helical_contact_cases import TORQUE, coarse_stiffness, stiff_teeth

MODULUS = 1.1e11
FILE = HelicalGearFile.named("he_2007").varied(
    {
        f"{role}.flank": {
            "tip_relief_um": 15.0,
            "tip_relief_depth_mm": 2.0,
            "crown_um": 6.0,
            "lead_slope_um": 2.0,
        }
        for role in ("pinion", "gear")
    }
)
NAMES = (
    "pinion.flank.tip_relief_um",
    "gear.flank.tip_relief_depth_mm",
    "pinion.flank.crown_um",
    "gear.flank.lead_slope_um",
    "pinion.flank.profile_slope_um",
)
QUANTITIES = ("rotation", "pressure_max", "secant_stiffness", "sliding_loss")
RATES = ("rotation_rate", "pressure_rate", "secant_stiffness_rate", "sliding_loss_rate")
PHASES = np.array([0.0, 0.25, 0.5, 0.75])
COARSE = LoadedSettings(strips=StripSettings(cells_across=11, cells_along=20), tolerance=1e-9)


@pytest.fixture(scope="module")
def rates():
    teeth = coarse_stiffness(FILE.helical_pair())
    return flank_rates(FILE, NAMES, torque=TORQUE, phases=PHASES, stiffness=teeth, settings=COARSE)


def varied(name, change):
    role, _, key = name.split(".")
    return FILE.varied({name: getattr(getattr(FILE, role).flank, key) + change})


def sliding(pair, x):
    """Return the difference of the flanks' rolling speeds per pinion speed, at x from T_p [m]."""
    return np.abs(x - (pair.tangent_length - x) / pair.ratio)


def analysed(file):
    """Return rotation, pressure, secant stiffness and sliding loss by whole analyses, (4, N)."""
    teeth, modified = coarse_stiffness(FILE.helical_pair()), file.modified_pair()
    pair, found = modified.pair, []
    for phase in PHASES:
        state = MeshPosition.at(modified, phase).load(TORQUE, teeth, COARSE)
        closing = state.rotation - state.unloaded_rotation
        slid = sum(np.sum(one.forces * sliding(pair, one.strip.x)) for one in state.lines)
        pressure = max(one.pressure.max() for one in state.lines)
        secant = TORQUE / pair.pinion_base_radius**2 / closing
        found.append((state.rotation, pressure, secant, slid / TORQUE))
    return np.transpose(found)


@pytest.mark.slow
def test_values_are_those_of_the_iteration(rates):
    # the iteration's tolerance is 1e-9 of the closing, a cell's force is a hundredth of it
    for name, expected in zip(QUANTITIES, analysed(FILE), strict=True):
        np.testing.assert_allclose(getattr(rates, name), expected, rtol=1e-6)


@pytest.mark.slow
def test_rates_are_those_of_the_contact_on_frozen_cells(rates):
    teeth, phase = coarse_stiffness(FILE.helical_pair()), PHASES[1]
    modified = FILE.modified_pair()
    state = MeshPosition.at(modified, phase).load(TORQUE, teeth, COARSE)

    lines = [line for line in state.lines if (line.forces > 0.0).any()]
    highest = np.argmax(np.concatenate([line.pressure.ravel() for line in lines]))
    pair = modified.pair

    def quantities(name, change):
        changed = varied(name, change).modified_pair()
        strips = []
        touching = MeshPosition.at(changed, phase).unloaded_rotation
        for line in lines:
            strip, there = line.strip, line.forces > 0.0
            gap = np.where(there, normal_gap(changed, strip.X, strip.y, strip.z), np.inf)
            strips.append(coupled_strip(pair, replace(strip, gap=gap), teeth))
        solved = solve_coupled(strips, teeth, TORQUE, 1e-12)
        rotation = solved.solution.rotation
        slid = sum(
            np.sum(forces * sliding(pair, line.strip.x))
            for forces, line in zip(solved.forces, lines, strict=True)
        )
        pressure = np.concatenate([one.ravel() for one in solved.pressure])[highest]
        secant = TORQUE / pair.pinion_base_radius**2 / (rotation - touching)
        return np.array([rotation, pressure, secant, slid / TORQUE])

    for k, name in enumerate(NAMES):
        # steps up to 4 nm let no cell go (10 nm do); solved to 1e-12 of the closing
        expected = extrapolated(partial(quantities, name), 2e-3)
        found = [getattr(rates, one)[k, 1] for one in RATES]
        # a solution to 1e-12 leaves some 1e-11 of the pressure to chance, a few 1e-6 of this rate
        chance = 1e-11 * rates.pressure_max[1] / 2e-3
        for quantity, rate, difference in zip(QUANTITIES, found, expected, strict=True):
            atol = chance if quantity == "pressure_max" else 0.0
            np.testing.assert_allclose(rate, difference, rtol=1e-6, atol=atol, err_msg=quantity)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("k", "most"),
    [
        # tip relief ends in a kink: with such large cells differences scatter by a tenth, and the
        # highest pressure is that of other cells
        (0, {"rotation_rate": 0.1, "secant_stiffness_rate": 0.1, "sliding_loss_rate": 0.15}),
        (2, dict.fromkeys(RATES, 0.05)),  # differences over steps twice as long: 0.01 to 0.07 apart
    ],
)
def test_rates_are_near_those_of_whole_analyses(rates, k, most):
    # whole analyses cut strips again for the changed flanks
    near, far = (analysed(varied(NAMES[k], change)) for change in (0.5, -0.5))
    for name, expected in zip(RATES, near - far, strict=True):
        if name in most:
            assert apart(getattr(rates, name)[k], expected) < most[name]


def test_slopes_of_both_members_open_the_same_gap():
    # each is a removal over the same face; a member's section differs by the gap's lean, and
    # cells lie off the line of action: half a per cent
    found = flank_rates(
        FILE,
        ("pinion.flank.lead_slope_um", "gear.flank.lead_slope_um", "pinion.flank.crown_um"),
        torque=TORQUE,
        phases=PHASES[:2],
        stiffness=stiff_teeth(MODULUS),
        settings=COARSE,
    )
    np.testing.assert_allclose(found.rotation_rate[0], found.rotation_rate[1], rtol=5e-3)
    assert (found.rotation_rate[2] > 0.0).all()  # what is removed has to be closed


def test_rates_over_the_mesh_follow_from_those_of_phases(rates):
    step = 1e-6  # um
    value, rate = rates.order(1)
    moved = rates.rotation + step * rates.rotation_rate
    wave = np.exp(-2j * np.pi * PHASES)
    np.testing.assert_allclose(
        (0.5 * abs(moved @ wave) - value) / step, rate, rtol=1e-3, atol=1e-3 * max(abs(rate))
    )
    np.testing.assert_allclose(
        np.ptp(moved, axis=1), rates.peak_to_peak + step * rates.peak_to_peak_rate, rtol=1e-9
    )


@each(
    ("name", "reason"),
    [
        ("pinion.flank.profile_crown_um", "docs/helical_gear_file"),
        ("pair.centre_distance_mm", r"pinion\.flank or gear\.flank"),
        ("pinion.flank.facets", "number with decimals"),
        ("pinion.flank.crown_start_mm", "inside its range"),
    ],
)
def test_what_has_no_rate_is_refused_by_its_name(name, reason):
    with pytest.raises(ParameterError, match=reason):
        flank_rates(FILE, (name,), torque=TORQUE, phases=PHASES, stiffness=stiff_teeth(MODULUS))
