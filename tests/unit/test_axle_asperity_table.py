"""The axle with asperities of a table instead of the usual constants."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from drivetrain.axle_file.read_axle import read_axle
from fmu_src import identity
from fmu_src.hypoid_axle import car_axle_in, definition_with_axle
from gearlube_core.contact.greenwood_tripp_1971 import (
    SurfaceParameters,
    asperity_area,
    asperity_load,
)
from gearlube_core.contact.hertz import ellipticity
from gearlube_core.contact.solid import STEEL_MOHAMMADPOUR_2015, contact_modulus
from gearlube_core.dynamics.hypoid_axle import mohammadpour_2015_axle
from gearlube_core.errors import ParameterError, TableError
from gearlube_core.friction.flank import flank_friction
from gearlube_core.friction.flank_data import CONSISTENT, contact_geometry
from gearlube_core.friction.flank_film import FlankEllipse
from gearlube_core.friction.flank_laws import Consistent
from gearlube_core.kernels.flat_tuples import flatten
from gearlube_core.oil.lubricant_state import lubricant_state

RATIOS = np.array([0.5, 0.75, 1.0, 1.5, 2.0, 3.0, 4.0])
USUAL = SurfaceParameters(0.5e-6, 0.055, 0.001)  # of finished gear flanks
STEEP = SurfaceParameters(0.7e-6, 0.3, 0.02)
MEDIUM = SurfaceParameters(0.7e-6, 0.1, 0.01)


def table_of(surface: SurfaceParameters, path: Path, **changes: object) -> Path:
    """Write a table that Greenwood and Tripp's law itself makes."""
    unit = surface._replace(sigma=1.0)
    load = [asperity_load(one, 1.0, 1.0, unit) for one in RATIOS]
    area = [asperity_area(one, 1.0, unit) for one in RATIOS]
    columns = {"asperity_pressure": load, "asperity_area": area} | changes
    data = {name: ("film_ratio", one) for name, one in columns.items() if one is not None}
    attributes = {"roughness": surface.sigma}
    xr.Dataset(data, {"film_ratio": RATIOS}, attributes).to_netcdf(path, engine="scipy")
    return path


def axle_file(folder: Path, more: str = "") -> Path:
    path = folder / "axle.toml"
    path.write_text(
        f'[gear_set]\nmesh_table = "mohammadpour_2015"\nasperity_table = "own.nc"\n{more}\n'
    )
    return path


def test_a_table_of_the_usual_law_is_the_axle_without_a_table(tmp_path):
    table_of(USUAL, tmp_path / "own.nc")
    made, plain = read_axle(axle_file(tmp_path)).axle, mohammadpour_2015_axle()
    # the fit takes logarithms back and forth: roundings, and 1e-8 of the law's interpolation
    assert flatten(made.kernel_parameters()) == pytest.approx(
        flatten(plain.kernel_parameters()), rel=1e-7, abs=0.0, nan_ok=True
    )


def test_friction_of_the_axle_is_that_of_the_surface_of_the_table(tmp_path):
    table_of(STEEP, tmp_path / "own.nc")
    axle = read_axle(axle_file(tmp_path)).axle
    law, oil = axle._flank_law(), lubricant_state(axle.oil.parameters(), 368.15)
    modulus, load = contact_modulus(STEEL_MOHAMMADPOUR_2015, STEEL_MOHAMMADPOUR_2015), 2000.0
    found = flank_friction(
        load, 3.0, 2.0, contact_geometry(0.02, 0.1, 0.0, modulus), oil,
        law.surface, law.solid, CONSISTENT,
    )  # fmt: skip
    ratio, area = found.film_ratio, load / found.mean_pressure
    assert 0.3 < ratio < 3.0  # mixed
    on_asperities = min(asperity_load(ratio, area, modulus, STEEP), load)
    touching = asperity_area(ratio, area, STEEP)
    expected = oil.tau_l0 * touching + oil.gamma * on_asperities
    # junctions build up over 1 mm/s of sliding; the fit is exact to roundings for its own law
    assert found.boundary_friction == pytest.approx(expected, rel=1e-6)


