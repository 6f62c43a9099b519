"""Report of a tooth contact analysis, and settings that meet."""

import re

import numpy as np
import pytest
import xarray as xr

from gearlube.report.parts import GOOD, NOTE, WARNING
from gearlube.studies.contact.figures import catalogue
from gearlube.studies.contact.findings import (
    contact_summary,
    edge_torque,
    findings,
    first_order,
    numbers,
)
from gearlube.studies.contact.run import _table
from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_contact.contact_dataset import ContactSettings, analyse_contact
from tests.helpers.contact_cases import shipped_file
from tests.helpers.known_answers import assert_cells, assert_findings, assert_numbers, assert_tables

TORQUES, PHASES, ARM = (10.0, 80.0), 16, 0.02
AMPLITUDE = (0.3, 0.9)  # um, first mesh order of the loaded error


def contact(pressure=1.0e9, heel=0.7):
    """Both sides alike: a cosine of known amplitude, a pattern from 20 % of the face to `heel`."""
    phase = np.arange(PHASES) / PHASES
    rotation = 1e-6 / ARM * np.cos(2.0 * np.pi * phase)[:, None] * np.array(AMPLITUDE) + 1e-3
    states = ("side", "phase", "torque")
    share = np.zeros((PHASES, 2, 5))
    share[..., 2:4] = 0.5
    peaks = np.where(share > 0.0, 0.8e9, 0.0)
    peaks[3, 1, 2] = pressure
    face = (np.arange(48) + 0.5) / 48
    cells = np.zeros((2, 24, 48))
    cells[:, 8:16, (face > 0.2) & (face < heel)] = 0.7e9

    def both(values):
        return np.stack([values, values])

    return xr.Dataset(
        {
            "rotation": (states, both(rotation)),
            "R_p": (states, np.full((2, PHASES, 2), ARM)),
            "k_m": (states, np.full((2, PHASES, 2), 3e8)),
            "share": ((*states, "pair"), both(share)),
            "pressure_max": ((*states, "pair"), both(peaks)),
            "pressure_map": (("side", "torque", "map_s", "map_t"), both(cells)),
            "error": (("side", "fine_phase"), both(np.array([0.0, 1e-4, 0.5e-4, 1e-4]))),
            "path_contact_ratio": (("side",), np.array([1.8, 1.7])),
        },
        coords={
            "side": ["drive", "coast"],
            "phase": phase,
            "torque": list(TORQUES),
            "pair": np.arange(-2, 3),
            "map_s": (np.arange(24) + 0.5) / 24,
            "map_t": face,
        },
    )


def test_the_first_mesh_order_of_the_error_is_the_amplitude_of_its_cosine():
    # exact but for rounding of the transform
    found = first_order(contact().sel(side="drive"))
    np.testing.assert_allclose(found, AMPLITUDE, rtol=1e-9)


def test_a_pressure_above_that_of_edges_is_told_with_its_torque():
    sound, pressed = contact(), contact(pressure=4.0e9)
    assert np.isnan(edge_torque(sound.sel(side="drive")))
    assert edge_torque(pressed.sel(side="drive")) == TORQUES[1]
    assert findings(sound)[1].level == GOOD
    warning = findings(pressed)[1]
    assert warning.level == WARNING
    assert "drive flanks from 80 N·m on and coast flanks from 80 N·m on" in warning.headline


@pytest.mark.parametrize(("heel", "level"), [(0.7, GOOD), (1.0, WARNING)])
def test_a_pattern_that_runs_off_the_heel_is_a_warning(heel, level):
    pattern = next(one for one in findings(contact(heel=heel)) if "pattern" in one.headline)
    assert pattern.level == level
    assert ("runs off the heel" in pattern.headline) == (level == WARNING)


