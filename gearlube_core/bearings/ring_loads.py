"""Forces between the rings of one rolling bearing from where the inner ring stands in the outer.

A bearing is a NamedTuple of floats whose kernels are those of `Rings`. Coordinates: z along the
axis, angles about axes fixed in space. Element i stands at cage_angle + 2 pi i/N from x towards y.
"""

from __future__ import annotations

from typing import NamedTuple, Protocol

from gearlube_core.arrays import Array
from gearlube_core.kernels.by_class import by_class
from gearlube_core.kernels.jit import kernel

N_RING = 5  # x, y, z, rx, ry
# Pa, of a bearing under a usual load, for what stiffness one without load may come to have
REFERENCE_PRESSURE = 1.5e9


class RingMotion(NamedTuple):
    """The inner ring relative to the outer one, in the middle of the bearing; all floats."""

    x: float  # displacement [m]
    y: float
    z: float
    rx: float  # tilt [rad]
    ry: float
    v_x: float  # rates [m/s]
    v_y: float
    v_z: float
    w_x: float  # [rad/s]
    w_y: float
    cage_angle: float  # of element 0 [rad]
    cage_speed: float  # [rad/s]


class RingLoads(NamedTuple):
    """Load of the elements between the rings; all floats."""

    f_x: float  # force on the inner ring [N]
    f_y: float
    f_z: float
    m_x: float  # moment on it about the middle of the bearing [N.m]
    m_y: float
    lost: float  # power of the damping, not negative [W]
    energy: float  # elastic [J]
    largest: float  # load of an element [N]
    loaded: float  # how many elements carry load
    low: float  # balls: least sine of a contact angle under load; rollers: 0
    high: float  # balls: largest such sine; rollers: largest load per length [N/m]


class Rings(Protocol):
    """One bearing; a NamedTuple of floats with these methods, which are kernels."""

    @property
    def n_elements(self) -> float:
        """Balls or rollers, a whole number of 3 to ROLLERS_MAX."""

    @property
    def spring(self) -> float:
        """About the radial stiffness with all elements at REFERENCE_PRESSURE [N/m]."""

    @property
    def cage_ratio(self) -> float:
        """Cage speed over the speed of the inner ring, with the outer one at rest [-]."""

    def ring_loads(self, motion: RingMotion, damping_time: float, gaps: Array) -> RingLoads:
        """Return forces, elastic energy, lost power and the loads of the elements.

        Parameters
        ----------
        motion : RingMotion
        damping_time : float
            Damper over tangent stiffness of every contact [s].
        gaps : ndarray of shape (laminae,)
            Gap of each lamina of a roller in the middle position [m]; empty for balls.
        """

    def ring_stiffness(self, motion: RingMotion, gaps: Array, out: Array) -> None:
        """Write -d(force)/d(displacement) without damping, shape (25,), row by row."""

    def ring_pressure(self, loads: RingLoads) -> float:
        """Return the largest Hertz pressure on the inner ring [Pa]."""

    def write_of_rings(self, loads: RingLoads, out: Array, first: int) -> None:
        """Write the outputs that this type has of its own into `out` from place `first` on."""


ring_loads = by_class()(Rings.ring_loads)
ring_stiffness = by_class()(Rings.ring_stiffness)
ring_pressure = by_class()(Rings.ring_pressure)
write_of_rings = by_class()(Rings.write_of_rings)


@kernel
def moment_on_cage(motion: RingMotion, loads: RingLoads) -> float:
    """Return the moment of the elements on their cage about z [N.m].

    T_c = y F_x - x F_y + ry M_x - rx M_y = -dV/d(cage angle) without damping

    Where the cage turns with r of the inner ring's speed and 1 - r of the outer one's, r T_c on the
    inner and (1 - r) T_c on the outer ring close the energy balance and that of the moments.
    """
    m = motion
    turned = m.y * loads.f_x - m.x * loads.f_y
    return turned + m.ry * loads.m_x - m.rx * loads.m_y


@kernel
def add_stiffness(out: Array, stiffness: float, direction: tuple[float, ...]) -> None:
    """Add stiffness g g^T of a direction g of five numbers to a matrix of shape (25,)."""
    for i in range(N_RING):
        for j in range(N_RING):
            out[N_RING * i + j] += stiffness * direction[i] * direction[j]
