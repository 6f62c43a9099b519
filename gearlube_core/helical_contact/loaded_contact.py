"""Loaded contact of all tooth pairs of a helical pair at one mesh phase."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from scipy.sparse import csr_array, hstack

from gearlube_core.arrays import Array
from gearlube_core.checks import check_finite, check_positive, check_within
from gearlube_core.helical_contact.strips import (
    LineGap,
    LineStrip,
    StripSettings,
    cut_strip,
    line_gap,
)
from gearlube_core.helical_contact.tooth_body import flank_position, tooth_form
from gearlube_core.helical_geometry.contact_line import line_count, line_position
from gearlube_core.helical_geometry.modification import ModifiedPair
from gearlube_core.helical_geometry.pair import HelicalPair
from gearlube_core.tooth_compliance.flank_compliance import interpolation_weights
from gearlube_core.tooth_contact.coupled_strips import (
    CoupledSolution,
    CoupledStrip,
    PairStiffness,
    StripGrowth,
    solve_coupled,
    solve_on_growing_strips,
)

_GROWTH = StripGrowth(factor=1.5, margin=1.1, attempts=10)
_FIRST_DENSITY = 1.2e10  # N/m2 of contact line, only to size the first strips
_WIDE = 1.7  # half-width of a strip over the half-width of Hertz' line contact


@dataclass(frozen=True, slots=True, kw_only=True)
class LoadedSettings:
    """Resolution of loaded contact.

    Parameters
    ----------
    strips : StripSettings
    tolerance : float
        Of the unilateral contact's residual [-].
    """

    strips: StripSettings = field(default_factory=StripSettings)
    tolerance: float = 1e-5

    def __post_init__(self) -> None:
        check_within("tolerance", self.tolerance, 1e-10, 1e-3)


@dataclass(frozen=True, slots=True)
class LoadedLine:
    """Load and contact of one tooth pair.

    Parameters
    ----------
    strip : LineStrip
    forces, pressure, tangents : ndarray of shape (nx, ny)
        Normal forces [N], pressure [Pa], and d(forces)/d(rotation) [N/rad].
    """

    strip: LineStrip
    forces: Array
    pressure: Array
    tangents: Array

    @property
    def torque(self) -> float:
        """Part of the pinion torque [N.m]."""
        return float(np.sum(self.forces * self.strip.arm))

    @property
    def gear_torque(self) -> float:
        """Part of the gear torque [N.m]."""
        return float(np.sum(self.forces * self.strip.gear_arm))

    @property
    def line_load(self) -> Array:
        """Normal force per length of the contact line at the strip's rows [N/m], (ny,)."""
        return np.asarray(self.forces.sum(axis=0) / self.strip.cell[1])

    @property
    def loaded_extent(self) -> tuple[float, float]:
        """Lowest and highest z under load [m], NaN without load; whole cells."""
        rows = np.flatnonzero((self.forces > 0.0).any(axis=0))
        if not rows.size:
            return math.nan, math.nan
        z = self.strip.z
        half = 0.5 * (z[1] - z[0])
        return float(z[rows[0]] - half), float(z[rows[-1]] + half)


@dataclass(frozen=True, slots=True)
class LoadedState:
    """Equilibrium at one mesh phase and pinion torque.

    Parameters
    ----------
    phase : float
        Mesh phase [mesh periods].
    torque : float
        Pinion torque [N.m].
    rotation : float
        Theta: pinion rotation from where unmodified rigid flanks touch, in the sense of its
        torque, the gear held [rad].
    unloaded_rotation : float
        The same to first touch, without load.
    strain_energy : float
        [J]
    tangent : float
        d(torque)/d(rotation) [N.m/rad].
    lines : tuple of LoadedLine
        Tooth pairs within reach, loaded or not, by rising number.
    iterations : int
    """

    phase: float
    torque: float
    rotation: float
    unloaded_rotation: float
    strain_energy: float
    tangent: float
    lines: tuple[LoadedLine, ...]
    iterations: int

    @property
    def gear_torque(self) -> float:
        """[N.m]; torque times the teeth ratio unless corners carry load."""
        return sum(line.gear_torque for line in self.lines)