def known():
    """Both sides unlike; the coast flanks are pressed by an edge at 80 N.m."""
    both = contact()
    both["rotation"][1] = 1e-3 + 2.0 * (both["rotation"][1] - 1e-3)
    ones = np.ones((2, PHASES, 1))
    for name, values in (
        ("k_m", [[2e8, 3e8], [5e8, 7e8]]),
        ("k_t", [[2.2e8, 3.3e8], [5.5e8, 7.7e8]]),
    ):
        both[name] = (("side", "phase", "torque"), ones * np.array(values)[:, None])
    both["R_p"][1] = 0.03
    both["rotation"][1] = 1e-3 + (both["rotation"][1] - 1e-3) * 0.02 / 0.03
    both["share"][0, 5, 1, 3], both["share"][1, 5, 1, 3] = 0.6, 0.7
    both["pressure_max"][0, 5, 1, 3], both["pressure_max"][1, 5, 1, 3] = 0.85e9, 0.9e9
    both["pressure_max"][1, 3, 1, 2] = 4.2e9
    both["error"][1] = [0.0, 3e-4, 1e-4, 2e-4]
    both["pressure_map"][:, 0, :, 24:] = 0.0  # half of the face at 10 N.m
    both["share"][0, :, 0, 1] = 0.1  # three pairs of the drive side
    return both


def test_key_numbers_and_findings_of_both_sides_are_known():
    expected = []
    for side, order, unloaded, pressure, edge, stiffness, path in (
        # 1e-4 rad at an arm of 20 mm are 2 um, 3e-4 rad at 30 mm 9 um
        ("drive", (0.9, "0.900"), (2.0, "2.00"), (1.0, "1.00"), (np.nan, "–"), (300.0, "300"),
         (1.8, "1.80")),
        ("coast", (1.8, "1.80"), (9.0, "9.00"), (0.9, "0.900"), (80.0, "80.0"), (700.0, "700"),
         (1.7, "1.70")),
    ):  # fmt: skip
        for words, unit, (value, text) in (
            ("largest first order of the loaded error", "µm", order),
            ("unloaded error, peak to peak", "µm", unloaded),
            ("highest pressure away from sharp edges", "GPa", pressure),
            ("least torque with edge contact", "N·m", edge),
            ("mean secant stiffness at the highest torque", "N/µm", stiffness),
            ("path of contact", "mesh periods", path),
        ):
            expected.append((f"{words}, {side}", value, unit, text))
    assert_numbers(numbers(known()), expected)
    # cells 10 to 33 of 48 at 80 N.m, 10 to 23 at 10 N.m
    pattern = "80 N·m, 21, 71 %, 0, 100, 10 N·m, 29 %"
    said = [
        (NOTE, "first mesh order … (drive, at … (coast, at … On drive flanks … On coast flanks",
         "0.900 µm, 80 N·m, 1.80 µm, 80 N·m, 10 N·m, 0.300 µm, 2.00 µm, 10 N·m, 0.600 µm, "
         "9.00 µm"),
        (WARNING, "Sharp edges press into the coast flanks",
         "80 N·m, 2.5 GPa, 80 N·m, 0.90 GPa"),
        (GOOD, "the drive pattern stays on the face", pattern),
        (GOOD, "the coast pattern stays on the face", pattern),
        (NOTE, "mean mesh stiffness (drive, secant)",
         "200 N/µm, 10 N·m, 300 N/µm, 80 N·m, 80 N·m, 2.0"),
    ]  # fmt: skip
    assert_findings(findings(known()), said)


def test_the_table_of_the_loaded_contact_is_known():
    found = [list(one) for one in contact_summary(known())]
    expected = [
        ["drive", 10.0, 2e8, 2.2e8, 0.02, 3.0, 0.8e9],
        ["drive", 80.0, 3e8, 3.3e8, 0.02, 2.0, 1.0e9],
        ["coast", 10.0, 5e8, 5.5e8, 0.03, 2.0, 0.8e9],
        ["coast", 80.0, 7e8, 7.7e8, 0.03, 2.0, 4.2e9],
    ]
    for got, row in zip(found, expected, strict=True):
        assert_cells(got, row, "contact summary")
    scale = (1.0, 1e-6, 1e-6, 1e3, 1.0, 1e-9)
    heads = [
        "flanks", "torque [N·m]", "secant stiffness [N/µm]", "tangent stiffness [N/µm]",
        "pinion arm [mm]", "pairs", "highest pressure [GPa]",
    ]  # fmt: skip
    rows = [[side, *(a * b for a, b in zip(row, scale, strict=True))] for side, *row in expected]
    rows[-1][-1] = None  # of a sharp edge, no number to use
    assert_tables([_table(known())], {"Loaded contact": [heads, *rows]})


