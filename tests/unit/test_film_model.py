"""The surrogate of solved films: kernel, groups, domain, file."""

from __future__ import annotations

import json
import math

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq

from gearlube_core.contact.hertz import ellipticity, hertz_coefficients
from gearlube_core.contact.solid import STEEL_MOHAMMADPOUR_2015, solid_parameters
from gearlube_core.errors import FileError
from gearlube_core.film_model import net
from gearlube_core.film_model.groups import (
    FilmContact,
    FilmGroups,
    contact_groups,
    contact_parts,
    film_contact,
)
from gearlube_core.film_model.inlet import model_inlet, oil_under
from gearlube_core.film_model.model import FilmModel
from gearlube_core.film_model.reference_friction import reference_friction
from gearlube_core.film_model.solved_film import solved_film
from gearlube_core.oil.film_oil import viscosity, viscosity_cooling
from gearlube_core.oil.film_oil_data import film_oil, film_oil_of
from gearlube_core.oil.lubricant import Lubricant
from gearlube_core.oil.pressure_coefficients import pressure_coefficient

SOLID = solid_parameters(STEEL_MOHAMMADPOUR_2015, STEEL_MOHAMMADPOUR_2015)
E_STAR = 210e9 / (2.0 * (1.0 - 0.3**2))


def contact(**changes: float) -> FilmContact:
    """A contact in the middle of the domain: 1 kN, 50 degC, 3 m/s."""
    R_x, R_y = 0.02, 1.4
    one = FilmContact(
        load=1000.0,
        contact_modulus=E_STAR,
        R_x=R_x,
        R_y=R_y,
        ellipticity=ellipticity(R_y / R_x),
        pressure_coefficient=hertz_coefficients(R_x, R_y, E_STAR)[2],
        entrainment_speed=3.0,
        entrainment_angle=math.radians(48.0),
        sliding_speed=2.0,
        sliding_angle=math.radians(15.0),
        eta0=0.03,
        alpha=1.8e-8,
        beta=0.031,
        tau0=3e6,
        limiting_stress=0.0,
        limiting_slope=0.0,
        temperature=343.15,
        conductivity=0.13,
        heat_capacity=1.74e6,
        solid_conductivity=46.0,
        solid_heat_capacity=7850.0 * 470.0,
    )
    return one._replace(**changes)


def chittenden_film() -> float:
    """Of that contact, with u cos(psi) along the minor axis; side flow is 1 at R_y/R_x = 70.

    Times Murch and Wilson's factor of the heat at the inlet.
    """
    E = 2.0 * E_STAR
    U = 0.03 * 3.0 * math.cos(math.radians(48.0)) / (E * 0.02)
    heat = 0.031 * 0.03 * 9.0 / 0.13
    cold = 4.31 * 0.02 * U**0.68 * (film_alpha() * E) ** 0.49 * (1000.0 / (E * 0.02**2)) ** -0.073
    return cold * 3.94 / (3.94 + heat**0.62)


def film_alpha() -> float:
    """Of that oil: what films respond to, [integral of eta0/eta over p]^-1 [1/Pa]."""
    log_ratio = math.log(0.03 / 63.15e-6)
    Z = 1.8e-8 / (5.1e-9 * log_ratio)

    def thin(p_gpa: float) -> float:
        return math.exp(-log_ratio * ((1.0 + 5.1 * p_gpa) ** Z - 1.0))

    return 1e-9 / float(quad(thin, 0.0, 5.0, epsrel=1e-9)[0])


def heated_stress(one: FilmContact, film: float, p: float, resistance: float) -> float:
    """Stress of an Eyring film heated by itself at one pressure, by bisection [Pa]."""
    log_ratio = math.log(one.eta0 / 63.15e-6)
    growth = (1.0 + 5.1e-9 * p) ** (one.alpha / (5.1e-9 * log_ratio))
    rate = one.sliding_speed / (film * one.tau0)

    def excess(stress: float) -> float:
        rise = stress * one.sliding_speed * resistance
        eta = 63.15e-6 * math.exp(log_ratio * growth / (1.0 + one.beta * rise / log_ratio))
        return stress - one.tau0 * math.asinh(eta * rate)

    return float(brentq(excess, 0.0, 1e9))


