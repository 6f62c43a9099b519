"""Shafts as beams against closed forms, and against a rotor of ROSS (Petrobras, commit 631a249).

The frequencies of the simply supported beam are roots of Timoshenko's equation.
"""

from __future__ import annotations

import math

import numpy as np
import pytest
import scipy.linalg
import scipy.optimize

from gearlube_core.dynamics.train.elements.half_shaft import HalfShaft
from gearlube_core.dynamics.train.elements.helical_mesh import HelicalMesh
from gearlube_core.dynamics.train.elements.port import Port
from gearlube_core.dynamics.train.elements.spring_support import SpringSupport
from gearlube_core.dynamics.train.model import Train
from gearlube_core.dynamics.train.part import Body, Element
from gearlube_core.dynamics.train.shaft import Shaft
from gearlube_core.errors import ParameterError
from gearlube_core.shafts.beam import shaft_beam, shear_coefficient
from gearlube_core.shafts.section import ShaftDisc, ShaftMaterial, ShaftSection
from tests.helpers.small_trains import OIL, PAIR, RATIO

KELVIN = 333.15
STEEL = ShaftMaterial(E=211e9, G=81.2e9, density=7810.0)
ROUND = ShaftSection(start=0.0, end=1.0, outer_diameter=0.05)
PINNED = 1e13  # N/m, of a support: a share of 1e-7 of the shaft's own flexibility


def turning(bodies, elements, speed: float) -> Train:
    """Return a train of one shaft at a speed [rad/s], without load."""
    elements = [*elements, Port(name="motor", body=bodies[0].name)]
    train = Train(bodies, elements, OIL)
    train.initialise({bodies[0].name: speed}, {"motor": 0.0}, KELVIN)
    return train


def pinned_beam(**more) -> Shaft:
    nodes = {"left": 0.0, "middle": 0.5, "right": 1.0}
    return Shaft(name="beam", sections=(ROUND,), nodes=nodes, material=STEEL, **more)


def pins() -> list[Element]:
    both = {"K_xx": PINNED, "K_yy": PINNED}
    return [
        SpringSupport(name="at left", body="beam.left", K_zz=1e8, **both),
        SpringSupport(name="at right", body="beam.right", **both),
    ]


def pinned_frequencies(longest: float) -> np.ndarray:
    """Return the frequencies of the simply supported beam by all its elements [Hz], rising."""
    beam = shaft_beam([ROUND], [], [], STEEL, longest)
    free = [i for i in range(2 * beam.places.size) if i not in (0, 2 * beam.places.size - 2)]
    both = np.ix_(free, free)
    squares = scipy.linalg.eigh(beam.bending.stiffness[both], beam.bending.mass[both],
                                eigvals_only=True)  # fmt: skip
    return np.sqrt(squares) / (2.0 * math.pi)


def whirling(train: Train) -> np.ndarray:
    """Return the frequencies of the train's linear motion [Hz], with gyroscopic moments."""
    at, base = train.continuous, train.derivative(train.continuous)
    names = train.continuous_names
    # the rotation about z and energies move nothing here
    free = ("energy.", "beam.angle", "beam.speed")
    kept = [i for i, name in enumerate(names) if not name.startswith(free)]
    jacobian = np.empty((len(kept), len(kept)))
    for column, i in enumerate(kept):
        moved = at.copy()
        moved[i] += 1e-7
        jacobian[:, column] = (train.derivative(moved) - base)[kept] / 1e-7
    values = np.linalg.eigvals(jacobian).imag
    return np.sort(values[values > 1.0]) / (2.0 * math.pi)


def exact_frequencies(order: int, speed: float = 0.0) -> tuple[float, float]:
    """Return backward and forward whirl of the simply supported shaft [Hz], from a power series.

    -rho I w2 + 2 s rho I W w stands for the inertia against tilting, s = -1 or +1.
    """
    rho, E, G = STEEL.density, STEEL.E, STEEL.G
    area, second = ROUND.area, ROUND.second_moment
    kappa, b = shear_coefficient(ROUND, STEEL.poisson), order * math.pi / 1.0

    def matrix(w: float, sense: float) -> float:
        shear = kappa * G * area
        tilting = E * second * b * b + shear - rho * second * (w * w - 2.0 * sense * speed * w)
        return (shear * b * b - rho * area * w * w) * tilting - (shear * b) ** 2

    guess = b * b * math.sqrt(E * second / (rho * area))
    roots = []
    for sense in (-1.0, 1.0):
        low, high = 0.5 * guess, 1.2 * guess
        roots.append(scipy.optimize.brentq(matrix, low, high, args=(sense,)) / (2.0 * math.pi))
    return min(roots), max(roots)


