"""Forces of the bearings along a motion."""

from __future__ import annotations

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.dynamics.helical_pair.kernel_parameters import SupportArrays

BEARING_FORCES = tuple(
    f"{kind}_{axis}{member}" for member in "pg" for kind in "FM" for axis in "xyz"
)


def bearing_forces(supports: SupportArrays, displacement: Array, rate: Array) -> Array:
    """Return forces and moments of both members' bearings on them, shape (N, 12) [N, N.m].

    F = -K u - c du/dt, in the order of `BEARING_FORCES`

    Parameters
    ----------
    supports
        Matrices of both members.
    displacement, rate : ndarray of shape (N, 11)
        Of the coordinates `linear_system.RELATIVE`, whose rotation no bearing feels.

    Notes
    -----
    Source: [he_2007 sec. 6], where du/dt is missing.
    """
    forces = np.zeros((displacement.shape[0], 12))
    for member in range(2):
        columns, first = slice(5 * member, 5 * member + 5), 6 * member
        forces[:, first : first + 6] = (
            -displacement[:, columns] @ supports.stiffness[member, :, :5].T
        )
        forces[:, first : first + 5] -= rate[:, columns] * supports.damping[member, :5]
    return forces
