"""A bearing type of another package, in one file: linear springs, whose forces and modes are known.

Nothing else names it. To import this file is to register the type, so tests do it in a process of
their own.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, NamedTuple

from gearlube_core.bearings.bearing_type import Bearing
from gearlube_core.kernels.jit import kernel
from gearlube_core.number import Number


@dataclass(frozen=True, kw_only=True)
class Springs(Bearing, name="springs", text="linear springs, the same in every direction"):
    """F = -k u and T = -c w of the two bearings of a shaft together."""

    stiffness: Annotated[
        float,
        Number(
            "N/m", 1e6, 1e10, shown="N/um", text="Stiffness k of both bearings", fmi="stiffness",
            source="a guess", factor=1.2,
        ),
    ] = 3e8  # fmt: skip
    drag: Annotated[
        float, Number("N.m.s/rad", 0.0, 1.0, text="Viscous drag c of both bearings", fmi="drag")
    ] = 0.0

    def parameters(self) -> SpringsOfShaft:
        """Return the floats for the kernels."""
        return SpringsOfShaft(self.stiffness, self.drag, 0.5 * self.stiffness)


class SpringsOfShaft(NamedTuple):
    """What the kernels take; all floats, SI."""

    stiffness: float
    drag: float
    each: float  # stiffness of one bearing
    cage_ratio: float = 0.0

    @kernel
    def shaft_forces(self, motion, f_ref, oil):
        k = self.each
        F = (-k * motion.r1, -k * motion.r2, -k * motion.axial)
        return F[0], F[1], F[2], F[0], F[1], F[2], 0.0

    @kernel
    def shaft_energy(self, motion, oil):
        square = motion.r1 * motion.r1 + motion.r2 * motion.r2 + motion.axial * motion.axial
        return self.each * square

    @kernel
    def shaft_drag(self, speed, axial_load, radial_load, law, oil):
        return 0.5 * self.drag * speed

    @kernel
    def write_derived(self, preload, out):
        out[2] = 0.5 * self.stiffness
