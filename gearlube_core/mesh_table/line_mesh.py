"""Elastic contact lines of a helical pair against mesh phase and load: plain data.

Contact analysis writes it, dynamics reads it. The load per unit length of the contact line is

    w = k (delta - e),  w >= 0

with delta the normal compression of the rigid members at the point.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_positive, check_within
from gearlube_core.errors import TableError


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LineMesh:
    """Stiffness density and offset along every contact line.

    Parameters
    ----------
    name, source : str
        Label, and how the data came about.
    pinion_teeth, gear_teeth : int
        [-]
    base_pitch : float
        Transverse [m]; together with the teeth it identifies the pair.
    torque : ndarray of shape (L,)
        Pinion torque of each level [N.m], rising, above zero.
    phase : ndarray of shape (N,)
        Mesh phases [mesh periods], equally spaced from 0, period 1 left out; see
        `helical_geometry.contact_line.line_position`.
    station : ndarray of shape (S,)
        Along a line's geometric segment [-], from 0 at z_low to 1 at z_high; one station stands
        for the whole line.
    density : ndarray of shape (L, N, lines, S)
        k, tangent dw/d(delta) [N/m2], not negative; normal to the flanks.
    offset : ndarray of shape (L, N, lines, S)
        e: compression at which the tangent spring carries nothing [m], counted from the first
        contact of the whole mesh cycle.
    provenance : dict of str to str
        Per datum: table, inferred or completed, with its derivation.

    Raises
    ------
    TableError
        Shapes differ or values are out of range.
    """

    name: str
    source: str
    pinion_teeth: int
    gear_teeth: int
    base_pitch: float
    torque: Array
    phase: Array
    station: Array
    density: Array
    offset: Array
    provenance: dict[str, str] = field(default_factory=dict)

    def __post_init__(self) -> None:
        for name in ("pinion_teeth", "gear_teeth"):
            check_within(name, getattr(self, name), 3, 1e4)
        check_positive("base_pitch", self.base_pitch, "m")
        for name in ("torque", "phase", "station", "density", "offset"):
            values = np.array(getattr(self, name), dtype=np.float64)
            if not np.isfinite(values).all():
                raise TableError(
                    f"{name} must be finite, but some entries are not. Write the file again."
                )
            values.setflags(write=False)
            object.__setattr__(self, name, values)
        shape = (self.torque.size, self.phase.size, self.density.shape[2], self.station.size)
        for name in ("density", "offset"):
            if getattr(self, name).shape != shape:
                raise TableError(
                    f"{name} must have shape (torque, phase, line, station) = {shape}, got "
                    f"{getattr(self, name).shape}."
                )
        if not (self.torque > 0.0).all() or (np.diff(self.torque) <= 0.0).any():
            raise TableError(f"torque must rise from above 0 N.m, got {self.torque}.")
        even = np.arange(self.phase.size) / self.phase.size
        if not np.allclose(self.phase, even, rtol=0.0, atol=1e-9):
            raise TableError(f"phase must divide 0 to 1 equally, got {self.phase}.")
        if (np.diff(self.station) <= 0.0).any() or self.station[0] < 0.0 or self.station[-1] > 1.0:
            raise TableError(f"station must rise within 0 to 1, got {self.station}.")
        if (self.density < 0.0).any():
            raise TableError("density must not be negative [N/m2]; some entries are.")

    @property
    def lines(self) -> int:
        """Number of contact lines."""
        return int(self.density.shape[2])


def uniform_line_mesh(
    *,
    name: str,
    source: str,
    pinion_teeth: int,
    gear_teeth: int,
    base_pitch: float,
    lines: int,
    density: float,
) -> LineMesh:
    """Return one density k [N/m2] everywhere, without offset: [he_2007 (2)]."""
    check_positive("density", density, "N/m2", "About 1.3e10 N/m2 is usual for steel.")
    shape = (1, 1, lines, 1)
    return LineMesh(
        name=name,
        source=source,
        pinion_teeth=pinion_teeth,
        gear_teeth=gear_teeth,
        base_pitch=base_pitch,
        torque=np.ones(1),
        phase=np.zeros(1),
        station=np.array([0.5]),
        density=np.full(shape, density),
        offset=np.zeros(shape),
        provenance={"density": "completed: one constant", "offset": "completed: zero"},
    )