def test_frequencies_of_a_simply_supported_shaft():
    """32 elements: the error of a cubic element falls with its fourth power."""
    exact = [exact_frequencies(order)[0] for order in (1, 2, 3, 4)]
    assert exact[0] == pytest.approx(101.75, abs=1e-4)
    np.testing.assert_allclose(pinned_frequencies(1.0 / 32.0)[:4], exact, rtol=5e-4)


def test_a_train_has_the_frequencies_of_the_beam_with_all_its_modes():
    train = turning([pinned_beam(highest_frequency=1e6, longest_element=0.125)], pins(), 0.0)
    found = [one for one in train.modes()[0] if one > 1.0]
    bending = [101.7546, 403.6719, 897.6792, 1575.767]  # of eight elements, both planes
    for frequency in bending:
        both = [one for one in found if abs(one / frequency - 1.0) < 3e-5]
        assert len(both) == 2


@pytest.mark.parametrize(("limit", "error"), [(1e4, 1e-5), (4e3, 1e-4)])
def test_few_modes_and_the_remaining_flexibility_are_enough(limit: float, error: float):
    """On supports without any give, where modes of the free shaft converge slowest."""
    few = turning([pinned_beam(highest_frequency=limit)], pins(), 0.0).modes()[0]
    whole = pinned_frequencies(0.25 * ROUND.outer_diameter)
    below = whole[whole < 1000.0]
    assert below.size == 3
    for frequency in below:  # both planes
        assert np.count_nonzero(abs(few / frequency - 1.0) < error) == 2


@pytest.mark.parametrize("limit", [1e6, 1e4, 500.0])
def test_static_deflection_under_a_load_does_not_depend_on_the_modes_kept(limit: float):
    """At midspan: L3 / 48 E I + L / 4 kappa G A, for any limit: the flexibility is complete."""
    kappa = shear_coefficient(ROUND, STEEL.poisson)
    exact = 1.0 / (48.0 * STEEL.E * ROUND.second_moment)
    exact += 1.0 / (4.0 * kappa * STEEL.G * ROUND.area)
    assert exact == pytest.approx(3.2359907e-7, rel=1e-7)
    own = pinned_beam(highest_frequency=limit).motion()
    # deflections at the nodes over: translation, tilt, modal coordinates
    shapes = np.vstack([np.ones(3), own.arms, own.bending.deflection])
    stiffness = np.diag([0.0, 0.0, *own.bending.stiffness])
    for pin in (0, 2):
        stiffness += 1e16 * np.outer(shapes[:, pin], shapes[:, pin])
    found = shapes[:, 1] @ np.linalg.solve(stiffness, shapes[:, 1])
    assert found == pytest.approx(
        exact, rel=1e-3
    )  # shapes that give less than 1e-3 of it are left out


@pytest.mark.parametrize("rpm", [10_000.0, 40_000.0])
def test_gyroscopic_moments_split_forward_and_backward_whirl(rpm: float):
    speed = rpm * math.pi / 30.0
    train = turning([pinned_beam(highest_frequency=2e4)], pins(), speed)
    found = whirling(train)
    for order in (1, 2):
        for exact in exact_frequencies(order, speed):
            # modes above the limit and the length of elements leave 2e-4
            assert min(abs(found / exact - 1.0)) < 3e-4


def test_a_disc_on_a_tilting_spring_whirls_as_in_closed_form():
    """w = +-Ip W / 2 Id + sqrt((Ip W / 2 Id)2 + k / Id)."""
    speed, polar, across, stiffness = 1000.0, 0.04, 0.022, 2e5
    disc = ShaftDisc(position=0.0, mass=5.0, inertia=across, polar_inertia=polar)
    stub = ShaftSection(start=-1e-4, end=1e-4, outer_diameter=0.002)
    rotor = Shaft(name="beam", sections=(stub,), discs=(disc,), nodes={"centre": 0.0},
                  highest_frequency=0.0)  # fmt: skip
    held = SpringSupport(name="spring", body="beam.centre", K_xx=1e8, K_yy=1e8, K_zz=1e8,
                         K_ax=stiffness, K_ay=stiffness)  # fmt: skip
    found = whirling(turning([rotor], [held], speed)) * 2.0 * math.pi
    half = 0.5 * polar * speed / across
    root = math.sqrt(half * half + stiffness / across)
    for exact in (root - half, root + half):
        assert min(abs(found / exact - 1.0)) < 1e-6  # differences of the Jacobian


