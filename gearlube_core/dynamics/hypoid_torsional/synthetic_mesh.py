"""A synthetic mesh table from a few parameters, for parameter studies."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_positive, check_within
from gearlube_core.mesh_table.table import PAIRS, SERIES_UNITS, WINDOW_UNITS, MeshTable, Provenance

Harmonics = Sequence[tuple[float, float]]

_NODES = 60
# flank data of the shipped pair's size, only read with friction on
_WINDOWS = {
    "R_x": 11e-3,
    "R_y": 0.6,
    "psi": 0.0,
    "entrainment_arm": 25e-3,
    "friction_arm_p": 23e-3,
    "friction_arm_g": 32e-3,
    "xi_x": 1.0,
    "xi_y": 0.0,
    "xi_z": 0.0,
    "chi": 0.0,
    "pressure_max": 8e8,
}


def synthetic_mesh(
    *,
    stiffness: float = 4.55e8,
    pinion_radius: float = 21.1e-3,
    stiffness_harmonics: Harmonics = ((0.07, 0.0), (0.025, 0.0)),
    error_harmonics: Harmonics = ((0.96e-6, 0.0),),
    radius_mismatch: float = 0.0,
    radius_modulation: float = 0.0,
    contact_ratio: float = 2.4,
    pinion_teeth: int = 13,
    gear_teeth: int = 36,
    torque: float = 50.0,
) -> MeshTable:
    """Return a mesh table with a stated stiffness, error and radius variation.

    k = k0 (1 + sum a_h cos h z phi + b_h sin h z phi),  e = sum a_h cos h z phi + b_h sin h z phi
    R_p = R_p0 (1 + m cos z phi + d cos z phi),  R_g = R_p0 z_g/z_p (1 + m cos z phi)

    Parameters
    ----------
    stiffness : float
        k0 [N/m].
    pinion_radius : float
        R_p0 [m].
    stiffness_harmonics : sequence of (a, b)
        Over k0 [-], from mesh order 1.
    error_harmonics : sequence of (a, b)
        [m], from mesh order 1.
    radius_mismatch : float
        d, of the pinion alone [-]: worth a transmission error of R_p0 d/z_p.
    radius_modulation : float
        m, of both radii together [-].
    contact_ratio : float
        Length of contact in mesh periods, for the load shares [-]; 1.01 to 3.
    torque : float
        Of the one load level [N.m].

    Notes
    -----
    The defaults are reconstructed for Karagiannis et al. 2012, who print neither k0, R_p0 nor
    harmonics: R_p0 from the blank's pitch radii and spiral angles, k0 = (c/(2 zeta))^2/m_eq from
    the printed damping and damping ratio, harmonics of usual size. Choose radii "paper" to let a
    mismatch act. Shares are a half sine over the length of contact, normalised. Arms and radii
    of curvature are constants of the size of that pair.
    """
    check_positive("stiffness", stiffness, "N/m")
    check_positive("pinion_radius", pinion_radius, "m")
    check_within("radius_mismatch", radius_mismatch, -0.5, 0.5, "", "0.2 % is 0.002.")
    check_within("radius_modulation", radius_modulation, -0.5, 0.5, "", "1 % is 0.01.")
    check_within("contact_ratio", contact_ratio, 1.01, float(PAIRS))  # at 1 no pair may carry
    orders = max(len(stiffness_harmonics), len(error_harmonics), 1)
    gear_radius = pinion_radius * gear_teeth / pinion_teeth
    k = stiffness * _series(1.0, stiffness_harmonics, orders)
    series = {
        "k_m": k,
        "R_p": pinion_radius * _series(1.0, [(radius_modulation + radius_mismatch, 0.0)], orders),
        "R_g": gear_radius * _series(1.0, [(radius_modulation, 0.0)], orders),
        "n_x": _series(1.0, (), orders),
        "n_y": _series(0.0, (), orders),
        "n_z": _series(0.0, (), orders),
        "e": _series(0.0, error_harmonics, orders),
        "k_t": k,
    }
    windows = {key: np.full((1, _NODES), value) for key, value in _WINDOWS.items()}
    windows["share"] = _shares(contact_ratio)[None]
    return MeshTable(
        name="synthetic",
        pinion_teeth=pinion_teeth,
        gear_teeth=gear_teeth,
        torque=np.array([torque]),
        contact_ratio=contact_ratio,
        series=series,
        windows=windows,
        provenance={
            key: Provenance("completed", "stated by the caller")
            for key in (*SERIES_UNITS, *WINDOW_UNITS)
        },
    )


def _series(mean: float, harmonics: Harmonics, orders: int) -> Array:
    """Return coefficients of shape (1, orders + 1, 2)."""
    coefficients = np.zeros((1, orders + 1, 2))
    coefficients[0, 0, 0] = mean
    for h, pair in enumerate(harmonics, start=1):
        coefficients[0, h] = pair
    return coefficients


def _shares(contact_ratio: float) -> Array:
    """Return the load share of a pair over its window, which it fills from the middle."""
    position = np.arange(_NODES) * PAIRS / _NODES
    within = (position - 0.5 * (PAIRS - contact_ratio)) / contact_ratio
    inside = (within > 0.0) & (within < 1.0)
    weight = np.where(inside, np.sin(np.pi * np.clip(within, 0.0, 1.0)), 0.0)
    share = weight.reshape(PAIRS, _NODES // PAIRS)
    return np.asarray((share / share.sum(axis=0)).ravel())
