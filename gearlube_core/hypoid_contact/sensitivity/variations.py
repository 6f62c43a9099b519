"""A pair of flanks with each of several parameters a step below and above its value."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_contact.sensitivity.parameter import Parameter
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile


@dataclass(frozen=True, slots=True)
class Variations:
    """What all derivatives of a pair are taken from.

    Parameters
    ----------
    pair : FlankPair
        As it stands.
    parameters : tuple of Parameter
        P of them.
    lower, upper : tuple of FlankPair
        P pairs, each with one parameter a step below and a step above its value.
    """

    pair: FlankPair
    parameters: tuple[Parameter, ...]
    lower: tuple[FlankPair, ...]
    upper: tuple[FlankPair, ...]

    @classmethod
    def of(cls, file: HypoidGearFile, pair: FlankPair, names: Iterable[str]) -> Variations:
        """Return the variations of a file's pair by the named parameters.

        Parameters
        ----------
        file : HypoidGearFile
        pair : FlankPair
            Of the file, displaced or not.
        names : iterable of str
            See `Parameter`.

        Raises
        ------
        ParameterError
            When there is no such number, or a step leaves the range of its field: a value on its
            limit has no derivative.
        """
        parameters = tuple(Parameter.named(name, file, pair.misalignment) for name in names)
        ends = [one.about(file, pair) for one in parameters]
        return cls(pair, parameters, tuple(a for a, _ in ends), tuple(b for _, b in ends))

    @property
    def steps(self) -> Array:
        """Step of each parameter [its unit], (P,)."""
        return np.array([one.step for one in self.parameters])

    def difference(self, at_lower: Array, at_upper: Array) -> Array:
        """Return the derivatives (P, ...) of something known at all lower and upper pairs."""
        change = np.asarray(at_upper) - np.asarray(at_lower)
        return np.asarray(change / (2.0 * self.steps).reshape(-1, *[1] * (change.ndim - 1)))
