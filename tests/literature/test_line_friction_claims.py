"""Line friction of helical pairs against the mean friction of gear practice and a thesis' films.

The closed formulas are independent of this package: Schlenk 1995 (in ISO/TR 14179-2), Benedict and
Kelley 1961, Xu and Kahraman 2007 (thermal non-Newtonian EHL, fitted for a 75W90 oil).
"""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from gearlube_core.arrays import Array
from gearlube_core.contact.greenwood_tripp_1971 import SurfaceParameters
from gearlube_core.contact.hertz import LARGEST_OVER_MEAN, line_mean_pressure
from gearlube_core.contact.solid import STEEL_MOHAMMADPOUR_2015, solid_parameters
from gearlube_core.film.line_film import minimum_line_film_thickness
from gearlube_core.friction.line_integrals import LineFrictionCycle, friction_along_lines
from gearlube_core.friction.line_points import line_points, uniform_line_load
from gearlube_core.helical_geometry.contact_line import line_kinematics
from gearlube_core.oil.lubricant import Lubricant
from tests.helpers.each import each
from tests.helpers.named_pairs import named_pair

SOLID = solid_parameters(STEEL_MOHAMMADPOUR_2015, STEEL_MOHAMMADPOUR_2015)
HE = named_pair("he_2007")
PLANE = HE.plane
# He et al. 2007 sec. 4: 1000 rpm, 2000 lbf in; oil and roughness are not given
RPM, TORQUE, SIGMA, T_OIL = 1000.0, 225.97, 0.5e-6, 353.15


def he_cycle(
    oil: str = "mohammadpour_2015",
    temperature: float = T_OIL,
    rpm: float = RPM,
    torque: float = TORQUE,
    sigma: float = SIGMA,
) -> LineFrictionCycle:
    points = line_points(HE)
    return friction_along_lines(
        points,
        uniform_line_load(points, torque),
        pinion_speed=rpm * math.pi / 30.0,
        pinion_torque=torque,
        lubricant=Lubricant.named(oil),
        oil_temperature=temperature,
        surface=SurfaceParameters(sigma, 0.055, 0.001),
        solid=SOLID,
    )


def our_mean(**changes: Any) -> float:
    return he_cycle(**changes).mean_coefficient


def viscosity_cp(temperature: float, oil: str = "mohammadpour_2015") -> float:
    return 1e3 * Lubricant.named(oil).dynamic_viscosity(temperature)


def schlenk(
    temperature: float = T_OIL, rpm: float = RPM, torque: float = TORQUE, sigma: float = SIGMA
) -> float:
    """0.048 [F_bt/b/(v_sum rho)]^0.2 eta^-0.05 Ra^0.25, N/mm, m/s, mm, mPa s, um; mineral oil."""
    load = torque / HE.pinion_base_radius / HE.face_width * 1e-3
    speed = 2.0 * PLANE.P * rpm * math.pi / 30.0
    rho = 1e3 * PLANE.P * (PLANE.x_g - PLANE.P) / PLANE.x_g / PLANE.cos_b
    Ra = 1e6 * sigma / math.sqrt(2.0) / 1.25  # of one of two like Gaussian surfaces
    viscosity = viscosity_cp(temperature)
    return float(0.048 * (load / (speed * rho)) ** 0.2 * viscosity**-0.05 * Ra**0.25)


Local = Callable[..., Array]


def benedict_kelley(w: Array, u_p: Array, u_g: Array, R: Array, nu: float, sigma: float) -> Array:
    """0.0127 1.13/(1.13 - S) log10[29700 w/(nu |v_s| v_r^2)], N/mm, mPa s, m/s, um."""
    del R
    group = 29700.0 * 1e-3 * w / (nu * abs(u_p - u_g) * (u_p + u_g) ** 2)
    return 0.0127 * 1.13 / (1.13 - 1e6 * sigma) * np.log10(group)


def xu_kahraman(w: Array, u_p: Array, u_g: Array, R: Array, nu: float, sigma: float) -> Array:
    """exp(f) p^b2 SR^b3 u^b6 nu^b7 R^b8; GPa, m/s, mPa s, m, um."""
    b = (-8.916465, 1.03303, 1.036077, -0.354068, 2.812084, -0.100601, 0.752755, -0.390958)
    u = 0.5 * (u_p + u_g)
    SR = abs(u_p - u_g) / u
    p = 1e-9 * np.sqrt(w * SOLID.contact_modulus / (math.pi * R))
    group = SR * p * math.log10(nu)
    f = b[0] + b[3] * group + b[4] * np.exp(-group) + 0.620305 * math.exp(1e6 * sigma)
    return np.exp(f) * p ** b[1] * SR ** b[2] * u ** b[5] * nu ** b[6] * R ** b[7]


def mean_of(
    formula: Local,
    temperature: float = T_OIL,
    rpm: float = RPM,
    torque: float = TORQUE,
    sigma: float = SIGMA,
) -> float:
    """Mean of a local formula, weighted with w |u_s| as lost power is."""
    points = line_points(HE)
    inside = points.length > 0.0
    w, x = uniform_line_load(points, torque)[inside], points.x[inside]
    speed = rpm * math.pi / 30.0
    u_p, u_g = x * speed, (PLANE.x_g - x) * speed * PLANE.r_bp / PLANE.r_bg
    R = x * (PLANE.x_g - x) / PLANE.x_g / PLANE.cos_b
    weight = w * abs(u_p - u_g) * points.length[inside]
    values = formula(w, u_p, u_g, R, viscosity_cp(temperature), sigma)
    return float((values * weight).sum() / weight.sum())


