"""Every variable of a helical study's datasets: known answers of results that are written down."""

import numpy as np
import pytest

from gearlube.studies.helical import (
    film_friction,
    operating_point,
    pair_losses,
    separation,
    stability,
    sweep_grid,
)
from gearlube.studies.helical.operating_point import FORCES, LENGTHS, MOMENTS, TILTS
from gearlube.studies.helical.sweep_grid import QUANTITIES
from gearlube_core.dynamics.helical_pair.supports import BEARING_FORCES
from tests.helpers.known_answers import assert_attributes, assert_variables, made_up, named

PHASE = np.arange(64) / 64
# a mean and the first two mesh orders, of which the dataset must find 3 and 4
WAVE = 7.0 + 3.0 * np.cos(2.0 * np.pi * PHASE) + 4.0 * np.sin(4.0 * np.pi * PHASE)
ORDERS = np.array([3.0, 4.0, *13 * [0.0]])
MODES = np.array([100.0, 400.0])  # Hz
MOTIONS = dict.fromkeys(LENGTHS, "m") | dict.fromkeys(TILTS, "rad")
LOADS = dict.fromkeys(FORCES, "N") | dict.fromkeys(MOMENTS, "N.m")
POINT = ("temperature", "torque", "speed")


@pytest.fixture
def pair(monkeypatch):
    """Return parameters with an oil film; a response is known by its friction, modes are known."""

    def response(parameters, speed, throw=True):
        k = 1.0 + parameters.mu + 0.01 * speed
        force = np.column_stack([k * made_up(name) * WAVE for name in BEARING_FORCES])
        return named(
            signal=lambda name: k * made_up(name) * WAVE,
            signal_rate=lambda name: k * made_up(f"{name} rate") * WAVE,
            bearing_force=force, friction_power=5.0 * k, friction_torque=6.0 * k, phase=PHASE,
            multipliers=np.array([0.75 * np.exp(0.3j), 0.5]),
        )  # fmt: skip

    def changed(parameters, **changes):
        film = {"mu": 0.5} if changes.get("friction") == "film" else {}
        return named(**vars(parameters) | changes | film)

    for module in (operating_point, sweep_grid, stability, separation):
        for name, value in {
            "replace": changed,
            "periodic_response": response,
            "with_friction": lambda parameters, mu: changed(parameters, mu=mu),
            "linear_system": lambda parameters: None,
            "natural_frequencies": lambda system: 2.0 * np.pi * MODES,
            "parameters_key": lambda parameters: "",
            "resumable_results": lambda tasks, key, run, *_: ((t, run(t), None) for t in tasks),
        }.items():
            monkeypatch.setattr(module, name, value, raising=False)
    of = named(mesh_frequency=lambda speed: 30.0 * speed, backlash=1e-4)
    return named(pair=of, film=named(), mu=0.0, mesh_damping_ratio=0.05)


def test_variables_of_the_operating_point_are_known(pair):
    made = operating_point.operating_point(pair, 100.0, (0.0, 0.1))
    k = np.array([2.0, 2.1, 2.5])
    expected = {
        "friction_power": ("W", 5.0 * k),
        "stability_margin": ("1", [0.25] * 3),
        "case_mu": ("1", [0.0, 0.1, np.nan]),
        "natural_frequency": ("Hz", MODES),
        "case": ("", ["0", "0.1", "film"]),
        "phase": ("1", PHASE),
        "harmonic": ("1", np.arange(1, 16)),
    }
    rates = {f"{name}_rate": f"{unit}/s" for name, unit in MOTIONS.items()}
    for name, unit in (MOTIONS | LOADS | rates).items():
        size = k * made_up(name.replace("_rate", " rate"))
        expected[name] = unit, np.outer(size, WAVE)
        expected[f"{name}_harmonic"] = unit, np.outer(size, ORDERS)
    assert_variables(made, expected)
    assert_attributes(made, {"mesh_frequency": 3000.0, "mesh_frequency_units": "Hz"})


