"""Statements H9 to H21 of He et al. 2007: steady vibration at 1000 rpm, mu = 0.01 and 0.1.

Ratios and orders are compared: stiffness density and bearings are completed, amplitudes with them.
"""

from __future__ import annotations

import numpy as np

from docs.helical.cases import (
    HIGH,
    LOW,
    ORDERS,
    Evidence,
    at_orders,
    growth,
    steady,
    steady_with_helix,
)
from docs.helical.structure import six_against_twelve
from docs.page import Claims, Verdict, judge
from gearlube_core.dynamics.helical_pair.linear.linear_system import (
    linear_system,
    natural_frequencies,
)
from gearlube_core.dynamics.helical_pair.linear.periodic_response import harmonics
from tests.helpers.he_2007 import he_2007_pair

CALIBRATED = "calibrated"
_UNCHANGED = (4, 5, *range(7, ORDERS + 1))
_SECOND_ORDER = (4, 8, 12)  # in mu: no first-order term off the line of action
_LINEAR_FROM = np.array([0.1, 0.15, 0.2, 0.25, 0.3])
MOTION = Claims()


@MOTION("H9")
def _off_line(_: Evidence) -> Verdict:
    kept = [n for n in range(1, ORDERS + 1) if n not in _SECOND_ORDER]
    ratios = np.concatenate([at_orders(growth(name), *kept) for name in ("u_yp", "u_yg")])
    every = np.concatenate([growth(name) for name in ("u_yp", "u_yg")])
    return Verdict(
        f"{ratios.min():.2f} to {ratios.max():.2f} times; all 15 orders "
        f"{every.min():.1f} to {every.max():.1f}",
        judge(bool(np.abs(ratios - 10.0).max() < 0.1), bool(np.abs(ratios - 10.0).max() < 1.0)),
    )


@MOTION("H10")
def _along_line(_: Evidence) -> Verdict:
    ratio = growth("u_xp")
    first, rest = at_orders(ratio, 1, 2), at_orders(ratio, *_UNCHANGED)
    return Verdict(
        f"n = 1, 2: {first[0]:.1f}, {first[1]:.1f} times; n = 4, 5, 7 to 15: "
        f"{rest.min():.2f} to {rest.max():.2f}; n = 3, 6: {ratio[2]:.2f}, {ratio[5]:.2f}",
        judge(bool(first.min() > 5.0 and np.abs(rest - 1.0).max() < 0.2), first.min() > 5.0),
    )


@MOTION("H11")
def _axial(_: Evidence) -> Verdict:
    ratio = growth("u_zp")
    resonance, first = at_orders(ratio, 7, 8, 9), at_orders(ratio, 1, 2)
    insensitive = bool(np.abs(resonance - 1.0).max() < 0.1) and first.min() > 5.0
    least = bool((np.abs(ratio - 1.0) < np.abs(growth("u_xp") - 1.0) - 1e-6)[2:].all())
    return Verdict(
        f"n = 7, 8, 9: {', '.join(f'{r:.3f}' for r in resonance)}; n = 1, 2: {first[0]:.1f}, "
        f"{first[1]:.1f} times",
        judge(insensitive and least, insensitive),
    )


@MOTION("H12")
def _resonances(_: Evidence) -> Verdict:
    orders = natural_frequencies(linear_system(he_2007_pair(0.0))) * steady(0.0).period
    orders = orders / (2.0 * np.pi)
    return Verdict("n = " + ", ".join(f"{n:.2f}" for n in orders), CALIBRATED)


@MOTION("H13")
def _elastic_bearings(_: Evidence) -> Verdict:
    response = steady(HIGH)
    parameters = response.parameters
    force, motion = harmonics(response.bearing_force), harmonics(response.displacement)
    K = parameters.support_arrays().stiffness
    ratios, offs = [], []
    for member, mass in enumerate((parameters.pinion_mass, parameters.gear_mass)):
        natural = np.sqrt(K[member, 0, 0] / mass)
        speed = 2.0 * np.pi * np.arange(1, ORDERS + 1) / response.period / natural
        zeta = parameters.support_damping_ratio
        for axis in range(3):
            ratio = force[:, 6 * member + axis] / motion[:, 5 * member + axis] / K[member, 0, 0]
            ratios.append(ratio)
            offs.append(np.abs(ratio / np.sqrt(1.0 + (2.0 * zeta * speed) ** 2) - 1.0))
    largest = float(np.max(ratios))
    return Verdict(
        f"force over K u at most {largest:.4f}",
        judge(largest < 1.02 and float(np.max(offs)) < 1e-3),
    )


