"""Power, energy and losses of the marching pair, against rigid bodies and matrices."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gearlube_core.dynamics.helical_model import outputs
from gearlube_core.dynamics.helical_model.outputs import (
    DURATION,
    MARKS,
    MOTION_OUTPUTS,
    N_ENERGIES,
    N_INTEGRATED,
    N_STATE,
    SENSES,
    STATE_NAMES,
    STATE_PLACES,
    WORKS,
)
from gearlube_core.dynamics.helical_model.pair import BEARING_FIELDS, N_BEARINGS
from gearlube_core.dynamics.helical_pair.march import flanks, pair_forces
from gearlube_core.dynamics.helical_pair.march.flanks import FlankConstants
from gearlube_core.dynamics.helical_pair.march.line_sums import LineSums
from gearlube_core.dynamics.helical_pair.mesh.mesh_wrench import Wrench
from gearlube_core.helical_geometry.contact_line import ContactPlane
from tests.helpers.pair_motions import (
    N_MOTION,
    OM_G,
    OM_P,
    PSI,
    TH_P,
    U_G,
    U_P,
    V_G,
    V_P,
    W_G,
    W_P,
    pair_motion,
)
from tests.helpers.source_of import interpret

PLANE = ContactPlane(
    A=0.004, D=0.021, P=0.011, W=0.03, x_g=0.026, pitch=0.009, sin_b=math.sin(0.35),
    cos_b=math.cos(0.35), r_bp=0.028, r_bg=0.041,
)  # fmt: skip
FLANKS = FlankConstants(
    plane=PLANE, damping=0.0, backlash=8e-5, coast_phase=3.7, turn_cos=math.cos(1.2),
    turn_sin=math.sin(1.2), line_work=0.0, lines=0.0, phases=0.0, stations=0.0,
)  # fmt: skip
RNG = np.random.default_rng(11)
STATE = RNG.normal(size=N_MOTION)


@pytest.fixture(autouse=True)
def uncompiled(monkeypatch):
    interpret(monkeypatch, pair_forces, flanks, outputs)


def power(w: Wrench, s: np.ndarray) -> float:
    """Return the power of the mesh on both gears; the pinion turns forward about -z [W]."""
    force = np.array([w.F_x, w.F_y, w.F_z])
    total = force @ (s[V_P : V_P + 3] - s[V_G : V_G + 3])
    total += np.array([w.M_px, w.M_py, w.M_pz]) @ (s[OM_P], s[OM_P + 1], -s[W_P])
    total += np.array([w.M_gx, w.M_gy, w.M_gz]) @ (s[OM_G], s[OM_G + 1], s[W_G])
    return float(total)


@pytest.mark.parametrize("direction", [1.0, -0.4])
def test_heat_of_friction_is_the_power_that_its_forces_take(direction: float):
    sums = LineSums(*np.zeros(11))._replace(F=31.0, Fx=0.4, Fz=-0.2)
    wrench = pair_forces.flank_wrench(sums, direction, PLANE)
    found = pair_forces.friction_heat(sums, direction, pair_motion(STATE), FLANKS)
    assert found == pytest.approx(-power(wrench, STATE), rel=1e-12)
    turned = pair_forces.turned_wrench(wrench, FLANKS)
    found = pair_forces.turned_friction_heat(sums, direction, pair_motion(STATE), FLANKS)
    assert found == pytest.approx(-power(turned, STATE), rel=1e-12)


def test_forces_of_the_loads_do_the_work_of_their_compression():
    # normal loads at (x, z): what they do is the load times the rate of closing
    x, z, load = 0.013, -0.004, 250.0
    sums = LineSums(*np.zeros(11))._replace(N=load, Nx=load * x, Nz=load * z)
    wrench = pair_forces.flank_wrench(sums, 1.0, PLANE)
    s = STATE
    normal = np.array([PLANE.cos_b, 0.0, -PLANE.sin_b])
    pinion = s[V_P : V_P + 3] + np.cross([s[OM_P], s[OM_P + 1], -s[W_P]], [x, PLANE.r_bp, z])
    arm = [x - PLANE.x_g, -PLANE.r_bg, z]
    gear = s[V_G : V_G + 3] + np.cross([s[OM_G], s[OM_G + 1], s[W_G]], arm)
    assert power(wrench, s) == pytest.approx(-load * normal @ (pinion - gear), rel=1e-12)


def of_train(s: np.ndarray) -> np.ndarray:
    """State of the pair's train with these continuous states."""
    made = np.zeros(N_STATE)
    made[STATE_PLACES] = SENSES * s
    return made


