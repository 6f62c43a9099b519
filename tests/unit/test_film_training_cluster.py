"""Films of a training set solved by the workers of a Dask cluster."""

from __future__ import annotations

import pytest

from gearlube.studies.film_model.plan import FilmPlan
from gearlube.studies.film_model.train import pool_of, train
from gearlube_core.errors import ParameterError
from tests.helpers.dask_cluster import dask_cluster

# six films; rollers are the cheapest
PLAN = FilmPlan(
    contact="roller", box=2, visited=1, edge=1, calibration=1, fresh=1,
    fine_box=0, fine_visited=0, fine_edge=0, fine_fresh=0,
)  # fmt: skip


@pytest.mark.slow
def test_films_of_a_cluster_are_those_of_this_machine(tmp_path):
    with dask_cluster(tmp_path) as (address, _):
        far = train(PLAN, tmp_path / "far", pool=pool_of(None, address))
    here = train(PLAN, tmp_path / "here", pool=pool_of(1, None))
    assert len(here.rows) == PLAN.solves == 6
    assert far.rows.keys() == here.rows.keys()
    for key, row in here.rows.items():
        other = far.rows[key]
        assert row.solved.converged
        assert (other.task, other.failure) == (row.task, row.failure)
        for one, two, name in zip(other.solved, row.solved, row.solved._fields, strict=True):
            if name != "seconds":
                # sums in another order, in a process with other threads
                assert one == pytest.approx(two, rel=1e-9, nan_ok=True), name
    # a second run has nothing left to solve: no cluster is asked
    again = train(PLAN, tmp_path / "far", pool=pool_of(1, None))
    took = {key: row.solved.seconds for key, row in far.rows.items()}
    assert {key: row.solved.seconds for key, row in again.rows.items()} == took


def test_processors_of_this_machine_and_a_cluster_are_not_mixed():
    with pytest.raises(ParameterError, match="--jobs must be left out beside --scheduler"):
        pool_of(2, "tcp://127.0.0.1:8786")
