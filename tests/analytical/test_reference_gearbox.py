"""The shipped 5 MW gearbox: speeds, torques, phases and torsion as its source's numbers give them.

Speeds, torques and the frequency of two inertias are those that Drivetrain-python prints of the
same gearbox. The torsional chain below is an own one, with the equations of [lin_parker_1999].
"""

from __future__ import annotations

import tomllib
from functools import cache
from typing import NamedTuple

import numpy as np
import pytest
import scipy.linalg

from drivetrain.train.train_file import TrainFile
from gearlube_core.dynamics.train.model import Train

RATED, RATIO = 5e6, 1850.0 / 19.2  # W; (75/19) (111/18) (95/24)
INPUT = RATED / (12.1 * np.pi / 30.0)  # N.m
STAGES = {
    "intermediate_shaft": 999650.88,
    "high_speed_intermediate_shaft": 162105.55,
    "high_speed_shaft": -40952.98,  # the pinion turns the other way
}  # N.m
ROTOR, GENERATOR = 57231535.0, 534.116  # kg m2
SHEAR = 206e9 / 2.6  # Pa


@cache
def smooth() -> Train:
    """Return the gearbox without friction, with even teeth and stiff bearings of the last stage."""
    data = tomllib.loads(TrainFile.shipped_text("nrel_5mw"))
    for name in ("sun_mesh_1a", "sun_mesh_2a", "stage_3"):  # the others are like them
        data["elements"][name] |= {"friction": 0.0, "stiffness_waves": [], "gap": []}
    for name in ("wheel", "pinion"):
        data["bodies"][name]["held"] = ["x", "y", "z", "rx", "ry"]
    data["start"]["torque_n_m"] = {"wind": INPUT, "load": INPUT / RATIO}
    return TrainFile.from_data(data, "file").case().start()


class Run(NamedTuple):
    """The gearbox as it ships, over 20 ms."""

    first: dict[str, float]  # outputs
    last: dict[str, float]
    missing: float  # energy that is neither stored nor lost [J]
    lost: float


@cache
def shipped() -> Run:
    case = TrainFile.named("nrel_5mw").case()
    train = case.start()
    first, before = train.outputs(), train.energy
    for _ in range(20):
        train.step(1e-3, case.torques, case.oil_temperature)
    lost = sum(train.lost.values())
    return Run(first, train.outputs(), train.work - lost - (train.energy - before), lost)


def test_shafts_turn_as_their_teeth_count():
    found = shipped().first
    rpm = [found[f"{one}.speed"] * 30.0 / np.pi for one in ("sun_1", "wheel", "generator")]
    assert rpm == pytest.approx([47.763, 294.539, -1165.885], abs=6e-4)  # digits printed
    assert found["rotor.speed"] * RATIO == pytest.approx(-found["generator.speed"], rel=1e-12)


def test_shafts_carry_the_rated_power():
    """Second-order moments of displaced planets take 2e-5 of the torque of the first stage."""
    found = smooth().outputs()
    for name, torque in STAGES.items():
        assert found[f"{name}.torque"] == pytest.approx(torque, rel=3e-5)


def test_planets_of_the_first_stage_mesh_in_sequence_and_of_the_second_one_together():
    """19 and 18 teeth of the sun, three planets: one after the other by 1/3 and 0 of a mesh cycle.

    A sequence turns the sum of the waves over the planets forwards, at the mesh frequency.
    """
    ways = np.exp(2j * np.pi * np.arange(3) / 3.0)
    sums = []
    for outputs in (shipped().first, shipped().last):
        waves = [
            np.array([outputs[f"sun_mesh_{stage}{one}.stiffness"] for one in "abc"]) / mean - 1.0
            for stage, mean in ((1, 14488.345e6), (2, 18455.879e6))
        ]
        # of 0.1, which deflections of the teeth by 1e-3 of a pitch shift
        assert abs(waves[0].sum()) < 3e-4
        assert np.ptp(waves[1]) < 1e-4
        sums.append(2.0 / 3.0 * (waves[0] @ ways))
    assert abs(sums[0]) == pytest.approx(0.1, rel=1e-3)
    turned = np.exp(2j * np.pi * 56.0 * 12.1 / 60.0 * 0.02)
    assert sums[1] / sums[0] == pytest.approx(turned, abs=3e-3)


