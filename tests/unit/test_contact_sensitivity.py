"""The sensitivity analysis from its settings to its rows, table and figure."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from gearlube.plotting.words import parameter_words, tolerance_words
from gearlube.studies.contact import sensitivity as study
from gearlube.studies.contact.sensitivity import sensitivity_figure, sensitivity_table
from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_contact.loaded_contact import LoadedSettings
from gearlube_core.hypoid_contact.sensitivity import analysis
from gearlube_core.hypoid_contact.sensitivity.analysis import SensitivitySettings
from gearlube_core.hypoid_contact.sensitivity.sensitivity_dataset import UNITS
from gearlube_core.hypoid_contact.strips import StripSettings
from tests.helpers.contact_cases import shipped_file
from tests.helpers.loaded_cases import stiffness
from tests.helpers.units import without_units

NAMES = ("misalignment.pinion_axial", "gear.machine.machine_root_angle_deg")
SETTINGS = SensitivitySettings(
    parameters=NAMES,
    torque=60.0,
    positions=4,
    loaded=LoadedSettings(strips=StripSettings(cells_across=8, cells_along=10)),
)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("sensitivity")


@pytest.fixture(scope="module")
def found(folder):
    with pytest.MonkeyPatch.context() as patch:
        teeth = stiffness()
        patch.setattr(analysis, "pair_stiffness", lambda *_, **__: {"drive": teeth, "coast": teeth})
        return study.run_sensitivity(shipped_file(), SETTINGS, folder=folder, jobs=1)


@pytest.mark.slow
def test_every_quantity_has_its_rate_by_every_parameter_and_nothing_is_lost(found):
    for name in UNITS:
        assert found[f"{name}_rate"].dims == ("side", "parameter", *found[name].dims[1:])
        if name != "ease_off":  # places without counterpart
            assert np.isfinite(found[name]).all()
            assert np.isfinite(found[f"{name}_rate"]).all()
    assert found["unit"].values.tolist() == ["m", "deg"]
    np.testing.assert_allclose(found["share"].sum("pair"), 1.0, rtol=1e-12)
    assert abs(found["share_rate"].sum("pair")).max() < 1e-9 * abs(found["share_rate"]).max()


@pytest.mark.slow
def test_rows_are_changes_by_the_tolerance(found):
    rows = study.sensitivity_rows(found)
    assert [(row.parameter, row.side) for row in rows] == [
        (name, side) for name in NAMES for side in ("drive", "coast")
    ]
    part = found.sel(side="coast", parameter=NAMES[0])
    assert rows[1].tolerance == pytest.approx(1e-5, rel=1e-12)
    assert rows[1].te_pp == pytest.approx(1e-5 * float(part["te_pp_rate"]), rel=1e-12)
    stiffer = part["secant_stiffness"] + 1e-5 * part["secant_stiffness_rate"]
    assert rows[1].stiffness == pytest.approx(
        float(stiffer.mean() / part["secant_stiffness"].mean()) - 1.0, rel=1e-6
    )


def test_rates_of_the_error_over_the_mesh_follow_from_those_of_positions(found):
    # to first order: the error with all rotations moved by a small step
    step = 1e-9
    moved = found["rotation"] + step * found["rotation_rate"]
    wave = np.exp(-2j * np.pi * found["phase"])
    order = 0.5 * abs((moved * wave).sum("phase"))
    held = 0.5 * abs((found["rotation"] * wave).sum("phase"))
    np.testing.assert_allclose((order - held) / step, found["te_1_rate"], rtol=1e-4)
    swing = moved.max("phase") - moved.min("phase") - found["te_pp"]
    np.testing.assert_allclose(swing / step, found["te_pp_rate"], rtol=1e-4)


def test_results_are_written_and_finished_positions_used_again(found, folder, monkeypatch):
    for name in ("sensitivity.nc", "sensitivity.csv", "figures/sensitivity.png"):
        assert (folder / name).is_file()
    assert not without_units(found)
    teeth = stiffness()
    monkeypatch.setattr(
        analysis, "pair_stiffness", lambda *_, **__: {"drive": teeth, "coast": teeth}
    )
    monkeypatch.setattr(analysis, "loaded_rates", None)
    again = analysis.contact_sensitivity(
        shipped_file(), SETTINGS, store=folder / study.POSITIONS, jobs=1
    )
    assert again.identical(found)


def test_teeth_that_meet_at_edges_have_loaded_rates_alone(monkeypatch):
    def refuse(*_):
        raise ParameterError("edges")

    monkeypatch.setattr(analysis, "unloaded_error", refuse)
    pair = analysis.FlankPair.from_file(shipped_file(), "drive")
    lost = analysis._unloaded(analysis.Variations.of(shipped_file(), pair, NAMES[:1]))
    assert np.isnan(lost["unloaded_pp_rate"]).all()
    assert np.isfinite(lost["ease_off_rate"]).any()


def test_table_and_figure_show_every_parameter_the_largest_on_top(found):
    rows = study.sensitivity_rows(found)
    table = sensitivity_table("pair", 60.0, rows)
    assert table.row_count == 2
    lost = [row._replace(unloaded_pp=np.nan) for row in rows]  # as on corrected flanks
    assert list(sensitivity_table("pair", 60.0, lost).columns[1].cells) == ["-/-", "-/-"]
    first = max(rows, key=lambda row: abs(row.te_1)).parameter
    assert next(iter(table.columns[0].cells)).startswith(f"{parameter_words(first)}, 0.01 ")
    labels = [text.get_text() for text in sensitivity_figure(found).axes[0].get_yticklabels()]
    assert sorted(labels) == [
        "gear: machine root angle  +0.01°",
        "misalignment P (pinion)  +0.01 mm",
    ]


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("pinion.cutter.point_radius_mm", "pinion: point radius"),
        ("pair.offset_mm", "pair: offset"),
        ("misalignment.shaft_angle", "misalignment Σ (shaft angle)"),
    ],
)
def test_parameters_have_words(name, words):
    assert parameter_words(name) == words


def test_tolerances_are_shown_in_millimetres_and_degrees():
    assert tolerance_words(1e-5, "m") == "0.01 mm"
    assert tolerance_words(np.radians(0.01), "rad") == "0.01°"
    assert tolerance_words(1e-4, "1") == "0.0001"


def test_settings_out_of_range_are_refused():
    for wrong in ({"torque": 0.0}, {"positions": 3}):
        with pytest.raises(ParameterError, match=next(iter(wrong))):
            replace(SETTINGS, **wrong)
