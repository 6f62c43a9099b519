"""The helical mesh cycle and its dataset: what is stored, resumed, labelled and refused."""

import numpy as np
import pytest

from gearlube_core.errors import ParameterError
from gearlube_core.helical_contact.contact_dataset import contact_dataset
from gearlube_core.helical_contact.loaded_contact import LoadedSettings
from gearlube_core.helical_contact.mesh_cycle import CycleSettings, run_cycle
from gearlube_core.helical_contact.strips import StripSettings
from gearlube_core.helical_geometry.modification import ModifiedPair
from gearlube_core.storage import resumable
from tests.helpers.each import each
from tests.helpers.helical_contact_cases import HE_2007, relieved, stiff_teeth
from tests.helpers.reports import Reports

CELLS = LoadedSettings(strips=StripSettings(cells_across=11, cells_along=12))
SMALL = CycleSettings(torques=(50.0, 200.0), positions=5, stations=4, loaded=CELLS)
PLAIN = ModifiedPair(pair=HE_2007)
TEETH = stiff_teeth(113e9)


@pytest.fixture(scope="module")
def store(tmp_path_factory):
    folder = tmp_path_factory.mktemp("cycle")
    run_cycle(PLAIN, TEETH, SMALL, store=folder, jobs=1)
    return folder


@pytest.mark.slow
def test_an_interrupted_run_goes_on_where_it_stopped(tmp_path, store):
    seen, rest = [], Reports()

    def stop(_, sentence):
        seen.append(sentence)
        if len(seen) == 2:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run_cycle(PLAIN, TEETH, SMALL, store=tmp_path, jobs=1, progress=stop)
    resumed = run_cycle(PLAIN, TEETH, SMALL, store=tmp_path, jobs=1, progress=rest)
    assert sorted(seen + rest) == [f"loaded contact, mesh phase {k:.2f}" for k in SMALL.phases]
    whole = run_cycle(PLAIN, TEETH, SMALL, store=store, jobs=1)
    for name, values in whole.items():
        np.testing.assert_array_equal(resumed[name], values)


def test_a_finished_run_computes_nothing(store, monkeypatch):
    monkeypatch.setattr(resumable, "single_threaded", None)  # would fail if called
    again = run_cycle(PLAIN, TEETH, SMALL, store=store, jobs=1)
    assert again["rotation"].shape == (5, 2)
    assert again["line_load"].shape == (5, 2, 5, 4)


@pytest.mark.slow
def test_other_teeth_or_reliefs_are_not_taken_from_the_store(store):
    for other in ((PLAIN, stiff_teeth(110e9)), (relieved(HE_2007, 1e-5, 1e-3), TEETH)):
        done = Reports()
        run_cycle(*other, SMALL, store=store, jobs=1, progress=done)
        assert len(done) == 5


@pytest.mark.slow
def test_two_processes_find_what_one_finds(store):
    whole = run_cycle(PLAIN, TEETH, SMALL, store=store, jobs=1)
    parallel = run_cycle(PLAIN, TEETH, SMALL, jobs=2)
    for name, values in whole.items():
        np.testing.assert_allclose(parallel[name], values, rtol=1e-9, atol=1e-12)


@each(
    "bad",
    [
        {"torques": ()},
        {"torques": (50.0, 20.0)},
        {"torques": (-5.0,)},
        {"torques": (5.0,), "positions": 2},
        {"torques": (5.0,), "stations": 0},
    ],
)
def test_settings_out_of_range_are_refused(bad):
    with pytest.raises(ParameterError, match=list(bad)[-1]):
        CycleSettings(**bad)
    with pytest.raises(ParameterError, match="odd"):
        StripSettings(cells_across=20)


def test_torques_are_within_a_thousandth_and_a_million():
    assert CycleSettings(torques=(0.001, 1e6)).torques == (0.001, 1e6)
    for torque in (0.00099, 1.001e6):
        with pytest.raises(ParameterError, match=r"torques must be within 0\.001 to 1e\+06 N\.m"):
            CycleSettings(torques=(torque,))


def test_the_dataset_is_labelled_and_adds_up(store):
    cycle = run_cycle(PLAIN, TEETH, SMALL, store=store, jobs=1)
    dataset = contact_dataset(PLAIN, SMALL, cycle)
    for name in (*dataset.data_vars, "phase", "torque", "line", "station"):
        assert dataset[name].attrs["units"], name
        assert dataset[name].attrs["long_name"], name
        assert np.isfinite(dataset[name].values).all(), name
    np.testing.assert_allclose(dataset["share"].sum("line"), 1.0, rtol=1e-12)
    np.testing.assert_allclose(dataset["length_share"].sum("line"), 1.0, rtol=1e-12)
    np.testing.assert_allclose(dataset["K_line"].sum("line"), dataset["K"], rtol=1e-12)
    # force in the plane of contact plus that at corners; a row across the plane's end has the arm
    # of a corner, a few per cent less, and a hundredth of the load
    r = HE_2007.pinion_base_radius * np.cos(HE_2007.base_helix_angle)
    part = dataset["contact_length"] / SMALL.stations
    inside = r * (dataset["line_load"] * part).sum(("line", "station"))
    np.testing.assert_allclose(inside / dataset["torque"] + dataset["corner_share"], 1.0, rtol=5e-4)
    # no relief: what is loaded beside the plane of contact is corner contact
    corner_free = dataset["relief_length"].where(dataset["share"] < 1e-12, drop=False)
    assert float(corner_free.max()) == 0.0
