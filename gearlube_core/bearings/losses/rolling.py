"""Power that a rolling contact loses, in the film and in the steel."""

from __future__ import annotations

import math

from gearlube_core.kernels.jit import kernel

HYSTERESIS = 0.005  # a_v, share of the elastic energy that rolling steel loses [-]


@kernel
def liebrecht_drag(
    density: float, nu: float, length: float, diameter: float, pitch: float, cage_speed: float
) -> float:
    """Return the torque that the oil bath exerts on the rollers of a bearing.

    T = 0.86 rho l D^0.164 nu^0.836 d_m^2.164 n_c^1.164

    Parameters
    ----------
    density, nu
        Of the oil [kg/m3], [m2/s].
    length, diameter
        l and D of a roller [m].
    pitch
        d_m [m].
    cage_speed
        n_c in turns per second [1/s], not negative.

    Returns
    -------
    float
        T [N m].

    Notes
    -----
    Right in dimension. The authors say that it is far too low for flooded bearings: at 4000 rpm it
    is below a thousandth of the torque of the measured one.
    Source: [wingertszahn_2023]
    """
    return 0.86 * density * length * diameter**0.164 * nu**0.836 * pitch**2.164 * cage_speed**1.164


@kernel
def rolling_power(force: float, speed: float, length: float) -> float:
    """Return the power that the film of a rolling line contact takes, 2 F u l [W].

    Parameters
    ----------
    force
        F on each of the two surfaces, per length [N/m].
    speed
        u, mean surface speed [m/s].
    length
        l of the line [m].

    Notes
    -----
    Both surfaces work against F: int h^3 p'^2/(12 eta) dx = u int h p' dx = 2 F u. The torque of a
    bearing is the sum of these powers over its shaft speed, which for tapered rollers is
    [zhou_hoeprich_1991 (42)]. One F u, as sometimes written, is half of it.
    """
    return 2.0 * force * speed * length


@kernel
def hysteresis_power(
    load: float, line_load: float, R: float, reduced_modulus: float, speed: float
) -> float:
    """Return the power that the steel of one rolling line contact takes [W].

    P = M u/R,  M = Q a_v 2 b/(3 pi),  b = [8 q R/(pi E')]^(1/2),  a_v = 0.005

    Parameters
    ----------
    load, line_load
        Q [N] and q = Q/l [N/m].
    R
        Relative radius of curvature [m]; u/R is the speed of one body relative to the other.
    reduced_modulus
        E' = 2 E* [Pa].
    speed
        u, mean surface speed [m/s].

    Notes
    -----
    a_v of hard bearing steel is not checked against the printed source.
    Source: [johnson_1985 sec. 9.1]
    """
    half_width = math.sqrt(8.0 * line_load * R / (math.pi * reduced_modulus))
    return load * HYSTERESIS * 2.0 * half_width / (3.0 * math.pi) * speed / R