def sun_and_planets(teeth: tuple[int, int, int], module: float, distance: float, mesh: float,
                    pin: tuple[float, float], inertia: float, mass: float):  # fmt: skip
    """Return stiffness and mass of three equal planets that move alike, at a fixed ring.

    Coordinates: carrier and sun [rad], a planet's rotation, its way outwards and along the orbit.
    """
    base = [0.5 * z * module * np.cos(np.radians(20.0)) for z in teeth]
    at_sun = np.arccos((base[0] + base[1]) / distance)
    at_ring = np.arccos((base[2] - base[1]) / distance)
    ways = np.array([
        [0.0, -base[0], -base[1], np.sin(at_sun), np.cos(at_sun)],
        [0.0, 0.0, base[1], -np.sin(at_ring), np.cos(at_ring)],
        [0.0, 0.0, 0.0, 1.0, 0.0],
        [-distance, 0.0, 0.0, 0.0, 1.0],
    ])  # fmt: skip
    stiffness = 3.0 * ways.T @ np.diag([mesh, mesh, *pin]) @ ways
    return stiffness, 3.0 * np.diag([0.0, 0.0, inertia, mass, mass])


def chain_frequency(stiffer: float = 1.0, lighter: float = 1.0) -> float:
    """Return the lowest frequency of the gearbox whose bodies only twist [Hz].

    All between main and high-speed shaft is stiffer and lighter by these factors. Rotor, first
    carrier, sun and planets, second ones, wheel, pinion, generator.
    """
    n = 14
    stiffness, mass = np.zeros((n, n)), np.zeros((n, n))
    sets = [
        ([1, 2, 3, 4, 5], sun_and_planets((19, 17, 56), 0.045, 0.863, 14488.345e6,
                                          (6.4e9, 18.8e9), 156.917, 1522.84)),
        ([6, 7, 8, 9, 10], sun_and_planets((18, 36, 93), 0.021, 0.584, 18455.879e6,
                                           (0.12e9, 2.4e9), 139.937, 1517.84)),
    ]  # fmt: skip
    for at, (k, m) in sets:
        stiffness[np.ix_(at, at)] += stiffer * k
        mass[np.ix_(at, at)] += m / lighter
    helix = np.arctan(np.tan(np.radians(10.0)) * np.cos(np.arctan(
        np.tan(np.radians(20.0)) / np.cos(np.radians(10.0)))))  # fmt: skip
    transverse = np.arctan(np.tan(np.radians(20.0)) / np.cos(np.radians(10.0)))
    base = 0.007 / np.cos(np.radians(10.0)) * np.cos(transverse)
    way = np.zeros(n)
    way[[11, 12]] = 95 * base * np.cos(helix), 24 * base * np.cos(helix)
    stiffness += stiffer * 13817.834e6 * np.outer(way, way)
    for a, b, diameter, length, factor in (
        (0, 1, 0.7, 2.0, 1.0), (2, 6, 0.533, 0.5, stiffer), (7, 11, 0.333, 0.666, stiffer),
        (12, 13, 0.333, 1.0, 1.0),
    ):  # fmt: skip
        k = factor * SHEAR * np.pi / 32.0 * diameter**4 / length
        stiffness[np.ix_([a, b], [a, b])] += k * np.array([[1.0, -1.0], [-1.0, 1.0]])
    inner = {1: 10600.0, 2: 225.471, 6: 2470.0, 7: 8.8402, 11: 942.889, 12: 3.71878}
    for at, inertia in {**inner, 0: ROTOR * lighter, 13: GENERATOR * lighter}.items():
        mass[at, at] += inertia / lighter
    # by flexibility, without the motion of the whole, which costs no force
    squares = scipy.linalg.eigh(stiffness, mass, eigvals_only=True)
    return float(np.sqrt(squares[1])) / (2.0 * np.pi)


def test_the_first_frequency_is_that_of_a_torsional_chain():
    """The chain gives the printed one of rotor, generator and two shafts when all else is stiff."""
    assert chain_frequency(1e5, 1e6) == pytest.approx(2.27549207, rel=2e-6)
    first = next(one for one in smooth().modes()[0] if one > 0.1)
    assert first == pytest.approx(chain_frequency(), rel=1e-5)  # digits of the file


def test_energy_balances_and_friction_takes_its_share_in_every_stage():
    """0.03 of friction takes 0.5 to 0.7 % in each of three stages; a turn of the rotor is 5 s."""
    passed = RATED * 0.02  # J
    assert abs(shipped().missing) < 1e-9 * passed  # rounding of sums over 1e4 steps
    assert 0.015 < shipped().lost / passed < 0.021
