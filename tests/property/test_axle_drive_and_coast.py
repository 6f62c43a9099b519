"""Drive and coast flanks with data of their own: a car whose driver tips in and out."""

from dataclasses import replace

import numpy as np
import pytest

from gearlube_core.dynamics.hypoid_axle import OUTPUT_INDEX, HypoidAxle
from gearlube_core.dynamics.hypoid_axle.state import (
    LOAD_TORQUE,
    PHI_G,
    PHI_P,
    SIDE,
    U_G,
    U_P,
    V_G,
    V_P,
    W_G,
    W_P,
    X,
)
from gearlube_core.dynamics.hypoid_mesh.mesh_at_load import (
    MeshAtLoad,
    MeshLevels,
    blend_mesh,
    follow_flank,
)
from gearlube_core.dynamics.hypoid_mesh.mesh_force import MeshMotion
from gearlube_core.mesh_table.kernels import mesh_series
from gearlube_core.mesh_table.netcdf import shipped_mesh_table
from gearlube_core.mesh_table.table import MeshTable
from tests.helpers.axle_cases import (
    OIL,
    RATIO,
    axle_with,
    conservative,
    output,
    plain,
    record,
    with_coast_flanks,
)

SHIPPED = plain(shipped_mesh_table("mohammadpour_2015"))
TWO_SIDED = with_coast_flanks(SHIPPED)
COAST_RADIUS, COAST_STIFFNESS, COAST_ERROR = 1.03, 0.9, 1.6  # as `with_coast_flanks` has them
DRIVING, COASTING = 40.0, -30.0  # N.m at the pinion
HOLD = 0.05  # s that each torque lasts
SPEED = 145.0  # rad/s
ENERGIES = ("energy.pinion_work", "energy.wheel_work", "energy.stored")
LOSSES = (
    "energy.friction_viscous",
    "energy.friction_boundary",
    "energy.mesh_damping",
    "energy.bearing_damping",
    "energy.bearing_torque",
)


def axle_of(mesh, torque=DRIVING, lossless=False, steps=120, **options):
    # roller films breathe with the shaft speed without a counter-torque: off here
    parameters = axle_with(mesh=mesh, steps_per_highest_period=steps, **options)
    parameters = replace(parameters, bearing=replace(parameters.bearing, film="off"))
    axle = HypoidAxle(conservative(parameters) if lossless else parameters)
    axle.initialise(
        pinion_speed=SPEED, pinion_torque=torque, wheel_torque=torque * RATIO, oil_temperature=OIL
    )
    return axle


def tip_in_tip_out(axle, names, reversals=5, h=1e-4):
    """Outputs by name and the state, after each step of a torque that changes its sign."""
    columns = [OUTPUT_INDEX[name] for name in names]
    rows, states = [], []
    for k in range(reversals + 1):
        torque = COASTING if k % 2 else DRIVING
        for _ in range(round(HOLD / h)):
            axle.step(h, torque, torque * RATIO, OIL)
            rows.append(axle.outputs[columns])
            states.append(axle.state_view.copy())
    return np.array(rows).T, np.array(states)


def one_level(table, level=3):
    """The table with the data of one level, so that a change of load changes nothing."""
    return replace(
        table,
        torque=table.torque[[level]],
        series={key: values[[level]] for key, values in table.series.items()},
        windows={key: values[[level]] for key, values in table.windows.items()},
    )


def energy_out_of_nothing(mesh, backlash):
    """Largest imbalance [J] over five reversals, and how often the side changed."""
    axle = axle_of(mesh, steps=250, backlash=backlash)
    start = output(axle, "energy.stored")
    data, states = tip_in_tip_out(axle, ENERGIES + LOSSES)
    put_in, taken_out, stored = data[:3]
    imbalance = put_in - taken_out - (stored - start) - data[3:].sum(axis=0)
    return np.max(np.abs(imbalance)), np.count_nonzero(np.diff(states[:, SIDE]))


@pytest.mark.slow
@pytest.mark.parametrize(
    "backlash", [150e-6, *(pytest.param(b, marks=pytest.mark.slow) for b in (20e-6, 2e-6)), 0.0]
)
def test_changing_flanks_puts_no_energy_in(backlash):
    one_sided, _ = energy_out_of_nothing(one_level(SHIPPED), backlash)
    imbalance, changes = energy_out_of_nothing(with_coast_flanks(one_level(SHIPPED)), backlash)
    assert changes == 5
    # What one table for both sides leaves is the integration's, of first order in the step (3e-4 J
    # at 150 um, 3e-6 J at 20 um). Another impact may leave half as much again; 5e-6 J is 1 % of
    # what data that change under 40 N.m would put in each time, (1 - 0.9) k f^2/2 = 4e-4 J.
    assert imbalance < 1.5 * one_sided + 5e-6


