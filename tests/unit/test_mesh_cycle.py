"""The mesh cycle: what is stored, resumed and refused."""

import numpy as np
import pytest

from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_contact import mesh_cycle
from gearlube_core.hypoid_contact.loaded_contact import LoadedSettings
from gearlube_core.hypoid_contact.mesh_cycle import SIDES, CycleSettings, run_cycle
from gearlube_core.hypoid_contact.strips import StripSettings
from tests.helpers.loaded_cases import FILE, stiffness
from tests.helpers.reports import Reports

SMALL = CycleSettings(
    positions=4,
    torques=(30.0,),
    loaded=LoadedSettings(strips=StripSettings(cells_across=12, cells_along=16)),
)
TEETH = dict.fromkeys(SIDES, stiffness())


@pytest.fixture(scope="module")
def store(tmp_path_factory):
    folder = tmp_path_factory.mktemp("cycle")
    run_cycle(FILE, TEETH, SMALL, store=folder, jobs=1)
    return folder


@pytest.mark.slow
def test_an_interrupted_run_goes_on_where_it_stopped(tmp_path, store):
    seen = []

    def stop(_, sentence):
        seen.append(sentence)
        if len(seen) == 3:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run_cycle(FILE, TEETH, SMALL, store=tmp_path, jobs=1, progress=stop)
    rest = Reports()
    resumed = run_cycle(FILE, TEETH, SMALL, store=tmp_path, jobs=1, progress=rest)
    assert sorted(seen + rest) == sorted(
        f"{s} flanks, mesh phase {k:.2f}" for s in SIDES for k in SMALL.phases
    )
    whole = run_cycle(FILE, TEETH, SMALL, store=store, jobs=1)
    for side in SIDES:
        for name, values in whole[side].items():
            np.testing.assert_array_equal(resumed[side][name], values)


@pytest.mark.slow
def test_a_finished_run_computes_nothing(store, monkeypatch):
    monkeypatch.setattr(mesh_cycle, "position_record", None)  # would fail if called
    again = run_cycle(FILE, TEETH, SMALL, store=store, jobs=1)
    assert again["drive"]["rotation"].shape == (4, 1)


@pytest.mark.slow
def test_other_teeth_or_loads_are_not_taken_from_the_store(store):
    for other in (
        (FILE, dict.fromkeys(SIDES, stiffness(2e-9)), SMALL),
        (FILE.varied({"pinion.cutter.blade_edge_radius_mm": 500.0}), TEETH, SMALL),
    ):
        done = Reports()
        run_cycle(*other, store=store, jobs=1, progress=done)
        assert len(done) == 8


@pytest.mark.slow
def test_a_damaged_position_is_computed_again(tmp_path, store):
    for file in store.glob("*.npz"):
        (tmp_path / file.name).write_bytes(file.read_bytes()[:100])
    done = Reports()
    run_cycle(FILE, TEETH, SMALL, store=tmp_path, jobs=1, progress=done)
    assert len(done) == 8


@pytest.mark.parametrize(
    "bad", [{"positions": 2}, {"torques": ()}, {"torques": (50.0, 20.0)}, {"torques": (-5.0,)}]
)
def test_settings_out_of_range_are_refused(bad):
    with pytest.raises(ParameterError, match=next(iter(bad))):
        CycleSettings(**bad)


def test_torques_are_within_a_hundredth_and_a_hundred_thousand():
    assert CycleSettings(torques=(0.01, 1e5)).torques == (0.01, 1e5)
    for torque in (0.0099, 1.001e5):
        with pytest.raises(ParameterError, match=r"torques must be within 0\.01 to 100000 N\.m"):
            CycleSettings(torques=(torque,))
