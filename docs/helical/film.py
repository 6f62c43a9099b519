"""Friction of the oil film along the contact lines, beside constants and gear-practice formulas.

The formulas are those of Schlenk 1995, of Benedict and Kelley 1961, and of Xu and Kahraman 2007.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import xarray as xr

from docs.helical.cases import HE
from docs.published_friction import schlenk, xu_kahraman
from gearlube_core.arrays import Array
from gearlube_core.contact.greenwood_tripp_1971 import SurfaceParameters
from gearlube_core.contact.solid import STEEL_MOHAMMADPOUR_2015, solid_parameters
from gearlube_core.friction.line_integrals import LineFrictionCycle, friction_along_lines
from gearlube_core.friction.line_points import line_points, table_line_load, uniform_line_load
from gearlube_core.mesh_table.line_mesh import LineMesh
from gearlube_core.oil.lubricant import Lubricant
from gearlube_core.units import ZERO_CELSIUS
from tests.helpers.he_2007 import PINION_SPEED, PINION_TORQUE

OIL, OIL_TEMPERATURE, SIGMA = "mohammadpour_2015", 353.15, 0.5e-6  # -, K, m
RPM = math.pi / 30.0
_SOLID = solid_parameters(STEEL_MOHAMMADPOUR_2015, STEEL_MOHAMMADPOUR_2015)
_SURFACE = SurfaceParameters(SIGMA, 0.055, 0.001)
_PLANE = HE.plane
_POINTS = line_points(HE)

SPEEDS = (100.0, 300.0, 1000.0, 3000.0, 6000.0)  # rpm
TEMPERATURES = (313.15, 333.15, 353.15, 373.15)  # K
Local = Callable[[Array, Array, Array, Array, float], Array]


def cycle(
    rpm: float, temperature: float, mesh: LineMesh | None = None, oil: str = OIL
) -> LineFrictionCycle:
    """Return the friction along the lines, loads even or those of elastic lines."""
    load = (
        uniform_line_load(_POINTS, PINION_TORQUE)
        if mesh is None
        else table_line_load(_POINTS, mesh, PINION_TORQUE)
    )
    return friction_along_lines(
        _POINTS,
        load,
        pinion_speed=rpm * RPM,
        pinion_torque=PINION_TORQUE,
        lubricant=Lubricant.named(oil),
        oil_temperature=temperature,
        surface=_SURFACE,
        solid=_SOLID,
    )


def formula_rows() -> tuple[list[list[str]], tuple[str, ...]]:
    """Return mean coefficients beside those of gear practice, and the ranges of their ratios."""
    rows, ratios = [], []
    points = [(rpm, OIL_TEMPERATURE) for rpm in SPEEDS]
    points += [(PINION_SPEED / RPM, T) for T in TEMPERATURES if T != OIL_TEMPERATURE]
    for rpm, T in points:
        found = cycle(rpm, T)
        here, formulas = found.mean_coefficient, (
            _schlenk(rpm, T), _mean_of(_xu_kahraman, rpm, T), _mean_of(_benedict_kelley, rpm, T),
        )  # fmt: skip
        ratios.append((here / formulas[0], here / formulas[1]))
        rows.append(
            [
                f"{rpm:.0f}",
                f"{T - ZERO_CELSIUS:.0f}",
                *(f"{mu:.4f}" for mu in (here, *formulas)),
                f"{1e6 * found.smallest_film.thickness:.2f}",
            ]
        )
    ends = [end for both in zip(*ratios, strict=True) for end in (min(both), max(both))]
    return rows, tuple(f"{end:.2f}" for end in ends)


def along_row(mesh: LineMesh | None) -> list[str]:
    """Return friction over a mesh period at the operating point, loads even or those of a mesh."""
    found = cycle(PINION_SPEED / RPM, OIL_TEMPERATURE, mesh)
    pressed = (_POINTS.length > 0.0) & (found.line_load > 0.0)
    away = pressed & (np.abs(_POINTS.x - _PLANE.P) > 1e-3)
    weight = found.line_load * _POINTS.length
    local = np.abs(found.coefficient)[away]
    side = np.sign(_POINTS.x - _PLANE.P)
    forces = (found.coefficient * weight, found.mean_coefficient * side * weight)
    return [
        f"{found.mean_coefficient:.4f}",
        f"{local.min():.4f} to {local.max():.4f}",
        f"{found.mean_power_loss:.1f}",
        f"{found.loss_factor:.4f}",
        *(f"{np.ptp(force.sum(axis=(1, 2))):.1f}" for force in forces),
        f"{found.temperature_rise[pressed].max():.0f}",
    ]


def stable_words(stability: xr.Dataset) -> tuple[str, ...]:
    """Return the least variation with the pair's and with light damping, and the largest ratio.

    At these the mesh's variation alone makes the pair unstable; the last is the mesh frequency
    [Hz] at the first.
    """
    found, frequency = [], 0.0
    for name, axis in (
        ("growth_variation", "variation"),
        ("growth_variation_light", "variation"),
        ("growth_damping", "damping_ratio"),
    ):
        growth = stability[name].values
        some = np.flatnonzero((growth > 0.0).any(axis=1))
        at = int(some[0 if axis == "variation" else -1])
        found.append(f"{stability[axis].values[at]:.3g}")
        frequency = frequency or float(stability["mesh_frequency"][int(growth[at].argmax())])
    return (*found, f"{frequency:.0f}")


def _viscosity(temperature: float) -> float:
    """Return the dynamic viscosity in mPa s."""
    return 1e3 * Lubricant.named(OIL).dynamic_viscosity(temperature)


def _schlenk(rpm: float, temperature: float) -> float:
    """Schlenk's mean over the mesh, with load and speeds at the pitch point."""
    load = PINION_TORQUE / HE.pinion_base_radius / HE.face_width * 1e-3
    rho = 1e3 * _PLANE.P * (_PLANE.x_g - _PLANE.P) / _PLANE.x_g / _PLANE.cos_b
    speed = 2.0 * _PLANE.P * rpm * RPM
    return float(schlenk(load, speed * rho, _viscosity(temperature), SIGMA))


