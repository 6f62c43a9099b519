"""The axle reduced to two inertias, for linear studies of the drivetrain."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from drivetrain.driveline.steady_state import GEAR_INERTIA, PINION_INERTIA
from gearlube_core.arrays import Array
from gearlube_core.checks import check_positive, check_within
from gearlube_core.errors import ParameterError

_Matrix = Array


@dataclass(frozen=True, slots=True, kw_only=True)
class TorsionalAxle:
    """The axle as two inertias, rigidly geared or with an elastic mesh.

    Parameters
    ----------
    pinion_inertia, gear_inertia : float
        By default [mohammadpour_2015 Table 1] [kg m2].
    mesh_stiffness : float
        Mesh stiffness about the pinion axis k R_p^2 [N m/rad]; infinite for a rigid mesh.
    mesh_damping : float
        c R_p^2 [N m s/rad].
    """

    pinion_inertia: float = PINION_INERTIA
    gear_inertia: float = GEAR_INERTIA
    mesh_stiffness: float = math.inf
    mesh_damping: float = 0.0

    def __post_init__(self) -> None:
        check_positive("pinion_inertia", self.pinion_inertia, "kg m2")
        check_positive("gear_inertia", self.gear_inertia, "kg m2")
        if not self.mesh_stiffness > 0.0:
            raise ParameterError(
                f"mesh_stiffness must be above 0 N m/rad, got {self.mesh_stiffness:g} N m/rad. "
                "Use math.inf for a rigid mesh."
            )
        check_within("mesh_damping", self.mesh_damping, 0.0, 1e6, "N m s/rad")

    @classmethod
    def karagiannis_2012(cls) -> TorsionalAxle:
        """Return the axle with an elastic mesh and a damping ratio of 0.03.

        Notes
        -----
        Karagiannis et al. 2012 give c = 2278.1 N s/m and zeta = 0.03 for the same gear pair. With
        the inertias and R_p = 21.1 mm of its pitch cones this is k = 4.55e8 N/m, 1.9 kHz.
        """
        arm = 21.1e-3**2
        return cls(mesh_stiffness=4.55e8 * arm, mesh_damping=2278.1 * arm)

    def matrices(self, ratio: float) -> tuple[_Matrix, _Matrix, _Matrix]:
        """Return A, B of the axle and the rows that give (pinion speed, wheel speed).

        Rigid: state w_p. Elastic: (a_p - i a_g, w_p, w_g). Inputs: T_p, T_w.
        """
        ip, ig, k, c = (
            self.pinion_inertia,
            self.gear_inertia,
            self.mesh_stiffness,
            self.mesh_damping,
        )
        if math.isinf(k):
            inertia = ip + ig / ratio**2
            return (
                np.zeros((1, 1)),
                np.array([[1.0, -1.0 / ratio]]) / inertia,
                np.array([[1.0], [1.0 / ratio]]),
            )
        a = np.array(
            [
                [0.0, 1.0, -ratio],
                [-k / ip, -c / ip, c * ratio / ip],
                [k * ratio / ig, c * ratio / ig, -c * ratio**2 / ig],
            ]
        )
        b = np.array([[0.0, 0.0], [1.0 / ip, 0.0], [0.0, -1.0 / ig]])
        return a, b, np.array([[0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])
