"""Limits and identities of bearing friction that need no measurement."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import fsolve

from gearlube_core.bearings.losses.geometry import Rib
from gearlube_core.bearings.losses.laws import (
    aihara_force,
    aihara_heating,
    goksem_hargreaves_force,
    zhou_hoeprich_force,
)
from gearlube_core.bearings.roller_loads import ring_loads
from gearlube_core.contact.greenwood_tripp_1971 import asperity_share
from gearlube_core.ehl.line.problem import LineProblem, LineSettings
from gearlube_core.ehl.line.solver import solve_line
from gearlube_core.film.biboulet_houpert_2010 import (
    biboulet_houpert_force,
    biboulet_houpert_starvation,
)
from gearlube_core.film.zhu_cheng_1989 import zhu_cheng_heating
from gearlube_core.oil.film_oil_data import film_oil_of
from gearlube_core.oil.lubricant import Lubricant
from tests.helpers.bearing_32216 import BEARING, F_A, RPM, loss_at
from tests.helpers.each import each

CONTACT = {"R": 9.8e-3, "reduced_modulus": 2.31e11, "eta0": 0.05, "alpha": 2.1e-8}


def test_rolling_force_is_free_of_load_and_of_alpha_in_a_heavy_contact():
    # E' R 1.47 U^(3/4): the printed limit has three digits
    U = 2.0 * 0.05 * 1.0 / (2.31e11 * 9.8e-3)
    limit = 2.31e11 * 9.8e-3 * 1.47 * U**0.75
    for load in (3e5, 3e6):
        for alpha in (1e-8, 3e-8):
            force, _ = biboulet_houpert_force(9.8e-3, load, 2.31e11, 0.05, alpha, 1.0)
            assert force == pytest.approx(limit, rel=2e-3)


def test_rolling_force_of_a_light_contact_is_that_of_rigid_cylinders():
    # M << 1: F = 1.42 E' R (U W)^(1/2) = 1.42 (2 eta u q)^(1/2), no modulus and no radius left
    for modulus in (2e11, 4e11):
        force, _ = biboulet_houpert_force(0.01, 1.0, modulus, 0.05, 2e-8, 2.0)
        assert force == pytest.approx(1.42 * math.sqrt(2.0 * 0.05 * 2.0 * 1.0), rel=1e-6)


@each("speed", [0.2, 1.0])
@each(
    ("law", "by_speed", "by_load"),
    [
        (zhou_hoeprich_force, 0.648, 0.246),
        (goksem_hargreaves_force, 0.658, 0.0126),
        (aihara_force, 0.658, 0.31),
    ],
)
def test_laws_have_the_unit_of_force_per_length(law, by_speed, by_load, speed):
    """Twice all lengths at the same pressure and speed/length: F [N/m] doubles."""
    at = dict(CONTACT, line_load=6e4, speed=speed)
    large = dict(at, R=2.0 * at["R"], line_load=2.0 * at["line_load"], speed=2.0 * speed)
    assert law(**large)[0] == pytest.approx(2.0 * law(**at)[0], rel=1e-12)
    faster = law(**dict(at, speed=2.0 * speed))[0] / law(**at)[0]
    assert math.log2(faster) == pytest.approx(by_speed, abs=1e-9)
    heavier = law(**dict(at, line_load=1.2e5))[0] / law(**at)[0]
    assert math.log2(heavier) == pytest.approx(by_load, abs=1e-9)


def test_the_fit_says_where_it_ends():
    def status(load: float, speed: float) -> int:
        return biboulet_houpert_force(9.8e-3, load, 2.31e11, 0.05, 2.1e-8, speed)[1]

    assert status(6e4, 1.0) == 0  # M 3, L 14
    assert status(6e4, 10.0) == 1  # L = 2.1e-8 2.31e11 (4.4e-10)^(1/4) = 22
    assert status(6e6, 1.0) == 1  # M 300


@pytest.mark.parametrize("rpm", [500, 2000])
def test_rolling_force_and_lost_power_are_those_of_a_solved_film(rpm):
    """Reynolds' equation solved: the film loses 2 F u, and the law has F within 15 %."""
    oil = film_oil_of(Lubricant.named("fva_3"), 323.15, newtonian=True)
    u = BEARING.mean_ratio * rpm * RPM
    R = BEARING.parameters().R_outer
    line = LineProblem(
        lubricant=oil,
        radius=R,
        line_load=1391.0 / 22.7e-3,
        reduced_modulus=BEARING.parameters().reduced_modulus,
        speed_1=u,
        speed_2=u,
    )
    film = solve_line(line, LineSettings(nodes=1201))
    slope = np.gradient(film.pressure, film.x)
    force = 0.5 * np.trapezoid(film.film * slope, film.x)
    lost = np.trapezoid(film.film**3 * slope**2 / (12.0 * film.viscosity), film.x)
    # the viscosity changes manifold from node to node: 1.5 % on 1201 nodes, falling with more
    assert lost == pytest.approx(2.0 * force * u, rel=0.03)
    law, _ = biboulet_houpert_force(R, line.line_load, line.reduced_modulus, oil.eta0, 2.1e-8, u)
    assert law == pytest.approx(force, rel=0.15)
    half, _ = zhou_hoeprich_force(R, line.line_load, line.reduced_modulus, oil.eta0, 2.1e-8, u)
    assert half / force == pytest.approx(0.53, abs=0.05)  # a third law, not of flooded films