def test_rotor_of_ross_with_two_discs():
    """ROSS prints these of six elements and two discs on soft bearings [rad/s]."""
    sections = tuple(
        ShaftSection(start=0.25 * i, end=0.25 * (i + 1), outer_diameter=0.05) for i in range(6)
    )
    disc = {"mass": 32.58973, "inertia": 0.1780893, "polar_inertia": 0.3295636}
    discs = tuple(ShaftDisc(position=z, **disc) for z in (0.5, 1.0))
    rotor = Shaft(name="beam", sections=sections, discs=discs, nodes={"left": 0.0, "right": 1.5},
                  material=STEEL, highest_frequency=1e6, longest_element=0.25)  # fmt: skip
    bearings = [
        SpringSupport(name=f"at {end}", body=f"beam.{end}", K_xx=1e6, K_yy=8e5, K_zz=1e5)
        for end in ("left", "right")
    ]
    found = 2.0 * math.pi * turning([rotor], bearings, 0.0).modes()[0]
    # the axial one is among them
    for printed in (47.62156, 91.79655, 96.28900, 274.5660, 296.5005, 722.898, 765.000):
        assert min(abs(found / printed - 1.0)) < 2e-6  # seven digits are printed


def test_twist_of_a_shaft_swings_as_a_free_bar():
    """Torsion of a free bar: n / 2 L sqrt(G / rho); at its ends nothing acts."""
    train = turning([pinned_beam(highest_frequency=2e4)], pins(), 0.0)
    exact = math.sqrt(STEEL.G / STEEL.density) / 2.0
    assert min(abs(train.modes()[0] / exact - 1.0)) < 1e-3  # eighty elements, linear ones


def test_energy_of_gears_on_elastic_shafts_balances():
    """The pair of He et al. on two shafts that bend and twist, driven and then braked."""
    ends = {"left": 0.0, "gear": 0.06, "right": 0.12}
    tube = ShaftSection(start=0.0, end=0.12, outer_diameter=0.03)
    blank = ShaftDisc.ring(0.06, 0.08, 0.03, 0.02)
    shafts = [
        Shaft(name=name, sections=(tube,), nodes=ends, discs=(blank,), damping_ratio=0.02)
        for name in ("first", "second")
    ]
    springs = {"K_xx": 2e8, "K_yy": 2e8, "K_zz": 1e8, "c_x": 300.0, "c_z": 100.0}
    elements = [
        *(
            SpringSupport(name=f"{shaft}_{end}", body=f"{shaft}.{end}", **springs)
            for shaft in ("first", "second")
            for end in ("left", "right")
        ),
        HelicalMesh(name="mesh", pinion="first.gear", gear="second.gear", parameters=PAIR),
        HalfShaft(name="coupling", first="second.right", second="wheel", stiffness=1e4),
        Port(name="motor", body="first.left", sign=-1.0),
        Port(name="road", body="wheel"),
    ]
    bodies = [*shafts, Body.spinning("wheel", 0.05)]
    # the error of steps falls with their fourth power or faster: 16 in a period leave 7e-6
    train = Train(bodies, elements, OIL, steps_per_highest_period=32)
    train.initialise({"wheel": 200.0}, {"motor": 100.0, "road": -100.0 * RATIO}, KELVIN)
    found = train.outputs()
    # the middle bends away from its bearings, by the mesh force
    away = [found[f"first.{place}.displacement.x"] for place in ends]
    assert abs(away[1]) > 1.5 * abs(away[0])
    before = train.energy
    for i in range(40):
        train.step(2e-4, {"motor": 150.0 if i < 20 else -50.0, "road": -100.0}, KELVIN)
    passed = abs(train.work) + sum(train.lost.values())
    missing = train.energy - before - train.work + sum(train.lost.values())
    assert passed > 40.0
    assert abs(missing) < 1e-6 * passed


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"sections": ()}, "at least one"),
        ({"nodes": {}}, "at least one place"),
        ({"nodes": {"far": 1.2}}, "node far of beam must lie on the shaft, 0 to 1000 mm"),
        ({"sections": (ROUND, ShaftSection(start=1.1, end=1.2, outer_diameter=0.05))},
         "gap from 1000 to 1100 mm"),
        ({"discs": (ShaftDisc.ring(-0.5, 0.1, 0.05, 0.02),)}, "disc 1 of beam"),
        # it would ask for a matrix of 65 TB
        ({"longest_element": 1e-7}, r"beam must be at most 600, got 1e\+07 of at most 0.0001 mm"),
    ],
)  # fmt: skip
def test_shafts_that_cannot_be_are_refused(change: dict, words: str):
    given = {"sections": (ROUND,), "nodes": {"left": 0.0}} | change
    with pytest.raises(ParameterError, match=words):
        Shaft(name="beam", **given)


def test_a_disc_turns_no_harder_than_a_thin_one():
    with pytest.raises(ParameterError, match=r"at most twice its inertia about a diameter, 0\.02"):
        ShaftDisc(position=0.0, mass=1.0, inertia=0.01, polar_inertia=0.03)
