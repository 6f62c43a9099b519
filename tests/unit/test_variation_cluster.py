"""The same variation on a real Dask cluster of two worker processes, one of which is killed."""

import signal
import threading

import pytest

from gearlube.variation.design import Axis, Design
from gearlube.variation.run import run_variation
from gearlube.variation.store import open_variation
from gearlube_core.errors import GearLubeError
from tests.helpers.dask_cluster import dask_cluster
from tests.helpers.variation_stand_in import AreaStudy

WIDTHS = tuple(float(w) for w in range(1, 25))
DESIGN = Design(axes=(Axis("width_mm", WIDTHS),))


@pytest.mark.slow  # starts a scheduler and two workers
def test_nothing_is_lost_when_a_worker_dies_and_nothing_is_computed_twice_after(tmp_path):
    killed = threading.Event()
    study = AreaStudy(seconds=0.1, fails_at=20.0)
    with dask_cluster(tmp_path) as (address, workers):

        def kill_one_worker_after_a_quarter(share, sentence):
            if share >= 0.25 and not killed.is_set():
                workers["first"].send_signal(signal.SIGKILL)
                killed.set()

        done = run_variation(
            study,
            DESIGN,
            out=tmp_path / "out",
            scheduler=address,
            block=2,
            progress=kill_one_worker_after_a_quarter,
        )
        assert workers["first"].wait(timeout=10.0) == -signal.SIGKILL
    assert (done.computed, done.failed, done.lost) == (24, 1, 0)
    found = open_variation(tmp_path / "out")
    assert found["area"].values[:19].tolist() == [2.0 * w for w in WIDTHS[:19]]
    assert found["message"].values[19] == b"no tooth is 20 mm wide"
    # no cluster is left: were a point missing, this would fail
    again = run_variation(study, DESIGN, out=tmp_path / "out", scheduler=address)
    assert again.computed == 0


def test_a_scheduler_that_is_not_there_is_named(tmp_path, monkeypatch):
    monkeypatch.setattr("gearlube_core.storage.dask_pool._CONNECT_TIMEOUT", 0.5)
    with pytest.raises(GearLubeError, match=r"No Dask scheduler answered at tcp://127\.0\.0\.1:1"):
        run_variation(AreaStudy(), DESIGN, out=tmp_path, scheduler="tcp://127.0.0.1:1")