def test_power_of_the_raceways_is_the_torque_of_their_levers():
    """The levers of Zhou and Hoeprich give what 2 F u gives, without any speed in them."""
    p = BEARING.parameters()
    inner, outer = BEARING.race_radii
    cosine = math.cos(BEARING.mean_angle)
    assert inner + p.R_inner * cosine == pytest.approx(2.0 * p.mean_ratio, rel=1e-12)
    assert outer - p.R_outer * cosine == pytest.approx(2.0 * p.mean_ratio, rel=1e-12)


def test_starvation_goes_from_nothing_to_flooded():
    assert biboulet_houpert_starvation(0.0, 1e-6) == 1.0  # stands for flooded
    assert biboulet_houpert_starvation(1e-12, 1e-6) < 1e-6
    assert biboulet_houpert_starvation(1.0, 1e-6) == pytest.approx(1.0, abs=1e-3)
    # S = 35: (1225 + 5698)/(1225 + 6758.5 + 1257)
    assert biboulet_houpert_starvation(35e-6, 1e-6) == pytest.approx(0.7492, abs=5e-5)


def test_heating_lowers_the_torque_once():
    cold = loss_at(2000, law="biboulet_houpert", heating="none").parts["rolling"]
    hot = loss_at(2000, law="biboulet_houpert", heating="aihara").parts["rolling"]
    # Lt = 0.0523 0.0449 5.549^2/0.134 by hand, for both races
    assert hot / cold == pytest.approx(1.0 / (1.0 + 0.29 * 0.540**0.78), rel=5e-3)
    assert aihara_heating(0.0) == 1.0
    assert zhu_cheng_heating(0.0, 0.003, 0.0) == 1.0
    assert zhu_cheng_heating(1.0, 0.003, 0.3) < zhu_cheng_heating(1.0, 0.003, 0.0) < 1.0


def between_rings(axial: float, radial: float) -> np.ndarray:
    """Return the loads of the rollers [N]; nan where the rings find none."""
    loads = np.zeros(16)
    failed = ring_loads(axial, radial, BEARING.dry_rollers(), loads)
    return np.full(16, np.nan) if failed else loads


@each("radial", [0.0, 3000.0, 6500.0, 12000.0])
def test_rollers_between_rigid_rings_carry_both_loads(radial):
    """Against the two equations of balance, solved on their own."""
    a, psi = BEARING.outer_angle, 2.0 * np.pi * np.arange(16) / 16
    loads = between_rings(F_A, radial)

    def carried(d: np.ndarray) -> np.ndarray:
        reach = d[0] * math.sin(a) + d[1] * math.cos(a) * np.cos(psi)
        return np.maximum(reach, 0.0) ** (10.0 / 9.0)

    def miss(d: np.ndarray) -> list[float]:
        Q = carried(d)
        balance = Q.sum() * math.sin(a) / F_A - 1.0
        return [balance, ((Q * np.cos(psi)).sum() * math.cos(a) - radial) / F_A]

    d = fsolve(miss, [F_A, 0.3 * radial], xtol=1e-13)
    assert np.allclose(miss(d), 0.0, atol=1e-10)
    assert loads == pytest.approx(carried(d), rel=1e-6, abs=1e-3)


