"""A flank cut with other settings, entered as measured numbers, meshes as it was cut."""

from dataclasses import replace

import numpy as np
import pytest

from gearlube_core.hypoid_contact.loaded_contact import LoadedSettings, MeshPosition
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_contact.searched_transmission_error import searched_transmission_error
from gearlube_core.hypoid_contact.settings_fit import flank_deviation
from gearlube_core.hypoid_contact.strips import StripSettings
from gearlube_core.hypoid_geometry.flank.correction import FlankCorrection
from gearlube_core.hypoid_geometry.measured.deviation_grid import DeviationGrid, GridPlaces
from gearlube_core.hypoid_geometry.measured.measured_flanks import smooth_surface
from tests.helpers.contact_cases import shipped_pair
from tests.helpers.loaded_cases import FILE, stiffness

PLACES = GridPlaces(s=np.linspace(0.25, 0.92, 5), t=np.linspace(0.08, 0.92, 9))
COARSE = LoadedSettings(strips=StripSettings(cells_across=16, cells_along=24))


@pytest.fixture(scope="module")
def cut():
    """The pair with tilt + 0.1 deg and radial + 0.05 mm, and its deviations: 12 um in all."""
    machine = FILE.pinion.machine
    pair = FlankPair.from_file(
        FILE.varied(
            {
                "pinion.machine.tilt_angle_deg": machine.tilt_angle_deg + 0.1,
                "pinion.machine.radial_setting_mm": machine.radial_setting_mm + 0.05,
            }
        ),
        "drive",
    )
    return pair, flank_deviation(shipped_pair("drive").pinion, pair.pinion, PLACES.s, PLACES.t)


def entered(deviation, degree):
    grid = DeviationGrid(
        role="pinion", side="drive", places=PLACES, teeth=(1,), deviation=deviation[None]
    )
    surface = smooth_surface(grid, degree)
    pair = shipped_pair("drive")
    correction = FlankCorrection(surface=surface.removal)
    return replace(pair, pinion=replace(pair.pinion, correction=correction)), surface


def errors(pair):
    """Unloaded errors where the path is open, loaded ones over a period; means removed [rad]."""
    # between the handovers, where the contact keeps to the grid's inner rows
    path = np.linspace(0.0, 0.9, 4) * pair.gear_pitch
    unloaded = searched_transmission_error(pair, path).error
    loaded = np.array(
        [
            MeshPosition.at(pair, phase).load(100.0, stiffness(), COARSE).rotation
            for phase in (0.0, 0.25, 0.5, 0.75)
        ]
    )
    return unloaded - unloaded.mean(), loaded - loaded.mean()


@pytest.mark.slow
def test_a_cut_change_of_settings_entered_as_5_x_9_numbers_gives_its_error(cut):
    pair, deviation = cut
    wanted, plain = errors(pair), errors(shipped_pair("drive"))
    assert 1e6 * np.ptp(deviation) == pytest.approx(12.3, abs=0.2)  # of the size asked about
    for degree, rest, off in ((3, 6e-9, 1.0e-6), (4, 1e-9, 0.5e-6)):
        measured, surface = entered(deviation, degree)
        assert surface.residual_rms < rest
        for got, want, before in zip(errors(measured), wanted, plain, strict=True):
            # what the surface leaves, some nanometres and more at the edges, over arms of 30 mm
            assert np.abs(got - want).max() < off
            # which is a small part of what the settings change
            assert np.abs(want - before).max() > 25.0 * np.abs(got - want).max()


def test_noise_of_the_probe_is_smoothed_by_a_low_degree(cut):
    """Variance of a fit: 10 of 45 numbers are used up, the rest stays as residual."""
    _, deviation = cut
    noise = 1e-6 * np.random.default_rng(5).standard_normal((40, 5, 9))
    rests, changes = [], []
    clean = np.array(entered(deviation, 3)[1].removal)
    x, y = np.meshgrid(2.0 * PLACES.s - 1.0, 2.0 * PLACES.t - 1.0, indexing="ij")
    for one in noise:
        surface = entered(deviation + one, 3)[1]
        rests.append(surface.residual_rms**2)
        change = FlankCorrection(surface=tuple(np.array(surface.removal) - clean))
        changes.append(np.mean(change.bends(0.5 * (x + 1), 0.5 * (y + 1), 1.0, 1.0).value ** 2))
    # means over 40 draws of 35 and 10 squares: scatter 3 and 5 %
    assert np.mean(rests) == pytest.approx(35 / 45 * 1e-12, rel=0.1, abs=0.0)
    assert np.mean(changes) == pytest.approx(10 / 45 * 1e-12, rel=0.17, abs=0.0)


def test_a_surface_of_second_degree_is_the_crowns_and_twist_of_the_same_numbers():
    s, t = np.array([0.1, 0.6]), np.array([0.3, 0.95])
    crowns = FlankCorrection(profile_crown=4e-6, lead_crown=-7e-6, twist=9e-6)
    surface = FlankCorrection(surface=(0.0, 0.0, 0.0, 4e-6, 9e-6, -7e-6))
    for one, other in zip(
        crowns.bends(s, t, 7e-3, 30e-3), surface.bends(s, t, 7e-3, 30e-3), strict=True
    ):
        np.testing.assert_allclose(one, other, rtol=1e-13)


def test_the_bend_of_a_surface_of_third_degree_is_that_of_its_values():
    surface = FlankCorrection(surface=tuple(1e-6 * np.arange(1.0, 11.0)))
    s, t, d, height, width = np.array([0.3]), np.array([0.8]), 1e-3, 7e-3, 30e-3

    def at(i, j):
        return surface.bends(s + i * d, t + j * d, height, width).value

    found = surface.bends(s, t, height, width)
    h, w = d * height, d * width
    expected = {
        "by_h": (at(1, 0) - at(-1, 0)) / (2 * h),
        "by_l": (at(0, 1) - at(0, -1)) / (2 * w),
        "by_hh": (at(1, 0) - 2 * at(0, 0) + at(-1, 0)) / h**2,
        "by_hl": (at(1, 1) - at(1, -1) - at(-1, 1) + at(-1, -1)) / (4 * h * w),
        "by_ll": (at(0, 1) - 2 * at(0, 0) + at(0, -1)) / w**2,
    }
    for name, value in expected.items():
        # third derivatives make first differences wrong by 1e-5; second ones suffer roundings
        np.testing.assert_allclose(getattr(found, name), value, rtol=1e-4)
