"""Inertia and supports of a gear, in SI units; limits of numbers that files and models share."""

from __future__ import annotations

from typing import Annotated, NamedTuple

from gearlube_core.number import Number

MASS = Number("kg", 1e-4, 1e6, text="Mass")
INERTIA = Number("kg.m2", 1e-9, 1e6)
POSITION = Number("m", -10.0, 10.0, "Give metres, not millimetres.")  # along the axis
STIFFNESS = Number("N/m", 0.0, 1e13)  # no bearing is as stiff
TILTING = Number("N.m/rad", 0.0, 1e13)
COUPLING = Number("N/rad", -1e13, 1e13)
BACKLASH = Number("m", 0.0, 1e-2, "100 um is 1e-4 m.")  # normal, of a pair
DAMPING_RATIO = Number("1", 0.0, 1.0, "Five percent is usual.")


class SupportStiffness(NamedTuple):
    """Springs of one shaft side and its bearing, at z = `position`."""

    position: Annotated[float, POSITION]  # from mid-face [m]
    K_xx: Annotated[float, STIFFNESS]  # [N/m]
    K_yy: Annotated[float, STIFFNESS]
    K_zz: Annotated[float, STIFFNESS]
    K_theta_x: Annotated[float, TILTING]  # [N.m/rad]
    K_theta_y: Annotated[float, TILTING]
    K_x_theta_y: Annotated[float, COUPLING]  # [N/rad]
    K_y_theta_x: Annotated[float, COUPLING]


class GearBody(NamedTuple):
    """One rigid gear."""

    mass: Annotated[float, MASS]  # [kg]
    polar_inertia: Annotated[float, INERTIA]  # J_z [kg.m2]
    diametral_inertia: Annotated[float, INERTIA]  # J_x = J_y [kg.m2]
    supports: tuple[SupportStiffness, ...]  # two, or none in a file without bearings
