"""The whine study of a helical pair: inertias of its file, its dataset and report."""

from dataclasses import replace

import numpy as np
import pytest

from gearlube.report.page import report_html
from gearlube.studies.whine import run as study
from gearlube.studies.whine.report import whine_report
from gearlube.studies.whine.run import WhineSettings
from gearlube_core.helical_contact.loaded_contact import LoadedSettings
from gearlube_core.helical_contact.series_rates import helical_series_rates
from gearlube_core.helical_contact.strips import StripSettings
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.hypoid_contact.sensitivity.series_rates import SeriesSettings
from tests.helpers.helical_contact_cases import stiff_teeth

FILE = HelicalGearFile.named("he_2007").varied({"pinion.flank.crown_um": 6.0})
NAMES = ("pinion.flank.crown_um", "gear.flank.lead_slope_um")
COARSE = LoadedSettings(strips=StripSettings(cells_across=9, cells_along=16))
SETTINGS = WhineSettings(
    series=SeriesSettings(parameters=NAMES, torque=200.0, positions=7),
    speeds=(20.0, 60.0),
    orders=(1, 2),
)


@pytest.fixture(scope="module")
def dataset():
    teeth = stiff_teeth(1.1e11)

    def coarse(file, series, **_):
        return helical_series_rates(file, replace(series, loaded=COARSE), stiffness=teeth)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(study, "helical_series_rates", coarse)
        return study.run_whine(FILE, SETTINGS)


@pytest.mark.slow
def test_far_below_resonance_the_error_is_the_static_one(dataset):
    static = dataset["loaded_error"].values
    wave = 2.0 / 7 * np.exp(-2j * np.pi * np.arange(7) / 7)
    # arms are constant; 80 Hz at the mesh, far below its mode
    found = float(dataset["transmission_error"].sel(pinion_speed=20.0, order=1))
    assert found == pytest.approx(abs(wave @ static), rel=0.05)


def test_inertias_are_those_of_the_gear_file_unless_given():
    own = SETTINGS.inertias(FILE)
    assert own == (FILE.body("pinion").polar_inertia, FILE.body("gear").polar_inertia)
    assert replace(SETTINGS, gear_inertia=0.5).inertias(FILE) == (own[0], 0.5)


@pytest.mark.slow
def test_the_report_says_that_the_pair_is_helical_and_what_moves_it(dataset):
    html = report_html(whine_report(dataset))
    for part in ("Whine of the helical pair he_2007", "reliefs and slopes change", "crown"):
        assert part in html
    assert "Profile shift coefficients are guessed: x = 0.000 (pinion)" in html
