"""The commands `gearlube ehl line`, `point` and `helical`: what they ask for, resume and refuse."""

import logging
import math
import tomllib
from dataclasses import replace

import numpy as np
import pytest
import typer
import xarray as xr

from gearlube.cli.exit_codes import BAD_ARGUMENT, FAILED, INTERRUPTED
from gearlube.studies.films import results, run_march, run_steady
from gearlube.studies.films.datasets.contact import hertz_line
from gearlube.studies.films.datasets.helical import march_key
from gearlube_core.ehl.case.contact_case import LineCase, PointCase
from gearlube_core.ehl.gears.helical_film import EXIT_GRADING
from gearlube_core.errors import ParameterError
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from tests.helpers.each import each
from tests.helpers.ehl_command import run
from tests.helpers.jamali_2015 import jamali_2015_film


@pytest.fixture
def asked(monkeypatch):
    """The cases that the command would have solved."""
    calls = []

    def remember(case, steps=None, **given):
        calls.append({"case": case, "steps": steps, **given})
        raise typer.Exit(0)

    for name in ("run_line", "run_point", "run_helical_line"):
        monkeypatch.setattr(run_steady, name, remember)
    monkeypatch.setattr(run_march, "run_helical_march", remember)
    return calls


def test_a_point_whose_oil_does_not_know_temperature_is_refused():
    with pytest.raises(ParameterError, match="houpert"):
        PointCase.named("elliptical").varied({"temperature": "thermal"})


@pytest.mark.slow  # the same store and march as that of hypoid flanks, in the default run
@pytest.mark.parametrize("spacing", ["uniform", "exit"])
def test_a_stopped_march_goes_on_as_if_it_had_not_stopped(spacing, tmp_path, monkeypatch):
    march = (
        "helical", "--march", "300:305", "--snapshots", "302", "--newtonian",
        "--nodes-across", 33, "--nodes-along", 33, "--spacing", spacing,
    )  # fmt: skip
    whole, stopped = tmp_path / "whole", tmp_path / "stopped"
    assert run(*march, "--out", whole).exit_code == 0
    steps = []
    march_itself = run_march.run_helical_march

    def stopping(case, given, *, progress, **others):
        def stop(share, sentence):
            progress(share, sentence)
            if sentence.startswith("smallest film"):
                steps.append(share)
                if len(steps) == 4:
                    raise KeyboardInterrupt

        given = replace(given, record_every=2)
        return march_itself(case, given, progress=stop, **others)

    monkeypatch.setattr(run_march, "run_helical_march", stopping)
    assert run(*march, "--out", stopped).exit_code == INTERRUPTED
    assert not (stopped / "cycle.nc").exists()
    assert not list(stopped.glob("*.part"))
    assert run(*march, "--out", stopped).exit_code == 0
    # steps 300 to 303, the record of 302, then 303 to 305
    assert len(steps) == 7
    one, other = (xr.load_dataset(out / "cycle.nc", engine="scipy") for out in (whole, stopped))
    np.testing.assert_array_equal(other["step"], np.arange(300.0, 306.0))
    # linear solutions of a fresh start differ within the tolerance of a step
    for name in ("minimum_film", "pressure_max", "line_pressure", "line_film"):
        largest = 1e-5 * float(one[name].max())
        np.testing.assert_allclose(other[name], one[name], rtol=1e-5, atol=largest)
    np.testing.assert_allclose(one["line_pressure"].max("y"), one["pressure_max"])
    np.testing.assert_allclose(one["position"][0], -6.7e-3)
    names = {path.name for path in (whole / "figures").iterdir()}
    steps_drawn = {"step_0302_contours.png", "step_0302_sections.png"}
    assert names == {"cycle.png", "cycle_map.png", *steps_drawn}
    # the film of the step, and of the line at rest there, which two steps of 0.04 mm cannot leave
    one, other = (xr.load_dataset(out / "step_0302.nc", engine="scipy") for out in (whole, stopped))
    np.testing.assert_allclose(one["film"], other["film"], rtol=1e-6)
    gaps = np.diff(one["x"])
    # the exit has a quarter of the inlet's spacing
    assert gaps[0] / gaps.min() == pytest.approx({"uniform": 1.0, "exit": 4.0}[spacing], rel=0.2)
    carried = np.trapezoid(np.trapezoid(one["pressure"], one["y"]), one["x"])
    assert carried == pytest.approx(one.attrs["load"], rel=1e-3)
    middle = {"x": 0.0, "y": 0.0}
    beside = one[["film", "steady_film"]].interp(middle)
    assert float(beside["film"]) == pytest.approx(float(beside["steady_film"]), rel=0.02)
    # marches side by side
    result = run("compare", f"k = 1={whole}", stopped, "--out", tmp_path / "both")
    assert result.exit_code == 0, result.output
    assert (tmp_path / "both" / "compare.png").exists()


