"""Power, energy and losses of the marching pair, against rigid bodies and matrices."""

from __future__ import annotations

import math
from types import SimpleNamespace

import numpy as np
import pytest

from gearlube_core.dynamics.helical_pair.march import flanks, outputs, pair_forces
from gearlube_core.dynamics.helical_pair.march.flanks import (
    FLANK_POINTS,
    FlankConstants,
    SupportConstants,
)
from gearlube_core.dynamics.helical_pair.march.given_pair import BEARING_FIELDS, N_BEARINGS
from gearlube_core.dynamics.helical_pair.march.jumps import LOAD_FILTER_TIME
from gearlube_core.dynamics.helical_pair.march.line_sums import LineSums
from gearlube_core.dynamics.helical_pair.march.outputs import MOTION_OUTPUTS
from gearlube_core.dynamics.helical_pair.march.state import (
    LOAD_TORQUE,
    MU,
    N_ENERGIES,
    N_ODE,
    N_STATE,
    OM_G,
    OM_P,
    PHI_G,
    PHI_P,
    PINION_WORK,
    PSI,
    TH_P,
    TIME_IN_STEP,
    U_G,
    U_P,
    V_G,
    V_P,
    W_G,
    W_P,
    WORK_MARK,
    pair_motion,
)
from gearlube_core.dynamics.helical_pair.mesh.mesh_wrench import Wrench
from gearlube_core.helical_geometry.contact_line import ContactPlane
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
STATE = RNG.normal(size=N_STATE)


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


@pytest.mark.parametrize("held", [False, True])
def test_energy_of_a_member_is_that_of_its_matrices(held: bool):
    values = RNG.uniform(1.0, 2.0, len(SupportConstants._fields))
    k = SupportConstants(*values)
    if held:
        k = k._replace(mobility_a=0.0)
    stiffness = np.diag([k.K_xx, k.K_yy, k.K_zz, k.K_ax, k.K_ay])
    stiffness[0, 4] = stiffness[4, 0] = k.K_x_ay
    stiffness[1, 3] = stiffness[3, 1] = k.K_y_ax
    tilting = 0.0 if held else 1.0 / k.mobility_a
    mass = np.diag([1.0 / k.mobility] * 3 + [tilting] * 2)
    for u, v in ((U_P, V_P), (U_G, V_G)):
        q, rate = STATE[u : u + 5], STATE[v : v + 5]
        expected = 0.5 * (q @ stiffness @ q + rate @ mass @ rate)
        assert outputs.member_energy(STATE, u, v, k) == pytest.approx(expected)


def motion_outputs(s: np.ndarray, rates: np.ndarray, bearings: np.ndarray) -> dict[str, float]:
    out = np.full(len(outputs.OUTPUT_NAMES), np.nan)
    outputs.write_motion(s, rates, 23.0, bearings, out)
    written = dict(zip(outputs.OUTPUT_NAMES, out, strict=True))
    assert {name for name, value in written.items() if not math.isnan(value)} == set(MOTION_OUTPUTS)
    return written


def test_motion_and_bearing_forces_are_told():
    bearings = RNG.normal(size=N_BEARINGS * BEARING_FIELDS)
    found = motion_outputs(STATE, np.zeros(N_ODE), bearings)
    s = STATE
    assert found["mesh.dte"] == pytest.approx(s[PSI] + s[U_P] - s[U_G])
    assert found["mesh.frequency"] == pytest.approx(23.0 * s[W_P] / (2.0 * math.pi))
    names = ("PINION_ANGLE", "WHEEL_ANGLE", "PINION_SPEED", "WHEEL_SPEED")
    for name, place in zip(names, (PHI_P, PHI_G, W_P, W_G), strict=True):
        assert found[outputs.OUTPUT_NAMES[getattr(outputs, name)]] == s[place]
    assert found["pinion.displacement.x"] == s[U_P]
    assert outputs.OUTPUT_NAMES[outputs.DISPLACEMENTS + 3] == "pinion.tilt.x"
    assert found["pinion.tilt.x"] == s[TH_P]
    for j, one in enumerate(bearings.reshape(N_BEARINGS, BEARING_FIELDS)):
        u, v = (U_P, V_P) if j < 2 else (U_G, V_G)
        stiffness = np.zeros((3, 5))
        stiffness[0, [0, 4]], stiffness[1, [1, 3]], stiffness[2, 2] = one[:2], one[2:4], one[4]
        force = -(stiffness @ s[u : u + 5] + one[5:] * s[v : v + 3])
        told = [found[f"bearing[{j + 1}].force.{axis}"] for axis in "xyz"]
        assert told == pytest.approx(force)


