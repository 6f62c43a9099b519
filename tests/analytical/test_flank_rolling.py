"""Rolling of the flanks: the line that stands for an ellipse, its loss, and the axle's energy."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from gearlube.plotting.words import left_out
from gearlube_core.contact.hertz import hertz_coefficients, hertz_ellipse
from gearlube_core.dynamics.hypoid_axle.losses import LOSS_SOURCES, axle_losses
from gearlube_core.dynamics.hypoid_axle.model import HypoidAxle
from gearlube_core.dynamics.hypoid_axle.mohammadpour_2015 import (
    mohammadpour_2015_axle,
)
from gearlube_core.errors import ParameterError
from gearlube_core.film.biboulet_houpert_2010 import biboulet_houpert_force
from gearlube_core.film.zhu_cheng_1989 import zhu_cheng_heating
from gearlube_core.friction.flank_rolling import (
    RollingGeometry,
    flank_rolling_force,
    rolling_geometry,
)
from gearlube_core.oil.lubricant_state import LubricantState, lubricant_state
from tests.helpers.each import each

MODULUS = 115e9  # E* [Pa]
R_X, LOAD, SPEED = 0.015, 2500.0, 3.0
OIL = LubricantState(0.03, 1.9e-8, 0.04, 3.5e-5, 3e6, 0.0, 0.07, 0.14, 350.0, 1.74e6, 1.9e-8)
COLD = OIL._replace(conductivity=1e12)  # no inlet heating
ROLLING = replace(mohammadpour_2015_axle(), rolling="biboulet_houpert_2010")
PINION_SPEED, OIL_TEMPERATURE = 150.0, 333.15


def line_pressure(length):
    """Mean Hertz pressure of a line contact: pi/4 of p0^2 = q E*/(pi R)."""
    return 0.25 * math.pi * math.sqrt(LOAD / length * MODULUS / (math.pi * R_X))


@each(("R_y", "within"), [(50.0, 1e-3), (1.5, 0.01), (0.5, 0.03)])
def test_the_line_has_the_mean_pressure_of_the_ellipse(R_y, within):
    """Of slender ellipses; of hypoid flanks, with a/b above 8, it stays within a few percent."""
    line = rolling_geometry(R_X, R_y, MODULUS)
    length = line.length_coefficient * LOAD ** (1.0 / 3.0)
    b, a, mean = hertz_ellipse(R_X, R_y, MODULUS, LOAD)
    assert a > 8.0 * b
    assert line_pressure(length) == pytest.approx(mean, rel=within)
    c = hertz_coefficients(R_X, R_y, MODULUS)[2]
    slender = LOAD ** (1.0 / 3.0) * math.pi * 2.0 * MODULUS / (32.0 * c * c * R_X)
    assert length == pytest.approx(slender, rel=2.0 * within)


def test_the_line_rolls_as_the_strips_of_the_ellipse():
    """Strips of line load (pi/2) p0 b (1 - (y/a)^2): all roll, the ends under little load."""
    R_y = 1.5
    b, a, mean = hertz_ellipse(R_X, R_y, MODULUS, LOAD)
    places = (np.arange(2000) + 0.5) / 2000.0
    loads = 0.5 * math.pi * 1.5 * mean * b * (1.0 - places**2)
    # the ellipse carries its load by these strips
    assert 2.0 * a * loads.mean() == pytest.approx(LOAD, rel=1e-6)
    of_strips = [
        biboulet_houpert_force(R_X, q, 2.0 * MODULUS, OIL.eta0, OIL.alpha, SPEED)[0] for q in loads
    ]
    expected = 2.0 * a * float(np.mean(of_strips))
    found = flank_rolling_force(
        LOAD, SPEED, 0.0, rolling_geometry(R_X, R_y, MODULUS), COLD, 2.0 * MODULUS
    )
    # F is all but free of load: strips sum to 2 a of it less their ends, the line has 1.85 a
    assert 3.0 * math.pi**2 / 32.0 < found / expected < 1.0


def test_inlet_heating_lowers_the_force_once_and_sliding_lowers_it_more():
    line = rolling_geometry(R_X, 0.5, MODULUS)
    cold, rolling, sliding = (
        flank_rolling_force(LOAD, SPEED, slip, line, oil, 2.0 * MODULUS)
        for slip, oil in ((0.0, COLD), (0.0, OIL), (6.0, OIL))
    )
    number = OIL.eta0 * OIL.beta * SPEED**2 / OIL.conductivity
    length = line.length_coefficient * LOAD ** (1.0 / 3.0)
    largest = 4.0 / math.pi * line_pressure(length) / (2.0 * MODULUS)
    for found, slip in ((rolling, 0.0), (sliding, 2.0)):
        # COLD keeps 1e-8 of the heating
        assert found / cold == pytest.approx(zhu_cheng_heating(number, largest, slip), rel=1e-6)
    assert sliding < rolling < cold


def test_nothing_rolls_at_rest_or_without_load():
    line = RollingGeometry(R_X, 1e-3)
    assert flank_rolling_force(LOAD, 0.0, 1.0, line, OIL, 2.0 * MODULUS) == 0.0
    assert flank_rolling_force(0.0, SPEED, 1.0, line, OIL, 2.0 * MODULUS) == 0.0


@pytest.mark.parametrize(
    ("kernel", "args"),
    [
        (rolling_geometry, (R_X, 0.5, MODULUS)),
        (flank_rolling_force, (LOAD, SPEED, 4.0, RollingGeometry(R_X, 1e-3), OIL, 2.0 * MODULUS)),
    ],
    ids=lambda x: getattr(x, "__name__", ""),
)
def test_compiled_kernels_agree_with_python(kernel, args):
    # fused multiply-add and libm round differently
    assert kernel(*args) == pytest.approx(kernel.py_func(*args), rel=1e-12)


def mean_loss(axle):
    grid = {
        "torques": np.array([80.0]),
        "speeds": np.array([PINION_SPEED]),
        "temperatures": np.array([OIL_TEMPERATURE]),
    }
    found = axle_losses(axle, **grid, extremes=False)
    power = dict(zip(LOSS_SOURCES, found.power[0, 0, 0], strict=True))
    return power["friction_rolling"], float(found.carried[0, 0, 0])


def test_the_axle_loses_two_forces_times_the_speed_across_each_line():
    """Nodes of the mesh table at its own torque, pair by pair, each with its raw numbers."""
    lost, carried = mean_loss(ROLLING)
    assert mean_loss(mohammadpour_2015_axle())[0] == 0.0
    table, data = ROLLING.mesh, ROLLING.mesh.windows
    level = int(np.argmin(np.abs(table.torque - carried)))
    lubricant = ROLLING.oil
    nu = lubricant.dynamic_viscosity(OIL_TEMPERATURE)
    shares = data["share"][level]
    force = carried / table.mean("R_p", carried)
    spacing = shares.size / np.sum(shares)  # nodes over one mesh period
    oil = HypoidAxle(ROLLING).kernel_parameters.oil
    state = lubricant_state(oil, OIL_TEMPERATURE)
    assert state.eta0 == pytest.approx(nu, rel=1e-9)
    power = []
    for node, share in enumerate(shares):
        if share <= 0.0:
            power.append(0.0)
            continue
        R_x, R_y = data["R_x"][level, node], data["R_y"][level, node]
        speed = abs(
            data["entrainment_arm"][level, node] * PINION_SPEED * math.cos(data["psi"][level, node])
        )
        slide = abs(
            data["friction_arm_p"][level, node] * PINION_SPEED
            - data["friction_arm_g"][level, node] * PINION_SPEED / table.ratio
        )
        F = flank_rolling_force(
            force * share, speed, slide, rolling_geometry(R_x, R_y, MODULUS), state, 2.0 * MODULUS
        )
        power.append(2.0 * F * speed)
    # the level is not the torque: load^(1/3) and the data's change from level to level, 3 %
    assert lost == pytest.approx(sum(power) / shares.size * spacing, rel=0.03)


def test_energy_is_kept_with_rolling():
    """Work put in less taken out is stored or lost, to the integrator's error."""
    # roller films breathe with the shaft speed without a counter-torque: off here
    axle = HypoidAxle(replace(ROLLING, bearing=replace(ROLLING.bearing, film="off")))
    axle.initialise(
        pinion_speed=PINION_SPEED, pinion_torque=60.0, wheel_torque=150.0,
        oil_temperature=OIL_TEMPERATURE,
    )  # fmt: skip
    names = [f"energy.{name}" for name in LOSS_SOURCES]
    every = [*names, "energy.pinion_work", "energy.wheel_work", "energy.stored"]

    def after(steps):
        for _ in range(steps):
            axle.step(1e-3, 60.0, 150.0, OIL_TEMPERATURE)
        return np.array([axle.output(name) for name in every])

    before = after(50)  # the load level of the mesh data follows the torque in the first 20 ms
    *lost, put_in, taken_out, stored = after(50) - before
    rolled = dict(zip(names, lost, strict=True))["energy.friction_rolling"]
    # 200 times the tolerance: the balance would miss it
    assert rolled > 2e-4 * put_in
    assert put_in == pytest.approx(taken_out + stored + sum(lost), abs=1e-6 * put_in)
    before = axle.output("energy.friction_rolling")
    axle.step(1e-3, 60.0, 150.0, OIL_TEMPERATURE)
    rise = axle.output("energy.friction_rolling") - before
    # roundings of an energy of 1 J
    assert axle.output("friction.power_loss_rolling") == pytest.approx(rise / 1e-3, rel=1e-9)


def test_what_is_left_out_is_said_and_a_wrong_law_is_named():
    assert "rolling of the flanks" in left_out(mohammadpour_2015_axle())
    assert "rolling of the flanks" not in left_out(ROLLING)
    with pytest.raises(ParameterError, match="biboulet_houpert_2010"):
        replace(mohammadpour_2015_axle(), rolling="biboulet")
