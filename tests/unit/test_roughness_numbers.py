"""Every number of the roughness study: known answers of surfaces that are written down."""

import math

import numpy as np
import pytest

from gearlube.studies.roughness import results
from gearlube_core.rough_patch import table
from gearlube_core.rough_patch.flow import FlowFactors
from gearlube_core.surface.heights import HeightMap, Profile
from gearlube_core.surface.statistics import MapStatistics, ProfileStatistics
from tests.helpers.known_answers import assert_attributes, assert_variables, made_up, named

MICRO = "um"
OF_PROFILES = {
    "length": MICRO, "spacing": MICRO, "Ra": MICRO, "Rq": MICRO, "Rp": MICRO, "Rv": MICRO,
    "Rt": MICRO, "Rz": MICRO, "Rsk": "1", "Rku": "1", "Rdq": "1", "steepest": "1", "Ral": MICRO,
    "mean_wavelength": MICRO,
}  # fmt: skip
OF_MAPS = {
    "lengths": MICRO, "spacing": MICRO, "Sa": MICRO, "Sq": MICRO, "Sp": MICRO, "Sv": MICRO,
    "Sz": MICRO, "Ssk": "1", "Sku": "1", "Sdq": "1", "steepest": "1", "Sal": MICRO, "Str": "1",
    "fastest_direction": "deg", "correlation_lengths": MICRO, "mean_wavelengths": MICRO,
}  # fmt: skip
PAIRS = ("lengths", "correlation_lengths", "mean_wavelengths")
FACTOR = {MICRO: 1e6, "1": 1.0, "deg": 180.0 / math.pi}


@pytest.fixture(autouse=True)
def no_figures_nor_netcdf(monkeypatch):
    for name in ("_surface_figure", "flow_figure"):
        monkeypatch.setattr(results, name, lambda _: named(savefig=lambda *_, **__: None))
    monkeypatch.setattr(results, "write_dataset", lambda *_: None)


def test_statistics_of_profiles_and_maps_are_known(monkeypatch, tmp_path):
    """Each statistic of its own, lengths in um, slopes without unit, the direction in deg."""
    for kind, units, shape, made in (
        ("profile", OF_PROFILES, (4,), ProfileStatistics),
        ("map", OF_MAPS, (4, 4), MapStatistics),
    ):
        pairs = (*PAIRS, "spacing") if kind == "map" else ()
        given = {
            name: tuple(made_up(name, 2)) if name in pairs else made_up(name) for name in units
        }
        monkeypatch.setattr(results, f"{kind}_statistics", lambda _, of=made, g=given: of(**g))
        height = np.zeros(shape)
        step = {"spacing": 1e-6} if kind == "profile" else {"spacing": (1e-6, 1e-6)}
        surface = (Profile if kind == "profile" else HeightMap)(height=height, **step)
        expected = []
        for name, unit in units.items():
            names = (f"{name} x", f"{name} y") if name in pairs else (name,)
            for shown, value in zip(names, np.atleast_1d(given[name]), strict=True):
                expected.append((shown, FACTOR[unit] * value, unit, None))
        found = results.statistics_rows(surface)
        assert [(*row[:1], *row[2:]) for row in found] == [(n, u, a) for n, _, u, a in expected]
        np.testing.assert_allclose([r.value for r in found], [r[1] for r in expected], rtol=1e-12)
        _, sheet, _ = results.write_results({kind: surface}, tmp_path)
        head, *rows = sheet.read_text().splitlines()
        assert head == "name,value,unit"
        assert rows == [f"{name},{value:.9g},{unit}" for name, value, unit, _ in expected]
    reached = [named(name="Rq", unit="m", asked=2e-7, reached=3e-7),
               named(name="Rsk", unit="1", asked=-0.5, reached=-0.25)]  # fmt: skip
    rows = results.reached_rows(named(statistics=reached))
    assert [(r.name, r.unit) for r in rows] == [("Rq", MICRO), ("Rsk", "1")]
    np.testing.assert_allclose([r[1::2] for r in rows], [[0.3, 0.2], [-0.25, -0.5]], rtol=1e-12)


def test_flow_factors_and_asperities_of_patches_are_known(monkeypatch, tmp_path):
    """Waves of 0.1 and 0.2 um over 16 um; a mean load over E* and slope of 10^-r leaves r sigma.

    Of the second wave the flow factors are twice as large: 1.5 and 0.5^(1/2) times the first.
    """
    wave = 1e-7 * np.cos(2.0 * math.pi * np.arange(16) / 16)[:, None] + np.zeros(16)
    patches = [HeightMap(height=k * wave, spacing=(1e-6, 1e-6)) for k in (1.0, 2.0)]
    sigma = 1e-7 / math.sqrt(2.0)
    slope = sigma * 2.0 * math.pi / 16e-6
    factors = ("pressure_x", "pressure_y", "pressure_xy", "shear_x", "contact_share")

    def flow(patch, film):
        k = float(patch.height.max()) / 1e-7
        ratio = film / (k * sigma)
        return FlowFactors(mean_film=1.25 * film, **{n: k * ratio * made_up(n) for n in factors})

    def press(patch, pressure, modulus, start, tolerance):
        k = float(patch.height.max()) / 1e-7
        ratio = -math.log10(pressure / (modulus * k * slope))
        return named(pressure=None, film=ratio * k * sigma, contact_share=0.5 * 10.0**-ratio)

    monkeypatch.setattr(table, "flow_factors", flow)
    monkeypatch.setattr(table, "press_patch", press)
    ratios = np.array([0.5, 3.0, 6.0])  # 10^-6 is below the least load
    made = table.patch_table(patches, ratios)
    load = np.array([10.0**-0.5, 10.0**-3.0, np.nan])
    expected = {"film_ratio": ("1", ratios), "mean_film": ("1", 1.25 * ratios),
                "mean_film_spread": ("1", 0.0 * ratios)}  # fmt: skip
    for name, values in [(n, made_up(n) * ratios) for n in factors] + [
        ("asperity_pressure", slope * load),
        ("asperity_area", 0.5 * load),
    ]:
        one = (1.0, 0.0) if name == "asperity_area" else (1.5, math.sqrt(0.5))
        expected[name], expected[f"{name}_spread"] = (("1", f * values) for f in one)
    even = ("mean_film_spread", "asperity_area_spread")
    assert_variables(made, expected, zero=even)
    assert_attributes(made, {"patches": 2, "roughness": 1.5 * sigma, "rms_slope": 1.5 * slope,
                             "nodes": "16x16"})  # fmt: skip
    _, sheet, _ = results.flow_results(made, tmp_path, None)
    head, *rows = sheet.read_text().splitlines()
    names = head.split(",")
    assert names[0] == "film_ratio"
    assert sorted(names) == sorted(expected)
    written = np.array([[float(cell) for cell in row.split(",")] for row in rows])
    # nine digits; the spread of equal films is rounding
    for name, column in zip(names, written.T, strict=True):
        np.testing.assert_allclose(column, expected[name][1], rtol=1e-8, atol=1e-9, err_msg=name)
    heads, shown = results.shown_rows(made)
    assert heads == ("h/sigma", "phi_x", "phi_y", "Phi_s", "overlap", "p/E*", "area")
    names = ("pressure_x", "pressure_y", "shear_x", "contact_share", "asperity_pressure",
             "asperity_area")  # fmt: skip
    assert shown[1] == ("3", *(f"{expected[name][1][1]:.3g}" for name in names))
