"""Machine settings fitted to the deviations that they would cut."""

import numpy as np
import pytest

from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_contact.settings_fit import fit_settings, flank_deviation
from gearlube_core.hypoid_geometry.flank.flank import Flank
from gearlube_core.hypoid_geometry.measured.deviation_grid import DeviationGrid, GridPlaces
from tests.helpers.each import each
from tests.helpers.loaded_cases import FILE

PLACES = GridPlaces(s=np.linspace(0.3, 0.92, 5), t=np.linspace(0.08, 0.92, 9))
TILT, RADIAL = "pinion.machine.tilt_angle_deg", "pinion.machine.radial_setting_mm"
CUT = FILE.varied(
    {
        TILT: FILE.pinion.machine.tilt_angle_deg + 0.1,
        RADIAL: FILE.pinion.machine.radial_setting_mm + 0.05,
    }
)


@pytest.fixture(scope="module")
def grids():
    found = []
    for side in ("drive", "coast"):
        flanks = (Flank.from_file(one, "pinion", side) for one in (FILE, CUT))
        deviation = flank_deviation(*flanks, PLACES.s, PLACES.t)[None]
        found.append(
            DeviationGrid(role="pinion", side=side, places=PLACES, teeth=(1,), deviation=deviation)
        )
    return found


def test_settings_come_back_exactly_without_noise(grids):
    found = fit_settings(FILE, grids, [TILT, RADIAL])
    # the search ends at a thousandth of a hundredth of a degree and of a millimetre
    assert found.change == pytest.approx([0.1, 0.05], abs=1e-5)
    assert found.corrective == pytest.approx(found.nominal - [0.1, 0.05], abs=1e-5)
    assert found.after < 1e-9
    assert found.before > 2e-6
    assert found.units == ("deg", "mm")


def test_with_noise_they_come_back_within_what_is_said(grids):
    rng = np.random.default_rng(3)
    noisy = [
        DeviationGrid(
            role=one.role, side=one.side, places=one.places, teeth=(1,),
            deviation=one.deviation + 1e-6 * rng.standard_normal(one.deviation.shape),
        )
        for one in grids
    ]  # fmt: skip
    found = fit_settings(FILE, noisy, [TILT, RADIAL])
    off = (found.change - [0.1, 0.05]) / found.uncertainty
    assert np.abs(off).max() < 3.0
    assert found.uncertainty[0] < 0.02
    # 90 numbers less two means and two settings
    assert found.after == pytest.approx(np.sqrt(86 / 90) * 1e-6, rel=0.15, abs=0.0)


@each(
    ("fields", "words"),
    [
        (["gear.machine.horizontal_setting_mm"], "must be of pinion.machine or pinion.cutter"),
        ([TILT, "pinion.machine.tilt_angle"], "must be a number of the gear file"),
        (
            ["pinion.machine.basic_cradle_angle_deg", TILT],
            "must change the flanks in different ways",
        ),
    ],
)
def test_foreign_and_idle_settings_are_refused(grids, fields, words):
    with pytest.raises(ParameterError, match=words):
        fit_settings(FILE, grids[:1], fields)