@pytest.mark.slow
def test_a_snapshot_that_was_asked_for_too_late_is_said(tmp_path, caplog, monkeypatch):
    monkeypatch.setattr(results, "save_film_figures", lambda *_: [])
    march = (
        "helical", "--march", "300:301", "--newtonian", "--nodes-across", 33, "--nodes-along", 33,
        "--out", tmp_path,
    )  # fmt: skip
    assert run(*march).exit_code == 0
    assert run(*march, "--snapshots", "300").exit_code == 0
    assert "passed step 300" in caplog.text
    assert not list(tmp_path.glob("step_*"))
    (lines,) = tmp_path.glob("lines_*.npz")
    lines.write_bytes(lines.read_bytes()[:100])
    assert run(*march).exit_code == BAD_ARGUMENT
    assert lines.name in caplog.text


def test_a_folder_does_not_hide_a_shipped_case(asked, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for name in ("elliptical", "jamali_2015_b"):
        (tmp_path / name).mkdir()
    assert run("point", "elliptical").exit_code == 0
    assert run("helical", "jamali_2015_b").exit_code == 0
    assert asked[1]["case"].file.name == "jamali_2015_b"


def test_options_replace_relief_crown_and_facets_of_both_flanks(asked):
    given = (
        (("--relief-parabola", 0.5, "--crown-start", 11.0), {"k": 0.5, "crown_start": 11e-3}),
        (("--relief-exponent", 3.0), {"beta": 3.0}),
        (("jamali_2015_b", "--facets", 40), {"facets": 40}),
    )
    for options, variant in given:
        assert run("helical", *options).exit_code == 0
        design = "b" if "jamali_2015_b" in options else "a"
        film = asked[-1]["case"].film()
        expected = jamali_2015_film(design, **variant)
        assert film.modified == expected.modified
        assert film.steps == expected.steps


def test_a_record_is_for_one_pair_operation_oil_grid_and_first_step(asked):
    options = (
        (), ("--torque", 1000), ("--newtonian",), ("--nodes-along", 129), ("--spacing", "exit"),
    )  # fmt: skip
    for extra in options:
        assert run("helical", "--march", "all", *extra).exit_code == 0
    films = [call["case"].film() for call in asked]
    keys = {march_key(film, 0) for film in films} | {march_key(films[0], 1)}
    assert len(keys) == len(options) + 1
    assert march_key(asked[0]["case"].film(), 0) in keys
    assert (asked[0]["steps"].first, asked[0]["steps"].last) == (0, None)


def test_the_dry_line_is_that_of_hertz():
    b, p, R = 2e-4, 1e9, 0.014
    x = np.linspace(-3.0 * b, 3.0 * b, 60001)
    pressure, gap = hertz_line(x, b, p, R)
    assert np.trapezoid(pressure, x) == pytest.approx(0.5 * math.pi * b * p, rel=1e-5)
    # the gap's slope d/dx = (X^2 - 1)^(1/2) b/R outside, none inside
    outside = x > 1.01 * b
    slope = np.gradient(gap, x)[outside][:-1]
    exact = (b / R) * np.sqrt((x[outside][:-1] / b) ** 2 - 1.0)
    np.testing.assert_allclose(slope, exact, rtol=1e-3)
    assert not gap[np.abs(x) < b].any()


def test_defaults_are_shipped_cases(asked):
    assert run("line").exit_code == 0
    assert run("point").exit_code == 0
    line, point = asked
    assert line["case"] == LineCase.named("jamali_2015")
    assert point["case"] == PointCase.named("mourier_2006")
    assert (str(line["folder"]), str(point["folder"])) == (
        "gearlube_ehl_line",
        "gearlube_ehl_point",
    )


def test_options_replace_what_the_case_says(asked):
    options = ("--load", 100, "--entrainment", 2.0, "--slide-roll", 0.5, "--nodes", 301)
    assert run("line", *options, "--stencil", "central").exit_code == 0
    cavitation = ("--cavitation", "mass_conserving")
    assert run("point", *options, "--wedge", "quick", *cavitation).exit_code == 0
    line, point = (call["case"] for call in asked)
    assert (line.load_n_per_mm, point.load_n) == (100.0, 100.0)
    for case in (line, point):
        assert (case.speed_1_m_s, case.speed_2_m_s) == pytest.approx((2.5, 1.5))
    assert (line.solver.nodes, line.solver.stencil) == (301, "central")
    assert (point.solver.nodes_x, point.solver.nodes_y) == (301, 301)
    assert point.solver.wedge == "quick"
    assert point.settings().cavitation == "mass_conserving"


def test_a_film_has_the_mesh_of_the_gear_file_or_of_the_options(asked, tmp_path):
    path = tmp_path / "own.toml"
    mesh = '[film_mesh]\nnodes_across = 129\nnodes_along = 193\nspacing = "exit"\n\n'
    text = HelicalGearFile.shipped_text("jamali_2015_a")
    path.write_text(text.replace("[pair]", mesh + "[pair]"))
    for options in ((), ("--nodes-along", 65), ("--spacing", "uniform")):
        assert run("helical", path, *options).exit_code == 0
    films = [call["case"].film() for call in asked]
    assert [film.nodes for film in films] == [(129, 193), (129, 65), (129, 193)]
    assert [film.grading for film in films] == [EXIT_GRADING, EXIT_GRADING, ()]


def test_a_line_of_a_pair_is_placed_by_step_or_position_or_its_largest_load(asked):
    assert run("helical", "--step", 75).exit_code == 0
    assert run("helical", "jamali_2015_b", "--position", -15.7).exit_code == 0
    assert run("helical", "--load-sharing", "thesis", "--torque", 530).exit_code == 0
    by_step, by_position, by_load = (call["case"] for call in asked)
    assert by_step.step_of(by_step.film()) == 75.0
    assert by_position.step_of(by_position.film()) == pytest.approx(75.0)
    film = by_load.film()
    assert film.nodes == (97, 257)
    X = float(film.steps.line(by_load.step_of(film)))
    # half of the thesis' torque: half of his largest load, 14.4 kN
    assert film.load(X) == pytest.approx(7.2e3, rel=0.01)


@pytest.mark.parametrize(("kind", "model"), [("line", LineCase), ("point", PointCase)])
def test_the_example_is_a_case_file_that_runs(kind, model, asked, tmp_path):
    result = run(kind, "--example")
    assert result.exit_code == 0
    assert not asked
    data = tomllib.loads(result.stdout)
    path = tmp_path / "own.toml"
    path.write_text(result.stdout)
    assert run(kind, path).exit_code == 0
    assert asked[0]["case"] == model.from_data(data, "own")


@pytest.mark.slow
@each(
    ("arguments", "word"),
    [
        (("line", "no_such_case"), "no_such_case"),
        (("line", "no_such_file.toml"), "no_such_file.toml"),
        (("line", "mourier_2006"), "mourier_2006"),
        (("line", "--nodes", 3), "nodes"),
        (("line", "--load", -5), "load_n_per_mm"),
        (("line", "--stencil", "upwind"), "upwind-1"),
        (("line", "--entrainment", "nan"), "--entrainment"),
        (("line", "--temperature", "warm"), "thermal"),
        (("line", "--temperature", "thermal"), "houpert"),
        (("point", "--wedge", "none"), "quick"),
        (("point", "--entrainment", 0.0), "entrainment"),
        (("point", "no_such_case", "--example"), "no_such_case"),
        (("helical", "no_such_pair"), "no_such_pair"),
        (("helical", "he_2007"), "oil"),
        (("helical", "--step", 10, "--position", 1.0), "not both"),
        (("helical", "--step", 1000), "575"),
        (("helical", "--march", "10"), "FIRST:LAST"),
        (("helical", "--march", "10:x"), "FIRST:LAST"),
        (("helical", "--march", "20:10"), "last"),
        (("helical", "--march", "20:30", "--snapshots", "31"), "20 to 30"),
        (("helical", "--march", "20:30", "--snapshots", "21;22"), "75,300"),
        (("helical", "--step", 20, "--snapshots", "20"), "--march"),
        (("helical", "--facets", -1), "facets"),
        (("helical", "--crown-start", 30), "22 mm"),
        (("helical", "--relief-parabola", 1, "--relief-exponent", 2), "Leave one out"),
        (("compare", "no_such_folder"), "no_such_folder"),
        (("compare", "a=x", "a=y"), "x"),
        (("line", "--cavitation", "jfo"), "mass_conserving"),
        (("helical", "--march", "all", "--step", 3), "--step"),
        (("helical", "--position", 50), "mm"),
        (("helical", "--nodes-along", 5), "along"),
        (("helical", "--spacing", "dense"), "exit"),
        (("helical", "--torque", -5), "torque"),
        (("helical", "--load-sharing", "equal"), "thesis"),
    ],
)
def test_what_is_out_of_range_ends_with_bad_argument(arguments, word, tmp_path, caplog):
    caplog.clear()
    with caplog.at_level(logging.ERROR, "gearlube"):
        assert run(*arguments, "--out", tmp_path).exit_code == BAD_ARGUMENT
    assert word in caplog.text
    assert not list(tmp_path.glob("*.nc"))


@pytest.mark.slow
def test_a_film_that_does_not_converge_is_written_and_fails(tmp_path, caplog, monkeypatch):
    monkeypatch.setattr(results, "save_film_figures", lambda *_: [])
    case = tmp_path / "hard.toml"
    text = LineCase.shipped_text("jamali_2015").replace("nodes = 1001", "nodes = 101")
    case.write_text(text + "max_iterations = 1\n")
    with caplog.at_level(logging.ERROR, "gearlube"):
        assert run("line", case, "--out", tmp_path / "out").exit_code == FAILED
    assert "Not converged" in caplog.text
    dataset = xr.load_dataset(tmp_path / "out" / "line.nc", engine="scipy")
    assert not dataset.attrs["converged"]


@pytest.mark.slow
def test_heights_at_rest_between_moving_surfaces_are_warned_of(tmp_path, caplog, monkeypatch):
    monkeypatch.setattr(results, "save_film_figures", lambda *_: [])
    x = np.linspace(-2.0, 1.0, 601)
    table = np.stack([x, 0.02 * np.cos(8.0 * x)], 1)
    np.savetxt(tmp_path / "own.csv", table, "%.9g", ",", header="x_mm,height_um", comments="")
    text = LineCase.shipped_text("jamali_2015").replace("nodes = 1001", "nodes = 101")
    text += '[domain]\nfirst_mm = -1.5\nlast_mm = 0.5\n[profile]\nfile = "own.csv"\n'
    standing = text.replace("speed_2_m_s = 5.5022", "speed_2_m_s = 0.0")
    for case, warned in ((text, True), (standing, False)):
        caplog.clear()
        (tmp_path / "own.toml").write_text(case)
        result = run("line", tmp_path / "own.toml", "--out", tmp_path / "out", "--overwrite")
        assert result.exit_code == 0, result.output
        assert ("heights do not move" in caplog.text) == warned
    dataset = xr.load_dataset(tmp_path / "out" / "line.nc", engine="scipy")
    assert np.trapezoid(dataset["pressure"], dataset["x"]) == pytest.approx(3.6e5, rel=1e-6)