@each("temperature", [313.15, 333.15, 353.15, 373.15])
def test_a_mineral_oil_gives_the_pair_of_he_a_friction_of_gear_practice(temperature: float) -> None:
    # what ground, oil-lubricated steel gears show; He et al. 2007 vary a constant from 0.01 to 0.3
    assert 0.02 < our_mean(temperature=temperature) < 0.06


def test_mean_friction_agrees_with_schlenk_and_xu_kahraman() -> None:
    ours = our_mean()
    # fits to other oils and rigs, 13 % apart from each other here; a quarter for the oil
    assert ours == pytest.approx(schlenk(), rel=0.25)
    assert ours == pytest.approx(mean_of(xu_kahraman), rel=0.25)
    # Benedict and Kelley's logarithm grows without bound towards the pitch line and with
    # roughness towards 1.13 um: an upper bound here
    assert ours < mean_of(benedict_kelley)


def test_an_oil_of_small_alpha_and_borrowed_eyring_stress_rubs_half_as_much() -> None:
    # karagiannis_2012: alpha 11.7 against 25.5 1/GPa at 80 degC, its Eyring stress of 2 MPa
    # completed from another table; 0.87 alpha tau0 is the larger part of the traction
    ratio = our_mean(oil="karagiannis_2012") / our_mean()
    assert 0.35 < ratio < 0.6


TRENDS = [
    ("rpm", [100.0, 300.0, 1000.0, 3000.0, 6000.0], -1),
    ("torque", [50.0, 100.0, 225.97, 500.0], 1),
    ("sigma", [0.1e-6, 0.3e-6, 0.5e-6, 0.8e-6], 1),
]


@each(("name", "values", "sign"), TRENDS)
def test_friction_changes_with_speed_load_and_roughness_as_the_formulas_say(
    name: str, values: list[float], sign: int
) -> None:
    means: dict[str, Callable[..., float]] = {
        "here": our_mean,
        "Schlenk": schlenk,
        "Benedict and Kelley": lambda **c: mean_of(benedict_kelley, **c),
        "Xu and Kahraman": lambda **c: mean_of(xu_kahraman, **c),
    }
    for source, mean in means.items():
        # Xu and Kahraman have friction level off at 500 N.m, by their thermal term
        used = values[:-1] if (source, name) == ("Xu and Kahraman", "torque") else values
        series = [mean(**{name: value}) for value in used]
        assert all(sign * step > 0.0 for step in np.diff(series)), source


def test_hotter_oil_rubs_less_as_thermal_ehl_says_and_viscosity_power_laws_do_not() -> None:
    temperatures = [313.15, 333.15, 353.15, 373.15]
    ours = [our_mean(temperature=T) for T in temperatures]
    ehl = [mean_of(xu_kahraman, temperature=T) for T in temperatures]
    assert ours == sorted(ours, reverse=True)
    assert ehl == sorted(ehl, reverse=True)
    # Schlenk's eta^-0.05 stands for thinner films that meet more asperities; the slope here lies
    # between the two
    power_law = [schlenk(temperature=T) for T in temperatures]
    assert power_law == sorted(power_law)
    assert ours[0] / ours[-1] < ehl[0] / ehl[-1]


# Jamali 2015, design A: 1.06 kN m, 235.62 rad/s, Mobil Jet 2; E' from E 207 GPa and nu 0.3
THESIS_E = 227.5e9
DESIGN_A = named_pair("jamali_2015_a")
ESTER = (0.00625, 13.3e-9)


def mid_cycle_line_load() -> float:
    """14.4 kN on the longest line, 0.93 of the face along the line."""
    return 14.4e3 / (0.93 * DESIGN_A.face_width / math.cos(DESIGN_A.base_helix_angle))


def test_smallest_films_of_design_a_are_those_of_its_ehl_solutions() -> None:
    w = mid_cycle_line_load()
    plane = DESIGN_A.plane
    films = []
    for x in np.linspace(plane.A + 5e-3, plane.D - 5e-3, 21):  # between the relieved tips
        motion = line_kinematics(x, 235.62, plane)
        films.append(minimum_line_film_thickness(motion.R, *ESTER, motion.entrainment, w, THESIS_E))
    middle = line_kinematics(plane.P, 235.62, plane)
    h = minimum_line_film_thickness(middle.R, *ESTER, middle.entrainment, w, THESIS_E)
    # sec. 4.6: 0.21 um in mid-cycle, step 300, F_o = 0; a regression of Newtonian line films
    assert h == pytest.approx(0.21e-6, rel=0.15)
    # 0.16 to 0.22 um over the cycle, the lower numbers at the edge of tip relief
    assert max(films) < 1.15 * 0.22e-6
    assert min(films) > 0.16e-6


def test_largest_pressure_of_the_smooth_line_of_chapter_7_is_hertz() -> None:
    # Table 7.1: 720 N on 2 mm, R = 14 mm; the pressure read there is 0.95 GPa
    p_0 = LARGEST_OVER_MEAN * line_mean_pressure(720.0 / 2e-3, 0.014, 0.5 * THESIS_E)
    assert p_0 == pytest.approx(0.95e9, rel=0.02)


@each("factor", [2.0, 5.0, 10.0])
def test_film_grows_with_speed_as_in_the_ehl_solutions(factor: float) -> None:
    arguments = (0.0148, *ESTER, 6.7, 3.3e5, THESIS_E)
    faster = (0.0148, *ESTER, 6.7 * factor, 3.3e5, THESIS_E)
    ratio = minimum_line_film_thickness(*faster) / minimum_line_film_thickness(*arguments)
    # sec. 5.3: exponent 0.68; Dowson 1968 has 0.70
    assert math.log(ratio) / math.log(factor) == pytest.approx(0.68, abs=0.0201)