@pytest.fixture(scope="module")
def model() -> FilmModel:
    return FilmModel.named("hypoid_flank")


def test_groups_are_those_of_a_hand_calculation():
    g = contact_groups(contact())
    p = hertz_coefficients(0.02, 1.4, E_STAR)[2] * 10.0
    Z = 1.8e-8 / (5.1e-9 * 6.163440)
    growth, alpha = (1.0 + 5.1e-9 * p) ** Z, film_alpha()
    # by Chittenden's formula, and Hertz's ellipse: W = p pi a_x^2 (a_y/a_x)
    thickness = 0.5 * math.log(chittenden_film() * 0.02 * p * math.pi * ellipticity(70.0) / 1000.0)
    by_hand = FilmGroups(
        pressure=math.log(p / E_STAR),
        ellipse=math.log(ellipticity(70.0)),
        psi=0.837758,
        slide_roll=math.log(2.0 / 3.0),
        delta=0.261799,
        sharpness=math.log(alpha * p) - 2.0 / 3.0 * thickness,
        shape=math.log(6.163440 * (growth - 1.0) / (alpha * p)),  # ln(475.06) = 6.163440
        stress=math.log(3e6 / 1.153846e11),
        limited=0.0,
        rate=math.log(0.03 * 3.0 / (1.153846e11 * 0.02)),
        peclet=math.log(0.06 * 3689500.0 / 46.0),
        cooling=math.log(growth),
        warmth=math.log(0.031 * 343.15),
        conductivity=math.log(0.13 / 46.0),
        capacity=math.log(1.74 / 3.6895),
        heat=math.log(0.031 * 0.03 * 9.0 / 0.13),
        thickness=thickness,
    )
    assert g == pytest.approx(by_hand, abs=2e-6)  # the digits given by hand


def test_a_film_is_the_same_with_axes_or_sliding_turned_round(model):
    oil, limit, solid = (0.03, 1.8e-8, 0.031, 3e6, 0.13, 1.74e6), (0.0, 0.0), (46.0, 3.7e6)

    def film(entrainment: tuple[float, float], sliding: tuple[float, float]) -> float:
        one = film_contact(1e3, E_STAR, 0.02, 1.4, entrainment, sliding, oil, limit, 343.15, solid)
        return solved_film(model.copied_numbers(), one).friction_coefficient

    first = film((2.0, 2.2), (1.0, 1.6))
    for turned in (
        film((2.0, 2.2), (-1.0, -1.6)),
        film((-2.0, 2.2), (-1.0, 1.6)),
        film((2.0, -2.2), (1.0, -1.6)),
        film((-2.0, -2.2), (1.0, 1.6)),
    ):
        assert turned == pytest.approx(first, rel=1e-12)  # rounding


def test_reference_friction_is_the_mean_stress_over_hertz_pressures():
    one = contact()
    film, p = 0.4e-6, one.pressure_coefficient * 10.0
    a_x = math.sqrt(one.load / (math.pi * p * one.ellipticity))
    across = 3.0 * math.cos(one.entrainment_angle)
    surfaces = 0.3665 * math.sqrt(a_x / (46.0 * 7850.0 * 470.0 * across))
    resistance = film / (8.0 * one.conductivity) + surfaces
    lower = p / (1.0 + 0.5 * (film * one.R_x / a_x**2) ** 1.5)  # thick films spread
    # area is even in s = (p'/p_max)^2
    shares = np.sqrt((np.arange(400) + 0.5) / 400)
    stress = [heated_stress(one, film, 1.5 * lower * t, resistance) for t in shares]
    found = reference_friction(film, p, across, 2.0, a_x, one.R_x, contact_parts(one)[1])
    # three points instead of 400: 0.5 %; one Newton step instead of all: as much
    assert found == pytest.approx(float(np.mean(stress)) / lower, rel=0.01)


