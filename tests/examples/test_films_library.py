"""Films solved by library calls: progress, results, files only where a folder is given."""

from dataclasses import replace

import numpy as np
import pytest
import xarray as xr

from gearlube.studies.films import results
from gearlube.studies.films.datasets.contact import line_dataset, point_dataset
from gearlube.studies.films.helical_case import HelicalLineCase, with_flanks
from gearlube.studies.films.results import write_film_results
from gearlube.studies.films.run_march import MarchSteps, compare_marches, run_helical_march
from gearlube.studies.films.run_steady import run_helical_line, run_line
from gearlube_core.ehl.case.contact_case import LineCase
from gearlube_core.ehl.line.problem import LineProblem, LineSettings
from gearlube_core.ehl.line.solver import solve_line
from gearlube_core.ehl.point.contact_domain import elliptical_contact
from gearlube_core.ehl.point.solver import solve_point_contact
from gearlube_core.errors import ParameterError
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.oil.film_oil_data import jamali_2015_oil

PAIR = HelicalLineCase(
    file=HelicalGearFile.named("jamali_2015_a"), step=300.0, newtonian=True, nodes=(33, 33)
)


class Heard:
    """What a run has reported."""

    def __init__(self):
        self.shares, self.sentences = [], []

    def __call__(self, share, sentence):
        self.shares.append(share)
        self.sentences.append(sentence)

    def assert_whole(self):
        assert self.shares == sorted(self.shares)
        assert (self.shares[0], self.shares[-1]) == (0.0, 1.0)
        assert all(self.sentences)


def test_a_run_reports_from_nothing_to_all_and_writes_nothing_unasked(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    heard = Heard()
    film = run_line(LineCase.named("jamali_2015").varied({"solver.nodes": 101}), progress=heard)
    assert film.attrs["converged"] == 1
    assert "onverged" in film.attrs["outcome"]
    heard.assert_whole()
    assert not list(tmp_path.iterdir())


def test_a_film_without_a_case_has_its_files(tmp_path, monkeypatch):
    drawn = []  # the figures of each kind are drawn by the tests of what is written
    monkeypatch.setattr(results, "save_film_figures", lambda *given: drawn.append(given) or [])
    contact = LineProblem(
        lubricant=jamali_2015_oil(), radius=0.014, line_load=2e5, reduced_modulus=227.5e9,
        speed_1=8.0, speed_2=5.0,
    )  # fmt: skip
    line = line_dataset(solve_line(contact, LineSettings(nodes=101)), name="mine")
    ball = elliptical_contact(
        R_x=0.012, R_y=0.012, entrainment=(1.0, 0.0), load=20.0, contact_modulus=115e9,
        lubricant=jamali_2015_oil(newtonian=True), nodes=(33, 33),
    )  # fmt: skip
    point = point_dataset(solve_point_contact(ball), sliding=(0.2, 0.0))
    for dataset in (line, point):
        kind = dataset.attrs["contact"]
        write_film_results(dataset, tmp_path / kind)
        xr.testing.assert_equal(
            xr.load_dataset(tmp_path / kind / f"{kind}.nc", engine="scipy"), dataset
        )
        assert (tmp_path / kind / "summary.csv").exists()
    assert len(drawn) == 2
    assert line.attrs["name"] == "mine"
    # a Newtonian film: shear force of eta |du|/h over the plane
    stress = point["viscosity"] * 0.2 / point["film"]
    force = np.trapezoid(np.trapezoid(stress, point["y"]), point["x"])
    assert point.attrs["friction_force"] == pytest.approx(force, rel=1e-9)


def test_a_march_begins_with_the_film_at_rest_and_needs_no_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    heard = Heard()
    march = run_helical_march(PAIR, MarchSteps(first=300, last=301), progress=heard)
    heard.assert_whole()
    assert march.sizes["step"] == 2
    assert march.attrs["outcome"] == "All 2 steps converged."
    rest = run_helical_line(PAIR)
    # both solve the same equations, to a residual of 1e-5
    for name in ("minimum_film", "pressure_max"):
        assert float(march[name][0]) == pytest.approx(rest.attrs[name], rel=1e-4)
    np.testing.assert_allclose(march["line_film"][0], rest["film"].min("x"), rtol=1e-4)
    assert not list(tmp_path.iterdir())
    with pytest.raises(ParameterError, match="folder"):
        run_helical_march(PAIR, MarchSteps(first=300, last=301, snapshots=(300,)))


@pytest.mark.slow
def test_a_record_with_more_steps_serves_a_shorter_march(tmp_path):
    given = MarchSteps(first=300, last=302, record_every=1)
    longer = run_helical_march(PAIR, given, folder=tmp_path)
    shorter = run_helical_march(PAIR, replace(given, last=301), folder=tmp_path)
    np.testing.assert_array_equal(shorter["step"], [300.0, 301.0])
    xr.testing.assert_equal(shorter, longer.isel(step=slice(0, 2)))
    assert shorter.attrs["outcome"] == "All 2 steps converged."


def march(steps, films, failed=()):
    """A dataset with the curves that a comparison shows."""
    converged = [float(step not in failed) for step in steps]
    curves = {"pressure_max": 1e9 * np.ones(len(steps)), "minimum_film": films}
    return xr.Dataset(
        {name: ("step", values) for name, values in {**curves, "converged": converged}.items()},
        {"step": steps},
        {
            "contact": "helical_cycle", "name": "made up", "pinion_speed": 100.0,
            "failures": len(failed), "converged": int(not failed),
        },
    )  # fmt: skip


def test_marches_are_compared_over_all_their_steps(tmp_path):
    marches = {"one": march([1.0, 2.0], [3e-7, 4e-7]), "two": march([2.0, 3.0], [5e-7, 6e-7])}
    both = compare_marches(marches, folder=tmp_path)
    np.testing.assert_array_equal(
        both["minimum_film"], [[3e-7, 4e-7, np.nan], [np.nan, 5e-7, 6e-7]]
    )
    assert list(both["march"].values) == ["one", "two"]
    assert both.attrs["converged"] == 1
    assert [path.name for path in tmp_path.iterdir()] == ["compare.png"]
    marches["three"] = march([1.0, 2.0], [1e-7, 1e-7], failed=(2.0,))
    failed = compare_marches(marches)
    assert failed.attrs["converged"] == 0
    assert failed.attrs["outcome"] == "Steps did not converge in three."


def test_only_one_form_of_relief_replaces_that_of_the_flanks():
    with pytest.raises(ParameterError, match="Leave one out"):
        with_flanks(PAIR.file, relief_parabola=0.5, relief_exponent=2.0)
    assert with_flanks(PAIR.file) is PAIR.file
