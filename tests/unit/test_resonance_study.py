"""A resonance study: branches against integration in time, datasets, an interrupted run."""

import numpy as np
import pytest
import xarray as xr

from gearlube.studies.resonance.cycle_dataset import cycle_dataset
from gearlube.studies.resonance.datasets import resonance_dataset
from gearlube.studies.resonance.response import Response, follow_response
from gearlube.studies.resonance.settings import ResonanceSettings
from gearlube.studies.resonance.study import study_resonance
from gearlube.studies.resonance.summary import (
    main_special,
    mesh_harmonics,
    rate_over_period,
    summaries,
)
from gearlube_core.dynamics.hypoid_torsional.kernel_parameters import DE, R_G, R_P
from gearlube_core.dynamics.hypoid_torsional.mode_march import MARCH_WORK, N_RECORD, march
from gearlube_core.dynamics.hypoid_torsional.synthetic_mesh import synthetic_mesh
from gearlube_core.errors import ParameterError
from tests.helpers.each import each


def dry(**changes):
    settings = {
        "mesh": synthetic_mesh(),
        "friction": "off",
        "frequencies": 15,
        "sweep_frequencies": 0,
        "section_starts": 0,
        "steps_per_mesh_period": 256,
    }
    return ResonanceSettings(**(settings | changes))


def marched(segment, row, periods=300):
    """Peak to peak of the motion that a disturbed start reaches, by integration in time [m]."""
    problem, branch = segment.problem, segment.branch
    y, load_torque = problem.state(branch.unknowns[row], branch.parameter[row])
    y[0] *= 1.01
    model, steps = problem.model, problem.steps_per_mesh_period
    rows, p = model.rows(steps), model.kernel_parameters
    speed = branch.parameter[row]
    march(y, 0, periods, load_torque, speed, rows, p, np.zeros((0, N_RECORD)), np.zeros(MARCH_WORK))
    record = np.zeros((2 * steps, N_RECORD))
    march(y, periods, 2, load_torque, speed, rows, p, record, np.zeros(MARCH_WORK))
    return 1e-6 * np.ptp(record[:, 1])


@pytest.mark.slow
@pytest.mark.parametrize("model", ["two_dof", "one_dof"])
def test_every_stable_motion_is_what_integration_in_time_settles_on(model):
    settings = dry(first=0.3, last=1.3, frequencies=11)
    response = Response(model=model)
    follow_response(response, settings)
    found = {value: response.motions(value) for value in (0.3, 0.5, 0.8, 0.9, 1.0, 1.3)}
    stable = {
        value: [(s, row) for s, row in motions if s.branch.stable[row]]
        for value, motions in found.items()
    }
    assert [len(motions) for motions in found.values()] == [1, 1, 1, 3, 1, 1]
    assert [len(motions) for motions in stable.values()] == [1, 1, 1, 2, 1, 1]
    for motions in stable.values():
        for segment, row in motions:
            followed = np.ptp(segment.orbit(row).x)
            # 0.5 % is what the continuation is asked to agree within; same steps, so it is closer
            assert marched(segment, row) == pytest.approx(followed, rel=5e-3)


def test_unstable_motion_between_folds_is_left_by_integration_in_time():
    settings = dry(first=0.8, last=1.1, frequencies=4)
    response = Response(model="one_dof")
    follow_response(response, settings)
    (unstable,) = [(s, row) for s, row in response.motions(0.9) if not s.branch.stable[row]]
    followed = np.ptp(unstable[0].orbit(unstable[1]).x)
    # the two stable motions differ from it by a third and more
    assert abs(marched(*unstable) / followed - 1.0) > 0.2


@pytest.mark.slow
def test_stable_lubricated_motions_are_what_integration_in_time_settles_on():
    settings = ResonanceSettings(first=0.6, last=1.2, frequencies=3, lubricated_steps=96)
    response = Response(model="two_dof_lubricated")
    follow_response(response, settings, doubled=False)
    for value in settings.relative:
        for segment, row in response.motions(float(value)):
            if segment.branch.stable[row]:
                followed = np.ptp(segment.orbit(row).x)
                assert marched(segment, row, 60) == pytest.approx(followed, rel=5e-3)


@pytest.mark.slow
def test_time_sweeps_lie_on_the_branches():
    study = study_resonance(dry(sweep_frequencies=8, first=0.4, last=0.9, frequencies=8))
    dataset = resonance_dataset(study)
    for model in ("two_dof", "one_dof"):
        rows = dataset.sel(model=model).peak_to_peak.values
        relative = dataset.sel(model=model).relative_frequency.values
        swept = dataset.sel(swept_model=model, direction="up").sweep_peak_to_peak.values
        for place, size in zip(np.linspace(0.4, 0.9, 8), swept, strict=True):
            near = rows[np.abs(relative - place) < 1e-6]
            # of both coexisting motions the sweep is on one; 512 against 256 steps
            assert np.min(np.abs(near / size - 1.0)) < 5e-3


@pytest.fixture(scope="module")
def study():
    return study_resonance(
        dry(first=0.7, last=1.1, frequencies=12, sweep_frequencies=4, section_starts=3)
    )


@pytest.mark.slow
def test_datasets_state_units_and_survive_netcdf(study, tmp_path):
    for name, dataset in (("a", resonance_dataset(study)), ("b", cycle_dataset(study))):
        for variable in dataset.data_vars.values():
            assert variable.attrs["long_name"]
            assert "units" in variable.attrs, variable.name
        dataset.to_netcdf(tmp_path / name, engine="scipy", format="NETCDF3_64BIT")
    response = resonance_dataset(study)
    part = response.sel(model="two_dof")
    rows = np.isfinite(part["segment"].values)
    np.testing.assert_allclose(
        part["maximum"].values[rows] - part["minimum"].values[rows],
        part["peak_to_peak"].values[rows],
        rtol=1e-12,
    )
    np.testing.assert_allclose(
        part["frequency"].values[rows],
        part["relative_frequency"].values[rows] * response.attrs["natural_frequency"],
    )
    assert np.all((part["multiplier"].values[rows] < 1.0) == (part["stable"].values[rows] == 1.0))