def test_kernel_agrees_with_a_plain_evaluation(model):
    one, n = contact(), model.copied_numbers()
    w, g = model.blocks, np.array(contact_groups(one))
    x = (g - w["shift"]) * w["scale"]

    def bend(a: np.ndarray) -> np.ndarray:
        return a / np.sqrt(1.0 + a * a)

    hidden = bend(bend(x @ w["first"] + w["first_offset"]) @ w["second"] + w["second_offset"])
    y = w["straight"] @ x + w["last"] @ hidden + w["last_offset"]
    film, p = chittenden_film() * math.exp(y[0]), one.pressure_coefficient * 10.0
    a_x = math.sqrt(one.load / (math.pi * p * one.ellipticity))
    across, inlet = 3.0 * math.cos(one.entrainment_angle), contact_parts(one)[1]
    friction = reference_friction(film, p, across, 2.0, a_x, 0.02, inlet) * math.exp(y[1])
    found = solved_film(n, one)
    assert found.central_film == pytest.approx(film, rel=1e-7)  # ten points of alpha's integral
    assert found.friction_coefficient == pytest.approx(friction, rel=1e-7)
    assert found.outside == 0.0
    assert found[3:] == (model.film_bound, model.friction_bound)
    assert np.array(solved_film.py_func(n, one)) == pytest.approx(np.array(found), rel=1e-12)


def test_outside_is_zero_inside_one_far_outside_and_smooth_between(model):
    n, low = model.copied_numbers(), model.domain["stress"][0]
    width = model.domain["stress"][1] - low

    def outside(place: float) -> float:
        tau0 = E_STAR * math.exp(low + place * width)
        return solved_film(n, contact(tau0=tau0)).outside

    assert outside(0.01) == 0.0
    border = float(model.blocks["border"][0])
    assert outside(-0.5 * border) == pytest.approx(0.5, abs=1e-9)  # half way
    assert outside(-1.01 * border) == 1.0
    places = np.linspace(-1.2 * border, 0.2 * border, 281)
    slopes = np.diff([outside(t) for t in places]) / np.diff(places)
    # a quarter of a step's change in slope 1.5/border, times 8 for its curvature: no kink
    assert np.abs(np.diff(slopes)).max() < 0.06 / border


@pytest.mark.parametrize("name", ["load", "entrainment_speed", "sliding_speed", "tau0", "eta0"])
def test_film_and_friction_are_smooth(model, name):
    n = model.copied_numbers()
    middle = getattr(contact(), name)
    factors = np.exp(np.linspace(-0.19, 0.19, 77))  # inside the domain
    found = [solved_film(n, contact(**{name: middle * f})) for f in factors]
    for values in ([f.central_film for f in found], [f.friction_coefficient for f in found]):
        slopes = np.diff(np.log(values)) / 0.005
        # slopes of logarithms are of order one; between neighbours they may turn by a
        # twentieth of that
        assert np.abs(np.diff(slopes)).max() < 0.05


def test_anything_positive_gives_finite_numbers(model):
    n = model.copied_numbers()
    for changes in (
        {"load": 0.0, "entrainment_speed": 0.0, "sliding_speed": 0.0},
        {"load": 1e-3, "entrainment_speed": 1e-6},
        {"load": 1e9, "sliding_speed": 1e4},
        {"tau0": 1e11, "entrainment_angle": 0.5 * math.pi},
        {"eta0": 1e3, "alpha": 1e-7, "R_x": 1.0},
    ):
        found = solved_film(n, contact(**changes))
        assert np.isfinite(found).all()
        assert found.outside == 1.0


def test_other_solids_and_a_limiting_stress_count_as_outside(model):
    n = model.copied_numbers()
    free = solved_film(n, contact())
    mean_stress = free.friction_coefficient * contact().pressure_coefficient * 10.0
    assert solved_film(n, contact(limiting_stress=2.5 * mean_stress)).outside == 0.0
    assert solved_film(n, contact(limiting_stress=mean_stress)).outside == 1.0
    assert solved_film(n, contact(contact_modulus=1.03 * E_STAR)).outside == 1.0


