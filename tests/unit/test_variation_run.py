"""Bookkeeping of a variation: nothing computed twice, nothing lost, failures are rows."""

import csv
import shutil

import numpy as np
import pytest

from gearlube.variation import run
from gearlube.variation.design import Axis, Design, Sampling, Spread
from gearlube.variation.run import run_variation
from gearlube.variation.store import gridded, open_variation
from gearlube.variation.summary import summarised, write_summary
from gearlube_core.errors import FileError, InterruptedRunError, ParameterError
from tests.helpers.known_answers import assert_variables
from tests.helpers.variation_stand_in import AreaStudy

WIDTHS = tuple(float(w) for w in range(1, 8))
GRID = Design(axes=(Axis("shape", ("straight", "bent")), Axis("width_mm", WIDTHS)))
SAMPLES = Design(
    axes=(Axis("width_mm", (3.0, 6.0)),),
    spreads=(Spread(key="length_mm", low=1.0, high=2.0),),
    sampling=Sampling("lhs", 50),
)


@pytest.fixture(autouse=True)
def quick_hash(monkeypatch):
    """The hash of all code takes a tenth of a second; none of these tests is about it."""
    monkeypatch.setattr(run, "code_hash", lambda: "code")


def varied(out, study=None, design=GRID, **options):
    return run_variation(study or AreaStudy(), design, out=out, **({"jobs": 1} | options))


def test_every_point_has_its_numbers_and_its_inputs(tmp_path):
    done = varied(tmp_path, block=4)
    found = open_variation(tmp_path)
    assert (done.computed, done.failed, done.store.blocks) == (14, 0, 4)
    assert found["area"].values.tolist() == [2.0 * w for w in WIDTHS] * 2
    assert found["width_mm"].values.tolist() == list(WIDTHS) * 2
    assert found["shape"].values.tolist() == ["straight"] * 7 + ["bent"] * 7
    assert found["area"].attrs == {"units": "mm2", "long_name": "area"}
    assert found["status"].values.tolist() == [1] * 14


@pytest.mark.slow
def test_every_variable_of_a_variation_and_its_statistics_is_known(tmp_path):
    """Widths of 3 and 5 mm, of which the last fails, by nine lengths within 1 to 2 mm."""
    spread = Spread(key="length_mm", low=1.0, high=2.0)
    axes = (Axis("shape", ("straight", "bent")), Axis("width_mm", (3.0, 5.0)))
    design = Design(axes=axes, spreads=(spread,), sampling=Sampling("lhs", 9))
    varied(tmp_path, AreaStudy(fails_at=5.0), design)
    found = open_variation(tmp_path)
    length = found["length_mm"].values.reshape(2, 2, 9)
    assert sorted(np.floor(9.0 * (length[0, 0] - 1.0))) == list(range(9))  # one in each ninth
    fails = np.array([[False, True]] * 2)[..., None] & np.ones((2, 2, 9), bool)
    width = np.broadcast_to(np.array([3.0, 5.0])[:, None], (2, 2, 9))
    expected = {
        "area": ("mm2", np.where(fails, np.nan, width * length)),
        "width": ("mm", np.where(fails, np.nan, width)),
        "status": ("", np.where(fails, 0, 1)),
        "message": ("", np.where(fails, b"no tooth is 5 mm wide", b"")),
        "length_mm": ("mm", length),
    }
    given = {"shape": ("", ["straight", "bent"]), "width_mm": ("mm", [3.0, 5.0])}
    assert_variables(gridded(found), expected | given)
    flat = {name: (unit, values.ravel()) for name, (unit, values) in expected.items()}
    points = {"shape": ("", np.repeat(["straight", "bent"], 18)), "width_mm": ("mm", width.ravel())}
    assert_variables(found, flat | points)
    area = 3.0 * length[:, 0]
    statistics = np.full((2, 2, 2, 9), np.nan)
    for n, values in enumerate(area):
        middle = np.percentile(values, [2.5, 25.0, 50.0, 75.0, 97.5])
        deviation = (((values - values.mean()) ** 2).sum() / 8.0) ** 0.5
        statistics[n, 0] = [
            [values.mean(), deviation, values.min(), *middle, values.max()],
            [3.0, 0.0, *7 * [3.0]],
        ]
    ranks = np.full((2, 2, 2, 1), np.nan)
    ranks[:, 0, 0] = 1.0
    shares = np.full((2, 2, 1), np.nan)
    shares[:, 0, 0] = (area > 4.5).mean(axis=-1)
    summary = {
        "statistics": ("", statistics),
        "rank_correlation": ("", ranks),
        "failed": ("", [[0, 9]] * 2),
        "share_above": ("", shares),
        "quantity": ("", ["area", "width"]),
        "statistic": (
            "", ["mean", "deviation", "low", "p2.5", "p25", "p50", "p75", "p97.5", "high"]
        ),
        "input": ("", ["length_mm"]),
        "unit": ("", ["mm2", "mm"]),
        "limited": ("", ["area"]),
        "limit": ("", [4.5]),
    }  # fmt: skip
    assert_variables(summarised(tmp_path, {"area": 4.5}), summary | given)


def test_results_are_opened_in_chunks_without_reading_them(tmp_path):
    varied(tmp_path, block=4)
    found = open_variation(tmp_path)
    assert found["area"].chunks == ((4, 4, 4, 2),)
    shutil.rmtree(tmp_path / "results.zarr" / "results")  # gone: only now would it be missed
    with pytest.raises(Exception, match="results"):
        open_variation(tmp_path)
    assert gridded(found)["area"].dims == ("shape", "width_mm", "sample")


