"""The command `gearlube damage` on small lives: table, files, report, refusals."""

import csv

import pytest
from typer.testing import CliRunner

from gearlube import command as cli
from gearlube.cli.exit_codes import BAD_ARGUMENT
from gearlube.report.stored import read_report
from tests.helpers.helical_contact_cases import even_contact

BINS = "torque_n_m,speed_rpm,temperature_degc,hours\n350,600,90,20\n-60,2500,80,100\n"
LIMITS = ("--contact-limit-mpa", 1500, "--bending-limit-mpa", 430)


def run(*arguments, gears="mohammadpour_2015"):
    return CliRunner().invoke(cli.app, ["damage", gears, *map(str, arguments)])


@pytest.fixture
def bins(tmp_path):
    path = tmp_path / "bins.csv"
    path.write_text(BINS, encoding="utf-8")
    return path


def rows(folder, name):
    with (folder / name).open(encoding="utf-8") as file:
        return list(csv.DictReader(file))


@pytest.mark.slow
def test_a_table_of_bins_gives_summary_maps_and_report(bins, tmp_path):
    out = tmp_path / "out"
    more = "--pinion-bearings-kn", 88, 110, "--wear-coefficient", 5e-18
    done = run("--cycle", bins, *LIMITS, *more, "--out", out)
    assert done.exit_code == 0, done.output
    found = {row["failure mode"]: row for row in rows(out, "summary.csv")}
    assert float(found["breakage, pinion"]["safety"]) > 1.0
    assert found["breakage, pinion"]["by"].startswith("ISO 10300-2, -3:2023, method B1")
    assert "bearing, pinion, first: basic life used" in found
    assert [float(row["hours_h"]) for row in rows(out, "damage.csv")] == [20.0, 100.0]
    figures = {path.name for path in (out / "figures").iterdir()}
    assert figures == {"maps_drive.png", "maps_coast.png", "bins.png"}
    given = [one[:2] for one in read_report(out)["inputs"]]
    assert ["contact limit [MPa]", "1500.0"] in given


@pytest.mark.slow
def test_hardness_limits_and_the_test_of_the_oil_give_their_rows(bins, tmp_path):
    out = tmp_path / "out"
    hardness = "--surface-hv", 720, "--core-hv", 342, "--case-depth-mm", 0.8
    limits = "--torsion-limit-mpa", 400, "--bending-fatigue-mpa", 640
    test = "--micropitting-torque-nm", 265.1, "--micropitting-bulk", 100
    done = run("--cycle", bins, *hardness, *limits, *test, "--out", out)
    assert done.exit_code == 0, done.output
    found = {row["failure mode"]: row for row in rows(out, "summary.csv")}
    drive = "fatigue under the surface, drive: compression"
    for name in ("flank fracture, coast: A_FF", f"{drive} helps", f"{drive} does not help"):
        assert float(found[name]["safety"]) > 0.5
    assert float(found["micropitting: least film ratio"]["limit"]) > 0.1
    assert (out / "figures" / "under_surface.png").exists()
    given = [one[:2] for one in read_report(out)["inputs"]]
    assert ["--case-depth-mm", "0.8"] in given


def test_a_case_without_its_depth_is_refused(bins, tmp_path, caplog):
    done = run("--cycle", bins, "--surface-hv", 720, "--core-hv", 342, "--out", tmp_path / "out")
    assert done.exit_code == BAD_ARGUMENT
    assert "--case-depth-mm None" in caplog.text


@pytest.mark.slow
def test_a_cycle_with_a_severe_block(bins, tmp_path):
    trace, out = tmp_path / "trace.csv", tmp_path / "out"
    trace.write_text("time_s,speed_kmh\n" + "".join(f"{t},{40 + t / 5}\n" for t in range(0, 61, 5)))
    done = run("--cycle", trace, "--distance-km", 1000, "--add", bins, "--out", out)
    assert done.exit_code == 0, done.output
    found = rows(out, "damage.csv")
    assert [float(row["torque_n_m"]) for row in found][-2:] == [350.0, -60.0]
    assert not any("wear" in name for name in found[0])  # its coefficient is not given
    # 1000 km at 46 km/h
    assert sum(float(row["hours_h"]) for row in found[:-2]) == pytest.approx(1000 / 46, rel=0.01)


