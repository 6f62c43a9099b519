"""Inertia and supports of a gear, in SI units."""

from __future__ import annotations

from typing import NamedTuple


class SupportStiffness(NamedTuple):
    """Springs of one shaft side and its bearing, at z = `position`."""

    position: float  # from mid-face [m]
    K_xx: float  # [N/m]
    K_yy: float
    K_zz: float
    K_theta_x: float  # [N.m/rad]
    K_theta_y: float
    K_x_theta_y: float  # [N/rad]
    K_y_theta_x: float


class GearBody(NamedTuple):
    """One rigid gear."""

    mass: float  # [kg]
    polar_inertia: float  # J_z [kg.m2]
    diametral_inertia: float  # J_x = J_y [kg.m2]
    supports: tuple[SupportStiffness, ...]  # two, or none in a file without bearings
