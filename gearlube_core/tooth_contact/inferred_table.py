"""A mesh table inferred from the blank and the constants of the papers.

Stands in for tooth contact analysis: every datum is tagged `inferred` and carries its derivation.
`python -m gearlube_core.tooth_contact.inferred_table` rewrites the table that ships.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

from gearlube_core.blank.hypoid_blank import HypoidBlank
from gearlube_core.contact.elliptical_hertz import hertz_ellipse
from gearlube_core.materials.solid import STEEL_MOHAMMADPOUR_2015, contact_modulus
from gearlube_core.mesh_table.netcdf import write_mesh_table
from gearlube_core.mesh_table.table import PAIRS, MeshTable, Provenance
from gearlube_core.tooth_contact.inferred_contact import (
    contact_ratio_bounds,
    kinematics_along_profile,
    relative_curvature_radius,
)

Array = NDArray[np.float64]

ORDERS = 5  # mesh orders kept of each series
NODES_PER_PITCH = 64
TORQUE_LEVELS = (5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 400.0)  # N.m at the pinion

# Karagiannis et al. 2012: c = 2278.1 N s/m with a damping ratio of 0.03 at the mesh mode.
DAMPING_PRINTED = 2278.1
DAMPING_RATIO_PRINTED = 0.03
TRANSMISSION_ERROR_MEAN = 0.96e-6  # m, Karagiannis et al. 2012, text of fig. 18
PINION_INERTIA = 1.734e-3  # kg m2, Mohammadpour et al. 2015, Table 1
GEAR_INERTIA = 5.81e-2  # kg m2, ditto
REFERENCE_TORQUE = 50.0  # N.m, pinion torque of Karagiannis et al. 2012
PATTERN_FRACTION = 0.5  # of the face width, filled by the ellipse at the highest torque


def contact_window(periods: Array, contact_ratio: float) -> Array:
    """Return the raised-cosine engagement of a pair `periods` mesh periods after its entry."""
    inside = (periods >= 0.0) & (periods <= contact_ratio)
    return np.where(inside, np.sin(math.pi * periods / contact_ratio) ** 2, 0.0)


def engagement_sum(periods: Array, contact_ratio: float) -> Array:
    """Return the sum of all pairs' engagements, periodic in one mesh period."""
    return sum(
        (contact_window(np.mod(periods, 1.0) + j, contact_ratio) for j in range(PAIRS)),
        start=np.zeros_like(periods),
    )


def fourier(function: Callable[[Array], Array], orders: int = ORDERS) -> Array:
    """Return the (orders + 1, 2) cosine and sine coefficients over one mesh period."""
    samples = 512
    spectrum = np.fft.rfft(function(np.arange(samples) / samples)) / samples
    result = np.stack([2.0 * spectrum.real, -2.0 * spectrum.imag], axis=1)[: orders + 1]
    result[0] = spectrum[0].real, 0.0
    return result


def mean_stiffness(R_p: float, R_g: float) -> float:
    """Return k0 = (c / 2 zeta)^2 / m_eq [N/m] from the printed damping and damping ratio."""
    m_eq = PINION_INERTIA * GEAR_INERTIA / (PINION_INERTIA * R_g**2 + GEAR_INERTIA * R_p**2)
    return (DAMPING_PRINTED / (2.0 * DAMPING_RATIO_PRINTED)) ** 2 / m_eq


def stiffness_trend(torque: Array) -> Array:
    """Return k_m / k0 against pinion torque [N.m]: half of the compliance Hertzian at reference.

    Bending deflects as F, a Hertzian point as F^(2/3): k/k0 = 2 / (1 + (T/T_ref)^(-1/3)).
    """
    return 2.0 / (1.0 + (torque / REFERENCE_TORQUE) ** (-1.0 / 3.0))


def crowning_radius(blank: HypoidBlank, R_x: float, load: float, modulus: float) -> float:
    """Return R_y [m] with which the ellipse under `load` [N] spans PATTERN_FRACTION of the face."""
    target = 0.5 * PATTERN_FRACTION * blank.gear.face_width

    def excess(log_R_y: float) -> float:
        return hertz_ellipse(R_x, math.exp(log_R_y), modulus, load)[1] - target

    return math.exp(brentq(excess, math.log(2.0 * R_x), math.log(1e4 * R_x), xtol=1e-12))