def _benedict_kelley(w: Array, u_p: Array, u_g: Array, R: Array, nu: float) -> Array:
    """0.0127 1.13/(1.13 - S) log10[29700 w/(nu |v_s| v_r^2)], N/mm, mPa s, m/s, um."""
    del R
    group = 29700.0 * 1e-3 * w / (nu * np.abs(u_p - u_g) * (u_p + u_g) ** 2)
    return np.asarray(0.0127 * 1.13 / (1.13 - 1e6 * SIGMA) * np.log10(group))


def _xu_kahraman(w: Array, u_p: Array, u_g: Array, R: Array, nu: float) -> Array:
    u = 0.5 * (u_p + u_g)
    p = 1e-9 * np.sqrt(w * _SOLID.contact_modulus / (math.pi * R))
    return xu_kahraman(p, np.abs(u_p - u_g) / u, u, nu, R, SIGMA)


def _mean_of(formula: Local, rpm: float, temperature: float) -> float:
    """Return the mean of a local formula, weighted with w |u_s| as lost power is."""
    inside = _POINTS.length > 0.0
    w, x = uniform_line_load(_POINTS, PINION_TORQUE)[inside], _POINTS.x[inside]
    u_p = x * rpm * RPM
    u_g = (_PLANE.x_g - x) * rpm * RPM * _PLANE.r_bp / _PLANE.r_bg
    R = x * (_PLANE.x_g - x) / _PLANE.x_g / _PLANE.cos_b
    weight = w * np.abs(u_p - u_g) * _POINTS.length[inside]
    values = formula(w, u_p, u_g, R, _viscosity(temperature))
    return float((values * weight).sum() / weight.sum())
