"""Mesh of two helical or spur gears on parallel shafts."""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass
from typing import Annotated, ClassVar

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.dynamics.helical_pair.march.flanks import N_FRICTION
from gearlube_core.dynamics.helical_pair.march.line_outputs import LINE_RECORDS
from gearlube_core.dynamics.helical_pair.march.mesh_data import pack_march_mesh, pair_data
from gearlube_core.dynamics.helical_pair.march.parameters import HelicalMarchParameters
from gearlube_core.dynamics.ranges import Range
from gearlube_core.dynamics.train.element import Axes, Listed
from gearlube_core.dynamics.train.elements.helical_mesh_kernels import (
    TABLE,
    HelicalMeshKernels,
    pair_data_at,
)
from gearlube_core.dynamics.train.elements.mesh_outputs import FILM_SHARE, MESH_OUTPUTS
from gearlube_core.dynamics.train.part import AxisPlace, Element
from gearlube_core.number import Number, Output

_ANGLE = Number(
    "rad",
    -2.0 * math.pi,
    2.0 * math.pi,
    text="Direction from the pinion's axis to the gear's, from x towards y",
    shown="deg",
)
_ARM = Number(
    "m", -10.0, 10.0, text="Place of mid-face along z, from the centre of the body", shown="mm"
)


@dataclass(frozen=True, slots=True, kw_only=True)
class HelicalMesh(Element):
    """Mesh of a pinion and a gear: the lubricated pair of [he_2007] between any two bodies.

    Parameters
    ----------
    name, pinion, gear : str
        Of the mesh, and of the bodies that carry its gears.
    parameters : HelicalMarchParameters
        Gears, stiffness and friction; its own bodies and supports give the damping of the mesh
        alone. Its oil's ranges hold, the oil itself is that of the train.
    angle : float
        Direction from the pinion's axis to the gear's, from x towards y [rad].
    drives_forward : bool
        Whether the pinion drives about +z; else about -z, as in the frame of [he_2007].
    right_hand : bool
        Whether the pinion's teeth are right-handed.
    pinion_arm, gear_arm : float
        Mid-face along z from the centre of each body [m].
    torque_of : str, optional
        Port whose torque selects the level of the line mesh; default: that of the mesh.

    Examples
    --------
    >>> from gearlube_core.dynamics.helical_pair.march import gear_file_march
    >>> from gearlube_core.helical_geometry.gear_file import HelicalGearFile
    >>> pair = gear_file_march.helical_march_parameters(HelicalGearFile.named("he_2007"))
    >>> mesh = HelicalMesh(name="stage 1", pinion="input", gear="counter", parameters=pair)
    >>> mesh.numbers().axes.over  # the pinion drives about -z
    1.0
    """

    name: str
    pinion: str
    gear: str
    parameters: HelicalMarchParameters
    angle: Annotated[float, _ANGLE] = math.pi / 2.0
    drives_forward: bool = False
    right_hand: bool = False
    pinion_arm: Annotated[float, _ARM] = 0.0
    gear_arm: Annotated[float, _ARM] = 0.0
    torque_of: str | None = None
    kind: ClassVar = "helical_mesh"
    interpreted: ClassVar = (Listed(HelicalMeshKernels, (), 11),)
    on: ClassVar = ("pinion", "gear")
    beside: ClassVar = ("torque_of",)
    states: ClassVar = (
        Output("rotation", "m", "base radius times rotation, pinion minus gear", 1e-5, "um"),
    )
    losses: ClassVar = ("friction", "mesh_damping")
    outputs: ClassVar = (
        *MESH_OUTPUTS,
        Output("load", "N", "normal load of the drive flanks less that of the coast flanks", 1e3),
        *(Output(f"force.{c}", "N", f"force along {c} on the pinion", 1e3) for c in "xyz"),
        Output("tilt", "rad", "tilt of the pinion against the gear", 1e-5),
        Output("friction_bound_relative", "1", "bound of the friction over it", 0.05),
        *LINE_RECORDS,
    )
    levels: ClassVar = ("load_torque",)
    events: ClassVar = (
        Output("event.drive_flank", "1", "bound of the deflection of the drive flanks over 1 um"),
        Output("event.coast_flank", "1", "bound of the deflection of the coast flanks over 1 um"),
        Output("event.friction_update", "1", "sine of pi times the updates of friction"),
    )

    def sizes(self) -> tuple[int, ...]:
        """Return the sizes of the line mesh."""
        packed = pack_march_mesh(self.parameters.mesh)
        levels, size = packed.density.shape
        data = self._pair_data().size
        return levels, size, int(pair_data_at(levels, size)), data

    def _pair_data(self) -> Array:
        given = self.parameters
        return pair_data(given.constants(), given.mesh, given.film_model())

    def numbers(self) -> HelicalMeshKernels:
        """Return the constants of the kernels."""
        plane = self.parameters.pair.plane
        centres = math.atan2(plane.r_bp + plane.r_bg, plane.x_g)
        x_axis = self.angle + centres if self.drives_forward else self.angle - centres
        axes = Axes.turned(x_axis, over=self.drives_forward, mirrored=self.right_hand)
        arms = float(self.pinion_arm), float(self.gear_arm)
        aligned = axes == Axes.turned(0.0) and arms == (0.0, 0.0)
        return HelicalMeshKernels(
            axes, *arms, float(self.parameters.steps_per_mesh_period), float(aligned)
        )

    def memory(self) -> Array:
        """Return the line mesh at all levels, the pair data and room for its lines."""
        packed = pack_march_mesh(self.parameters.mesh)
        table = packed.torque, packed.density.ravel(), packed.offset.ravel()
        return np.concatenate([np.zeros(TABLE), *table, self._pair_data()])

    def between_axes(self) -> list[AxisPlace]:
        """Return both bodies, and where the gear is."""
        pair = self.parameters.pair
        return [AxisPlace(self.pinion, self.gear, cmath.rect(pair.centre_distance, self.angle))]

    def ranges(self) -> tuple[Range, ...]:
        """Return the ranges of line mesh, oil and formulas, and that of solved films."""
        return (*self.parameters.ranges, FILM_SHARE)

    def kept_size(self) -> int:
        """Return the places of the load level, when friction was last computed, and its numbers."""
        return 1 + N_FRICTION