@pytest.mark.slow
def test_summary_of_a_softening_resonance(study):
    dataset = resonance_dataset(study)
    for summary in summaries(dataset):
        if summary.model == "two_dof_mean_radii":
            continue
        (_, high), (_, low) = [point for point in summary.special if point[0] == "fold"]
        ((lost, _),), ((_, regained),) = summary.separated_up, summary.separated_down
        # backlash softens: contact is lost at the upper fold on the way up, and regained at the
        # lower one, where the motion is largest, on the way down; rows are at most 0.01 apart
        assert low < high < 1.0
        assert lost == pytest.approx(high, abs=0.01)
        assert regained == pytest.approx(low, abs=0.01)
        assert summary.peak_at == pytest.approx(low, abs=0.01)
        assert not summary.remarks


@pytest.mark.slow
def test_an_interrupted_study_keeps_what_was_found():
    calls = []

    def stop(_, sentence):
        calls.append(sentence)
        if "1-DOF" in sentence and len([c for c in calls if "1-DOF" in c]) == 5:
            raise KeyboardInterrupt

    study = study_resonance(dry(frequencies=10), stop)
    assert study.interrupted
    assert list(study.responses) == ["two_dof", "one_dof"]
    dataset = resonance_dataset(study)
    ends = dataset["relative_frequency"].max("row").values
    assert ends[0] == pytest.approx(1.6)
    assert 0.2 < ends[1] < 1.6
    assert dataset.attrs["interrupted"] == 1
    assert "x" not in cycle_dataset(study)


@pytest.mark.slow
def test_flank_contacts_share_the_mesh_force_and_brake_the_pinion():
    study = study_resonance(
        ResonanceSettings(
            first=0.28,
            last=0.31,
            frequencies=2,
            sweep_frequencies=0,
            section_starts=0,
            lubricated_steps=64,
        )
    )
    cold, hot = study.cycles
    assert (cold.oil_temperature, hot.oil_temperature) == (313.15, 373.15)
    for cycle in (cold, hot):
        values = cycle.values
        np.testing.assert_allclose(
            np.nansum(values["load"], axis=0), cycle.motion.orbit.force, rtol=1e-9
        )
        friction = values["viscous_friction"] + values["boundary_friction"]
        np.testing.assert_allclose(
            values["friction_coefficient"] * values["load"], friction, rtol=1e-9
        )
        # Karagiannis et al. 2012: the sum brakes the pinion at all times
        assert np.all(np.nansum(values["torque_pinion"], axis=0) < 0.0)
        lost = np.nansum(friction * np.abs(values["sliding_speed"]), axis=0)
        orbit = cycle.motion.orbit
        power = orbit.pinion_speed * np.nansum(values["torque_pinion"], axis=0)
        power += orbit.gear_speed * np.nansum(values["torque_gear"], axis=0)
        np.testing.assert_allclose(power, -lost, rtol=1e-9)
    # a quarter of the film at 100 degC: viscosity^(3/4) alone gives 0.25 to 0.3
    thinner = hot.values["film_thickness"] / cold.values["film_thickness"]
    assert 0.15 < np.nanmedian(thinner) < 0.35


def test_rate_is_the_kinematic_one(study):
    for motion in study.motions:
        if motion.model != "two_dof":
            continue
        orbit = motion.orbit
        rows = motion.problem.model.rows(orbit.x.size)[::2]
        kinematic = (rows[:, R_P] - rows[:, DE]) * orbit.pinion_speed
        kinematic -= rows[:, R_G] * orbit.gear_speed
        # x' has corners where contact is made with damping, which a Fourier series rounds
        np.testing.assert_allclose(
            rate_over_period(orbit), kinematic, atol=1e-2 * np.ptp(kinematic)
        )


def test_harmonics_of_a_known_series():
    angle = 2.0 * np.pi * np.arange(64) / 64
    x = 3.0 + 2.0 * np.cos(2 * angle) + 0.5 * np.sin(4 * angle) + 0.7 * np.cos(3 * angle)
    # over two mesh periods the third harmonic is half an order and is left out
    np.testing.assert_allclose(mesh_harmonics(x, 2, 3), [2.0, 0.5, 0.0], atol=1e-12)


@each(
    "changes",
    [
        {"first": 0.01},
        {"last": 5.0},
        {"first": 1.0, "last": 0.5},
        {"frequencies": 1},
        {"friction": "some"},
        {"pinion_torque": -1.0},
        {"pinion_torque": 1000.0},
        {"radii": "other"},
        {"load_at": 5.0},
    ],
)
def test_settings_out_of_range_are_refused(changes):
    with pytest.raises(ParameterError):
        dry(**changes)


def test_wrinkles_of_a_branch_are_not_listed_as_folds():
    kinds = ["fold", "exchange", "fold", "fold", "fold", "period doubling", ""]
    places = [0.96, 0.96, 0.8201, 0.8202, 0.81, 0.9, np.nan]
    part = xr.Dataset(
        {"special_kind": ("special", kinds), "special_relative_frequency": ("special", places)}
    )
    # the pair 1e-4 apart goes, the exchange says nothing new, the last place is empty
    assert main_special(part).tolist() == [0, 4, 5]
