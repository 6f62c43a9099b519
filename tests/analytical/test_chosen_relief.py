"""Relief of designs: at the torque for which it is chosen the pressure is not that of the cells."""

import math

import pytest

from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_contact.loaded_contact import LoadedSettings, MeshPosition
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_contact.strips import StripSettings
from gearlube_core.hypoid_contact.tooth_body import pair_stiffness
from gearlube_core.hypoid_design import chosen_relief as chosen
from gearlube_core.hypoid_design.blank_file import BlankFile
from gearlube_core.hypoid_design.design import design_pair
from gearlube_core.hypoid_design.designed_blank import DesignedBlank
from gearlube_core.hypoid_design.start_settings import start_pair
from gearlube_core.tooth_compliance.tooth_body import ToothBodySettings
from tests.helpers.loaded_cases import stiffness

SIDES = ("drive", "coast")
SAMPLE = BlankFile.named("hypoid_13_42")
SURVEY = {
    "pair.outer_pitch_diameter_mm": 190.0,
    "pair.pinion_spiral_angle_deg": None,
    "pair.gear_spiral_angle_deg": 32.0,
    "cutter.radius_mm": 76.0,
}
LARGE = {
    "pair.pinion_teeth": 11,
    "pair.gear_teeth": 43,
    "pair.offset_mm": 30.0,
    "pair.outer_pitch_diameter_mm": 200.0,
}
SLIM = {"pair.pinion_teeth": 9, "pair.gear_teeth": 41, "pair.offset_mm": 25.0}
HOBBED = {"pair.pinion_teeth": 17, "pair.gear_teeth": 35, "pair.offset_mm": 30.0,
          "cutter.blade_groups": 13}  # fmt: skip


def highest_pressure(file, side, torque, cells, phases):
    pair, teeth = FlankPair.from_file(file, side), pair_stiffness(file, ToothBodySettings())[side]
    settings = LoadedSettings(strips=StripSettings(cells_across=cells, cells_along=3 * cells // 2))
    states = [
        MeshPosition.at(pair, k / phases).load(torque, teeth, settings) for k in range(phases)
    ]
    return max(float(one.pressure.max()) for state in states for one in state.pairs)


@pytest.fixture
def soft(monkeypatch):
    """Teeth of known compliance in place of finite elements; one side, few positions and cells."""
    monkeypatch.setattr(chosen, "pair_stiffness", lambda *_, **__: {"drive": stiffness()})
    monkeypatch.setattr(chosen, "SIDES", ("drive",))
    monkeypatch.setattr(chosen, "POSITIONS", 2)
    cells = StripSettings(cells_across=10, cells_along=16)
    monkeypatch.setattr(chosen, "_CELLS", LoadedSettings(strips=cells))


def chosen_for(**relief):
    given = {f"relief.{name}": value for name, value in relief.items()}
    designed = DesignedBlank.from_file(SAMPLE.varied(given))
    return chosen.chosen_relief(designed, start_pair(designed))


@pytest.mark.slow
def test_relief_rises_with_the_torque_until_no_edge_carries(soft):
    # conjugate flanks stand off nowhere: they close to the edges at once
    low, high = (chosen_for(torque_n_m=torque) for torque in (100.0, 400.0))
    assert low.warnings() == high.warnings() == []
    for edge, least in chosen.LEAST.items():
        assert high.amounts["drive"][edge] >= low.amounts["drive"][edge] >= least
    assert max(high.amounts["drive"].values()) > 1.2 * max(low.amounts["drive"].values())


def test_the_torque_is_that_of_the_size_where_none_is_given():
    designed = DesignedBlank.from_file(SAMPLE)
    # 0.2 N/mm2 x (170 mm)^3 x 13/42 = 304 N.m, told with two digits
    assert chosen.relief_torque(designed) == 300.0
    given = DesignedBlank.from_file(SAMPLE.varied({"relief.torque_n_m": 77.0}))
    assert chosen.relief_torque(given) == 77.0


def test_given_relief_stays_and_is_looked_at_where_a_torque_is_given(soft):
    found = chosen_for(tip_relief_um=12.0, end_relief_um=0.0)
    assert math.isnan(found.pressure["drive"])
    assert found.amounts["drive"] == {"pinion tip": 12.0, "gear tip": 12.0, "ends": 0.0}
    found = chosen_for(tip_relief_um=12.0, end_relief_um=0.0, torque_n_m=400.0)
    assert found.amounts["drive"] == {"pinion tip": 12.0, "gear tip": 12.0, "ends": 0.0}
    assert "At 400 N.m edges of the drive flanks carry: " in " ".join(found.warnings())


@pytest.mark.slow
def test_relief_rises_no_further_than_a_gear_file_takes_and_stays_away_where_it_has_no_extent(soft):
    # a tenth of the height: 0.59 mm, of which a gear file takes 59 um
    found = chosen_for(torque_n_m=900.0, tip_relief_share=0.1, end_relief_share=0.0)
    assert found.amounts["drive"]["gear tip"] == 53.0  # 0.09 of it
    assert found.amounts["drive"]["ends"] == 0.0
    assert "edges of the drive flanks carry" in " ".join(found.warnings())


def test_teeth_without_a_mesh_get_the_least_relief_and_a_warning(monkeypatch):
    def refuse(*_, **__):
        raise ParameterError("The teeth are pointed.")

    monkeypatch.setattr(chosen, "pair_stiffness", refuse)
    found = chosen_for()
    assert found.amounts["drive"] == chosen.LEAST
    assert "The teeth are pointed." in " ".join(found.warnings())


@pytest.mark.slow
@pytest.mark.parametrize("changes", [{}, SURVEY | LARGE, SURVEY | SLIM, SURVEY | HOBBED])
def test_pressure_at_the_torque_of_the_relief_does_not_follow_the_cells(changes):
    # positions other than those at which the relief was chosen
    design = design_pair(SAMPLE.varied(changes))
    assert design.relief.warnings() == []
    for side in SIDES:
        coarse, fine = (
            highest_pressure(design.file, side, design.relief.torque, cells, 8)
            for cells in (32, 96)
        )
        assert coarse == pytest.approx(fine, rel=0.03), side


@pytest.mark.slow
def test_a_relief_that_is_too_small_for_the_torque_leaves_a_pressure_that_follows_the_cells():
    given = {"relief.tip_relief_um": 10.0, "relief.end_relief_um": 10.0, "relief.torque_n_m": 300.0}
    design = design_pair(SAMPLE.varied(given))
    assert "edges of the drive flanks carry" in " ".join(design.relief.warnings())
    coarse, fine = (highest_pressure(design.file, "drive", 300.0, cells, 8) for cells in (32, 96))
    assert fine > 1.1 * coarse
