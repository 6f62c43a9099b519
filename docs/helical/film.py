"""Friction of the oil film along the contact lines."""

from __future__ import annotations

import math

import numpy as np
import xarray as xr

from docs.helical.cases import HE
from gearlube_core.contact.greenwood_tripp_1971 import SurfaceParameters
from gearlube_core.contact.solid import STEEL_MOHAMMADPOUR_2015, solid_parameters
from gearlube_core.friction.line_integrals import LineFrictionCycle, friction_along_lines
from gearlube_core.friction.line_points import line_points, table_line_load, uniform_line_load
from gearlube_core.mesh_table.line_mesh import LineMesh
from gearlube_core.oil.lubricant import Lubricant
from tests.helpers.he_2007 import PINION_SPEED, PINION_TORQUE

OIL, OIL_TEMPERATURE, SIGMA = "mohammadpour_2015", 353.15, 0.5e-6  # -, K, m
RPM = math.pi / 30.0
_SOLID = solid_parameters(STEEL_MOHAMMADPOUR_2015, STEEL_MOHAMMADPOUR_2015)
_SURFACE = SurfaceParameters(SIGMA, 0.055, 0.001)
_PLANE = HE.plane
_POINTS = line_points(HE)


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