def followed(x_um, side, backlash):
    """Position and side [um, -] after the table has followed the flanks, mean k_m before, after."""
    axle = axle_of(TWO_SIDED, backlash=backlash)
    mesh = axle.parameters.packed_mesh()
    table = MeshLevels(mesh.levels, mesh.series, mesh.orders, mesh.windows, mesh.nodes)
    at_load = MeshAtLoad(
        np.zeros(mesh.series_size), mesh.orders, np.zeros(mesh.window_size), mesh.nodes
    )
    s = np.array(axle.state_view)
    load, apart = s[LOAD_TORQUE], s[U_P : U_P + 3] - s[U_G : U_G + 3]
    moving = s[V_P : V_P + 3] - s[V_G : V_G + 3]
    motion = MeshMotion(s[PHI_P], 1e-6 * x_um, s[W_P], s[W_G], *apart, *moving)
    blend_mesh(load, side, table, at_load)
    before = mesh_series(at_load.series, mesh.orders, 13.0, s[PHI_P]).k_m
    x, other = follow_flank(motion, load, side, table, axle.kernel_parameters.mesh, at_load)
    after = mesh_series(at_load.series, mesh.orders, 13.0, s[PHI_P]).k_m
    return 1e6 * x, other, before, after


@pytest.mark.parametrize(("x", "side"), [(-4.0, 1.0), (4.0, -1.0)])
def test_without_backlash_a_change_of_side_keeps_the_elastic_energy(x, side):
    found, other, before, after = followed(x, side, 0.0)
    assert other == -side
    assert after / before == pytest.approx(COAST_STIFFNESS**side, rel=1e-12)
    assert np.sign(found) == np.sign(x)
    # k f^2 / 2 to rounding
    assert after * found**2 == pytest.approx(before * x**2, rel=1e-12)


@pytest.mark.parametrize(("x", "side"), [(3.0, 1.0), (-23.0, -1.0), (-1.0, 1.0), (-19.0, -1.0)])
def test_flanks_in_contact_or_near_it_keep_their_side(x, side):
    assert followed(x, side, 20e-6)[:2] == (1e6 * (1e-6 * x), side)


@pytest.mark.parametrize(("x", "side"), [(-19.0, 1.0), (-1.0, -1.0)])
def test_teeth_beyond_the_middle_of_the_gap_change_side_without_touching(x, side):
    found, other, *_ = followed(x, side, 20e-6)
    assert other == -side
    assert -20.0 <= found <= 0.0


@pytest.mark.slow
@pytest.mark.parametrize("backlash", [150e-6, 20e-6])
def test_both_gaps_follow_from_rotation_and_displacements_alone(backlash):
    """x + b = R_p theta + n.(u_p - u_g) - e on either side, with one theta: nothing creeps."""
    axle = axle_of(TWO_SIDED, backlash=backlash)
    _, states = tip_in_tip_out(axle, ["mesh.dte"], reversals=9)
    side = states[:, SIDE]
    lag = states[:, PHI_P] - RATIO * states[:, PHI_G]
    lateral = states[:, U_P : U_P + 3] - states[:, U_G : U_G + 3]
    n = np.array([SHIPPED.series[key][0, 0, 0] for key in ("n_x", "n_y", "n_z")])
    R_p = SHIPPED.series["R_p"][0, 0, 0]
    c = SHIPPED.series["e"][0]
    angle = np.outer(states[:, PHI_P], 13 * np.arange(c.shape[0]))
    e = np.cos(angle) @ c[:, 0] + np.sin(angle) @ c[:, 1]
    drive = R_p * lag + lateral @ n - e
    coast = COAST_RADIUS * R_p * lag + lateral @ (n * [1.0, -1.0, 1.0]) - COAST_ERROR * e
    x = states[:, X]
    # theta = lag - zero, from the first sample
    zero = (drive[0] - x[0] - 0.5 * backlash) / R_p
    drive -= R_p * zero
    coast -= COAST_RADIUS * R_p * zero
    expected = np.where(side > 0.0, drive, coast) - 0.5 * backlash
    assert np.count_nonzero(side < 0.0) > 100
    # a rotation of 70 rad known to 1e-14 times a radius of 0.02 m, and 1e5 roundings of x; RK4
    # integrates e' along with the angle to the same error as the angle
    np.testing.assert_allclose(x, expected, rtol=0, atol=1e-12)