def test_a_point_that_fails_is_a_row_with_its_reason(tmp_path):
    done = varied(tmp_path, AreaStudy(fails_at=3.0))
    found = open_variation(tmp_path)
    assert done.failed == 2
    assert found["status"].values.tolist() == [1, 1, 0, 1, 1, 1, 1] * 2
    assert np.isnan(found["area"].values[2])
    assert found["message"].values[2] == b"no tooth is 3 mm wide"
    _, summary = write_summary(tmp_path)
    assert summary["failed"].sel(shape="bent").values.tolist() == [0, 0, 1, 0, 0, 0, 0]
    with (tmp_path / "points.csv").open() as stream:
        rows = list(csv.DictReader(stream))
    assert rows[2]["message"] == "no tooth is 3 mm wide"
    assert rows[8] == {
        "shape": "bent", "width_mm": "2.0", "status": "1", "area": "4.0", "width": "2.0",
        "message": "",
    }  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize("error", [MemoryError, OSError, FileError, EOFError])
def test_what_fails_by_the_machine_is_computed_by_the_next_run(tmp_path, caplog, error):
    study = AreaStudy(loses_at=3.0, fails_at=5.0, folder=tmp_path, error=error)
    done = varied(tmp_path / "out", study, block=4)
    assert (done.computed, done.failed, done.lost) == (13, 2, 1)
    assert "no room" in caplog.text
    found = open_variation(tmp_path / "out")
    assert found["status"].values.tolist() == [1, 1, -1, 1, 0, *4 * [1], 1, 1, 0, 1, 1]
    assert np.isnan(found["area"].values[2])
    # its block alone, and the failure of the physics stays
    assert varied(tmp_path / "out", study).computed == 4
    assert open_variation(tmp_path / "out")["area"].values[2] == 6.0
    assert varied(tmp_path / "out", study).computed == 0


def test_a_second_run_computes_nothing_and_a_lost_block_alone_again(tmp_path):
    varied(tmp_path, block=4)
    assert varied(tmp_path, block=4).computed == 0
    (tmp_path / "results.zarr" / "status" / "3").unlink()
    assert varied(tmp_path, block=2).computed == 2  # the last block of four has two points
    assert open_variation(tmp_path)["area"].values[-1] == 14.0


def test_a_stop_keeps_finished_blocks_and_the_next_run_computes_the_rest(tmp_path):
    study = AreaStudy(stops_at=6.0, folder=tmp_path)
    with pytest.raises(InterruptedRunError, match="4 of 14 points are kept"):
        varied(tmp_path / "out", study, block=4)
    half = open_variation(tmp_path / "out")
    assert half["status"].values.tolist() == [1] * 4 + [-1] * 10
    assert varied(tmp_path / "out", study).computed == 10
    assert open_variation(tmp_path / "out")["area"].values.tolist() == [2.0 * w for w in WIDTHS] * 2


def test_nothing_is_computed_where_a_point_is_wrong(tmp_path):
    design = Design(axes=(Axis("length_mm", (1.0, 99.0, 101.0, 500.0)),))
    with pytest.raises(ParameterError, match=r"2 of 4 points are out of range.*got 101 mm"):
        varied(tmp_path / "out", design=design)
    assert not (tmp_path / "out").exists()


@pytest.mark.slow
def test_another_variation_is_not_mixed_in(tmp_path):
    varied(tmp_path)
    for study, design in ((AreaStudy(fails_at=3.0), GRID), (AreaStudy(), SAMPLES)):
        with pytest.raises(ParameterError, match="holds another one"):
            varied(tmp_path, study, design)
    assert varied(tmp_path, design=SAMPLES, overwrite=True).computed == 100
    assert open_variation(tmp_path).sizes["point"] == 100


def test_a_folder_without_results_is_refused(tmp_path):
    with pytest.raises(FileError, match="Run it first"):
        open_variation(tmp_path)


@pytest.mark.slow
def test_statistics_are_those_of_a_uniform_distribution(tmp_path):
    varied(tmp_path, design=SAMPLES)
    _, summary = write_summary(tmp_path, {"area": 9.0})
    # area = 6 mm times a length between 1 and 2 mm, one of 50 samples in each fiftieth: every
    # quantile is met to a fiftieth of the range of 6 mm2
    at_six = summary["statistics"].sel(width_mm=6.0, quantity="area")
    assert float(at_six.sel(statistic="mean")) == pytest.approx(9.0, abs=0.12)
    assert float(at_six.sel(statistic="p25")) == pytest.approx(7.5, abs=0.12)
    assert float(at_six.sel(statistic="deviation")) == pytest.approx(6.0 / 12.0**0.5, rel=0.03)
    shares = summary["share_above"].sel(limited="area")
    assert shares.values.tolist() == pytest.approx([0.0, 0.5], abs=0.02)
    ranks = summary["rank_correlation"].sel(input="length_mm")
    assert ranks.sel(quantity="area").values.tolist() == pytest.approx([1.0, 1.0])
    assert np.isnan(ranks.sel(quantity="width").values).all()
    assert (tmp_path / "sensitivity.csv").is_file()


@pytest.mark.slow  # three starts of two processes; the sweep's are in the default run
def test_a_process_that_dies_loses_no_point(tmp_path):
    study = AreaStudy(dies_at=5.0, folder=tmp_path)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(run, "_compile", lambda study, design: None)
        done = varied(tmp_path / "out", study, jobs=2, block=2)
    assert (tmp_path / "died").exists()
    assert (done.computed, done.failed, done.lost) == (14, 0, 0)
    assert open_variation(tmp_path / "out")["area"].values.tolist() == [2.0 * w for w in WIDTHS] * 2
