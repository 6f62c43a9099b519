"""What Karagiannis et al. 2012 and Mohammadpour et al. 2015 say or imply of loaded contact."""

from __future__ import annotations

import numpy as np
import xarray as xr

from docs.page import FAILS, Claims, Verdict, judge
from docs.tooth_contact.measures import (
    LOAD,
    exponent,
    mean,
    pair_course,
    pairs,
    rises_then_falls,
    unloaded_mean,
    unloaded_span,
    variation,
)
from gearlube_core.contact.hertz import hertz_ellipse
from gearlube_core.contact.solid import STEEL_MOHAMMADPOUR_2015, contact_modulus
from gearlube_core.hypoid_contact.mesh_cycle import SIDES

PINION_INERTIA, GEAR_INERTIA = 1.734e-3, 5.81e-2  # kg m2, Karagiannis 2012, data below fig. 7
DAMPING, DAMPING_RATIO = 2278.1, 0.03  # N s/m and -, the same
_EDGE_SHARE = 0.15  # below it the pair carries at an edge
CLAIMS = Claims()


def implied_stiffness(dataset: xr.Dataset) -> float:
    """Return k0 = (c / (2 zeta))^2 / m_eq [N/m] of the papers, m_eq by their eq. (30)."""
    R_p, R_g = mean(dataset, "R_p", "drive"), mean(dataset, "R_g", "drive")
    equivalent_mass = 1.0 / (R_p**2 / PINION_INERTIA + R_g**2 / GEAR_INERTIA)
    return (DAMPING / (2.0 * DAMPING_RATIO)) ** 2 / equivalent_mass


def _torques(dataset: xr.Dataset) -> list[float]:
    return [float(t) for t in dataset["torque"].values]


@CLAIMS("1")
def most_pairs(dataset: xr.Dataset) -> Verdict:
    """At most three pairs."""
    most = {s: max(pairs(dataset, s, t)[1] for t in _torques(dataset)) for s in SIDES}
    average = " / ".join(f"{pairs(dataset, s)[0]:.2f}" for s in SIDES)
    return Verdict(
        f"{most['drive']} on drive, {most['coast']} on coast; mean at 50 N.m {average}",
        judge(max(most.values()) <= 3),
    )


@CLAIMS("2")
def radii_vary_little(dataset: xr.Dataset) -> Verdict:
    """Contact radii below 2 %."""
    torques = _torques(dataset)
    parts, failing = [], []
    for side in SIDES:
        values = [
            100.0 * max(variation(dataset, name, side, t) for name in ("R_p", "R_g"))
            for t in torques
        ]
        failing += [f"{t:g}" for t, v in zip(torques, values, strict=True) if v >= 2.0]
        parts.append(f"{side} {' / '.join(f'{v:.1f}' for v in values)} %")
    return Verdict(
        "; ".join(parts) + f" at {' / '.join(f'{t:g}' for t in torques)} N.m",
        judge(not failing, len(failing) < len(torques)),
    )


@CLAIMS("3")
def stiffness_level(dataset: xr.Dataset) -> Verdict:
    """Level of k_m at 50 N.m."""
    wanted = implied_stiffness(dataset)
    values = [mean(dataset, name, "drive") for name in ("k_m", "k_t")]
    off = [value / wanted - 1.0 for value in values]
    return Verdict(
        f"implied {1e-6 * wanted:.0f} N/um; secant {1e-6 * values[0]:.0f} ({100.0 * off[0]:+.0f} "
        f"%), tangent {1e-6 * values[1]:.0f} N/um ({100.0 * off[1]:+.0f} %)",
        judge(all(abs(o) < 0.3 for o in off), any(abs(o) < 0.3 for o in off)),
    )


@CLAIMS("4")
def stiffness_rises(dataset: xr.Dataset) -> Verdict:
    """Trend of k_m with torque."""
    torques = _torques(dataset)
    texts = []
    rising, flattening = True, True
    for side in SIDES:
        for name, what in (("k_m", "secant"), ("k_t", "tangent")):
            values = [mean(dataset, name, side, t) for t in torques]
            spans = [variation(dataset, name, side, t) for t in (50.0, torques[-1])]
            rising &= bool(np.all(np.diff(values) > 0.0))
            flattening &= spans[1] < spans[0]
            texts.append(f"{side} {what} T^{exponent(dataset, name, side, 20.0, 100.0):.2f}")
    return Verdict(", ".join(texts) + " from 20 to 100 N.m", judge(rising and flattening))


@CLAIMS("5")
def error_level(dataset: xr.Dataset) -> Verdict:
    """e0."""
    values = [1e6 * unloaded_mean(dataset, side) for side in SIDES]
    return Verdict(
        f"{values[0]:.2f} um drive, {values[1]:.2f} um coast",
        "calibrated" if all(abs(v / 0.96 - 1.0) < 0.05 for v in values) else FAILS,
    )