def test_a_roller_is_unloaded_where_the_radial_load_is_large():
    tan = math.tan(BEARING.outer_angle)
    assert between_rings(F_A, 0.45 * F_A / tan).min() > 0.0
    assert between_rings(F_A, 0.60 * F_A / tan).min() == 0.0
    assert np.isnan(between_rings(F_A, 0.85 * F_A / tan)).all()
    assert np.isnan(between_rings(0.0, 1.0)).all()


def test_torque_of_the_rib_is_that_of_its_height():
    """All load on asperities: e mu cos(b) F_a, whatever the radii, Aihara 1987 eq. (11)."""
    rough = Rib(contact_height=2.5e-3, roughness=1e-5, share_b=0.1, share_c=3.0)
    found = loss_at(10, changes={"rib": rough})
    expected = 2.5e-3 * 0.15 * math.cos(BEARING.half_cone) * F_A
    # common apex to 0.03 % of the roller radius, cos(b) 0.07 %; asperities carry 99.9 %
    assert found.rib_friction == pytest.approx(0.15, rel=2e-3)
    assert found.parts["rib"] == pytest.approx(expected, rel=3e-3)


def test_asperities_carry_all_without_film_and_nothing_under_a_thick_one():
    assert asperity_share(0.0, 1.9, 0.99) == 1.0
    assert asperity_share(10.0, 1.9, 0.99) < 1e-7


def test_rib_friction_falls_from_boundary_to_full_film_as_speed_rises():
    friction = [loss_at(rpm).rib_friction for rpm in (1, 10, 50, 200)]
    assert friction[0] > 0.05
    assert friction[-1] < 0.01
    assert all(np.diff(friction) < 0.0)


@each("law", ["biboulet_houpert", "zhou_hoeprich", "palmgren", "skf"])
def test_no_speed_no_power_and_hotter_oil_less_of_it(law):
    assert loss_at(0, law=law).power == 0.0
    cold, hot = (loss_at(1000, law=law, temperature_degc=t).power for t in (40.0, 90.0))
    assert 0.0 < hot < cold
    assert loss_at(1000, law=law).power == pytest.approx(
        1000 * RPM * loss_at(1000, law=law).torque, rel=1e-12
    )


def test_two_rows_under_twice_the_load_lose_twice_as_much():
    one = loss_at(1000, radial_load=3000.0)
    two = loss_at(1000, axial_load=2 * F_A, radial_load=6000.0, changes={"rows": 2})
    for part, torque in one.parts.items():
        # the drag of a row does not know the load
        assert two.parts[part] == pytest.approx(2.0 * torque, rel=1e-12)


def test_a_rib_without_a_film_makes_the_torque_as_uncertain_as_its_data():
    """At 10 rpm asperities carry half of the rib's load: friction 1.4, roughness to twice."""
    slow = loss_at(10, temperature_degc=90.0)
    share = slow.parts["rib"] / slow.torque
    rib = BEARING.rib
    error = [math.log(slow.factor) ** 2 - math.log(2.0) ** 2]
    for changed in (
        replace(rib, boundary_friction=1.4 * rib.boundary_friction),
        replace(rib, roughness=2.0 * rib.roughness),
    ):
        more = loss_at(10, temperature_degc=90.0, changes={"rib": changed}).torque / slow.torque
        error.append(-(math.log(more) ** 2))
    assert share > 0.3
    # all rollers carry the same axial load, so the one that is asked stands for all
    assert sum(error) == pytest.approx(0.0, abs=1e-9)


def test_a_calibrated_bearing_has_a_narrower_error_bar_and_the_scaled_rolling_torque():
    plain, scaled = loss_at(1000), loss_at(1000, changes={"rolling_scale": 0.8})
    # the rib has a full film and takes 1 % of the torque: it widens neither bar by 1 %
    assert (plain.factor, scaled.factor) == pytest.approx((2.0, 1.25), rel=0.01)
    assert plain.factor > 2.0
    assert scaled.parts["rolling"] == pytest.approx(0.8 * plain.parts["rolling"], rel=1e-12)
    assert scaled.parts["rib"] == plain.parts["rib"]