def test_each_side_carries_force_of_its_own_sign():
    axle = axle_of(TWO_SIDED, steps=22)
    (force, separated), states = tip_in_tip_out(axle, ["mesh.force", "mesh.separated"])
    side = states[:, SIDE]
    assert np.all(force[side > 0.0] >= 0.0)
    assert np.all(force[side < 0.0] <= 0.0)
    assert np.all(force[separated == 1.0] == 0.0)
    assert force.min() < -500.0 < 500.0 < force.max()


@pytest.mark.parametrize("torque", [40.0, -40.0])
def test_start_rests_on_the_flanks_of_the_torque(torque):
    axle = axle_of(TWO_SIDED, torque)
    R_p, k_m = TWO_SIDED.mean("R_p", torque), TWO_SIDED.mean("k_m", torque)
    drive = MeshTable.mean(SHIPPED, "R_p", 40.0)
    assert R_p == pytest.approx(drive * (1.0 if torque > 0.0 else COAST_RADIUS), rel=1e-12)
    # x = T/(R k), beyond the backlash when coasting
    x = torque / R_p / k_m - (150e-6 if torque < 0.0 else 0.0)
    assert output(axle, "mesh.dte") == pytest.approx(x, rel=1e-12)
    assert axle.state_view[SIDE] == np.sign(torque)


def test_load_level_follows_the_torque_within_hundredths_of_a_second():
    axle = axle_of(SHIPPED)
    for _ in range(20):
        axle.step(1e-3, 2.0 * DRIVING, 2.0 * DRIVING * RATIO, OIL)
    # a first-order lag of 20 ms after 20 ms, for a torque that does not change meanwhile
    expected = DRIVING * (2.0 - np.exp(-1.0))
    assert axle.state_view[LOAD_TORQUE] == pytest.approx(expected, rel=1e-12)


def test_steady_coasting_has_the_force_of_the_coast_radius():
    axle = axle_of(TWO_SIDED, COASTING, steps=22, bearing_torque_loss="none", friction="off")
    record(axle, (COASTING, COASTING * RATIO), ["mesh.force"], 0.1)
    (force,) = record(axle, (COASTING, COASTING * RATIO), ["mesh.force"], 0.1)
    # at rest relative to each other: R_p F = T up to what is left of the start, 5 %
    expected = COASTING / (COAST_RADIUS * SHIPPED.series["R_p"][0, 0, 0])
    assert force.mean() == pytest.approx(expected, rel=5e-3)


def test_coast_data_equal_to_the_drive_data_change_nothing():
    def motion(mesh):
        axle = axle_of(mesh, steps=22)
        return tip_in_tip_out(axle, ["mesh.dte", "mesh.force", "wheel.speed"], reversals=1)[0]

    same = with_coast_flanks(SHIPPED, R_p=1.0, k_m=1.0, e=1.0)
    same.series["n_y"][: SHIPPED.torque.size] *= -1.0
    one_sided, both = motion(SHIPPED), motion(same)
    # a rounding of x at the change of side, 1e-20 m, grows in the impacts that follow
    scale = np.abs(one_sided).max(axis=1, keepdims=True)
    np.testing.assert_allclose(both / scale, one_sided / scale, rtol=0, atol=1e-9)


@pytest.mark.slow
def test_teeth_that_touch_between_two_evaluations_of_friction_meet_no_leftovers():
    """Coefficients of friction kept from elsewhere once threw the teeth 0.1 m apart."""
    axle = axle_of(TWO_SIDED, steps=22)
    ((force,), _) = tip_in_tip_out(axle, ["mesh.force"], reversals=40)
    # an impact at 0.3 m/s on 4.5e8 N/m with the 3.2 kg of the mesh mode: 11 kN
    assert np.max(np.abs(force)) < 3e4


def test_a_state_saved_while_coasting_continues_bit_for_bit():
    axle = axle_of(TWO_SIDED, steps=22)
    tip_in_tip_out(axle, ["mesh.dte"], reversals=1)
    assert axle.state_view[SIDE] < 0.0
    twin = axle_of(TWO_SIDED, steps=22)
    twin.set_state(axle.get_state())
    np.testing.assert_array_equal(twin.outputs, axle.outputs)
    for one in (axle, twin):
        tip_in_tip_out(one, ["mesh.dte"], reversals=2)
    np.testing.assert_array_equal(twin.get_state(), axle.get_state())
