"""Linear springs and dampers that carry a body."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Any, ClassVar, NamedTuple

from gearlube_core.arrays import Array
from gearlube_core.checks import check_within
from gearlube_core.dynamics.helical_pair.supports import COUPLING_CURE, coupling_limit
from gearlube_core.dynamics.train.element import RATE, Listed
from gearlube_core.dynamics.train.part import Element
from gearlube_core.helical_geometry.gear_body import COUPLING, STIFFNESS, TILTING
from gearlube_core.kernels.inlining import inside
from gearlube_core.kernels.jit import kernel
from gearlube_core.number import Number, Output, check_fields, constants_of
from gearlube_core.oil.lubricant_state import LubricantState

# of all bearings of a body together, up to 10 m from its centre
_STIFFNESS, _TILTING = STIFFNESS._replace(high=1e14), TILTING._replace(high=1e16)
_COUPLING = COUPLING._replace(low=-1e15, high=1e15)
_DAMPING = Number("N.s/m", 0.0, 1e11)
_TILT_DAMPING = Number("N.m.s/rad", 0.0, 1e12)
_ROUNDED_UP = 1.0 + 1e-12


def _worded(number: Number, text: str, shown: str = "") -> Number:
    return number._replace(text=text, shown=shown)


class SpringKernels(NamedTuple):
    """Constants of springs and dampers, and their kernels: see `element.Kernels`."""

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
    def add_forces(
        self, at: Any, memory: Array, s: Array, oil: LubricantState, stage: int, ds: Array
    ) -> None:
        """See `Kernels.add_forces`."""
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
        """See `Kernels.stored_energy`."""
        u = at[0]
        x, y, z, a_x, a_y = s[u], s[u + 1], s[u + 2], s[u + 3], s[u + 4]
        elastic = self.K_xx * x * x + self.K_yy * y * y + self.K_zz * z * z
        elastic += self.K_ax * a_x * a_x + self.K_ay * a_y * a_y
        return 0.5 * elastic + (self.K_x_ay * x * a_y + self.K_y_ax * y * a_x)

    @kernel
    def write(
        self, at: Any, memory: Array, s: Array, oil: LubricantState, out: Array, first: int
    ) -> None:
        """See `Kernels.write`."""
        u, v = at[0], at[0] + RATE
        x, y, z, a_x, a_y = s[u], s[u + 1], s[u + 2], s[u + 3], s[u + 4]
        out[first] = -(self.K_xx * x + self.K_x_ay * a_y + self.c_x * s[v])
        out[first + 1] = -(self.K_yy * y + self.K_y_ax * a_x + self.c_y * s[v + 1])
        out[first + 2] = -(self.K_zz * z + self.c_z * s[v + 2])
        out[first + 3] = -(self.K_ax * a_x + self.K_y_ax * y + self.c_ax * s[v + 3])
        out[first + 4] = -(self.K_ay * a_y + self.K_x_ay * x + self.c_ay * s[v + 4])


@dataclass(frozen=True, kw_only=True)
class Springs:
    """Stiffness and dampers of a support along and about its axes."""

    K_xx: Annotated[float, _worded(_STIFFNESS, "Stiffness along x", "N/um")] = 0.0
    K_yy: Annotated[float, _worded(_STIFFNESS, "Stiffness along y", "N/um")] = 0.0
    K_zz: Annotated[float, _worded(_STIFFNESS, "Stiffness along z", "N/um")] = 0.0
    K_ax: Annotated[float, _worded(_TILTING, "Stiffness against tilting about x")] = 0.0
    K_ay: Annotated[float, _worded(_TILTING, "Stiffness against tilting about y")] = 0.0
    K_x_ay: Annotated[float, _worded(_COUPLING, "Force along x per tilt about y", "kN/rad")] = 0.0
    K_y_ax: Annotated[float, _worded(_COUPLING, "Force along y per tilt about x", "kN/rad")] = 0.0
    c_x: Annotated[float, _worded(_DAMPING, "Damper along x")] = 0.0
    c_y: Annotated[float, _worded(_DAMPING, "Damper along y")] = 0.0
    c_z: Annotated[float, _worded(_DAMPING, "Damper along z")] = 0.0
    c_ax: Annotated[float, _worded(_TILT_DAMPING, "Damper against tilting about x")] = 0.0
    c_ay: Annotated[float, _worded(_TILT_DAMPING, "Damper against tilting about y")] = 0.0

    def check_couplings(self) -> None:
        """Raise ParameterError where a coupling is too large for the springs beside it."""
        for coupling, direct, tilting in (
            ("K_x_ay", self.K_xx, self.K_ay),
            ("K_y_ax", self.K_yy, self.K_ax),
        ):
            # of one bearing alone the coupling is as large as this, to rounding
            limit, cure = coupling_limit(direct, tilting) * _ROUNDED_UP, COUPLING_CURE
            check_within(coupling, getattr(self, coupling), -limit, limit, "N/rad", cure)


@dataclass(frozen=True, kw_only=True)
class SpringSupport(Springs, Element):
    """Linear springs and dampers of all bearings of a body together, against the ground.

    Parameters
    ----------
    name, body : str
    K_xx, K_yy, K_zz : float
        Stiffness against displacement [N/m], 0 to 1e14.
    K_ax, K_ay : float
        Against tilting about x and y [N.m/rad], 0 to 1e16.
    K_x_ay, K_y_ax : float
        Symmetric coupling of x with tilting about y, and of y with tilting about x [N/rad].
    c_x, c_y, c_z, c_ax, c_ay : float
        Dampers [N s/m], [N.m s/rad], not negative.

    Notes
    -----
    `support_stiffness` gives the stiffness of two bearings on a shaft, [he_2007 (28)].

    Examples
    --------
    >>> springs = SpringSupport(name="bearings", body="input", K_xx=4e8, K_yy=4e8, K_zz=1e8)
    >>> springs.numbers().K_xx
    400000000.0
    """

    name: str
    body: str
    kind: ClassVar = "spring_support"
    interpreted: ClassVar = (Listed(SpringKernels, (), 2),)
    linear: ClassVar = True
    on: ClassVar = ("body",)
    losses: ClassVar = ("bearing_damping",)
    outputs: ClassVar = (
        *(Output(f"force.{c}", "N", f"force along {c} on the body", 1e3) for c in "xyz"),
        *(Output(f"moment.{c}", "N.m", f"moment about {c} on the body", 10.0) for c in "xy"),
    )

    def __post_init__(self) -> None:
        check_fields(self)
        self.check_couplings()

    def numbers(self) -> SpringKernels:
        """Return the constants of the kernels."""
        return constants_of(SpringKernels, self)