def test_a_model_survives_its_file(model, tmp_path):
    model.write(tmp_path / "copy.json")
    again = FilmModel.read(tmp_path / "copy.json")
    assert np.array_equal(again.numbers[: net.N_NUMBERS], model.numbers[: net.N_NUMBERS])
    assert again.provenance == model.provenance


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda c: c.update(format="other"), "must have the format"),
        (lambda c: c.update(version=99), "must be of version 2, got 99"),
        (lambda c: c["numbers"].pop("last"), "missing"),
        (lambda c: c["numbers"]["bounds"].append(1.0), "must be of shape"),
        (lambda c: c["numbers"]["first"][0].__setitem__(0, 7.5), "do not belong to its checksum"),
        (lambda c: c["numbers"]["bounds"].__setitem__(0, math.nan), "must be finite"),
        (lambda c: c.pop("provenance"), "is damaged"),
    ],
)
def test_foreign_and_damaged_files_are_refused_in_words(model, tmp_path, change, words):
    path = tmp_path / "model.json"
    model.write(path)
    content = json.loads(path.read_text())
    change(content)
    path.write_text(json.dumps(content))
    with pytest.raises(FileError, match=words):
        FilmModel.read(path)


def test_what_is_no_file_or_no_json_is_refused_in_words(tmp_path):
    (tmp_path / "text.json").write_text("not a model")
    with pytest.raises(FileError, match="must be a film model in JSON"):
        FilmModel.read(tmp_path / "text.json")
    with pytest.raises(FileError, match="was not found in"):
        FilmModel.read(tmp_path / "none.json")
    with pytest.raises(FileError, match=r"must be one of .*hypoid_flank"):
        FilmModel.named("no_such_model")


@pytest.mark.parametrize(
    "name", ["fva_3", "arana_2019_m100", "arana_2019_pao100", "mohammadpour_2015"]
)
def test_the_oil_of_a_model_is_that_of_a_solved_film(name):
    oil = Lubricant.named(name)
    for T in (303.15, 383.15):
        state = oil.state(T)
        inlet = model_inlet(state, SOLID, 0.0)
        law = film_oil(
            eta0=state.eta0,
            alpha=None if state.modulus else state.slope,
            law=film_oil_of(oil, T).viscosity if state.modulus else "houpert",
            temperature=T,
            temperature_exponent=(
                0.0 if state.modulus else state.beta * (T - 138.0) / math.log(state.eta0 / 63.15e-6)
            ),
            eyring_slope=0.05,
        )
        local = inlet._replace(eyring_slope=0.05)
        # ten points of the integral over pressure: 1e-3
        alpha = pressure_coefficient(law.viscosity, "film")
        assert inlet.alpha == pytest.approx(alpha, rel=1e-3)
        for p in (1e8, 1e9):
            under = oil_under(p, local)
            ratio = math.log(viscosity(law, p) / law.eta0)
            assert under.log_ratio == pytest.approx(ratio, rel=1e-9)
            # the law of films takes a difference over 1e-4 of T
            assert under.decline == pytest.approx(viscosity_cooling(law, p, T), rel=1e-6)
            assert under.stress == pytest.approx(2.0 * 0.05 * p / ratio, rel=1e-9)


def test_a_film_at_its_limit_has_the_friction_lambda():
    # 2 GPa, 0 degC: the stress of the cold film is far above Lambda p
    one = contact(modulus=4e7, modulus_slope=0.01, modulus_turn=2e5, slope_turn=2e-4,
                  eyring_slope=0.05, sliding_speed=0.05)  # fmt: skip
    inlet = contact_parts(one)[1]
    found = reference_friction(1e-7, 2e9, 2.0, 0.05, 2e-4, 0.02, inlet)
    assert found == pytest.approx(0.05, rel=0.08)  # the corner at the limit is rounded
    assert found < 0.05