def test_one_limit_is_refused_with_an_example(bins, tmp_path, caplog):
    done = run("--cycle", bins, "--contact-limit-mpa", 1500, "--out", tmp_path / "out")
    assert done.exit_code == BAD_ARGUMENT
    assert "1500 and 430 MPa are an example" in caplog.text
    assert not (tmp_path / "out").exists()


@pytest.mark.slow
def test_a_pair_takes_a_table_of_bins(bins, tmp_path, monkeypatch, caplog):
    out = tmp_path / "out"

    def even(settings, *, store, **given):
        assert store == out / "contact"  # finished positions, for the next run
        return even_contact(settings.constant_mesh())

    monkeypatch.setattr("gearlube.damage.pair.analyse_loaded_contact", even)
    more = "--face-factor", 1.2, "--load-stage", 12, "--load-stage-torque-nm", 534.5
    more += "--oil", "fva_3"
    done = run("--cycle", bins, *LIMITS, *more, "--out", out, gears="he_2007")
    assert done.exit_code == 0, done.output
    found = {row["failure mode"]: row for row in rows(out, "summary.csv")}
    assert float(found["breakage, pinion"]["safety"]) > 1.0
    assert found["breakage, pinion"]["by"].startswith("ISO 6336-1, -2, -3:2006, method B")
    assert float(found["scuffing: integral temperature"]["safety"]) > 1.0
    given = [one[:2] for one in read_report(out)["inputs"]]
    assert ["oil", "fva_3"] in given
    assert "from memory" not in caplog.text  # the torque of the load stage is given
    assert ["pair.face_width_mm", "31.75"] in given


def test_a_pair_and_an_axle_refuse_what_is_not_theirs(bins, tmp_path, caplog):
    out = "--out", tmp_path / "out"
    for gears, arguments, words in (
        ("he_2007", (), "a vehicle cycle needs an axle"),
        ("he_2007", ("--cycle", bins, "--gear-bearings-kn", 88), "works only with an axle"),
        ("mohammadpour_2015", ("--cycle", bins, "--oil", "fva_3"), "only with a gear pair"),
        ("he_2007", ("--cycle", bins, *LIMITS[:2]), "1500 and 430 MPa are an example"),
    ):
        caplog.clear()
        assert run(*arguments, *out, gears=gears).exit_code == BAD_ARGUMENT
        assert words in caplog.text
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("--wear-of-all-load",), "must have --wear-coefficient with it"),
        (("--cleanliness", "bath -/17/14"), "must have --pinion-bearings-kn or"),
        (("--raceway-roughness-um", 0.2), "must have ratings of bearings"),
        ((*LIMITS, "--face-factor", 0), "face must be within 1 to 10, got 0"),
    ],
)
def test_no_option_is_left_out_in_silence(arguments, words, bins, tmp_path, caplog):
    done = run("--cycle", bins, *arguments, "--out", tmp_path / "out")
    assert done.exit_code == BAD_ARGUMENT
    assert words in caplog.text


def test_steps_of_wear_need_a_coefficient(bins, tmp_path, caplog):
    done = run("--cycle", bins, "--wear-steps", 3, "--out", tmp_path / "out")
    assert done.exit_code == BAD_ARGUMENT
    assert "Steps of wear must have an axle, a gear file and a wear coefficient" in caplog.text
    assert not (tmp_path / "out").exists()


def test_the_example_is_a_table_of_bins():
    done = run("--example")
    assert done.exit_code == 0
    assert "torque_n_m, speed_rpm, temperature_degc, hours" in done.output
