"""Every variable of a loss map and of a drive cycle: known answers of losses that are written."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np

from drivetrain.sump_heat import Warming
from gearlube.report import churning
from gearlube.studies.drive_cycle.loss_field import Demand, LossesAlong
from gearlube.studies.drive_cycle.run import cycle_dataset
from gearlube.studies.drive_cycle.spread import CycleSpread
from gearlube.studies.loss_map import datasets
from gearlube.studies.loss_map.sampling import Spread
from gearlube_core.dynamics.hypoid_axle.losses import LOSS_SOURCES, AxleLosses
from gearlube_core.dynamics.hypoid_axle.mohammadpour_2015 import mohammadpour_2015_axle
from gearlube_core.dynamics.ranges import RANGE_OUTPUTS, Range
from tests.helpers.known_answers import assert_variables

ZERO, RPM = 273.15, 30.0 / np.pi
RANGES = tuple(Range(one, "a quantity", 0.0, 1.0, "1", "") for one in RANGE_OUTPUTS[1:])
SOURCES = np.array([100.0, 40.0, 3.0, 5.0, 20.0, 7.0, 11.0, 13.0])  # W


def an_axle(**changes):
    """Return what the datasets read of an axle of ratio 3 whose films are solved."""
    oil = SimpleNamespace(name="an oil", temperature_high=423.15)
    usual = {
        "mesh": SimpleNamespace(ratio=3.0, name="a mesh"),
        "oil": oil,
        "film": "solved",
        "film_models": {},
        "bearing_torque_loss": "solved_films",
        "churning": "changenet_velex_2007",
        "flank_bulk_resistance": 0.1,
        "pinion_seal_torque": 1.0,
        "wheel_seal_torque": 0.0,
        "hub_torque": 0.0,
        "friction_law": SimpleNamespace(rubs=True),
        "rolling": "none",
        "ranges": RANGES,
    }
    return SimpleNamespace(**usual | changes)


def test_every_variable_of_a_loss_map_has_its_known_values_and_unit(monkeypatch):
    torque, turning = np.array([-50.0, 0.0, 100.0]), np.array([100.0, 200.0])  # N.m, rad/s
    warm = np.array([1.0, 0.5])[:, None, None] * np.ones((2, 2, 3))
    one = np.arange(1.0, 13.0).reshape(2, 2, 3)
    losses = AxleLosses(
        power=warm[..., None] * SOURCES,
        carried=10.0 * one,
        film_ratio=np.where(one == 5.0, np.inf, 0.1 * one),
        flank_temperature=400.0 + one,
        friction_bound=0.2 * one,
        share_outside=0.004 * one,
        drag_bound=0.3 * one,
        rollers_outside=0.003 * one,
        pinion_drag=0.7 * one,
        bulk_temperature=380.0 + one,
        exceeded=np.where(one == 7.0, 16.0, 0.0),
        status=np.zeros((2, 2, 3), dtype=int),
    )
    spread = Spread(low=80.0 * warm, high=300.0 * warm, swing=np.stack([2.0 * one, 3.0 * one]))
    uncertain = [SimpleNamespace(name=n, factor=f, why="old") for n, f in (("a", 1.5), ("b", 2.0))]
    settings = SimpleNamespace(
        axle=an_axle(),
        grid=(torque, turning, np.array([313.15, 353.15])),
        uncertain=uncertain,
        draws=60,
        seed=1,
    )
    regime = np.array([[0.0, 0.0], [0.0, 1.0]])
    monkeypatch.setattr(
        datasets, "churning_regime", lambda axle, *_: None if axle.churning == "none" else regime
    )
    made = datasets.loss_map_dataset(settings, losses, spread)
    heat = SimpleNamespace(conductance_at_rest=7.0, conductance_at_100_kmh=18.0)
    cooling = SimpleNamespace(heat=heat, air_temperature=293.15)
    steady = 300.0 + one[0]
    made = datasets.with_steady_temperature(made, cooling, steady, 50.0 * one[0])
    total, w = 199.0 * warm, turning[None, :, None]  # W
    # put in: 100 N.m by the pinion, or what the wheels give for 50 N.m and the loss
    put_in = np.where(torque > 0.0, torque * w, total - torque * w)
    efficiency = np.where(torque == 0.0, np.nan, 1.0 - total / put_in)
    expected = {
        "temperature": ("degC", [40.0, 80.0]),
        "speed": ("rpm", turning * RPM),
        "torque": ("N.m", torque),
        "source": ("", list(LOSS_SOURCES)),
        "input": ("", ["a", "b"]),
        "loss_torque": ("N.m", total / w),
        "loss": ("W", warm[..., None] * SOURCES),
        "efficiency": ("1", efficiency),
        "wheel_torque": ("N.m", 3.0 * (torque - total / w)),
        "pinion_bearing_loss": ("W", 0.7 * one),
        "carried_torque": ("N.m", 10.0 * one),
        "film_ratio": ("1", np.where(one == 5.0, np.nan, 0.1 * one)),
        "flank_temperature": ("degC", 400.0 + one - ZERO),
        "range_exceeded": ("1", np.where(one == 7.0, 16.0, 0.0)),
        "status": ("1", np.zeros((2, 2, 3))),
        "churning_regime": ("1", regime),
        "bulk_temperature": ("degC", 380.0 + one - ZERO),
        "friction_bound": ("W", 0.2 * one),
        "efficiency_bound": ("1", 0.2 * one / put_in),
        "share_outside": ("1", 0.004 * one),
        "drag_bound": ("W", 0.3 * one),
        "rollers_outside": ("1", 0.003 * one),
        "loss_torque_low": ("N.m", 80.0 * warm / w),
        "loss_torque_high": ("N.m", 300.0 * warm / w),
        "swing": ("N.m", np.stack([2.0 * one / w, 3.0 * one / w])),
        "steady_temperature": ("degC", steady - ZERO),
        "steady_loss_torque": ("N.m", 50.0 * one[0] / turning[:, None]),
    }
    assert_variables(made, expected, zero=("status",))
    known = {
        "ratio": 3.0,
        "pinion_seal_torque": 1.0,
        "oil_data_high_degc": 150.0,
        "not_modelled": "wheel seals, rolling of the flanks, bearings of the wheel ends "
        "(give their torque in seals.hub_torque_n_m), windage",
        "uncertain": "a: factor 1.5 (k = 2), old; b: factor 2 (k = 2), old",
        "air_temperature_degc": 20.0,
        "conductance_at_rest_w_k": 7.0,
        "conductance_at_100_kmh_w_k": 18.0,
    }
    assert {name: made.attrs[name] for name in known} == known
    assert made.attrs["ranges_left"].endswith(f"({RANGE_OUTPUTS[5]})")  # 16 is the fifth
    plain = {"film": "formula", "bearing_torque_loss": "none", "churning": "none"}
    settings.axle = an_axle(flank_bulk_resistance=0.0, **plain)
    bare = datasets.loss_map_dataset(settings, losses, None)
    assert set(bare.data_vars) == {*list(expected)[5:15]}


def test_every_variable_of_a_cycle_has_its_known_values_and_unit(monkeypatch):
    """Four steps: drive, coast, brakes alone at rest, drive; oil a quarter between two nodes."""
    steps, kmh = np.array([10.0, 20.0, 5.0, 2.0]), np.array([36.0, 72.0, 0.0, 18.0])
    turning = np.array([100.0, 200.0, 0.0, 50.0])
    brakes = np.array([0.0, 50.0, 0.0, 0.0])
    demand = Demand(
        steps=steps, speed=kmh / 3.6, shaft_speed=turning, torque=turning, brakes=brakes,
        road=brakes, measured=False,
    )  # fmt: skip
    cold = np.array([1.0, 2.0, 0.0, 3.0])[:, None] * SOURCES  # W at 300 K, half of it at 340 K
    torque = np.array([[40.0, 44.0], [-30.0, -34.0], [0.0, 0.0], [20.0, 24.0]])
    outside = np.zeros((4, 2, len(RANGES)))
    outside[0, :, 1], outside[3, :, 2] = [0.4, 0.8], 1.0
    film = 1e-3 * np.arange(1.0, 17.0).reshape(4, 1, 4) * np.ones((4, 2, 1))
    losses = LossesAlong(
        temperatures=np.array([300.0, 340.0]),
        power=np.stack([cold, 0.5 * cold], axis=1),
        torque=torque,
        outside=outside,
        film=film,
    )
    oil = np.array([300.0, 320.0, 315.0, 312.0, 310.0])
    warming = Warming(temperature=oil, mean=np.full(4, 310.0))
    others = [Warming(temperature=oil - 2.0 * k, mean=np.full(4, 310.0)) for k in (1, -1)]
    spread = CycleSpread(lost=(3.0, 14.0), efficiency=(0.7, 0.9), end_temperature=(305.0, 318.0))
    axle = an_axle()
    settings = SimpleNamespace(
        car=SimpleNamespace(
            axle=axle,
            name="a car",
            driveline=SimpleNamespace(
                road_load=SimpleNamespace(final_drive=SimpleNamespace(ratio=3.0))
            ),
        ),
        cycle=SimpleNamespace(name="made", notes=("noted",), time=np.array([0, 10, 30, 35, 37.0])),
        heat=SimpleNamespace(
            capacity=18000.0, conductance_at_rest=7.0, conductance_at_100_kmh=18.0
        ),
        start_temperature=300.0,
        air_temperature=293.15,
        regeneration=0.25,
        coast_torque=30.0,
        draws=60,
        seed=1,
    )
    monkeypatch.setattr("gearlube.studies.drive_cycle.run.uncertain_inputs", lambda _: ())
    regime = np.array([0.0, 1.0, 0.0, 0.0])
    monkeypatch.setattr("gearlube.studies.drive_cycle.run.churning_regime", lambda *_: regime)
    made = cycle_dataset(settings, demand, losses, warming, others, spread)
    power = 0.875 * cold  # a quarter of the way from 1 to 0.5
    total = power.sum(axis=1)
    at = np.array([41.0, -31.0, 0.0, 21.0])  # N.m
    put_in = at * turning  # W; in the second step the wheels give 6200 W and the loss
    energy_in = 1e-3 * (4100.0 * 10.0 + (6200.0 + total[1]) * 20.0 + 1050.0 * 2.0)
    lost = 1e-3 * steps @ power
    bound, share, drag, rollers = film[:, 0].T
    of = "energy_lost"
    share_1, share_2 = 0.5, 1.0  # of the steps outside the second and the third range
    time, energy = np.zeros(len(RANGES)), np.zeros(len(RANGES))
    time[1:3] = np.array([share_1 * 10.0, share_2 * 2.0]) / 32.0  # s of 32 s that turn
    energy[1:3] = np.array([share_1 * total[0] * 10.0, share_2 * total[3] * 2.0]) / (
        1e3 * lost.sum()
    )
    outside_now = np.zeros((4, len(RANGES)))
    outside_now[0, 1], outside_now[3, 2] = share_1, share_2
    expected = {
        "time": ("s", [0.0, 10.0, 30.0, 35.0, 37.0]),
        "step": ("s", [5.0, 20.0, 32.5, 36.0]),
        "source": ("", list(LOSS_SOURCES)),
        "range": ("", [one.output for one in RANGES]),
        "oil_temperature": ("degC", oil - ZERO),
        "oil_temperature_low": ("degC", oil - 2.0 - ZERO),
        "oil_temperature_high": ("degC", oil + 2.0 - ZERO),
        "duration": ("s", steps),
        "vehicle_speed": ("km/h", kmh),
        "pinion_speed": ("rpm", turning * RPM),
        "pinion_torque": ("N.m", at),
        "wheel_torque": (
            "N.m",
            [3.0 * (put_in[k] - total[k]) / turning[k] if turning[k] else 0.0 for k in range(4)],
        ),
        "brake_power": ("W", brakes),
        "loss": ("W", power),
        "churning_regime": ("1", regime),
        "outside_range": ("1", outside_now),
        "time_outside_range": ("1", time),
        "energy_outside_range": ("1", energy),
        "energy_in": ("kJ", energy_in),
        "energy_in_pinion": ("kJ", 41.0 + 2.1),
        of: ("kJ", lost),
        f"{of}_low": ("kJ", 3.0),
        f"{of}_high": ("kJ", 14.0),
        "energy_brakes": ("kJ", 1.0),
        "efficiency": ("1", 1.0 - lost.sum() / energy_in),
        "drag_bound": ("W", drag),
        "rollers_outside": ("1", rollers),
        "energy_drag_bound": ("kJ", 1e-3 * steps @ drag),
        "friction_bound": ("W", bound),
        "share_outside": ("1", share),
        f"{of}_bound": ("kJ", 1e-3 * steps @ bound),
        "efficiency_bound": ("1", 1e-3 * steps @ bound / energy_in),
        "efficiency_low": ("1", 0.7),
        "efficiency_high": ("1", 0.9),
        "end_temperature_low": ("degC", 305.0 - ZERO),
        "end_temperature_high": ("degC", 318.0 - ZERO),
    }
    assert_variables(made, expected)
    assert made.attrs["ranges_left"].count("(range.") == 2
    assert made.attrs["start_temperature_degc"] == 300.0 - ZERO
    assert made.attrs["trace_notes"] == "noted"
    # without draws: the losses at the temperatures of the slowest and fastest warming
    warmer = [Warming(temperature=oil, mean=np.full(4, t)) for t in (306.0, 322.0)]
    bare = cycle_dataset(settings, demand, losses, warming, warmer)
    whole = 1e-3 * float(steps @ cold.sum(axis=1))
    # 0.5 / 40 of the loss less for each kelvin
    ends = [(1.0 - 0.0125 * kelvin) * whole for kelvin in (22.0, 6.0)]
    np.testing.assert_allclose([bare[f"{of}_low"], bare[f"{of}_high"]], ends, rtol=1e-12)
    assert set(expected) - set(bare.variables) == set(list(expected)[-4:])
    # nothing turns: no share of the running time, and no loss
    still = replace(demand, shaft_speed=np.zeros(4))
    nothing = replace(losses, power=0.0 * losses.power, torque=0.0 * torque)
    rest = cycle_dataset(settings, still, nothing, warming, others)
    assert not rest["time_outside_range"].any()
    assert not rest["energy_outside_range"].any()
    assert np.isnan(rest["efficiency"])
    assert np.isnan(rest["efficiency_bound"])


def test_the_axle_of_these_datasets_has_what_they_read():
    axle = mohammadpour_2015_axle()
    assert all(hasattr(axle, name) for name in vars(an_axle()))


def test_the_regime_of_churning_is_that_of_the_oils_kinematic_viscosity(monkeypatch):
    monkeypatch.setattr(churning, "fast_regime", lambda speed, nu, p: p * speed * nu)
    oil = SimpleNamespace(dynamic_viscosity=lambda kelvin: 1e-3 * kelvin, density=800.0)
    axle = an_axle(oil=oil, kernel_parameters=lambda: SimpleNamespace(churning=2.0))
    kelvin = np.array([[300.0], [400.0]])
    found = churning.churning_regime(axle, kelvin, np.array([10.0, 30.0]))
    nu = np.array([[0.3 / 800.0], [0.4 / 800.0]])
    np.testing.assert_allclose(found, 2.0 * nu * [10.0, 30.0], rtol=1e-12)


def test_the_bound_of_the_efficiency_counts_what_is_put_in():
    """Half a watt by the pinion, or what the wheels give, or nothing that turns."""
    one = np.array([0.01, 0.02, 0.03])
    losses = SimpleNamespace(friction_bound=one, share_outside=one)
    power, total = np.array([0.5, -0.6, 0.0]), np.array([0.2, 0.2, 0.0])
    found = datasets._of_film_model(losses, power, total)["efficiency_bound"][1]
    np.testing.assert_allclose(found, [0.01 / 0.5, 0.02 / 0.8, np.nan])
