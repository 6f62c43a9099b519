"""The command `gearlube`: what people type, and what they are told when it is wrong."""

import pytest
import xarray as xr
from typer.testing import CliRunner

from gearlube import command as cli
from gearlube.cli.option_groups import repeat_flags
from gearlube.cli.ranges import numbers_from
from gearlube.studies.sweep import findings as sweep_findings
from gearlube.studies.sweep import report as sweep_report
from gearlube.studies.sweep import run as sweep_run
from gearlube_core import __version__
from gearlube_core.errors import InterruptedRunError, ParameterError

FLAGS = {"--preload", "--speeds"}


def result_with(statuses):
    """The dataset of a sweep whose points ended with these statuses."""
    attributes = {"computed_points": len(statuses), "wall_time": 1.0}
    return xr.Dataset({"status": ("speed", statuses)}, attrs=attributes)


@pytest.fixture(autouse=True)
def folder(monkeypatch, tmp_path):
    """Commands write into their default folder here."""
    monkeypatch.chdir(tmp_path)


@pytest.fixture
def calls(monkeypatch):
    """Arguments of the sweeps that the command would run."""
    seen = []

    def run_sweep(settings, **options):
        seen.append({"settings": settings, **options})
        return result_with([1, 1])

    monkeypatch.setattr(sweep_run, "run_sweep", run_sweep)
    monkeypatch.setattr(sweep_report, "write_sweep_report", lambda dataset, out, entries: out)
    monkeypatch.setattr(sweep_findings, "findings", lambda dataset: [])
    return seen


def run(*arguments):
    return CliRunner().invoke(cli.app, list(arguments))


def test_preloads_may_follow_one_flag_or_one_flag_each(calls):
    assert run("sweep", "--preload", "2500", "6000").exit_code == 0
    assert run("sweep", "--preload", "2500", "--preload", "6000").exit_code == 0
    assert run("sweep", "--preload=2500", "--preload=6000").exit_code == 0
    assert [call["preloads"] for call in calls] == [[2500.0, 6000.0]] * 3


def test_values_are_spread_only_over_the_flags_that_take_several():
    assert repeat_flags(["--preload", "1", "2", "--out", "3", "4"], FLAGS) == [
        *("--preload", "1", "--preload", "2", "--out", "3", "4")
    ]
    assert repeat_flags(["--preload", "1", "x", "2"], FLAGS) == ["--preload", "1", "x", "2"]
    assert repeat_flags(["--preload", "--out", "2"], FLAGS) == ["--preload", "--out", "2"]
    assert repeat_flags(["--speeds", "20:40:10", "55"], FLAGS) == [
        *("--speeds", "20:40:10", "--speeds", "55")
    ]


def test_default_is_the_sweep_of_the_paper(calls):
    assert run("sweep").exit_code == 0
    (call,) = calls
    assert call["speeds_kmh"] == tuple(20.0 + 5.0 * i for i in range(17))
    assert call["preloads"] == (2500.0, 6000.0)
    assert call["settings"].equations == "consistent"
    assert call["settings"].driver == "vehicle"
    assert str(call["out"]) == "gearlube_sweep"


def test_options_reach_the_settings_in_si_units(calls):
    result = run(
        *("sweep", "--speeds", "30", "--oil-temperature", "60", "--roughness-um", "0.3"),
        *("--equations", "as_printed", "--driver", "hold", "--jobs", "2"),
    )
    assert result.exit_code == 0
    (call,) = calls
    assert call["speeds_kmh"] == (30.0,)
    assert call["settings"].oil_temperature == pytest.approx(333.15)
    assert call["settings"].roughness_rms == pytest.approx(0.3e-6)
    assert call["settings"].equations == "as_printed"
    assert call["settings"].driver == "hold"
    assert call["jobs"] == 2


