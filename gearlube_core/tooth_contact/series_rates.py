"""A mesh table of one torque and its derivatives, from loaded contact at two torques about it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.mesh_table.table import (
    PAIRS,
    SERIES_UNITS,
    WINDOW_UNITS,
    MeshTable,
    Provenance,
    fourier,
    orders_kept,
)
from gearlube_core.storage.resumable import Record

HALF_WIDTH = 0.1  # of the torque: the tangent stiffness is that between 0.9 and 1.1 of it
KEPT = ("rotation", "touching", "gear_torque", "force")


def torques_about(torque: float) -> tuple[float, float]:
    """Return the torques between which the mesh is a spring [N.m]."""
    return (1.0 - HALF_WIDTH) * torque, (1.0 + HALF_WIDTH) * torque


class RateParameter(Protocol):
    """Parameter of derivatives of a mesh table."""

    @property
    def name(self) -> str:
        """Dotted field of a gear file, or a misalignment."""

    @property
    def unit(self) -> str:
        """Of its value."""

    @property
    def value(self) -> float:
        """Its value [unit]."""

    @property
    def tolerance(self) -> float:
        """A small change to compare parameters by [unit]."""


class PairNames(Protocol):
    """Data of the pair in a mesh table."""

    name: str
    source: str


@dataclass(frozen=True, slots=True)
class SeriesRates:
    """A mesh table of one level and the derivatives of its series by P parameters.

    Parameters
    ----------
    table : MeshTable
        Its windows are empty: of use where flank friction is off.
    parameters : tuple of RateParameter
    rates : mapping of str to ndarray of shape (P, H + 1, 2)
        Of k_m, k_t, R_p, R_g and e, per unit of each parameter. The normal is held.
    rotation : ndarray of shape (N,)
        Loaded transmission error over the mesh phases [rad].
    rotation_rate : ndarray of shape (P, N)
        [rad/unit]
    """

    table: MeshTable
    parameters: Sequence[RateParameter]
    rates: Mapping[str, Array]
    rotation: Array
    rotation_rate: Array


def series_of_records(
    pair: PairNames,
    teeth: tuple[int, int],
    parameters: Sequence[RateParameter],
    records: Record,
    torque: float,
) -> SeriesRates:
    """Return the table and rates of N positions' records.

    With theta and F the means of both torques, c = d theta/dT between them and T in the middle

    R_p = T/F,  R_g = T_g/F,  k_t = 1/(c R_p^2),  k_m = T/((theta - touching) R_p^2),
    e = touching times the mean of R_p

    Parameters
    ----------
    pair : PairNames
        Name and source of the table.
    teeth : tuple of int
        Of pinion and gear.
    parameters : sequence of RateParameter
        P of them.
    records : Record
        `KEPT` at both `torques_about` (N, 2) and, ending in _rate, their rates (N, 2, P).
    torque : float
        On the pinion [N.m].
    """
    low, high = torques_about(torque)
    torque = 0.5 * (low + high)
    values = {name: records[name].T for name in KEPT}  # (2, N)
    # (N, 2, P) to (2, P, N)
    rates = {name: np.moveaxis(records[f"{name}_rate"], 0, 2) for name in KEPT}

    def middle(of: Mapping[str, Array], name: str) -> Array:
        return np.asarray(0.5 * (of[name][0] + of[name][1]))

    theta, touching, force, gear = (
        middle(values, name) for name in ("rotation", "touching", "force", "gear_torque")
    )
    d_theta, d_touching, d_force, d_gear = (
        middle(rates, name) for name in ("rotation", "touching", "force", "gear_torque")
    )
    soft = (values["rotation"][1] - values["rotation"][0]) / (high - low)
    d_soft = (rates["rotation"][1] - rates["rotation"][0]) / (high - low)
    arm, closing = torque / force, theta - touching
    d_arm = -arm * d_force / force
    twice = 2.0 * d_arm / arm
    k_t, k_m = 1.0 / (soft * arm**2), torque / (closing * arm**2)
    samples = {
        "k_t": (k_t, -k_t * (d_soft / soft + twice)),
        "k_m": (k_m, -k_m * ((d_theta - d_touching) / closing + twice)),
        "R_p": (arm, d_arm),
        "R_g": (gear / force, (d_gear - gear / force * d_force) / force),
        "e": (
            arm.mean() * touching,
            arm.mean() * d_touching + d_arm.mean(axis=1, keepdims=True) * touching,
        ),
    }
    orders = orders_kept(theta.size)
    series = {name: fourier(value, orders)[None] for name, (value, _) in samples.items()}
    for axis in ("n_x", "n_y", "n_z"):
        series[axis] = np.zeros((1, orders + 1, 2))
    series["n_z"][0, 0, 0] = 1.0
    moved = {
        name: np.array([fourier(one, orders) for one in rate]).reshape(-1, orders + 1, 2)
        for name, (_, rate) in samples.items()
    }
    return SeriesRates(_table(pair, teeth, torque, series), parameters, moved, theta, d_theta)


def _table(
    pair: PairNames, teeth: tuple[int, int], torque: float, series: Mapping[str, Array]
) -> MeshTable:
    windows = {name: np.ones((1, PAIRS)) for name in WINDOW_UNITS}
    windows["share"] = np.full((1, PAIRS), 1.0 / PAIRS)
    origin = Provenance("inferred", "loaded contact between two torques, for derivatives")
    empty = Provenance("completed", "no flank friction: not read")
    return MeshTable(
        name=pair.name,
        pinion_teeth=teeth[0],
        gear_teeth=teeth[1],
        torque=np.array([torque]),
        contact_ratio=1.0,
        series=series,
        windows=windows,
        provenance={**dict.fromkeys(SERIES_UNITS, origin), **dict.fromkeys(WINDOW_UNITS, empty)},
        source=pair.source,
    )
