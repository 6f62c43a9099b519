"""Derivatives of the loaded contact: frozen strips, reciprocity, statics."""

import dataclasses

import numpy as np
import pytest

from gearlube_core.contact.unilateral import solve_torque
from gearlube_core.contact.unilateral_problem import UnilateralProblem
from gearlube_core.hypoid_contact.loaded_contact import LoadedSettings, MeshPosition
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_contact.sensitivity.loaded_rates import QUANTITIES, loaded_rates
from gearlube_core.hypoid_contact.sensitivity.parameter import Variations, usual_parameters
from tests.helpers.contact_cases import shipped_file, shipped_pair
from tests.helpers.differences import changed_pair, extrapolated
from tests.helpers.each import each
from tests.helpers.frozen_contact import PHASE, SOFT_TEETH, TORQUE, Frozen

NAMES = (
    "misalignment.pinion_axial",
    "misalignment.shaft_angle",
    "pinion.machine.tilt_angle_deg",
    "gear.cutter.point_radius_mm",
)
# rounding of 1e-17 m over steps of 1e-6 m; some quantities are small differences of larger ones
LIMIT = 1e-6


@pytest.fixture(scope="module", params=["drive", "coast"])
def frozen(request):
    return Frozen(shipped_pair(request.param))


@pytest.fixture(scope="module")
def rates(frozen):
    variations = Variations.of(shipped_file(), frozen.pair, NAMES)
    return variations, loaded_rates(variations, frozen.state, SOFT_TEETH)


def flat(quantities, *index):
    return np.concatenate(
        [[getattr(quantities, name)[index] for name in QUANTITIES], quantities.share[index]]
    )


def test_equilibrium_on_the_loaded_cells_is_that_of_the_iteration(frozen, rates):
    value = rates[1].value
    # the iteration's tolerance is 1e-9 of the closing, a thousandth of the rotation or more
    assert value.rotation == pytest.approx(frozen.state.rotation, rel=1e-7)
    assert value.gear_torque == pytest.approx(frozen.state.gear_torque, rel=1e-6)
    assert value.force == pytest.approx(np.linalg.norm(frozen.state.force), rel=1e-6)
    highest = max(one.pressure.max() for one in frozen.state.pairs)
    assert value.pressure_max == pytest.approx(highest, rel=1e-6)
    assert value.share == pytest.approx([p.torque / TORQUE for p in frozen.carrying], rel=1e-6)


@each("k", range(len(NAMES)))
def test_rates_are_those_of_frozen_strips_cut_out_of_changed_flanks(frozen, rates, k):
    variations, found = rates
    parameter = variations.parameters[k]
    expected = extrapolated(
        lambda change: frozen.quantities(
            changed_pair(shipped_file(), frozen.pair, parameter, change)
        ),
        parameter.step,
    )
    np.testing.assert_allclose(flat(found.rate, k), expected, rtol=LIMIT)
    assert sum(found.rate.share[k]) == pytest.approx(0.0, abs=LIMIT * max(abs(expected[9:])))


def test_rotation_rate_holds_with_cells_free_to_unload(frozen, rates):
    variations, found = rates
    parameter = variations.parameters[1]

    def rotation(change):
        whole, gap, arm, strips = frozen.system(
            changed_pair(shipped_file(), frozen.pair, parameter, change)
        )
        area = np.concatenate([strip.area[there] for strip, there in strips])
        problem = UnilateralProblem(
            compliance=lambda forces: whole @ forces, gap=gap, arm=arm, cell_area=area
        )
        return solve_torque(problem, TORQUE, tolerance=1e-11).rotation

    # steps of 2 urad let no loaded cell go; the iteration ends at 1e-11 of the closing
    assert extrapolated(rotation, 0.2 * parameter.step) == pytest.approx(
        found.rate.rotation[1], rel=1e-5
    )


@pytest.mark.slow
def test_rotation_by_axial_displacement_is_axial_force_by_torque(frozen, rates):
    # Maxwell: with the work U* at given torque, d2U*/dT dp is the rotation's rate by p and the rate
    # by T of the force along p. Strips are cut again for each torque: 1 %.
    pair = frozen.pair
    axis, _ = pair.pinion_axis_placed
    position = MeshPosition.at(pair, PHASE, pairs=1)
    force = [
        position.load(TORQUE + change, SOFT_TEETH, LoadedSettings()).force @ axis
        for change in (-4.0, 4.0)
    ]
    fine = position.load(TORQUE, SOFT_TEETH, LoadedSettings())
    found = loaded_rates(
        dataclasses.replace(
            rates[0],
            parameters=rates[0].parameters[:1],
            lower=rates[0].lower[:1],
            upper=rates[0].upper[:1],
        ),
        fine,
        SOFT_TEETH,
    )
    assert found.rate.rotation[0] == pytest.approx(-(force[1] - force[0]) / 8.0, rel=0.01)


def test_reliefs_have_rates_like_any_setting():
    relief = {"tip_relief_um": 15.0, "tip_relief_depth_mm": 2.0, "lead_crown_um": 5.0}
    file = shipped_file().varied({"pinion.drive_flank": relief, "gear.drive_flank": relief})
    frozen = Frozen(FlankPair.from_file(file, "drive"))
    names = ("pinion.drive_flank.tip_relief_um", "pinion.machine.radial_setting_mm")
    variations = Variations.of(file, frozen.pair, names)
    assert set(names) <= set(usual_parameters(file))
    found = loaded_rates(variations, frozen.state, SOFT_TEETH)
    for k, parameter in enumerate(variations.parameters):
        expected = extrapolated(
            lambda change, parameter=parameter: frozen.quantities(
                changed_pair(file, frozen.pair, parameter, change)
            ),
            parameter.step,
        )
        # the relief's own step is 0.1 um of 15: where it moves nothing, differences are rounding
        np.testing.assert_allclose(
            flat(found.rate, k), expected, rtol=LIMIT, atol=LIMIT * max(abs(expected[9:]))
        )