@dataclass(frozen=True, slots=True)
class MeshPosition:
    """The contact lines of a helical pair at one mesh phase, unloaded.

    Parameters
    ----------
    modified : ModifiedPair
    phase : float
        [mesh periods]
    gaps : dict of int to LineGap
        Lines by number: those of the plane of contact, the next to enter (-1) and the last to
        have left.
    """

    modified: ModifiedPair
    phase: float
    gaps: dict[int, LineGap]

    @classmethod
    def at(cls, modified: ModifiedPair, phase: float) -> MeshPosition:
        """Return the position at a mesh phase [mesh periods]; any number."""
        check_finite("phase", phase)
        plane = modified.pair.plane
        numbers = range(-1, line_count(plane) + 1)
        gaps = {i: line_gap(modified, line_position(phase, i, plane)) for i in numbers}
        return cls(modified, phase, gaps)

    @property
    def unloaded_rotation(self) -> float:
        """Pinion rotation [rad] to first touch."""
        return min(gap.touching_rotation for gap in self.gaps.values())

    def load(
        self, torque: float, stiffness: PairStiffness, settings: LoadedSettings, closing: float = 0
    ) -> LoadedState:
        """Return the equilibrium under the pinion torque `torque` [N.m], above zero.

        `closing` [rad] is a first guess of the rotation beyond first touch; strips are enlarged
        until they hold the contact.

        Raises
        ------
        ConvergenceError
            When contact keeps running out of the strips.
        """
        check_positive("torque", torque, "N.m", "Give its magnitude: both flanks are alike.")
        pair = self.modified.pair
        arm = pair.pinion_base_radius * math.cos(pair.base_helix_angle)
        line_load = torque / arm / pair.mean_contact_length
        closing = closing or line_load / _FIRST_DENSITY / arm
        half_width = _WIDE * self._hertz_half_width(line_load, stiffness.contact_modulus)

        def solve(closing: float, half_width: float) -> tuple[list[LineStrip], CoupledSolution]:
            strips = self.strips(closing, half_width, settings.strips)
            coupled = [coupled_strip(self.modified.pair, strip, stiffness) for strip in strips]
            return strips, solve_coupled(coupled, stiffness, torque, settings.tolerance)

        strips, solved = solve_on_growing_strips(
            solve,
            lambda solved: solved.solution.rotation - self.unloaded_rotation,
            closing=closing,
            width=half_width,
            growth=_GROWTH,
            tolerance=settings.tolerance,
            where=f"mesh phase {self.phase:.3f} and {torque:g} N.m",
        )
        return self._state(torque, strips, solved)

    def strips(self, closing: float, half_width: float, settings: StripSettings) -> list[LineStrip]:
        """Return the strips of all lines within `closing` [rad] of first touch.

        `half_width` [m] is that off the line of action.
        """
        reach = self.unloaded_rotation + closing
        strips = []
        for number, gap in self.gaps.items():
            extent = gap.extent(reach)
            if extent is None:
                continue
            strip = cut_strip(self.modified, number, gap.X, extent, half_width, settings)
            if strip is not None and strip.usable.any():
                strips.append(strip)
        return strips

    def _hertz_half_width(self, line_load: float, modulus: float) -> float:
        """Return the half-width [m] where the flanks are least curved."""
        pair = self.modified.pair
        x_g = pair.tangent_length
        x = min(max(0.5 * x_g, pair.contact_start), pair.contact_end)
        radius = x * (x_g - x) / (x_g * math.cos(pair.base_helix_angle))
        return math.sqrt(4.0 * line_load * radius / (math.pi * modulus))

    def _state(
        self, torque: float, strips: Sequence[LineStrip], solved: CoupledSolution
    ) -> LoadedState:
        return LoadedState(
            phase=self.phase,
            torque=torque,
            rotation=solved.solution.rotation,
            unloaded_rotation=self.unloaded_rotation,
            strain_energy=solved.solution.strain_energy,
            tangent=solved.tangent,
            lines=tuple(
                LoadedLine(strip, *fields)
                for strip, *fields in zip(
                    strips, solved.forces, solved.pressure, solved.tangents, strict=True
                )
            ),
            iterations=solved.solution.outcome.iterations,
        )


def coupled_strip(pair: HelicalPair, strip: LineStrip, stiffness: PairStiffness) -> CoupledStrip:
    """Return the cells of a strip with their weights on the hats of both teeth."""
    t = 0.5 + strip.z / pair.face_width
    parts = []
    for member, roll, compliance in (
        ("pinion", strip.pinion_roll, stiffness.pinion),
        ("gear", strip.gear_roll, stiffness.gear),
    ):
        s = flank_position(tooth_form(pair, member), np.nan_to_num(roll))
        parts.append(interpolation_weights(s, t, compliance))
    shape = strip.gap.shape
    return CoupledStrip(
        cell=strip.cell,
        gap=strip.gap,
        arm=np.where(strip.usable, strip.arm, 1.0),
        area=np.full(shape, strip.cell[0] * strip.cell[1]),
        weights=csr_array(hstack(parts)),
    )
