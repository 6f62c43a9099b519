"""What the axle conserves and what it dissipates, at every operating point."""

from dataclasses import replace

import numpy as np
import pytest

from gearlube_core.dynamics.hypoid_axle import HypoidAxle, linearise, mohammadpour_2015_axle
from gearlube_core.dynamics.hypoid_axle.state import N_ODE, U_G, U_P, V_G, V_P, W_G, W_P
from tests.helpers.axle_cases import OIL, axle_with, conservative, output, record, running_axle
from tests.helpers.each import each

ENERGIES = ["energy.pinion_work", "energy.wheel_work", "energy.stored"]
LOSSES = [
    "energy.friction_viscous",
    "energy.friction_boundary",
    "energy.mesh_damping",
    "energy.bearing_damping",
    "energy.bearing_torque",
]
EFFICIENCIES = ["efficiency", "axle.efficiency"]


@pytest.mark.parametrize("speed_kmh", [20, 100])
@pytest.mark.parametrize("radii", ["consistent", "paper", "mean"])
def test_axle_without_losses_conserves_energy(speed_kmh, radii):
    parameters = conservative(axle_with(radii=radii, steps_per_highest_period=250))
    axle, *torques = running_axle(speed_kmh, parameters, efficiency=0.99)
    start = output(axle, "energy.stored")
    put_in, taken_out, stored = record(axle, torques, ENERGIES, 0.2)
    imbalance = put_in - taken_out - (stored - start)
    # 1e-8 of the energy that passed; RK4 at 250 steps per period errs by (2 pi/250)^4 = 4e-7 of
    # the vibration energy, which is below 1e-3 of what passes
    assert np.max(np.abs(imbalance)) < 1e-8 * put_in[-1]


def test_conservation_would_notice_a_missing_term():
    parameters = conservative(axle_with(equations="as_printed", steps_per_highest_period=250))
    axle, *torques = running_axle(20, parameters, efficiency=0.99)
    start = output(axle, "energy.stored")
    put_in, taken_out, stored = record(axle, torques, ENERGIES, 0.004)
    imbalance = put_in - taken_out - (stored - start)
    assert np.max(np.abs(imbalance)) > 1e-6 * put_in[-1]


@pytest.mark.parametrize("speed_kmh", [20, 60, 100])
def test_losses_account_for_all_energy_with_friction_and_damping_on(speed_kmh):
    # roller films breathe with the shaft speed without a counter-torque: off here
    parameters = axle_with(steps_per_highest_period=60)
    parameters = replace(parameters, bearing=replace(parameters.bearing, film="off"))
    axle, *torques = running_axle(speed_kmh, parameters)
    start = output(axle, "energy.stored")
    data = record(axle, torques, ENERGIES + LOSSES, 0.2)
    put_in, taken_out, stored = data[:3]
    imbalance = put_in - taken_out - (stored - start) - data[3:].sum(axis=0)
    # RK4 energies to (2 pi/60)^4 of the vibration part, linear interpolation of the window data
    assert np.max(np.abs(imbalance)) < 1e-6 * put_in[-1]


@each("speed_kmh", [20, 60, 100])
@each("friction", ["consistent", "as_printed"])
def test_no_loss_is_ever_negative(speed_kmh, friction):
    axle, *torques = running_axle(speed_kmh, axle_with(friction=friction))
    data = record(axle, torques, LOSSES, 0.1)
    # roundings of sums of about 100 J
    assert np.min(np.diff(data, axis=1)) >= -1e-13


def test_efficiencies_are_those_of_the_energies_of_the_step():
    axle, *torques = running_axle(60)
    data = record(axle, torques, ["energy.pinion_work", *LOSSES, *EFFICIENCIES], 0.002)
    put_in, viscous, boundary, *others = np.diff(data[:6], axis=1)
    of_the_mesh, of_the_axle = data[6:, 1:]
    friction = viscous + boundary
    # roundings of energies of 10 J against 1 J put in each step; bearings take over 1e-3 of it
    np.testing.assert_allclose(of_the_mesh, 1.0 - friction / put_in, rtol=1e-11)
    np.testing.assert_allclose(of_the_axle, 1.0 - (friction + sum(others)) / put_in, rtol=1e-11)
    assert np.all(of_the_mesh - of_the_axle > 1e-3)


def test_only_bearing_forces_change_the_momentum_of_the_members():
    axle, *torques = running_axle(60)
    record(axle, torques, ["mesh.dte"], 0.02)
    slope = axle.derivative(axle.get_state()[:N_ODE])
    p = axle.kernel_parameters
    rate = p.m_p * slope[V_P : V_P + 3] + p.m_g * slope[V_G : V_G + 3]
    bearings = np.array(
        [sum(output(axle, f"bearing[{j}].force.{c}") for j in (1, 2, 3, 4)) for c in "xyz"]
    )
    # mesh force and friction cancel exactly; roundings of forces of about 1e4 N remain
    np.testing.assert_allclose(rate, bearings, atol=1e-8)