def test_variables_of_a_sweep_are_known(pair, monkeypatch):
    """Two speeds, two frictions; the oil film beside them, whose amplitudes are those of a wave."""
    mu, speeds = np.array([0.0, 0.1]), np.array([100.0, 200.0])
    of_motion, of_force = (np.array([made_up(n) for n in names]) for names in
                           (QUANTITIES, BEARING_FORCES))  # fmt: skip

    def column(parameters, mu, speed):
        size, orders = (1.0 + mu) * speed, np.arange(1.0, 16.0)
        return {
            "displacement": np.multiply.outer(size, np.outer(of_motion, orders)),
            "bearing_force": np.multiply.outer(size, np.outer(of_force, orders)),
            "mean_bearing_force": np.outer(size, of_force),
            "friction_torque": 2.0 * size,
            "stability_margin": 3.0 * size,
        }

    monkeypatch.setattr(sweep_grid, "friction_column", column)
    made = sweep_grid.sweep_dataset(pair, mu, speeds)
    size, k = np.outer(1.0 + mu, speeds), 1.5 + 0.01 * speeds
    frequency = 30.0 * speeds
    expected = {
        "friction_torque": ("N.m", 2.0 * size),
        "stability_margin": ("1", 3.0 * size),
        "film_friction_torque": ("N.m", 6.0 * k),
        "mesh_frequency": ("Hz", frequency),
        "natural_frequency": ("Hz", MODES),
        "mu": ("1", mu),
        "speed": ("rad/s", speeds),
        "harmonic": ("1", np.arange(1, 16)),
    }
    for name, unit in (MOTIONS | LOADS).items():
        if name in (*QUANTITIES, *LOADS):
            orders = np.multiply.outer(size * made_up(name), np.arange(1.0, 16.0))
            expected[f"{name}_harmonic"] = unit, orders
            expected[f"film_{name}_harmonic"] = unit, np.outer(k * made_up(name), ORDERS)
        if name in LOADS:
            expected[f"{name}_mean"] = unit, size * made_up(name)
    rates = 2.0 * np.pi * np.outer(frequency, np.arange(1, 16))
    for prefix in ("", "film_"):
        amplitude = expected[f"{prefix}delta_z_harmonic"][1]
        expected[f"{prefix}delta_z_rate_harmonic"] = "m/s", amplitude * rates
    assert_variables(made, expected)


def test_variables_of_a_stability_map_are_known(pair, monkeypatch):
    """Growth is 1/s per Hz times the value of the row, less ten times the damping."""

    def growth(parameters, frequency, axis, values):
        lost = 10.0 * parameters.mesh_damping_ratio
        return named(growth=np.outer(values, frequency) - lost)

    monkeypatch.setattr(stability, "instability_map", growth)
    monkeypatch.setattr(stability, "_without_stiffness", lambda parameters: 5.0)
    made = stability.stability_dataset(pair, 3, 2)
    frequency, variation = np.array([30.0, 455.0, 880.0]), np.array([0.0, 4.75])
    damping = np.array([0.001, 0.05])
    rises = np.outer(variation, frequency)
    expected = {
        "growth_variation": ("1/s", rises - 0.5),
        "growth_variation_light": ("1/s", rises - 0.1),
        "growth_damping": ("1/s", np.outer(damping, frequency) - 0.5),
        "natural_frequency": ("Hz", MODES),
        "mesh_frequency": ("Hz", frequency),
        "variation": ("1", variation),
        "damping_ratio": ("1", damping),
    }
    assert_variables(made, expected)


