"""Findings and key numbers of a tooth contact analysis, from datasets with known answers."""

import numpy as np
import pytest
import xarray as xr

from gearlube.report.parts import GOOD, WARNING
from gearlube.studies.contact.figures.charts import stiffness_chart
from gearlube.studies.contact.findings import edge_torque, findings, numbers, transmission_orders

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
    found = transmission_orders(contact().sel(side="drive"))
    np.testing.assert_allclose(found[:, 0], AMPLITUDE, rtol=1e-9)
    np.testing.assert_allclose(found[:, 1:], 0.0, atol=1e-9)


def test_the_chart_of_stiffness_has_the_pairs_that_its_caption_names():
    chart = stiffness_chart(contact().assign(k_t=1.5 * contact()["k_m"]))
    lines = {(one.name, one.yaxis): one.y for one in chart.data}
    np.testing.assert_allclose(lines["drive, secant", "y"], 300.0)  # N/um
    np.testing.assert_allclose(lines["coast, tangent", "y"], 450.0)
    np.testing.assert_allclose(lines["drive, pairs", "y2"], 2.0)  # two of five carry load


def test_a_pressure_above_that_of_edges_is_told_with_its_torque():
    sound, pressed = contact(), contact(pressure=4.0e9)
    assert np.isnan(edge_torque(sound.sel(side="drive")))
    assert edge_torque(pressed.sel(side="drive")) == TORQUES[1]
    assert findings(sound)[0].level == GOOD
    warning = findings(pressed)[0]
    assert warning.level == WARNING
    assert "from 80 N·m on, with up to 4.00 GPa" in warning.headline


@pytest.mark.parametrize(("heel", "level"), [(0.7, GOOD), (1.0, WARNING)])
def test_a_pattern_that_runs_off_the_heel_is_a_warning(heel, level):
    pattern = next(one for one in findings(contact(heel=heel)) if "pattern" in one.headline)
    assert pattern.level == level
    assert ("runs off the heel" in pattern.headline) == (level == WARNING)


def test_key_numbers_have_everyday_units():
    found = {one.name: (one.value, one.unit) for one in numbers(contact())}
    # 1e-4 rad at an arm of 20 mm are 2 um
    assert found["unloaded error, peak to peak, drive"] == (pytest.approx(2.0), "µm")
    assert found["highest pressure, coast"] == (pytest.approx(1.0), "GPa")
    assert found["mean secant stiffness at the highest torque, drive"][0] == pytest.approx(300.0)
