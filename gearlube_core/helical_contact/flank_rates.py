"""Derivatives of loaded helical contact by modifications of the flanks and by misalignment."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.linalg import block_diag

from gearlube_core.arrays import Array, Indices
from gearlube_core.errors import ParameterError
from gearlube_core.helical_contact.loaded_contact import (
    LoadedLine,
    LoadedSettings,
    MeshPosition,
    coupled_strip,
)
from gearlube_core.helical_contact.strips import LineStrip, line_gap, normal_gap
from gearlube_core.helical_contact.tooth_body import HelicalBodySettings, pair_stiffness
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.helical_geometry.modification import ModifiedPair
from gearlube_core.input_file.field_notes import field_notes
from gearlube_core.storage.process_pool import on_one_thread
from gearlube_core.tooth_contact.coupled_strips import PairStiffness
from gearlube_core.tooth_contact.held_contact import FrozenEquilibrium, frozen_compliance

# of differences of the gap alone; the gap is linear in amounts, but not in lengths
_STEPS = {"um": 1e-2, "mm": 2e-4}
_SHARE_STEP = 1e-4  # of shares and exponents


@dataclass(frozen=True, slots=True)
class FlankRates:
    """The loaded mesh at N phases and its derivatives, per unit of each of P fields.

    Parameters
    ----------
    names : tuple of str
    phases : ndarray of shape (N,)
        [mesh periods]
    rotation : ndarray of shape (N,)
        Theta of `LoadedState` [rad]: times the pinion's base radius the transmission error [m].
    rotation_rate : ndarray of shape (P, N)
        [rad/unit]
    pressure_max : ndarray of shape (N,)
        [Pa]
    pressure_rate : ndarray of shape (P, N)
        In the cell that carries it [Pa/unit].
    secant_stiffness : ndarray of shape (N,)
        Torque over rotation from first touch, over the square of the pinion's base radius [N/m].
    secant_stiffness_rate : ndarray of shape (P, N)
        [N/m/unit]
    sliding_loss : ndarray of shape (N,)
        Sliding power of the normal forces over the pinion's power [-]: times a coefficient of
        friction it is the share of power that sliding takes.
    sliding_loss_rate : ndarray of shape (P, N)
        [1/unit]
    """

    names: tuple[str, ...]
    phases: Array
    rotation: Array
    rotation_rate: Array
    pressure_max: Array
    pressure_rate: Array
    secant_stiffness: Array
    secant_stiffness_rate: Array
    sliding_loss: Array
    sliding_loss_rate: Array

    @property
    def peak_to_peak(self) -> float:
        """Of the rotation over the phases [rad]."""
        return float(np.ptp(self.rotation))

    @property
    def peak_to_peak_rate(self) -> Array:
        """[rad/unit], (P,)."""
        high, low = np.argmax(self.rotation), np.argmin(self.rotation)
        return np.asarray(self.rotation_rate[:, high] - self.rotation_rate[:, low])

    def order(self, number: int) -> tuple[float, Array]:
        """Return the amplitude of a mesh order [rad] and its rates (P,) [rad/unit].

        The phases must be even over one period.
        """
        count = self.rotation.size
        wave = np.exp(-2j * np.pi * number * np.arange(count) / count) * 2.0 / count
        value = self.rotation @ wave
        rate = np.real(np.conj(value) * (self.rotation_rate @ wave)) / abs(value)
        return float(abs(value)), rate


@dataclass(frozen=True, slots=True)
class _Cells:
    strip: LineStrip
    row: Indices
    column: Indices
    weights: Array

    @classmethod
    def of(cls, modified: ModifiedPair, line: LoadedLine, stiffness: PairStiffness) -> _Cells:
        there = line.forces > 0.0
        weights = coupled_strip(modified.pair, line.strip, stiffness).weights
        row, column = np.nonzero(there)
        return cls(line.strip, row, column, weights[there.ravel()].toarray())

    @property
    def arm(self) -> Array:
        return np.asarray(self.strip.arm[self.column])

    @property
    def area(self) -> Array:
        return np.full(self.row.size, self.strip.cell[0] * self.strip.cell[1])

    def sliding(self, modified: ModifiedPair) -> Array:
        return self.strip.sliding_arm(modified.pair)[self.column]

    def gap(self, modified: ModifiedPair) -> Array:
        strip = self.strip
        y, z = strip.y[self.row, self.column], strip.z[self.column]
        return normal_gap(modified, strip.X, y, z)


@on_one_thread
def flank_rates(
    file: HelicalGearFile,
    names: Sequence[str],
    *,
    torque: float,
    phases: Array,
    stiffness: PairStiffness | None = None,
    settings: LoadedSettings | None = None,
) -> FlankRates:
    """Return the loaded mesh of a helical pair and its derivatives by its flanks.

    The loaded cells and the teeth's compliance are held: with the tangent forces y of
    `FrozenEquilibrium`, dtheta/dp = y.(dg/dp) / (y.R). Arms and sliding speeds do not move.

    Parameters
    ----------
    file : HelicalGearFile
    names : sequence of str
        Fields of `pinion.flank` and `gear.flank` with a number: reliefs, their lengths, crowns,
        slopes. A misalignment in the plane of contact is a lead slope.
    torque : float
        On the pinion [N.m].
    phases : ndarray of shape (N,)
        [mesh periods]
    stiffness : PairStiffness, optional
        Of the pair's teeth; absent: of finite elements (`pair_stiffness`).
    settings : LoadedSettings, optional

    Raises
    ------
    ParameterError
        A name is no number of a flank, or its value stands on the limit of its range.
    ConvergenceError
        A phase finds no equilibrium.

    Notes
    -----
    A new analysis cuts its strips for the changed flanks; its differences are 1 to 3 % apart from
    these rates with 31 x 48 cells a line, those of rotation 0.3 % with 61 x 96: that is the scatter
    of the cells. The highest pressure stands in one cell, and with 31 x 48 cells its differences by
    a relief or a slope are apart by a quarter to the whole of themselves.

    Examples
    --------
    >>> file = HelicalGearFile.named("he_2007").varied({"pinion.flank.crown_um": 5.0})
    >>> names = ("pinion.flank.crown_um", "gear.flank.lead_slope_um")
    >>> rates = flank_rates(  # doctest: +SKIP
    ...     file, names, torque=200.0, phases=np.arange(8) / 8
    ... )
    >>> rates.order(1)  # doctest: +SKIP
    """
    modified = file.modified_pair()
    ends, steps = [], []
    for name in names:
        step = _step(file, name)
        value = _number(file, name)
        steps.append(step)
        lower = file.varied({name: value - step}).modified_pair()
        ends.append((lower, file.varied({name: value + step}).modified_pair()))
    if stiffness is None:
        stiffness = pair_stiffness(modified.pair, HelicalBodySettings())
    image = block_diag(stiffness.pinion.image, stiffness.gear.image)
    phases = np.asarray(phases, float)
    values, rates = np.zeros((4, phases.size)), np.zeros((4, len(steps), phases.size))
    for n, phase in enumerate(phases):
        position = MeshPosition.at(modified, float(phase))
        state = position.load(torque, stiffness, settings or LoadedSettings())
        cells = [
            _Cells.of(modified, line, stiffness)
            for line in state.lines
            if (line.forces > 0.0).any()
        ]
        compliances = [
            frozen_compliance(
                *(one.row, one.column, one.strip.cell, one.weights, image),
                stiffness.contact_modulus,
            )
            for one in cells
        ]
        rises = [
            [(one.gap(upper) - one.gap(lower)) / (2.0 * step) for one in cells]
            for (lower, upper), step in zip(ends, steps, strict=True)
        ]
        held = FrozenEquilibrium.of(
            compliances, [one.gap(modified) for one in cells], [one.arm for one in cells], torque
        )
        touching = _touching(position, ends, steps)
        values[:, n], rates[:, :, n] = _held_rates(modified, cells, held, rises, touching, torque)
    parts = [one for both in zip(values, rates, strict=True) for one in both]
    return FlankRates(tuple(names), phases, *parts)


def _touching(
    position: MeshPosition,
    ends: Sequence[tuple[ModifiedPair, ModifiedPair]],
    steps: Sequence[float],
) -> tuple[float, Array]:
    """Return the rotation to first touch [rad] and its rates (P,) [rad/unit]."""
    line = min(position.gaps.values(), key=lambda gap: gap.touching_rotation)
    first = int(np.argmin(line.gap / line.arm))
    gaps = [[line_gap(end, line.X).gap[first] for end in pair] for pair in ends]
    rises = [
        (upper - lower) / (2.0 * step) for (lower, upper), step in zip(gaps, steps, strict=True)
    ]
    return line.touching_rotation, np.array(rises) / line.arm[first]


def _held_rates(
    modified: ModifiedPair,
    cells: Sequence[_Cells],
    held: FrozenEquilibrium,
    rises: Sequence[Sequence[Array]],
    touching: tuple[float, Array],
    torque: float,
) -> tuple[Array, Array]:
    """Return rotation, pressure, secant stiffness and sliding loss (4,), and rates (4, P).

    `rises`: of the gaps of each strip, by each of P fields [m/unit].
    """
    forces = np.concatenate(held.forces)
    area = np.concatenate([one.area for one in cells])
    sliding = np.concatenate([one.sliding(modified) for one in cells]) / torque
    highest = int(np.argmax(forces / area))
    closing = held.rotation - touching[0]
    secant = torque / modified.pair.pinion_base_radius**2 / closing
    still = [np.zeros(one.row.size) for one in cells]
    rates = np.zeros((4, len(rises)))
    for k, rise in enumerate(rises):
        turn, moves = held.rates(rise, still, still)
        move = np.concatenate(moves)
        rates[:, k] = (
            turn,
            move[highest] / area[highest],
            secant * (touching[1][k] - turn) / closing,
            move @ sliding,
        )
    values = held.rotation, forces[highest] / area[highest], secant, forces @ sliding
    return np.array(values), rates


def _number(file: HelicalGearFile, name: str) -> float:
    role, _, rest = name.partition(".")
    section, _, key = rest.partition(".")
    known = field_notes(HelicalGearFile)
    if role not in ("pinion", "gear") or section != "flank" or name not in known:
        raise ParameterError(
            "A derivative is taken by a field of pinion.flank or gear.flank, such as "
            f"gear.flank.crown_um, got {name!r}. docs/helical_gear_file.md lists them."
        )
    value = getattr(getattr(file, role).flank, key)
    if not isinstance(value, float):
        raise ParameterError(
            f"{name} must have a number with decimals to be changed, got {value!r}. Give it in the "
            "gear file, or take another field."
        )
    return value


def _step(file: HelicalGearFile, name: str) -> float:
    value, note = _number(file, name), field_notes(HelicalGearFile)[name]
    step = _STEPS.get(note.unit, _SHARE_STEP)
    try:
        for way in (-step, step):
            file.varied({name: value + way})
    except ParameterError as reason:
        raise ParameterError(
            f"{name} must be inside its range to have a derivative, got {value:g} {note.unit}: "
            f"{reason} Give the field a value inside the range first."
        ) from None
    return step