def test_mesh_power_on_the_members_is_the_power_of_the_mesh():
    """Without friction: torques and forces of the mesh do the work -F x' - dV/dphi w."""
    parameters = conservative(mohammadpour_2015_axle())
    axle, *torques = running_axle(100, parameters)
    record(axle, torques, ["mesh.dte"], 0.01)
    state = axle.get_state()[:N_ODE]
    slope = axle.derivative(state)
    p = axle.kernel_parameters
    energy_rate = (
        p.I_p * state[W_P] * slope[W_P]
        + p.I_g * state[W_G] * slope[W_G]
        + p.m_p * state[V_P : V_P + 3] @ slope[V_P : V_P + 3]
        + p.m_g * state[V_G : V_G + 3] @ slope[V_G : V_G + 3]
    )
    h = 1e-7
    twin = HypoidAxle(parameters)
    twin.initialise(
        pinion_speed=state[W_P],
        pinion_torque=torques[0],
        wheel_torque=torques[1],
        oil_temperature=OIL,
    )

    def elastic(at):
        full = twin.get_state()
        full[:N_ODE] = at
        full[N_ODE:] = axle.get_state()[N_ODE:]
        twin.set_state(full)
        kinetic = 0.5 * (
            p.I_p * at[W_P] ** 2
            + p.I_g * at[W_G] ** 2
            + p.m_p * at[V_P : V_P + 3] @ at[V_P : V_P + 3]
            + p.m_g * at[V_G : V_G + 3] @ at[V_G : V_G + 3]
        )
        return output(twin, "energy.stored") - kinetic

    elastic_rate = (elastic(state + h * slope) - elastic(state - h * slope)) / (2 * h)
    external = torques[0] * state[W_P] - torques[1] * state[W_G]
    # the central difference of an energy of 1 J carries roundings of 1e-16/1e-7 = 1e-9 W per J
    # and a truncation (w h)^2 = 1e-6 of the elastic power
    assert energy_rate + elastic_rate == pytest.approx(external, rel=1e-5)


@pytest.mark.parametrize("preload", [2500.0, 6000.0])
def test_linear_stiffness_is_symmetric(preload):
    axle, *torques = running_axle(60, mohammadpour_2015_axle(bearing_preload=preload))
    K = linearise(axle, OIL, torques[0]).stiffness
    # central differences: roundings of 1e-16 x 1e4 N / 1e-9 m against 5e8 N/m
    np.testing.assert_allclose(K, K.T, atol=2e-5 * np.max(np.abs(K)))


def test_printed_signs_make_the_stiffness_asymmetric():
    axle, *torques = running_axle(60, axle_with(equations="as_printed"))
    K = linearise(axle, OIL, torques[0]).stiffness
    torsion_to_lateral = K[0, 2:]
    lateral_to_torsion = K[2:, 0]
    np.testing.assert_allclose(lateral_to_torsion, -torsion_to_lateral, rtol=1e-3)
    assert np.max(np.abs(torsion_to_lateral)) > 1e6  # N/rad: R_p k_m n_x is about 7e6


@pytest.mark.parametrize("speed_kmh", [20, 100])
def test_no_roller_is_ever_pulled(speed_kmh):
    axle, *torques = running_axle(speed_kmh, mohammadpour_2015_axle(bearing_preload=200.0))
    names = [f"bearing[{j}].roller_load_min" for j in (1, 2, 3, 4)]
    data = record(axle, torques, names, 0.1)
    assert data.min() >= 0.0
    # so light a preload must unload rollers, or the test could not fail
    assert data.min() == 0.0


@pytest.mark.parametrize("speed_kmh", [20, 100])
def test_flank_loads_sum_to_the_mesh_force(speed_kmh):
    axle, *torques = running_axle(speed_kmh)
    names = ["mesh.force", *(f"flank[{i}].load" for i in (1, 2, 3))]
    data = record(axle, torques, names, 0.05)
    np.testing.assert_allclose(data[1:].sum(axis=0), data[0], rtol=1e-9)  # SHARE_TOLERANCE


def test_static_start_is_an_equilibrium_of_the_shafts():
    axle, *_ = running_axle(60, conservative(axle_with(radii="mean")))
    slope = axle.derivative(axle.get_state()[:N_ODE])
    # k_m varies with the angle about the mean that the start uses: up to 6 % of F = 1900 N
    limit = 0.08 * 1900.0 / np.array(3 * [12.0] + 3 * [49.9])
    rates = np.concatenate([slope[V_P : V_P + 3], slope[V_G : V_G + 3]])
    assert np.all(np.abs(rates) < limit)
    assert np.any(np.abs(axle.get_state()[U_P : U_P + 3]) > 1e-7)
    assert np.any(np.abs(axle.get_state()[U_G : U_G + 3]) > 1e-7)
