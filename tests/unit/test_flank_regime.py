"""Place of a flank on the traction map, from the numbers of its state by hand."""

import math

import pytest

from gearlube_core.friction import traction_regime as module
from gearlube_core.friction.thermal_eyring_data import ThermalEyringOil, ThermalFlankState
from gearlube_core.friction.traction_regime import EYRING, NEWTONIAN, PLASTIC
from tests.helpers.source_of import interpret, source_of

OIL = ThermalEyringOil(7.0, 360.0, 1.1, 0.55, 2.5e6, 0.0, 0.1, 0.14)
STATE = ThermalFlankState(
    4e-7, 1.1, 6e8, 0.03, 2.0, 9e6, 2e7, 40.0, 30.0, 12.0, 1e-7, 1e-9, 3.0, 20.0, 2.0, 0.05, -1.7,
    5.3, 0.0,
)  # fmt: skip
GLASS, BARUS = 138.0, 9.67  # K, of the law of Houpert


def place(state=STATE, limiting=1e9, modulus=1e8):
    return source_of(module.flank_regime)(state, OIL, limiting, modulus, 2.5e-4)


def test_flank_stands_where_its_film_at_the_surfaces_temperature_does(monkeypatch):
    interpret(monkeypatch, module)
    found = place()
    hot = 360.0 + 12.0  # the surfaces, not the oil
    inlet = 7.0 * ((hot - GLASS) / (360.0 - GLASS)) ** -1.1
    pressed = inlet * (1.0 + 5.1e-9 * 6e8) ** 0.55
    beta = 1.1 * pressed / (hot - GLASS)
    assert found.pressure_number == pytest.approx(pressed - inlet, rel=1e-9)
    film = math.log(2.0 * 0.14 / (beta * (2.5e6 * 4e-7) ** 2)) + inlet - BARUS
    assert found.film_number == pytest.approx(film, rel=1e-9)
    eta = math.exp(pressed - BARUS)
    newtonian = eta * 1.7 / (2.5e6 * 4e-7)
    assert found.slip_number == pytest.approx(newtonian, rel=1e-9)
    # heat takes what the isothermal film would have beyond 9 MPa
    loss = 1.0 - 9e6 / 2.5e6 / math.asinh(newtonian)
    assert found.thermal_loss == pytest.approx(loss, rel=1e-9)
    assert found.thermal == (1.0 if loss > 0.1 else 0.0)
    assert found.deborah_number == pytest.approx(eta * 5.3 / (1e8 * 2.5e-4), rel=1e-9)
    s = found.largest_stress_ratio
    # s sinh s = 4 X*^2 exp(L), X*^2 = 0.4392
    L = found.pressure_number + found.film_number
    assert s * math.sinh(s) == pytest.approx(4.0 * 0.43922884 * math.exp(L), rel=1e-7)
    assert (found.limit, found.state) == (EYRING, EYRING)


def test_film_yields_where_it_reaches_the_limiting_stress(monkeypatch):
    interpret(monkeypatch, module)
    largest = place().largest_stress_ratio * 2.5e6
    assert (place(limiting=1.001 * largest).limit, place(limiting=0.999 * largest).limit) == (
        EYRING,
        PLASTIC,
    )
    assert (place(limiting=8.99e6).state, place(limiting=9.01e6).state) == (PLASTIC, EYRING)


@pytest.mark.parametrize(("slip", "state"), [(1e-6, NEWTONIAN), (1.7, EYRING), (0.0, NEWTONIAN)])
def test_slow_sliding_leaves_a_film_newtonian(monkeypatch, slip, state):
    interpret(monkeypatch, module)
    found = place(STATE._replace(sliding_speed=slip, shear_stress=1e3))
    assert found.state == state
    assert found.limit == EYRING
    if slip == 0.0:
        assert found.thermal_loss == found.thermal == 0.0
