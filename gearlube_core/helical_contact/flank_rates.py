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
from gearlube_core.helical_contact.strips import LineStrip, normal_gap
from gearlube_core.helical_contact.tooth_body import HelicalBodySettings, pair_stiffness
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.helical_geometry.modification import ModifiedPair
from gearlube_core.input_file.field_notes import field_notes
from gearlube_core.tooth_contact.coupled_strips import PairStiffness
from gearlube_core.tooth_contact.frozen_equilibrium import FrozenEquilibrium, frozen_compliance

# of differences of the gap alone; the gap is linear in amounts
_STEPS = {"um": 1e-2, "mm": 1e-3}
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
    """

    names: tuple[str, ...]
    phases: Array
    rotation: Array
    rotation_rate: Array
    pressure_max: Array
    pressure_rate: Array

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

    def gap(self, modified: ModifiedPair) -> Array:
        strip = self.strip
        y, z = strip.y[self.row, self.column], strip.z[self.column]
        return normal_gap(modified, strip.X, y, z)


def flank_rates(
    file: HelicalGearFile,
    names: Sequence[str],
    *,
    torque: float,
    phases: Array,
    stiffness: PairStiffness | None = None,
    settings: LoadedSettings | None = None,
) -> FlankRates:
    """Return the loaded transmission error of a helical pair and its derivatives by its flanks.

    The loaded cells and the teeth's compliance are held: with the tangent forces y of
    `FrozenEquilibrium`, dtheta/dp = y.(dg/dp) / (y.R). The arms do not move.

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
    An analysis anew cuts its strips for the changed flanks; its differences are 1 to 2 % apart from
    these rates with 31 x 48 cells a line, 0.3 % with 61 x 96: that is the scatter of the cells.

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
        ends.append(
            tuple(file.varied({name: value + way * step}).modified_pair() for way in (-1.0, 1.0))
        )
    if stiffness is None:
        stiffness = pair_stiffness(modified.pair, HelicalBodySettings())
    image = block_diag(stiffness.pinion.image, stiffness.gear.image)
    phases = np.asarray(phases, float)
    count = len(steps), phases.size
    rotation, pressure = np.zeros(phases.size), np.zeros(phases.size)
    rotation_rate, pressure_rate = np.zeros(count), np.zeros(count)
    for n, phase in enumerate(phases):
        state = MeshPosition.at(modified, float(phase)).load(
            torque, stiffness, settings or LoadedSettings()
        )
        cells = [
            _Cells.of(modified, line, stiffness)
            for line in state.lines
            if (line.forces > 0.0).any()
        ]
        held = FrozenEquilibrium.of(
            [
                frozen_compliance(
                    *(one.row, one.column, one.strip.cell, one.weights, image),
                    stiffness.contact_modulus,
                )
                for one in cells
            ],
            [one.gap(modified) for one in cells],
            [one.arm for one in cells],
            torque,
        )
        rotation[n] = held.rotation
        area = np.concatenate([np.full(one.row.size, np.prod(one.strip.cell)) for one in cells])
        loads = np.concatenate(held.forces) / area
        highest = int(np.argmax(loads))
        pressure[n] = loads[highest]
        still = [np.zeros(one.row.size) for one in cells]
        for k, (lower, upper) in enumerate(ends):
            gaps = [(one.gap(upper) - one.gap(lower)) / (2.0 * steps[k]) for one in cells]
            rotation_rate[k, n], moves = held.rates(gaps, still, still)
            pressure_rate[k, n] = np.concatenate(moves)[highest] / area[highest]
    return FlankRates(tuple(names), phases, rotation, rotation_rate, pressure, pressure_rate)


def _number(file: HelicalGearFile, name: str) -> float:
    role, _, rest = name.partition(".")
    section, _, key = rest.partition(".")
    known = field_notes(HelicalGearFile)
    if role not in ("pinion", "gear") or section != "flank" or name not in known:
        raise ParameterError(
            f"A rate is by a field of pinion.flank or gear.flank, as gear.flank.crown_um, got "
            f"{name!r}. docs/helical_gear_file.md lists them."
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
            f"{name} must lie inside its range to have a rate, got {value:g} {note.unit}: {reason} "
            "Give the flank some of it first."
        ) from None
    return step