def test_variables_of_tooth_separation_are_known(pair, monkeypatch):
    """With 5 % damping one branch that ends early and one from above, with 1 % one of a fold."""

    class Problem:
        natural_speed, natural_frequency, names = 1000.0, 500.0, ("u_xp",)

        def __init__(self, parameters):
            self.k = 1.0 + parameters.mesh_damping_ratio

        def over_speed(self):
            return self.k

        def orbit(self, unknowns, speed):
            size = self.k * float(unknowns[0]) * speed
            return named(peak_to_peak=1e-9 * size, separation_share=1e-4 * size,
                         lift_off_share=2e-4 * size)  # fmt: skip

    def follow(k, start, speed, *, limits, heading, at, progress):
        rows = np.array([300.0, 800.0] if heading > 0.0 else [1300.0])
        special = []
        if k < 1.02:
            rows = np.array([300.0, 1300.0])
            special = [named(kind="fold", parameter=700.0, unknowns=np.array([3.0]))]
        stable = np.arange(rows.size) == 0
        return named(parameter=rows, unknowns=np.full((rows.size, 1), 2.0), stable=stable,
                     special=special, ending="end")  # fmt: skip

    monkeypatch.setattr(separation, "SeparationProblem", Problem)
    monkeypatch.setattr(separation, "follow", follow)
    monkeypatch.setattr(separation, "_start", lambda *_: np.zeros(2))
    made = separation.separation_dataset(pair, 3)
    speed = np.array([[300.0, 800.0, 1300.0], [300.0, 1300.0, np.nan]])
    size = np.array([[1.05], [1.01]]) * 2.0 * speed
    asked = np.array([300.0, 800.0, 1300.0])
    swing = np.ptp(WAVE) * made_up("delta_z")
    expected = {
        "speed": ("rad/s", speed),
        "relative_frequency": ("1", 1e-3 * speed),
        "peak_to_peak": ("m", 1e-9 * size),
        "separation_share": ("1", 1e-4 * size),
        "lift_off_share": ("1", 2e-4 * size),
        "segment": ("1", [[0.0, 0.0, 1.0], [0.0, 0.0, np.nan]]),
        "stable": ("1", [[1.0, 0.0, 1.0], [1.0, 0.0, np.nan]]),
        "linear_peak_to_peak": ("m", [swing * (1.0 + 0.01 * asked)] * 2),
        "special_speed": ("rad/s", [[np.nan], [700.0]]),
        "special_peak_to_peak": ("m", [[np.nan], [1e-9 * 1.01 * 3.0 * 700.0]]),
        "special_kind": ("", [[""], ["fold"]]),
        "damping": ("1", [0.05, 0.01]),
        "linear_speed": ("rad/s", asked),
    }
    assert_variables(made, expected)
    known = {"endings": "end and end, end", "natural_frequency": 500.0, "natural_speed": 1000.0,
             "backlash": 1e-4}  # fmt: skip
    assert_attributes(made, known)


def a_cycle(speed, fine=(2, 2, 3)):
    """Return the friction of lines at a speed: all means rise with it."""
    units = ("coefficient", "central_film", "minimum_film", "film_ratio", "temperature_rise",
             "mean_pressure", "entrainment", "sliding")  # fmt: skip
    return named(
        **{name: speed * made_up(name, *fine) for name in units},
        line_load=made_up("line_load", *fine), mean_coefficient=4e-4 * speed,
        power_loss=speed * made_up("power", 2), mean_power_loss=0.5 * speed, efficiency=speed,
        smallest_film=named(thickness=1e-9 * speed), share_outside=1e-3 * speed, loss_factor=0.125,
        power_loss_bound=0.25 * speed, by_formulas=False,
    )  # fmt: skip


SETTINGS = {
    "pinion_speed": 100.0, "pinion_torque": 50.0, "oil_temperature": 353.15, "roughness_rms": 5e-7,
    "file": named(helical_pair=lambda: None),
}  # fmt: skip
OIL = named(name="oil", temperature_high=423.15)


def test_variables_of_the_film_on_the_lines_are_known(monkeypatch):
    """The last line has no length at its last point: its numbers are missing there."""
    shape = (2, 2, 3)
    length, x = made_up("length", *shape), made_up("x", *shape)
    length[:, 1, 2] = 0.0
    points = named(x=x, z=made_up("z", *shape), length=length, phase=np.array([0.0, 0.5]),
                   pair=named(pitch_point=1.5))  # fmt: skip
    load = made_up("line_load", *shape)
    monkeypatch.setattr(film_friction, "line_points", lambda *_: points)
    monkeypatch.setattr(film_friction, "table_line_load", lambda *_: load)
    film = named(oil=OIL, film="formulas", film_models={},
                 covered_cycle=lambda points, load, speed, torque: a_cycle(speed))  # fmt: skip
    made = film_friction.film_dataset(named(**SETTINGS, film=lambda: film), None)
    speeds = 100.0 * 0.1 * 40.0 ** (np.arange(17) / 16.0)
    valid = np.where(length > 0.0, 1.0, np.nan)
    units = {"coefficient": "1", "central_film": "m", "minimum_film": "m", "film_ratio": "1",
             "temperature_rise": "K", "mean_pressure": "Pa", "entrainment": "m/s",
             "sliding": "m/s"}  # fmt: skip
    here = a_cycle(100.0)
    force = load * length
    side = np.where(x > 1.5, 1.0, -1.0)
    expected = {name: (unit, valid * getattr(here, name)) for name, unit in units.items()} | {
        "line_load": ("N/m", valid * load),
        "x": ("m", valid * x),
        "z": ("m", valid * points.z),
        "length": ("m", length),
        "friction_force": ("N", (here.coefficient * force).sum(axis=(1, 2))),
        "friction_force_constant": ("N", 0.04 * (side * force).sum(axis=(1, 2))),
        "power_loss": ("W", 100.0 * made_up("power", 2)),
        "mean_coefficient": ("1", 4e-4 * speeds),
        "mean_power_loss": ("W", 0.5 * speeds),
        "efficiency": ("1", speeds),
        "smallest_film": ("m", 1e-9 * speeds),
        "film_share_outside": ("1", 1e-3 * speeds),
        "friction_phase": ("1", [0.0, 0.5]),
        "film_speed": ("rad/s", speeds),
    }
    assert_variables(made, expected)
    known = {
        "oil_data_high_degc": 150.0, "oil_temperature": 353.15, "roughness_rms": 5e-7,
        "pitch_point": 1.5, "loss_factor": 0.125, "operating_mean_coefficient": 0.04,
        "operating_power_loss": 50.0, "operating_power_loss_bound": 25.0,
        "operating_efficiency_bound": 0.005, "operating_share_outside": 0.1,
    }  # fmt: skip
    assert_attributes(made, known)