def inferred_mesh_table(blank: HypoidBlank) -> MeshTable:
    """Return the mesh table inferred from `blank` and the papers' constants.

    Notes
    -----
    Drive flank; the coast flank uses the same data. Provisional until tooth contact analysis.

    References
    ----------
    Mohammadpour et al. 2015, Table A1; Karagiannis et al. 2012, Table 1 and text.
    """
    z_p, z_g = blank.pinion.teeth, blank.gear.teeth
    torque = np.array(TORQUE_LEVELS)
    levels = torque.size
    modulus = contact_modulus(STEEL_MOHAMMADPOUR_2015, STEEL_MOHAMMADPOUR_2015)

    contact_ratio = 0.5 * sum(contact_ratio_bounds(blank))
    periods = np.arange(PAIRS * NODES_PER_PITCH) / NODES_PER_PITCH
    engagement = contact_window(periods, contact_ratio)
    share = engagement / engagement_sum(periods, contact_ratio)

    progress = np.clip(periods / contact_ratio, 0.0, 1.0)
    depth = -blank.gear.addendum + progress * blank.working_depth
    motion = kinematics_along_profile(blank, depth / math.cos(blank.normal_pressure_angle))
    normal = blank.drive_flank_normal()
    mean_point_arm = np.cross(blank.pinion_axis, blank.mean_point() - blank.pinion_apex)
    R_p0 = float(mean_point_arm @ normal)
    k0 = mean_stiffness(R_p0, R_p0 * blank.ratio)

    R_x, across = relative_curvature_radius(blank)
    R_y = crowning_radius(blank, R_x, float(share.max() * torque[-1] / R_p0), modulus)

    loaded = share > 0.0
    load = np.outer(torque / R_p0, share[loaded])
    peak = 1.5 * hertz_ellipse(R_x, R_y, modulus, 1.0)[2] * np.cbrt(load)
    pressure_max = np.array([np.interp(periods, periods[loaded], row) for row in peak])

    def transmission_error(t: Array) -> Array:
        return 3.0 * TRANSMISSION_ERROR_MEAN * (2.0 * _to_nearest(t - 0.5 * contact_ratio)) ** 2

    def stiffness(t: Array) -> Array:
        return engagement_sum(t, contact_ratio) / (0.5 * contact_ratio)

    error = fourier(transmission_error)
    order = np.arange(ORDERS + 1) * z_p
    error_rate = np.stack([order * error[:, 1], -order * error[:, 0]], axis=1)
    constant = np.zeros((ORDERS + 1, 2))
    constant[0, 0] = 1.0
    radius_g = blank.ratio * (R_p0 * constant - error_rate)

    k_m = k0 * stiffness_trend(torque)[:, None, None] * fourier(stiffness)
    series = {
        "k_m": k_m,
        "R_p": np.tile(R_p0 * constant, (levels, 1, 1)),
        "R_g": np.tile(radius_g, (levels, 1, 1)),
        "n_x": np.tile(normal[0] * constant, (levels, 1, 1)),
        "n_y": np.tile(normal[1] * constant, (levels, 1, 1)),
        "n_z": np.tile(normal[2] * constant, (levels, 1, 1)),
        "e": np.tile(error, (levels, 1, 1)),
        "k_t": k_m,
    }
    windows = {
        "share": share,
        "R_x": np.full_like(periods, R_x),
        "R_y": np.full_like(periods, R_y),
        "psi": motion.psi,
        "entrainment_arm": motion.entrainment_arm,
        "friction_arm_p": motion.friction_arm_p,
        "friction_arm_g": motion.friction_arm_g,
        "xi_x": motion.xi[:, 0],
        "xi_y": motion.xi[:, 1],
        "xi_z": motion.xi[:, 2],
        "chi": np.arccos(np.minimum(1.0, np.abs(motion.xi @ across))),
    }
    by_load = {key: np.tile(values, (levels, 1)) for key, values in windows.items()}
    return MeshTable(
        name=blank.name,
        pinion_teeth=z_p,
        gear_teeth=z_g,
        torque=torque,
        contact_ratio=contact_ratio,
        series=series,
        windows={**by_load, "pressure_max": pressure_max},
        provenance={key: Provenance("inferred", text) for key, text in _DERIVATIONS.items()},
        source="blank of Mohammadpour et al. 2015, Table A1; constants of Karagiannis et al. 2012",
    )


def _to_nearest(t: Array) -> Array:
    return t - np.round(t)


_KINEMATICS = (
    "rigid rotation of both members at points along the profile of the drive flank, from gear tip "
    "to pinion tip through the mean point; the flank's own normal and constant ratio"
)
_DERIVATIONS = {
    "k_m": (
        "mean: k0 = (c/(2 zeta))^2/m_eq with c = 2278.1 N s/m and zeta = 0.03 of Karagiannis 2012 "
        "at 50 N.m; variation: sum of raised-cosine pair engagements over the contact ratio; "
        "load: half of the compliance Hertzian (F^(2/3)) at 50 N.m"
    ),
    "R_p": "n . (j_p x r) at the mean point of the blank, mean blade angle as pressure angle",
    "R_g": "(R_p - de/dphi_p) z_g/z_p, so that e is the integral of the ratio mismatch",
    "n_x": "drive flank normal at the mean point of the blank",
    "n_y": "drive flank normal at the mean point of the blank",
    "n_z": "drive flank normal at the mean point of the blank",
    "e": (
        "parabola over a pitch, zero where a pair stands at mid-contact, of mean 0.96 um "
        "(Karagiannis 2012, text of fig. 18), cut after five orders"
    ),
    "k_t": "taken equal to the secant stiffness k_m",
    "share": "raised-cosine engagement over the contact ratio, normalised to sum to one",
    "R_x": "conjugate line contact with the Formate gear flank (straight profile, cutter radius)",
    "R_y": "contact ellipse of the most loaded pair spans half the face width at 400 N.m",
    "psi": _KINEMATICS,
    "entrainment_arm": _KINEMATICS,
    "friction_arm_p": _KINEMATICS,
    "friction_arm_g": _KINEMATICS,
    "xi_x": _KINEMATICS,
    "xi_y": _KINEMATICS,
    "xi_z": _KINEMATICS,
    "chi": _KINEMATICS,
    "pressure_max": "Hertz ellipse under the share of T/R_p; beyond contact the nearest value",
}


def main() -> None:
    """Rewrite the mesh table that ships with the package."""
    import gearlube_core.mesh_table as home

    folder = Path(str(home.__file__)).parent / "data"
    write_mesh_table(
        inferred_mesh_table(HypoidBlank.named("mohammadpour_2015")),
        folder / "mohammadpour_2015.nc",
    )


if __name__ == "__main__":
    main()
