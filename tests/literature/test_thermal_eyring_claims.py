"""Statements of Karagiannis et al. 2012 about film and friction over a mesh cycle.

The analysed mesh of the shipped table at 50 N.m and 2640 rpm of the pinion (0.3 of its resonance),
static load shares, flanks with more than a tenth of the load. The paper's choices where it makes
them: printed film convention, radii of the contact axes, film at effective temperature, surfaces at
oil temperature. Pressure is that of the ellipse.
"""

import math
from dataclasses import replace
from functools import cached_property

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.optimize import brentq

from gearlube_core.contact.greenwood_tripp_1971 import SurfaceParameters
from gearlube_core.contact.hertz import hertz_ellipse
from gearlube_core.contact.solid import STEEL_MOHAMMADPOUR_2015, solid_parameters
from gearlube_core.friction.friction_torques import flank_speeds, friction_torques
from gearlube_core.friction.johnson_greenwood_1980 import thermal_eyring_film
from gearlube_core.friction.thermal_eyring_data import (
    ELLIPTICAL,
    ThermalEyringOil,
    ThermalFlankState,
    grubin_contact_geometry,
    thermal_eyring_oil,
    thermal_eyring_options,
)
from gearlube_core.friction.thermal_eyring_flank import thermal_eyring_flank
from gearlube_core.friction.traction_regime import EYRING, flank_regime
from gearlube_core.mesh_table.netcdf import shipped_mesh_table
from gearlube_core.oil.houpert_1985 import (
    houpert_log_viscosity,
    houpert_parameters,
    houpert_temperature_coefficient,
)
from gearlube_core.oil.lubricant import Lubricant

SOLID = solid_parameters(STEEL_MOHAMMADPOUR_2015, STEEL_MOHAMMADPOUR_2015)
SURFACE = SurfaceParameters(0.5e-6, 0.055, 0.001)
OIL = Lubricant.named("karagiannis_2012")
LAW = houpert_parameters(OIL)
TABLE = shipped_mesh_table("mohammadpour_2015")
LEVEL = int(np.flatnonzero(TABLE.torque == 50.0)[0])
FORCE = 50.0 / TABLE.series["R_p"][LEVEL, 0, 0]
SPEED = 2640.0 * math.pi / 30.0
WINDOW = {key: values[LEVEL] for key, values in TABLE.windows.items()}
NODES = np.flatnonzero(WINDOW["share"] > 0.1)
PRINTED = thermal_eyring_options(SOLID.contact_modulus, "as_printed", "effective")
COLD, HOT = 313.15, 373.15
ETA0 = OIL.dynamic_viscosity(COLD)


class Cycle:
    """States of one flank through its mesh, fields as arrays over the nodes."""

    def __init__(self, temperature: float, speed: float = 1.0, tau0: float = 2e6) -> None:
        self.temperature, self.speed, self.tau0 = temperature, speed, tau0

    @cached_property
    def oil(self) -> ThermalEyringOil:
        parameters = replace(OIL, eyring_stress=self.tau0).parameters()
        return thermal_eyring_oil(LAW, parameters, self.temperature)

    @cached_property
    def states(self) -> list[ThermalFlankState]:
        states = []
        for node in NODES:
            w = {key: float(values[node]) for key, values in WINDOW.items()}
            w_p = self.speed * SPEED
            u, dU = flank_speeds(w_p, w_p / TABLE.ratio, w["friction_arm_p"], w["friction_arm_g"])
            geometry = grubin_contact_geometry(
                w["R_x"], w["R_y"], 0.0, SOLID.contact_modulus, ELLIPTICAL
            )
            states.append(
                thermal_eyring_flank(
                    FORCE * w["share"], u, dU, geometry, self.oil, SURFACE, SOLID, PRINTED
                )
            )
        return states

    @cached_property
    def most_loaded(self) -> int:
        return int(np.argmax(self.area))

    def __getattr__(self, name: str) -> NDArray[np.float64]:
        return np.array([getattr(state, name) for state in self.states])


AT_40, AT_100, FAST = Cycle(COLD), Cycle(HOT), Cycle(COLD, speed=1.0 / 0.3)
MIDDLE = WINDOW["share"][NODES] > 0.5


def test_15_film_is_half_a_micrometre_and_nearly_constant_while_a_flank_carries_most() -> None:
    film = AT_40.film_thickness[MIDDLE]
    assert AT_40.film_thickness[AT_40.most_loaded] == pytest.approx(0.5e-6, abs=0.1e-6)
    # spread allowed for radii of another contact analysis: 30 %
    assert np.ptp(film) / film.mean() < 0.3