def test_figures_show_numbers_in_the_units_of_their_labels():
    """Each quantity has one value: what is drawn is this value in the unit of the axis."""
    sizes = {  # SI, and as drawn
        "R_x": (0.011, "mm", 11.0), "R_y": (0.7, "m", 0.7), "R_sliding": (0.031, "mm", 31.0),
        "entrainment_arm": (0.013, "mm", 13.0), "sliding_arm": (0.017, "mm", 17.0),
        "psi": (np.pi / 6.0, "°", 30.0), "chi": (np.pi / 4.0, "°", 45.0), "share": (0.5, "-", 0.5),
        "pressure_max": (1.5e9, "GPa", 1.5), "k_m": (3e8, "N/µm", 300.0),
        "k_t": (2e8, "N/µm", 200.0), "R_p": (ARM, "mm", 20.0), "R_g": (0.05, "mm", 50.0),
    }  # fmt: skip
    of_pairs = contact()["share"]
    states = contact()["k_m"]
    dataset = contact().assign(
        {
            name: (states if name in ("k_m", "k_t", "R_p", "R_g") else of_pairs) * 0.0 + value
            for name, (value, _, _) in sizes.items()
        }
    )
    dataset["share"] = of_pairs  # of two pairs of five
    shown = []
    for figure in (
        catalogue.contact_properties(dataset),
        catalogue._load_shares(dataset),
        catalogue._stiffness_and_radii(dataset),
    ):
        for left, right in zip(figure.axes[::2], figure.axes[1::2], strict=True):
            values = [line.get_ydata() for ax in (left, right) for line in ax.lines[: len(TORQUES)]]
            drawn = np.concatenate(values)
            (one,) = np.unique(np.round(drawn[np.isfinite(drawn)], 9))
            shown.append((left.get_ylabel().partition("[")[2].rstrip("]"), one))
    assert shown == [(unit, pytest.approx(one, rel=1e-9)) for _, unit, one in sizes.values()]
    figure = catalogue._stiffness_against_torque(dataset)
    for ax, expected in zip(figure.axes, ([300.0, 200.0], [2.0, 2.0]), strict=True):
        for line, value in zip(ax.lines, 2 * expected, strict=True):
            assert line.get_xdata() == pytest.approx(TORQUES)
            assert line.get_ydata() == pytest.approx(value)
    loaded = catalogue.new_figure(3.0, 3.0).subplots()
    catalogue._loaded(loaded, dataset.sel(side="coast"))
    found = [np.ptp(line.get_ydata()) for line in loaded.lines]
    assert found == pytest.approx(2.0 * np.array(AMPLITUDE))  # um
    seven = dataset.isel(torque=[0] * 7).assign_coords(torque=np.arange(1.0, 8.0))
    catalogue._loaded(loaded := catalogue.new_figure(3.0, 3.0).subplots(), seven.sel(side="drive"))
    assert [line.get_label()[0] for line in loaded.lines] == ["1", "3", "5", "7"]


def test_a_wrong_sliding_base_is_refused_with_the_one_that_meshes(tmp_path):
    wrong = shipped_file().varied({"pinion.machine.sliding_base_mm": 10.647})
    with pytest.raises(ParameterError, match="The flanks cannot mesh") as refusal:
        analyse_contact(wrong, ContactSettings(), store=tmp_path, cache=tmp_path)
    found = re.search(r"sliding_base_mm from 10\.647 to ([\d.]+) mm", str(refusal.value))
    # printed 20.647 mm, with which the reference planes miss each other by 1.6 um
    assert float(found[1]) == pytest.approx(20.647, abs=5e-3)
    assert not list(tmp_path.iterdir())