@CLAIMS("6")
def error_order(dataset: xr.Dataset) -> Verdict:
    """Mesh order dominates the unloaded error."""
    spectrum = np.abs(np.fft.rfft(dataset["e"].sel(side="drive").values))[1:]
    share = float(spectrum[0] ** 2 / np.sum(spectrum**2))
    return Verdict(
        f"first order has {100.0 * share:.0f} % of the power; "
        f"{1e6 * unloaded_span(dataset, 'drive'):.1f} um peak to peak",
        judge(share > 0.8),
    )


@CLAIMS("7")
def radius_course(dataset: xr.Dataset) -> Verdict:
    """R_zx over the cycle."""
    courses = {s: 1e3 * pair_course(dataset, "R_sliding", s) for s in SIDES}
    good = {s: rises_then_falls(course) for s, course in courses.items()}
    coast = courses["coast"]
    dip = 100.0 * (1.0 - coast[: np.argmax(coast)].min() / coast[0])
    return Verdict(
        "; ".join(f"{s} {c[0]:.0f}, {c.max():.0f}, {c[-1]:.0f} mm" for s, c in courses.items()),
        judge(all(good.values()), good["drive"]),
        f"entry, highest, exit; on coast it first falls by {dip:.0f} %",
    )


@CLAIMS("8")
def entrainment_course(dataset: xr.Dataset) -> Verdict:
    """Entrainment along sliding over the cycle."""
    speed, share = sliding_entrainment(dataset, "drive"), pair_course(dataset, "share", "drive")
    inner = speed[share > _EDGE_SHARE]
    whole, middle = rises_then_falls(speed), rises_then_falls(np.append(inner, speed[-1]))
    coast = sliding_entrainment(dataset, "coast")
    return Verdict(
        f"drive {1e3 * speed[0]:.1f}, least {1e3 * speed.min():.1f}, then highest "
        f"{1e3 * inner.max():.1f}, at the end {1e3 * speed[-1]:.1f} mm; coast falls from "
        f"{1e3 * coast[0]:.1f} to {1e3 * coast[-1]:.1f} mm",
        judge(whole, middle or inner.max() > 1.02 * inner.min()),
    )


def sliding_entrainment(dataset: xr.Dataset, side: str) -> np.ndarray:
    """Return the entrainment along the sliding direction over the pinion speed [m]."""
    ratio = dataset.attrs["gear_teeth"] / dataset.attrs["pinion_teeth"]
    pinion, gear = (pair_course(dataset, f"friction_arm_{m}", side) for m in "pg")
    return np.asarray(0.5 * (pinion + gear / ratio))


@CLAIMS("9")
def share_course(dataset: xr.Dataset) -> Verdict:
    """Load of a pair over its cycle."""
    tops, good = [], True
    for side in SIDES:
        share = pair_course(dataset, "share", side)
        top = np.argmax(share) / (share.size - 1)
        tops.append(f"{side} {share.max():.2f} at {top:.2f} of the cycle")
        good = good and rises_then_falls(share) and bool(abs(top - 0.5) < 0.1)
    return Verdict("; ".join(tops), judge(good))


@CLAIMS("10")
def ratio_on_average(dataset: xr.Dataset) -> Verdict:
    """R_g / R_p over the period."""
    teeth = dataset.attrs["gear_teeth"] / dataset.attrs["pinion_teeth"]
    quotient = (dataset["R_g"] / dataset["R_p"]).mean("phase") / teeth - 1.0
    off = {t: 100.0 * np.abs(quotient.sel(torque=t).values) for t in (LOAD, _torques(dataset)[-1])}
    texts = [f"{v[0]:.3f} / {v[1]:.3f} % at {t:g} N.m" for t, v in off.items()]
    return Verdict(
        "off by " + ", ".join(texts) + " (drive / coast)",
        judge(float(off[LOAD].max()) < 0.1),
    )


@CLAIMS("11")
def mid_flank_pressure(dataset: xr.Dataset) -> Verdict:
    """Pressures within the flank."""
    worst, texts = 0.0, []
    modulus = contact_modulus(STEEL_MOHAMMADPOUR_2015, STEEL_MOHAMMADPOUR_2015)
    for side in SIDES:
        for torque in (20.0, 50.0, 100.0, 200.0):
            share, R_x, R_y, found = (
                pair_course(dataset, name, side, torque)
                for name in ("share", "R_x", "R_y", "pressure_max")
            )
            top = int(np.argmax(share))
            load = share[top] * torque / mean(dataset, "R_p", side, torque)
            hertz = 1.5 * hertz_ellipse(R_x[top], R_y[top], modulus, load)[2]
            worst = max(worst, abs(float(found[top]) / hertz - 1.0))
            if torque == LOAD:
                texts.append(f"{side} {1e-9 * found[top]:.3f} GPa, by Hertz {1e-9 * hertz:.3f} GPa")
    return Verdict(
        "; ".join(texts) + f" at 50 N.m; 20 to 200 N.m within {100.0 * worst:.1f} %",
        judge(worst < 0.03),
    )