def test_17_viscosity_rises_by_two_orders() -> None:
    assert 50.0 < AT_40.effective_viscosity.max() / ETA0 < 300.0


def test_18_temperature_rises_by_percents_of_the_inlet() -> None:
    rise = AT_40.rise_effective / COLD
    assert np.all((rise > 0.005) & (rise < 0.05))


def test_19_viscous_friction_dominates_at_40_degc() -> None:
    assert np.all(AT_40.boundary_friction < 0.25 * AT_40.viscous_friction)


def departure_from_newtonian(tau0: float) -> float:
    """Return tau/p where the traction curve is a tenth below its tangent at the origin."""
    state = AT_40.states[AT_40.most_loaded]
    log = houpert_log_viscosity(LAW, state.mean_pressure, COLD)
    beta = houpert_temperature_coefficient(LAW, log, COLD)
    h = state.film_thickness

    def film(slip: float) -> float:
        K = AT_40.oil.conductivity
        return tau0 * float(thermal_eyring_film(log - 9.67, beta, K, tau0, h, slip).stress_ratio)

    def shortfall(log_slip: float) -> float:
        slip = math.exp(log_slip)
        return film(slip) / (math.exp(log - 9.67) * slip / h) - 0.9

    slip = math.exp(float(brentq(shortfall, math.log(1e-8), math.log(10.0))))
    return film(slip) / float(state.mean_pressure)


def test_20_traction_leaves_the_newtonian_line_at_a_hundredth_of_the_pressure() -> None:
    # the Eyring stress is not printed: 4 to 5 MPa put the bend where fig. 19a has it
    assert 0.004 < departure_from_newtonian(5e6) < 0.015
    assert departure_from_newtonian(2e6) < 0.004


@pytest.mark.parametrize("cycle", [AT_40, AT_100])
def test_21_every_state_is_eyring_and_newtonian_stress_exceeds_the_eyring_stress(
    cycle: Cycle,
) -> None:
    assert np.all(cycle.newtonian_stress > 2e6)
    for state, node in zip(cycle.states, NODES, strict=True):
        half_width = hertz_ellipse(
            WINDOW["R_x"][node],
            WINDOW["R_y"][node],
            SOLID.contact_modulus,
            FORCE * WINDOW["share"][node],
        )[0]
        place = flank_regime(state, cycle.oil, math.inf, math.inf, half_width)
        assert place.state == place.limit == EYRING


def test_25_temperature_rise_at_resonance_speed() -> None:
    # a fifth of the inlet temperature in kelvin
    assert 0.12 < FAST.rise_effective.max() / COLD < 0.25
    assert FAST.effective_viscosity.max() < AT_40.effective_viscosity.max()


def test_26_hot_film_is_a_quarter_of_the_cold_one() -> None:
    ratio = AT_100.film_thickness.max() / AT_40.film_thickness.max()
    assert 0.2 < ratio < 0.3
    assert 0.09e-6 < AT_100.film_thickness[AT_40.most_loaded] < 0.16e-6


def test_27_shear_rate_is_several_times_higher_at_100_degc() -> None:
    hot = (AT_100.sliding_speed / AT_100.film_thickness).max()
    cold = (AT_40.sliding_speed / AT_40.film_thickness).max()
    assert 2.0 < hot / cold < 6.0


def test_28_boundary_friction_matters_at_100_degc() -> None:
    share = AT_100.boundary_friction.max() / AT_100.viscous_friction.max()
    cold = AT_40.boundary_friction.max() / AT_40.viscous_friction.max()
    # a fifth is printed; here up to two thirds, since the film ratio is 0.3 and friction less than
    # with 5 MPa, which gives two fifths
    assert share > 4.0 * cold
    hotter = Cycle(HOT, tau0=5e6)
    with_5_mpa = hotter.boundary_friction.max() / hotter.viscous_friction.max()
    assert 0.1 < with_5_mpa < share < 0.7


def test_12_friction_torque_is_trivial_and_resists_the_pinion() -> None:
    torque, power = 0.0, 0.0
    pitch = TABLE.nodes // 3
    for state, node in zip(AT_40.states, NODES, strict=True):
        force = state.viscous_friction + state.boundary_friction
        Q_p, _, P = friction_torques(
            force,
            state.sliding_speed,
            float(WINDOW["friction_arm_p"][node]),
            float(WINDOW["friction_arm_g"][node]),
        )
        # every node of a window stands for one of the pairs in mesh at one position of a pitch
        torque += Q_p / pitch
        power += P / pitch
    assert -0.04 * 50.0 < torque < 0.0
    # loss of a film with mu of 0.01 to 0.02 over a sliding arm of a third of R_p
    assert 0.002 < power / (50.0 * SPEED) < 0.015