def test_with_solved_films_the_asperities_of_the_table_stand_on_the_solved_film(tmp_path):
    table_of(MEDIUM, tmp_path / "own.nc")
    axle = read_axle(axle_file(tmp_path, '[film]\nmodel = "solved"')).axle
    law, oil = axle._flank_law(), lubricant_state(axle.oil.parameters(), 368.15)
    modulus, load, numbers = law.solid.contact_modulus, 2000.0, axle.film_model()
    R_x, R_y, psi = 0.0125, 1.0, 0.85
    contact = (load, 5.0, 3.6, contact_geometry(R_x, R_y, psi, modulus))
    ellipse = FlankEllipse(R_x, R_y, ellipticity(R_y / R_x), psi, 0.4)
    film = law.model_film(*contact, ellipse, oil, numbers)
    found = law.bounded_flank(*contact, film, oil, numbers)
    assert found.outside == 0.0
    solved = math.exp(film.log_film)
    assert found.state.film_thickness == pytest.approx(solved, rel=1e-12)
    formula = law._replace(film=0.0).flank_state(*contact, oil)
    assert solved < 0.9 * formula.film_thickness
    area = load / found.state.mean_pressure
    on_asperities = asperity_load(solved / MEDIUM.sigma, area, modulus, MEDIUM)
    touching = asperity_area(solved / MEDIUM.sigma, area, MEDIUM)
    assert on_asperities < load
    expected = oil.tau_l0 * touching + oil.gamma * on_asperities
    assert found.state.boundary_friction == pytest.approx(expected, rel=1e-6)  # as above
    # a thinner film under rougher asperities: more than either change alone
    assert expected > 1.1 * formula.boundary_friction
    plain = Consistent()(USUAL, law.solid)._replace(film=law.film)
    assert expected > plain.bounded_flank(*contact, film, oil, numbers).state.boundary_friction


def test_the_file_says_what_the_table_became_and_how_far_it_is_missed(tmp_path):
    # the load is twice the law's at one film ratio of seven
    load = np.array([asperity_load(one, 1.0, 1.0, STEEP._replace(sigma=1.0)) for one in RATIOS])
    table_of(STEEP, tmp_path / "own.nc", asperity_pressure=load * np.where(RATIOS == 1.0, 2.0, 1.0))
    notes = {note.field: note for note in read_axle(axle_file(tmp_path)).inputs}
    fit = notes["gear_set.asperity_table.xi_beta_sigma"]
    assert (fit.origin, fit.value) == ("inferred", pytest.approx(0.3, rel=1e-7))
    # six ratios are within 0.5 to 3: mean logarithm ln(2)/6, largest miss 2^(5/6) = 1.78
    assert "misses the load by a factor of 1.78 at most, the area by 1" in fit.why
    roughness = notes["gear_set.roughness_rms_um"]
    assert (roughness.value, roughness.origin) == (pytest.approx(0.7), "inferred")
    given = read_axle(axle_file(tmp_path, "roughness_rms_um = 0.4")).axle
    assert given.roughness_rms == pytest.approx(0.4e-6)


def test_an_fmu_carries_the_table_and_computes_with_it(tmp_path):
    path, table = axle_file(tmp_path), table_of(STEEP, tmp_path / "own.nc")
    definition = definition_with_axle(path)
    assert definition.resources["asperity_table.nc"] == table.read_bytes()
    inside = car_axle_in(definition.resources).axle
    outside = read_axle(path).axle
    assert inside.xi_beta_sigma == outside.xi_beta_sigma == pytest.approx(0.3, rel=1e-7)
    assert inside.sigma_over_beta == pytest.approx(0.02, rel=1e-7)
    # the FMU's parameter starts at the roughness of the table
    (start,) = (v.start for v in definition.variables if v.name == "flank.roughness_rms")
    assert start == pytest.approx(0.7e-6, rel=1e-9, abs=0.0)
    guid = identity.guid_of(definition)
    table_of(STEEP._replace(sigma_over_beta=0.03), table)
    assert identity.guid_of(definition_with_axle(path)) != guid


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"asperity_pressure": None}, "it lacks asperity_pressure"),
        ({"asperity_area": np.zeros(7)}, "asperity_area must be above 0, got 0"),
        ({"asperity_pressure": np.full(7, np.nan)}, "at two film ratios within 0.5 to 3, got 0"),
    ],
)
def test_tables_without_asperities_are_refused(tmp_path, changes, words):
    table_of(USUAL, tmp_path / "own.nc", **changes)
    with pytest.raises(TableError, match=words):
        read_axle(axle_file(tmp_path))


def test_a_missing_or_damaged_table_is_refused_with_its_place(tmp_path):
    with pytest.raises(ParameterError, match=r"own\.nc was not found in .* it in gear_set\.asp"):
        read_axle(axle_file(tmp_path))
    (tmp_path / "own.nc").write_bytes(b"no table")
    with pytest.raises(TableError, match=r"own\.nc is not a readable NetCDF 3 file"):
        read_axle(axle_file(tmp_path))