def test_a_steady_temperature_reaches_the_settings_with_its_air(calls):
    words = ("--steady-temperature", "--air-temperature", "7", "--conductance-at-100", "25")
    assert run("sweep", *words).exit_code == 0
    (call,) = calls
    settings = call["settings"]
    assert settings.oil_state == "steady"
    assert settings.air_temperature == pytest.approx(280.15)
    assert (settings.conductance_at_rest, settings.conductance_at_100_kmh) == (7.0, 25.0)
    assert run("sweep").exit_code == 0
    assert calls[1]["settings"].oil_state == "given"


def test_quick_run_is_short(calls):
    assert run("sweep", "--quick").exit_code == 0
    (call,) = calls
    assert call["speeds_kmh"] == (20.0, 60.0, 100.0)
    assert call["settings"].record_time < 0.2


@pytest.mark.parametrize(
    ("arguments", "parts"),
    [
        (["--speeds", "20:10:5"], ["at least the first, 20 km/h", "got 10 km/h", "20:100:5"]),
        (["--speeds", "2000"], ["1 to 300 km/h", "got 2000 km/h"]),
        (["--speeds", "20:100"], ["three numbers", "'20:100'", "first:last:step"]),
        (["--speeds", "20:100:0"], ["above 0 km/h", "got 0 km/h"]),
        (["--speeds", "20:100:0.001"], ["at most 500 values", "got 80001", "larger step"]),
        (["--driver", "horse"], ["vehicle, hold", "'horse'"]),
        (["--oil-temperature", "400"], ["0 to 150 degC", "got 400 degC", "The data of"]),
        (["--roughness-um", "500"], ["got 0.0005 m", "0.5 um"]),
        (["--air-temperature", "5"], ["--air-temperature works only with --steady-temperature"]),
        (
            ["--steady-temperature", "--oil-temperature", "60"],
            ["--oil-temperature cannot be combined with --steady-temperature", "60 degC"],
        ),
        (
            ["--steady-temperature", "--air-temperature", "200"],
            ["--air-temperature", "0 to 150 degC", "got 200 degC"],
        ),
        (["--steady-temperature", "--conductance-at-rest", "-1"], ["conductance_at_rest", "W/K"]),
    ],
)
def test_bad_argument_is_explained_with_what_got_limit_and_cure(calls, caplog, arguments, parts):
    result = run("sweep", *arguments)
    assert result.exit_code == 2
    assert not calls
    for part in parts:
        assert part in caplog.text


def test_unknown_option_is_refused():
    assert run("sweep", "--sped", "20").exit_code == 2


def test_failed_points_show_in_the_exit_code(calls, monkeypatch, caplog):
    monkeypatch.setattr(sweep_run, "run_sweep", lambda settings, **_: result_with([1, 0, 0]))
    assert run("sweep").exit_code == 1
    assert "2 points failed" in caplog.text


def test_a_stopped_sweep_says_what_is_kept_and_has_the_exit_code_of_ctrl_c(
    calls, monkeypatch, caplog
):
    def stopped(settings, **options):
        raise InterruptedRunError("3 of 6 points are finished and kept")

    monkeypatch.setattr(sweep_run, "run_sweep", stopped)
    assert run("sweep").exit_code == 130
    assert "3 of 6 points" in caplog.text


def test_version_is_that_of_the_package():
    result = run("--version")
    assert result.exit_code == 0
    assert __version__ in result.output


def numbers(*texts):
    return numbers_from("--speeds", texts, "km/h", 1.0, 300.0, example="20:100:5", most=500)


def test_speeds_are_sorted_without_repeats():
    assert numbers("60", "20:60:20", "30,40") == (20.0, 30.0, 40.0, 60.0)


def test_last_speed_is_reached_although_the_step_is_no_binary_fraction():
    assert numbers("20:21:0.1")[-1] == 21.0
    assert len(numbers("20:21:0.1")) == 11


def test_words_are_no_speeds():
    with pytest.raises(ParameterError, match="must be a number in km/h, got 'fast'"):
        numbers("fast")
