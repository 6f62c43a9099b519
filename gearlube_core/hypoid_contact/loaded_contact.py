"""Loaded contact of all tooth pairs at one position of the mesh."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace

import numpy as np
from scipy.sparse import csr_array, hstack

from gearlube_core.arrays import Array
from gearlube_core.checks import check_positive, check_within
from gearlube_core.errors import ConvergenceError
from gearlube_core.hypoid_contact.gap_map import GapMap, gap_map
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_contact.placement import tooth_position
from gearlube_core.hypoid_contact.strips import (
    Strip,
    StripFrame,
    StripSettings,
    cut_strip,
    strip_frame,
)
from gearlube_core.tooth_compliance.flank_compliance import interpolation_weights
from gearlube_core.tooth_contact.coupled_strips import (
    CoupledSolution,
    CoupledStrip,
    PairStiffness,
    StripGrowth,
    solve_coupled,
    solve_on_growing_strips,
)

_GROWTH = StripGrowth(factor=1.6, margin=1.15, attempts=8)
_FIRST_STIFFNESS = 3e8  # N/m, only to size the first strips
_SHORTEST = 2e-3  # m, length of a strip for its first width
_WIDE = 2.5  # half-width of a strip over the half-width of Hertz' line contact


@dataclass(frozen=True, slots=True, kw_only=True)
class LoadedSettings:
    """Resolution of loaded contact.

    Parameters
    ----------
    strips : StripSettings
    tolerance : float
        Of the cells' forces, as in `solve_torque` [-].
    """

    strips: StripSettings = field(default_factory=StripSettings)
    tolerance: float = 1e-5

    def __post_init__(self) -> None:
        check_within("tolerance", self.tolerance, 1e-10, 1e-3)


@dataclass(frozen=True, slots=True)
class LoadedPair:
    """Load and contact of one tooth pair.

    Parameters
    ----------
    phase : float
        Position of the pair [mesh periods]; zero where the reference points meet.
    strip : Strip
    forces, pressure : ndarray of shape (nx, ny)
        [N], [Pa].
    torque : float
        Part of the pinion torque [N.m].
    """

    phase: float
    strip: Strip
    forces: Array
    pressure: Array
    torque: float


@dataclass(frozen=True, slots=True)
class LoadedState:
    """Equilibrium at one gear angle and pinion torque.

    Parameters
    ----------
    phase : float
        Mesh phase [mesh periods].
    torque : float
        Pinion torque [N.m], positive on either flank.
    rotation : float
        Pinion rotation beyond the nominal ratio, towards the gear [rad].
    unloaded_rotation : float
        The same without load.
    gear_torque : float
        [N.m]
    strain_energy : float
        [J]
    tangent : float
        d(torque)/d(rotation) [N.m/rad].
    pairs : tuple of LoadedPair
        Pairs with strips, loaded or not, by rising phase.
    iterations : int
    """

    phase: float
    torque: float
    rotation: float
    unloaded_rotation: float
    gear_torque: float
    strain_energy: float
    tangent: float
    pairs: tuple[LoadedPair, ...]
    iterations: int

    @property
    def force(self) -> Array:
        """Resultant of the normal forces on the gear [N], (3,), fixed frame."""
        return -sum(
            (np.einsum("ij,ijk->k", p.forces, p.strip.normal) for p in self.pairs), np.zeros(3)
        )


@dataclass(frozen=True, slots=True)
class MeshPosition:
    """The tooth pairs near contact at one gear angle, unloaded.

    Parameters
    ----------
    pair : FlankPair
    phase : float
        [mesh periods]
    phases : tuple of float
        Phase of each pair.
    maps : tuple of GapMap
    """

    pair: FlankPair
    phase: float
    phases: tuple[float, ...]
    maps: tuple[GapMap, ...]

    @classmethod
    def at(cls, pair: FlankPair, phase: float, pairs: int = 2) -> MeshPosition:
        """Return the position at mesh phase `phase`, with `pairs` tooth pairs before and after."""
        phases = tuple(phase + j for j in range(-pairs, pairs + 1))
        maps = tuple(gap_map(pair, *pair_angles(pair, k)) for k in phases)
        return cls(pair, phase, phases, maps)

    @property
    def unloaded_rotation(self) -> float:
        """Pinion rotation [rad] to first contact on the maps' grid."""
        return min(float(np.min(m.touching_rotation)) for m in self.maps)

    def load(
        self, torque: float, stiffness: PairStiffness, settings: LoadedSettings, closing: float = 0
    ) -> LoadedState:
        """Return the equilibrium under the pinion torque `torque` [N.m], above zero.

        `closing` [m] is a first guess of the loaded approach; strips are enlarged until they hold
        the contact.

        Raises
        ------
        ConvergenceError
            When the teeth meet nowhere, or contact keeps running out of the strips.
        """
        check_positive("torque", torque, "N.m", "Coast flanks carry positive torque too.")
        if not math.isfinite(self.unloaded_rotation):
            raise ConvergenceError(
                f"The teeth must meet at mesh phase {self.phase:.3f}, but turning the pinion "
                "closes no gap there. Check blank and machine settings: the flanks pass each other."
            )
        arm = float(np.nanmedian(np.abs(self.maps[len(self.maps) // 2].arm)))
        closing = closing or torque / arm / _FIRST_STIFFNESS

        def solve(
            closing: float, width: float
        ) -> tuple[list[tuple[float, Strip]], CoupledSolution]:
            strips = self.strips(torque / arm, closing, width, stiffness, settings)
            coupled = [coupled_strip(self.pair, strip, stiffness) for _, strip in strips]
            return strips, solve_coupled(coupled, stiffness, torque, settings.tolerance)

        strips, solved = solve_on_growing_strips(
            solve,
            lambda solved: arm * (solved.solution.rotation - self.unloaded_rotation),
            closing=closing,
            width=1.0,
            growth=_GROWTH,
            tolerance=settings.tolerance,
            where=f"mesh phase {self.phase:.3f} and {torque:g} N.m",
            cure=", or check that the flanks are crowned: the strips hold contact along lines",
        )
        return self._state(torque, strips, solved)

    def strips(
        self,
        force: float,
        closing: float,
        width: float,
        stiffness: PairStiffness,
        settings: LoadedSettings,
    ) -> list[tuple[float, Strip]]:
        """Return the strips of all pairs within reach, each with the pair's phase.

        Parameters
        ----------
        force : float
            Mesh force that sets their width [N].
        closing : float
            Beyond first touch [m].
        width : float
            Factor on their width [-].
        stiffness : PairStiffness
        settings : LoadedSettings
        """
        strips = []
        for phase, gaps in zip(self.phases, self.maps, strict=True):
            # turned to first touch: with backlash to close, arms that differ by per cents would
            # else blur the reach by more than the closing
            touching = replace(gaps, gap=gaps.gap - self.unloaded_rotation * gaps.arm)
            frame = strip_frame(touching, closing)
            if frame is None:
                continue
            half = _WIDE * width * self.hertz_half_width(frame, force, stiffness.contact_modulus)
            strip = cut_strip(
                self.pair, *pair_angles(self.pair, phase), frame, half, settings.strips
            )
            if strip.usable.any():
                strips.append((phase, strip))
        return strips

    def hertz_half_width(self, frame: StripFrame, force: float, modulus: float) -> float:
        """Return the half-width [m] of line contact under `force` [N] over the strip's length."""
        curvature = 0.0
        for flank, start in (
            (self.pair.gear, frame.gear_start),
            (self.pair.pinion, frame.pinion_start),
        ):
            shape = flank.sample_parameters(start).curvature
            curvature += float(np.max(np.abs(np.linalg.eigvalsh(shape))))
        per_length = force / max(2.0 * frame.half_length, _SHORTEST)
        return math.sqrt(4.0 * per_length / (math.pi * modulus * curvature))

    def _state(
        self, torque: float, strips: list[tuple[float, Strip]], solved: CoupledSolution
    ) -> LoadedState:
        pairs = []
        for (phase, strip), forces, pressure in zip(
            strips, solved.forces, solved.pressure, strict=True
        ):
            pairs.append(
                LoadedPair(phase, strip, forces, pressure, float(np.nansum(forces * strip.arm)))
            )
        return LoadedState(
            phase=self.phase,
            torque=torque,
            rotation=solved.solution.rotation,
            unloaded_rotation=min(solved.first_rotation, self.unloaded_rotation),
            gear_torque=float(sum(np.nansum(p.forces * p.strip.gear_arm) for p in pairs)),
            strain_energy=solved.solution.strain_energy,
            tangent=solved.tangent,
            pairs=tuple(pairs),
            iterations=solved.solution.outcome.iterations,
        )


def pair_angles(pair: FlankPair, phase: float) -> tuple[float, float]:
    """Return the angles of gear and pinion [rad] at which a tooth pair has a phase."""
    return phase * pair.gear_pitch, phase * pair.pinion_pitch


def coupled_strip(pair: FlankPair, strip: Strip, stiffness: PairStiffness) -> CoupledStrip:
    """Return the cells of a strip with their weights on the elastic teeth."""
    usable = strip.usable
    parts = []
    for flank, parameters, compliance in (
        (pair.pinion, strip.pinion_parameters, stiffness.pinion),
        (pair.gear, strip.gear_parameters, stiffness.gear),
    ):
        s, t = tooth_position(flank, flank.sample_parameters(parameters).r)
        s, t = np.where(usable, s, 0.5), np.where(usable, t, 0.5)
        parts.append(interpolation_weights(s, t, compliance))
    return CoupledStrip(
        cell=strip.cell,
        gap=strip.gap,
        arm=np.where(usable, strip.arm, 1.0),
        area=strip.area,
        weights=csr_array(hstack(parts)),
    )