def motion_outputs(s: np.ndarray, rates: np.ndarray, bearings: np.ndarray) -> dict[str, float]:
    out = np.full(len(outputs.OUTPUT_NAMES), np.nan)
    outputs.write_motion(s, rates, 23.0, bearings, out)
    written = dict(zip(outputs.OUTPUT_NAMES, out, strict=True))
    assert {name for name, value in written.items() if not math.isnan(value)} == set(MOTION_OUTPUTS)
    return written


def test_motion_and_bearing_forces_are_told():
    bearings = RNG.normal(size=N_BEARINGS * BEARING_FIELDS)
    s = STATE
    found = motion_outputs(of_train(s), np.zeros(N_INTEGRATED), bearings)
    assert found["mesh.dte"] == pytest.approx(s[PSI] + s[U_P] - s[U_G])
    assert found["mesh.frequency"] == pytest.approx(23.0 * s[W_P] / (2.0 * math.pi))
    for name, value in zip(STATE_NAMES, s, strict=True):
        assert found[name] == value
    assert found["pinion.displacement.x"] == s[U_P]
    assert found["pinion.tilt.x"] == s[TH_P]
    for j, one in enumerate(bearings.reshape(N_BEARINGS, BEARING_FIELDS)):
        u, v = (U_P, V_P) if j < 2 else (U_G, V_G)
        stiffness = np.zeros((3, 5))
        stiffness[0, [0, 4]], stiffness[1, [1, 3]], stiffness[2, 2] = one[:2], one[2:4], one[4]
        force = -(stiffness @ s[u : u + 5] + one[5:] * s[v : v + 3])
        told = [found[f"bearing[{j + 1}].force.{axis}"] for axis in "xyz"]
        assert told == pytest.approx(force)


@pytest.mark.parametrize("duration", [0.0, 0.004])
def test_losses_are_mean_powers_of_a_step_and_efficiency_is_of_the_side_that_drives(duration):
    def found(works: list[float], mark: float = 0.4) -> dict[str, float]:
        s, rates = of_train(STATE), RNG.normal(size=N_INTEGRATED)
        s[DURATION], s[MARKS : MARKS + N_ENERGIES] = duration, mark
        powers = np.array(works) * [1.0, -1.0, 1.0, 1.0, 1.0]  # ports count what is put in
        if duration > 0.0:
            s[WORKS : WORKS + N_ENERGIES] = mark + powers * duration
        else:
            rates[WORKS : WORKS + N_ENERGIES] = powers
        return motion_outputs(s, rates, np.zeros(N_BEARINGS * BEARING_FIELDS))

    driven = found([100.0, -90.0, 5.0, 3.0, 2.0])
    losses = [driven[f"{one}.power_loss"] for one in ("friction", "damping", "bearing")]
    assert losses == pytest.approx([5.0, 3.0, 2.0])
    assert driven["efficiency"] == pytest.approx(0.95)
    assert driven["pair.efficiency"] == pytest.approx(0.9)
    coasting = found([-80.0, -100.0, 5.0, 3.0, 2.0])
    assert coasting["efficiency"] == pytest.approx(0.95)
    # the wheel's work is counted as it leaves the pair
    assert coasting["pair.efficiency"] == pytest.approx(0.9)
    # work of a picojoule in the step; before the first step, of a second
    least = 1e-12 / duration if duration > 0.0 else 1e-12
    for share, told in ((0.95, 0.0), (1.05, 1.0)):
        idle = found([share * least, 0.0, 0.0, 0.0, 0.0], mark=0.0)
        assert (idle["efficiency"], idle["pair.efficiency"]) == (told, told)