@pytest.mark.parametrize(
    ("on_drive", "on_coast"), [(300.0, 0.0), (300.0, 0.5), (0.5, 250.0), (0.0, 0.0)]
)
def test_outputs_of_the_mesh_are_those_of_both_flanks(monkeypatch, on_drive, on_coast):
    loads, calls = {MU: on_drive, MU + FLANK_POINTS: on_coast}, {}
    member = SupportConstants(*RNG.uniform(1.0, 2.0, len(SupportConstants._fields)))
    ranges, teeth = object(), 23.0
    p = SimpleNamespace(
        motion=SimpleNamespace(flanks=FLANKS, pinion=member, gear=member._replace(mobility_r=3.0)),
        teeth=teeth, oil="oil", ranges=ranges,
    )  # fmt: skip
    slope = RNG.normal(size=N_ODE)

    def line_sums(a, tilt, phase, data, s, mu_at):
        load = loads[mu_at]
        return LineSums(load, 0.01 * load, -0.02 * load, 0.3 * load, 0.1, 0.2, 1e-3 * load, 0.0,
                        1e6 * (load > 0.0), 0.0, 0.0)  # fmt: skip

    def march_rates(s, pinion_torque, wheel_torque, data, out):
        assert (pinion_torque, wheel_torque) == (50.0, 120.0)
        out[:] = slope

    def write_lines(
        view, coast, mu, mu_at, w_p, temperature, data, oil, constants, first, bounds, out
    ):
        assert (coast, w_p) == (mu_at != MU, s[W_P])
        calls["lines"] = (mu_at, temperature, oil, first, bounds)
        return SimpleNamespace(
            thinnest_film=2e-7, film_load=1.0, film_material=2.0, traction=3.0, temperature=4.0,
            pressure=5.0, outside=0.25, loss_bound=0.1,
        )  # fmt: skip

    for name, stand_in in {
        "tuple_from_array": lambda data, kind: p,
        "mesh_at_torque": lambda torque, mesh, data: calls.setdefault("torque", torque),
        "march_rates": march_rates,
        "line_sums": line_sums,
        "laws_of_oil": lambda *mesh: "laws",
        "lubricant_state": lambda oil, temperature, laws: (oil, temperature, laws),
        "write_lines": write_lines,
        "write_ranges": lambda *given: calls.setdefault("ranges", given[:7]),
        "write_event_indicators": lambda *given: None,
    }.items():
        monkeypatch.setattr(outputs, name, stand_in)
    s = STATE.copy()
    s[TIME_IN_STEP], s[LOAD_TORQUE] = 0.0, 0.8
    out = np.full(len(outputs.OUTPUT_NAMES), np.nan)
    inputs, bearings = np.array([50.0, 120.0, 340.0]), np.zeros(N_BEARINGS * BEARING_FIELDS)
    outputs.write_outputs(s, inputs, "mesh", "data", bearings, np.empty(N_ODE), out)
    told = dict(zip(outputs.OUTPUT_NAMES, out, strict=True))

    assert told["pinion.acceleration"] == slope[W_P]
    assert told["wheel.acceleration"] == slope[W_G]
    assert told["der(pinion.speed)"] == slope[W_P]
    assert told["der(mesh.load_torque)"] == pytest.approx((50.0 - 0.8) / LOAD_FILTER_TIME)
    assert told["mesh.load"] == on_drive - on_coast
    assert told["mesh.separated"] == (on_drive == on_coast == 0.0)
    assert told["mesh.coast_contact"] == (on_coast > 0.0)
    touching = 1e6 * ((on_drive > 0.0) + (on_coast > 0.0))
    assert told["mesh.stiffness"] == pytest.approx(math.cos(0.35) ** 2 * touching)
    direction = outputs.friction_direction(s[W_P])
    sums = [line_sums(0, 0, 0, 0, 0, at) for at in loads]
    drive = pair_forces.flank_wrench(sums[0], direction, PLANE)
    back = pair_forces.turned_wrench(pair_forces.flank_wrench(sums[1], -direction, PLANE), FLANKS)
    for k, axis in enumerate("xyz"):
        assert told[f"mesh.force.{axis}"] == pytest.approx(drive[k] + back[k])
    # lines and ranges are those of the flank that carries more
    leads = on_drive >= on_coast
    mu_at = MU if leads else MU + FLANK_POINTS
    first_line = outputs.OUTPUT_NAMES.index("line[1].load")
    assert calls["lines"] == (mu_at, 340.0, ("oil", 340.0, "laws"), first_line, outputs.BOUNDS)
    torque = max(0.8, max(on_drive, on_coast) * PLANE.r_bp * PLANE.cos_b)
    assert calls["ranges"][0] == pytest.approx(torque if leads else -torque)
    assert calls["ranges"][1:] == (1.0, 2.0, 3.0, 4.0, 5.0, ranges)
    assert calls["torque"] == 0.8
    assert told["mesh.film_thickness_min"] == 2e-7
    assert told["film.share_outside"] == 0.25
    assert told["friction.power_loss_bound"] == pytest.approx(
        0.1 * abs(told["friction.power_loss"])
    )
    stored = 0.5 * s[W_P] ** 2 / member.mobility_r + 0.5 * s[W_G] ** 2 / 3.0
    stored += outputs.member_energy(s, U_P, V_P, member)
    stored += outputs.member_energy(s, U_G, V_G, member)
    assert told["energy.stored"] == pytest.approx(stored + 1e-3 * (on_drive + on_coast))


@pytest.mark.parametrize("duration", [0.0, 0.004])
def test_losses_are_mean_powers_of_a_step_and_efficiency_is_of_the_side_that_drives(duration):
    def found(works: list[float], mark: float = 0.4) -> dict[str, float]:
        s, rates = STATE.copy(), RNG.normal(size=N_ODE)
        s[TIME_IN_STEP] = duration
        s[WORK_MARK : WORK_MARK + N_ENERGIES] = mark
        powers = np.array(works)
        if duration > 0.0:
            after = s[WORK_MARK : WORK_MARK + N_ENERGIES] + powers * duration
            s[PINION_WORK : PINION_WORK + N_ENERGIES] = after
        else:
            rates[PINION_WORK : PINION_WORK + N_ENERGIES] = powers
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
