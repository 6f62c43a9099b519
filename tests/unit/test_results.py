"""Results of studies draw their figure and write the report of their command."""

import numpy as np
import pytest
import xarray as xr

import gearlube as gl
from gearlube.report import result
from gearlube.report.stored import read_report
from gearlube.studies.loss_map.report import loss_map_report
from gearlube_core.errors import ParameterError


@pytest.fixture(scope="module")
def losses():
    settings = gl.LossMapSettings(
        axle=gl.mohammadpour_2015_axle(),
        torques=np.array([50.0, 100.0]),
        speeds=np.array([100.0, 200.0]),
        temperatures=np.array([353.15]),
        draws=0,
    )
    return gl.run_loss_map(settings)


def test_a_result_writes_the_report_of_its_command(losses, tmp_path):
    page = losses.report(tmp_path)
    assert page == tmp_path / "report.html"
    read = read_report(tmp_path)
    assert (read["study"], read["title"]) == ("map", "Loss map of an axle")
    assert [one[0] for one in read["numbers"]] == [
        one.name for one in loss_map_report(losses).numbers
    ]


def test_a_result_and_what_is_taken_from_it_draw_the_figure_of_the_study(losses, tmp_path):
    assert "Torque lost" in losses.plot().get_suptitle()
    assert "Losses by source" in losses.isel(speed=[0]).plot().get_suptitle()
    losses.to_netcdf(tmp_path / "map.nc")
    assert xr.load_dataset(tmp_path / "map.nc").attrs["study"] == "map"


def test_a_film_takes_its_pictures_into_the_report(tmp_path):
    case = gl.ehl.LineCase.named(gl.ehl.LineCase.shipped()[0])
    film = gl.ehl.run_line(case.varied({"solver.nodes": 129}))
    assert film.plot().axes
    text = film.report(tmp_path).read_text()
    assert text.count("<figure") >= 2
    assert (tmp_path / "figures" / "profile.png").is_file()


def test_a_part_of_a_train_has_a_figure_alone(tmp_path):
    found = result.Result.of(xr.Dataset(), "train map")
    with pytest.raises(ParameterError, match="gearlube drivetrain"):
        found.report(tmp_path)


@pytest.mark.parametrize("study", result._SHOWN)
def test_what_shows_a_study_is_there(study):
    shown = result._SHOWN[study]
    for place in filter(None, (shown.figures, shown.report)):
        assert result._named(place) is not None


def test_a_result_in_si_units_has_no_other(losses):
    si = losses.si()
    assert si["speed"].values == pytest.approx([100.0, 200.0])  # as in the settings
    assert si["temperature"].values == pytest.approx([353.15])
    np.testing.assert_array_equal(si["loss_torque"], losses["loss_torque"])
    assert {one.attrs.get("units") for one in si.variables.values()} <= {
        "rad/s", "K", "N.m", "W", "1", None,
    }  # fmt: skip
