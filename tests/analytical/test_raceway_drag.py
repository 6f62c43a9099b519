"""Drag of the raceways under the load of each roller, alone and in the axle."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from gearlube_core.bearings.bearing_type import ShaftMotion
from gearlube_core.bearings.losses.laws import (
    AIHARA_HEATING,
    ROLLING_LAWS,
    ZHU_CHENG_HEATING,
    heating_factor,
    rolling_force,
)
from gearlube_core.bearings.parameters import ROLLERS_MAX
from gearlube_core.bearings.raceway_drag import raceway_drag
from gearlube_core.bearings.roller_loads import roller_loads
from gearlube_core.bearings.tapered_roller_bearing import TaperedRollerBearing
from gearlube_core.dynamics.hypoid_axle.losses import LOSS_SOURCES, axle_losses
from gearlube_core.dynamics.hypoid_axle.model import HypoidAxle
from gearlube_core.dynamics.hypoid_axle.mohammadpour_2015 import mohammadpour_2015_axle
from gearlube_core.dynamics.hypoid_axle.state import gear_motion, pinion_motion
from gearlube_core.oil.lubricant import Lubricant
from gearlube_core.oil.lubricant_state import lubricant_state
from tests.helpers.each import each

PRELOAD, SPEED, OIL_TEMPERATURE = 3000.0, 180.0, 343.15
OIL = lubricant_state(Lubricant.named("mohammadpour_2015").parameters(), OIL_TEMPERATURE)
LAWS_OF_AXLE = ("zhou_hoeprich_1991", "biboulet_houpert_2010", "aihara_1987")


def bearing(film="off"):
    return TaperedRollerBearing.mohammadpour_2015(film=film).with_preload(PRELOAD)


def motion(r1=0.0, r2=0.0, axial=0.0, cage=0.0, speed=SPEED):
    return ShaftMotion(r1, r2, axial, 0.0, 0.0, 0.0, cage, speed)


def lines(made):
    """Radii of both lines: the roller against a cone of the race, and mean speed over speed."""
    r = 0.5 * made.roller_diameter
    inner, outer = 0.5 * made.inner_race_diameter, 0.5 * made.outer_race_diameter
    cos = math.cos(made.contact_angle)
    radii = 1.0 / (1.0 / r + cos / inner), 1.0 / (1.0 / r - cos / outer)
    return radii, inner * outer / (inner + outer)


def test_preloaded_rollers_give_the_printed_sum():
    """Zhou and Hoeprich with the heating of Zhu and Cheng, all 24 rollers under the same load."""
    made = bearing()
    radii, arm = lines(made)
    u = arm * SPEED
    modulus = made.parameters().reduced_modulus
    q = PRELOAD / (12 * math.sin(made.contact_angle)) / made.roller_length
    heat = OIL.eta0 * OIL.beta * u**2 / OIL.conductivity
    expected = 0.0
    for R in radii:
        W, GU = q / (modulus * R), OIL.alpha * OIL.eta0 * u / R
        cold = 29.2 * R / OIL.alpha * GU**0.648 * W**0.246
        pressure = math.sqrt(q * modulus / (2.0 * math.pi * R)) / modulus
        factor = (1.0 - 13.2 * pressure * heat**0.42) / (1.0 + 0.213 * heat**0.64)
        expected += 24 * 2.0 * cold * factor * arm * made.roller_length
    found = raceway_drag(motion(), ROLLING_LAWS["zhou_hoeprich"], OIL, made.parameters())
    # the kernels' ninth root: 1e-9
    assert found == pytest.approx(expected, rel=1e-7)


@each("film", ["off", "steady"])
@each("law", ["zhou_hoeprich", "biboulet_houpert", "aihara"])
def test_every_roller_counts_with_its_own_load(law, film):
    made = bearing(film)
    p = made.parameters()._replace(loss=0.0, cage_ratio=0.0)  # rollers at rest: no rates
    # 60 um: rollers of the far side carry nothing
    at = motion(r1=50e-6, r2=-30e-6, axial=8e-6, cage=0.3)
    radii, arm = lines(made)
    u = arm * SPEED
    heat = OIL.eta0 * OIL.beta * u**2 / OIL.conductivity
    heating = ZHU_CHENG_HEATING if law == "zhou_hoeprich" else AIHARA_HEATING
    loads = np.zeros(ROLLERS_MAX)
    expected, idle = 0.0, 0
    for side in (1.0, -1.0):
        assert roller_loads(at, 1e3, OIL.eta0, OIL.alpha, p, side, loads) == 0
        idle += int(np.sum(loads[:12] == 0.0))
        for q in loads[:12] / made.roller_length:
            for R in radii if q > 0.0 else ():
                force, _ = rolling_force(
                    ROLLING_LAWS[law], R, q, p.reduced_modulus, OIL.eta0, OIL.alpha, u
                )
                pressure = math.sqrt(q / (2.0 * math.pi * R * p.reduced_modulus))
                force *= heating_factor(heating, heat, pressure)
                expected += 2.0 * force * arm * made.roller_length
    assert 0 < idle < 24
    assert raceway_drag(at, ROLLING_LAWS[law], OIL, p) == pytest.approx(expected, rel=1e-9)


def test_the_torque_opposes_either_way_and_ends_at_rest():
    p = bearing("squeeze").parameters()
    for law in ROLLING_LAWS.values():
        forward = raceway_drag(motion(), law, OIL, p)
        assert forward > 0.0
        assert raceway_drag(motion(speed=-SPEED), law, OIL, p) == -forward
        assert raceway_drag(motion(speed=0.0), law, OIL, p) == 0.0
        # fused multiply-add and libm round differently
        assert raceway_drag.py_func(motion(), law, OIL, p) == pytest.approx(forward, rel=1e-12)


def axle_with_drag(law, film="squeeze"):
    base = mohammadpour_2015_axle()
    return replace(base, bearing=replace(base.bearing, film=film), bearing_torque_loss=law)


def drag_powers(axle, torques, speed=SPEED):
    found = axle_losses(
        axle,
        torques=np.array(torques),
        speeds=np.array([speed]),
        temperatures=np.array([OIL_TEMPERATURE]),
        extremes=False,
    )
    return found.power[0, 0, :, LOSS_SOURCES.index("bearing_torque")]


def idle_rollers(torque):
    """Rollers without load on both shafts at rest under a torque."""
    axle = HypoidAxle(axle_with_drag("palmgren"))
    axle.initialise(
        pinion_speed=SPEED,
        pinion_torque=torque,
        wheel_torque=torque * axle.parameters.mesh.ratio,
        oil_temperature=OIL_TEMPERATURE,
    )
    s, p = axle.get_state(), axle.kernel_parameters
    loads, idle = np.zeros(ROLLERS_MAX), 0
    for moved, made in ((pinion_motion(s), p.bearing_p), (gear_motion(s), p.bearing_g)):
        for side in (1.0, -1.0):
            roller_loads(moved, 1e3, OIL.eta0, OIL.alpha, made, side, loads)
            idle += int(np.sum(loads[:12] == 0.0))
    return idle


def test_drag_of_raceways_falls_as_the_axle_takes_rollers_out_of_contact():
    """Rolling hardly depends on the load, so the rollers in contact count; not for Palmgren."""
    assert idle_rollers(5.0) == 0
    share = 1.0 - idle_rollers(300.0) / 48.0
    assert share < 0.9
    fixed = drag_powers(axle_with_drag("palmgren"), [5.0, 300.0])
    assert fixed[1] == pytest.approx(fixed[0], rel=1e-3)  # the gear's speed swings by 1e-4
    powers = {law: drag_powers(axle_with_drag(law), [5.0, 300.0]) for law in LAWS_OF_AXLE}
    for light, heavy in powers.values():
        # those that stay carry more, and the shafts have different speeds
        assert share - 0.2 < heavy / light < 1.0
    # three laws, not one
    assert len({round(float(power[0]), 3) for power in powers.values()}) == 3


@each(
    ("law", "step"),
    [
        ("aihara_1987", 1e-4),
        ("aihara_1987", 2e-3),
        ("palmgren_loaded", 2e-3),
        ("skf_2013", 2e-3),
    ],
)
def test_energy_is_kept_and_a_long_step_keeps_the_drag_of_short_ones(law, step):
    """The drag is again with the bearing forces, so that its power does not depend on the step."""
    # roller films breathe with the shaft speed without a counter-torque: off here
    made = axle_with_drag(law, film="off")
    axle = HypoidAxle(made)
    axle.initialise(
        pinion_speed=SPEED, pinion_torque=60.0, wheel_torque=150.0, oil_temperature=OIL_TEMPERATURE
    )
    names = [f"energy.{name}" for name in LOSS_SOURCES]
    every = [*names, "energy.pinion_work", "energy.wheel_work", "energy.stored"]

    def after(duration):
        for _ in range(round(duration / step)):
            axle.step(step, 60.0, 150.0, OIL_TEMPERATURE)
        return np.array([axle.output(name) for name in every])

    before = after(0.05)  # the load level of the mesh data follows the torque in the first 20 ms
    angle = axle.output("pinion.angle")
    *lost, put_in, taken_out, stored = after(0.05) - before
    assert put_in == pytest.approx(taken_out + stored + sum(lost), abs=1e-6 * put_in)
    drag = dict(zip(names, lost, strict=True))["energy.bearing_torque"]
    speed = (axle.output("pinion.angle") - angle) / 0.05
    # the drag of a steady axle at the mean speed; loads swing about theirs
    assert drag / 0.05 == pytest.approx(drag_powers(made, [60.0], speed)[0], rel=0.01)
