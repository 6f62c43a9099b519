"""Linear springs and dampers that carry a body."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar, NamedTuple

from gearlube_core.arrays import Array
from gearlube_core.dynamics.helical_pair.march.state import SupportConstants
from gearlube_core.dynamics.train.element import RATE
from gearlube_core.dynamics.train.part import Element
from gearlube_core.kernels.inlining import inside
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.lubricant import LubricantState


class _Support(NamedTuple):
    K_xx: float  # [N/m]
    K_yy: float
    K_zz: float
    K_ax: float  # against tilting about x [N.m/rad]
    K_ay: float
    K_x_ay: float  # symmetric coupling [N/rad]
    K_y_ax: float
    c_x: float  # [N s/m]
    c_y: float
    c_z: float
    c_ax: float  # [N.m s/rad]
    c_ay: float

    @inside
    def add_forces(self, at: Any, memory: Array, s: Array, oil: LubricantState, ds: Array) -> None:
        u, lost = at
        v = u + RATE
        x, y, z, a_x, a_y = s[u], s[u + 1], s[u + 2], s[u + 3], s[u + 4]
        v_x, v_y, v_z, w_x, w_y = s[v], s[v + 1], s[v + 2], s[v + 3], s[v + 4]
        ds[v] = ds[v] - self.K_xx * x - self.K_x_ay * a_y - self.c_x * v_x
        ds[v + 1] = ds[v + 1] - self.K_yy * y - self.K_y_ax * a_x - self.c_y * v_y
        ds[v + 2] = ds[v + 2] - self.K_zz * z - self.c_z * v_z
        ds[v + 3] = ds[v + 3] - self.K_ax * a_x - self.K_y_ax * y - self.c_ax * w_x
        ds[v + 4] = ds[v + 4] - self.K_ay * a_y - self.K_x_ay * x - self.c_ay * w_y
        power = self.c_x * v_x * v_x + self.c_y * v_y * v_y + self.c_z * v_z * v_z
        ds[lost] += power + self.c_ax * w_x * w_x + self.c_ay * w_y * w_y

    @kernel
    def stored_energy(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> float:
        u = at[0]
        x, y, z, a_x, a_y = s[u], s[u + 1], s[u + 2], s[u + 3], s[u + 4]
        elastic = self.K_xx * x * x + self.K_yy * y * y + self.K_zz * z * z
        elastic += self.K_ax * a_x * a_x + self.K_ay * a_y * a_y
        return 0.5 * elastic + (self.K_x_ay * x * a_y + self.K_y_ax * y * a_x)


@dataclass(frozen=True, slots=True, kw_only=True)
class Support(Element):
    """Springs and dampers of both bearings of a body, against the ground.

    Parameters
    ----------
    name : str
    body : str
    constants : SupportConstants
        Stiffness and damping; its mobilities are not read.
    """

    name: str
    body: str
    constants: SupportConstants
    on: ClassVar = ("body",)
    losses: ClassVar = ("bearing_damping",)

    def numbers(self) -> _Support:
        """Return the constants of the kernels."""
        return _Support(*self.constants[: len(_Support._fields)])