@MOTION("H14")
def _below_spur(_: Evidence) -> Verdict:
    parts, least = [], np.inf
    for mu in (LOW, HIGH):
        helical = np.ptp(steady(mu).bearing_force, axis=0)
        spur = np.ptp(steady_with_helix(mu, 0.0).bearing_force, axis=0)
        ratios = spur[[0, 1, 6, 7]] / helical[[0, 1, 6, 7]]
        least = min(least, float(ratios.min()))
        parts.append(f"{ratios[0]:.0f} / {ratios[1]:.0f} times at mu = {mu:g}")
    return Verdict(
        "spur over helical, x / y: " + ", ".join(parts),
        judge(least > 10.0, least > 1.0),
    )


@MOTION("H15")
def _transmission_error(_: Evidence) -> Verdict:
    ratio, amplitude = growth("delta_z"), harmonics(steady(HIGH).signal("delta_z"))
    dominant = amplitude[0] / amplitude[1:].max()
    others = np.delete(ratio, 1)
    return Verdict(
        f"n = 1: {ratio[0]:.3f}, n = 2: {ratio[1]:.2f} times, others {others.min():.2f} to "
        f"{others.max():.2f}; n = 1 is {dominant:.1f} times the next",
        judge(
            bool(0.9 < ratio[0] < 1.1 and ratio[1] > 3.0 and np.argmax(ratio) == 1 and dominant > 1)
        ),
    )


@MOTION("H16")
def _composites(_: Evidence) -> Verdict:
    ratios = {name: growth(name) for name in ("delta_x", "delta_y")}
    second = all(np.argmax(r) == 1 and r[1] > 5.0 for r in ratios.values())
    first = all(np.argsort(r)[-2] == 0 for r in ratios.values())
    return Verdict(
        "; ".join(f"{n}: n = 1, 2: {r[0]:.1f}, {r[1]:.1f} times" for n, r in ratios.items()),
        judge(second and first, second),
    )


@MOTION("H17")
def _two_orders(_: Evidence) -> Verdict:
    ratios = []
    for mu in (LOW, HIGH):
        size = {n: harmonics(steady(mu).signal(n))[0] for n in ("delta_x", "delta_y", "delta_z")}
        ratios += [size["delta_z"] / size["delta_x"], size["delta_z"] / size["delta_y"]]
    return Verdict(
        f"n = 1: {ratios[0]:.0f} / {ratios[1]:.0f} times delta_x / delta_y at mu = 0.01, "
        f"{ratios[2]:.0f} / {ratios[3]:.0f} at 0.1",
        judge(min(ratios) > 100.0, max(ratios) > 100.0),
    )


@MOTION("H18")
def _six_dof(_: Evidence) -> Verdict:
    found = {mu: max(six_against_twelve(mu).values()) for mu in (LOW, HIGH)}
    every = max(max(six_against_twelve(mu, ORDERS).values()) for mu in (LOW, HIGH))
    return Verdict(
        "x, y, n <= 6: within "
        + ", ".join(f"{100.0 * v:.1f} % (mu = {mu:g})" for mu, v in found.items()),
        judge(max(found.values()) < 0.1, max(found.values()) < 0.3),
        f"n <= 15: {100.0 * every:.0f} %",
    )


@MOTION("H20")
def _crossing(_: Evidence) -> Verdict:
    ratio = growth("delta_z", rate=True)
    return Verdict(
        f"n = 2 grows {ratio[1]:.2f} times, the others at most {np.delete(ratio, 1).max():.2f}",
        judge(bool(ratio[1] > 3.0), bool(np.argmax(ratio) == 1)),
    )


@MOTION("H21")
def _linear_in_mu(_: Evidence) -> Verdict:
    size = np.array([harmonics(steady(float(m)).signal("u_xp"))[0] for m in _LINEAR_FROM])
    line = np.polyval(np.polyfit(_LINEAR_FROM, size, 1), _LINEAR_FROM)
    off = float(np.abs(line / size - 1.0).max())
    return Verdict(f"off a straight line by {100.0 * off:.2f} %", judge(off < 0.02))