def test_variables_of_the_losses_are_known(monkeypatch):
    """Sliding 0.5 s, rolling 0.125 s T/K at the speed s; of two points one is by formulas."""

    def losses(points, load, point, film, raw=False):
        torque, speed = point
        rolling = 0.125 * speed * film.oil_temperature / 300.0
        return a_cycle(speed), np.array([0.5 * speed, rolling * torque / 50.0])

    monkeypatch.setattr(pair_losses, "line_points", lambda *_: None)
    monkeypatch.setattr(pair_losses, "table_line_load", lambda *_: None)
    monkeypatch.setattr(pair_losses, "uncertain_of", lambda *_: ())
    monkeypatch.setattr(pair_losses, "replace", lambda film, oil_temperature: named(
        oil_temperature=oil_temperature, formulas=film))  # fmt: skip
    monkeypatch.setattr(pair_losses, "_losses", losses)
    monkeypatch.setattr(pair_losses, "_spread", lambda *_: np.array([0.5, 2.0]))
    film = named(oil=OIL, film="solved", film_models={}, asperities=None)
    torque, speed = np.array([50.0, 100.0]), np.array([10.0, 100.0])
    settings = named(
        **SETTINGS, film=lambda: film, load_steps=(50.0, 100.0), speeds=(10.0, 100.0),
        oil_temperatures=(300.0, 330.0), draws=4, seed=1,
    )  # fmt: skip
    made = pair_losses.losses_dataset(settings, named(name="mesh"))
    s = np.broadcast_to(speed, (2, 2, 2))
    rolling = 0.125 * s * np.array([1.0, 1.1])[:, None, None] * np.array([1.0, 2.0])[:, None]
    total = 0.5 * s + rolling
    power = torque[:, None] * speed
    loaded = np.ones((2, 2, 3))
    expected = {
        "loss": ("W", np.stack([0.5 * s, rolling], axis=-1)),
        "loss_torque": ("N.m", total / s),
        "efficiency": ("1", 1.0 - total / power),
        "film_ratio": ("1", s * (loaded * made_up("film_ratio", 2, 2, 3)).min()),
        "film_min": ("m", 1e-9 * s),
        "temperature_rise": ("K", s * made_up("temperature_rise", 2, 2, 3).max()),
        "loss_bound": ("W", 0.25 * s),
        "efficiency_bound": ("1", 0.25 * s / power),
        "share_outside": ("1", 1e-3 * s),
        "by_formulas": ("1", 1.0 * (s > 50.0)),
        "loss_torque_low": ("N.m", 0.5 * total / s),
        "loss_torque_high": ("N.m", 2.0 * total / s),
        "temperature": ("degC", [26.85, 56.85]),
        "torque": ("N.m", torque),
        "speed": ("rpm", speed * 30.0 / np.pi),
        "part": ("", ["sliding", "rolling"]),
    }
    assert_variables(made, expected)
    assert all(made[name].dims[:3] == POINT for name in ("loss", "loss_torque", "film_min"))
