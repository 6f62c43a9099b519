"""Damage of gears over a duty cycle: bins of torque, speed and temperature, and Miner's sums."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_positive
from gearlube_core.errors import ParameterError
from gearlube_core.rating.gears import StrengthRating
from gearlube_core.rating.life import miner_sum
from gearlube_core.rating.pairs import Pair, both

PITTING_EXPONENT = 6.611  # of the torque, case-hardened, up to 5e7 cycles
Rate = Callable[[float, float, float], StrengthRating]


class DutyBins(NamedTuple):
    """Bins of a duty cycle, shape (n,)."""

    torque: Array  # of the pinion, below 0 on the coast flank [N.m]
    speed: Array  # its amount [rad/s]
    temperature: Array  # [K]
    time: Array  # [s]

    @property
    def revolutions(self) -> Array:
        """Of the pinion [-]."""
        return self.speed * self.time / (2.0 * math.pi)


def duty_bins(
    time: Array, torque: Array, speed: Array, temperature: Array | float, *,
    widths: tuple[float, float, float], exponent: float = PITTING_EXPONENT,
) -> DutyBins:  # fmt: skip
    """Return the bins of a cycle that have time in them.

    Turns of the pinion and time are kept. The torque of a bin is the power mean over turns, which
    does the damage of its samples where their strength line has this exponent. A bin never has
    torque of both flanks. ParameterError where shapes differ, a number is not finite, a duration is
    negative or a width not above 0.

    Parameters
    ----------
    time, torque, speed
        Duration of each sample [s]; torque [N.m], above 0 on the drive flank, and speed [rad/s] of
        the pinion; shape (n,).
    temperature
        Of the oil [K].
    widths
        Of a bin [N.m], [rad/s], [K].
    exponent
        Of the torque in life [-].

    Examples
    --------
    >>> bins = duty_bins(
    ...     np.ones(4), np.array([90.0, 95.0, -20.0, -25.0]), np.full(4, 100.0), 330.0,
    ...     widths=(50.0, 50.0, 10.0),
    ... )
    >>> bins.torque.round(1).tolist(), bins.time.tolist()
    ([-23.2, 92.7], [2.0, 2.0])
    """
    for name, width in zip(("torque", "speed", "temperature"), widths, strict=True):
        check_positive(f"width of {name}", width, "", "A bin needs a width.")
    samples = [np.asarray(one, dtype=float) for one in (time, torque, speed, temperature)]
    if samples[3].ndim == 0:
        samples[3] = np.full(samples[0].shape, samples[3])
    shapes = {one.shape for one in samples}
    if len(shapes) > 1 or samples[0].ndim != 1 or not samples[0].size:
        found = ", ".join(str(one.shape) for one in samples)
        raise ParameterError(
            f"time, torque, speed and temperature must have one shape (n,), got {found}. Give each "
            "sample of the cycle all four, or one temperature."
        )
    time, torque, speed, heat = samples
    if not all(np.isfinite(one).all() for one in samples) or (time < 0.0).any():
        raise ParameterError(
            "A cycle must have finite numbers and durations that are not negative."
        )
    speed = np.abs(speed)
    keys = np.floor(np.stack((torque, speed, heat), axis=1) / np.array(widths))
    _, which = np.unique(keys, axis=0, return_inverse=True)

    def summed(weights: Array) -> Array:
        return np.bincount(which.ravel(), weights).astype(float)

    whole, turns = summed(time), summed(time * speed)
    power = summed(time * speed * np.abs(torque) ** exponent)
    sign = np.where(summed(time * torque) < 0.0, -1.0, 1.0)
    some = np.where(whole > 0.0, whole, 1.0)
    mean = (power / np.where(turns > 0.0, turns, 1.0)) ** (1.0 / exponent)
    bins = DutyBins(sign * mean, turns / some, summed(time * heat) / some, whole)
    return DutyBins(*(one[whole > 0.0] for one in bins))


class SpectrumDamage(NamedTuple):
    """Miner's sums by bin, shape (n, 2): of pinion and gear."""

    contact: Array
    bending: Array
    drive: np.ndarray  # which bins load the drive flank, shape (n,)
    outside: tuple[str, ...]  # limits that a bin exceeds, in words

    def sums(self) -> dict[str, Pair]:
        """Return the damage of pinion and gear: pitting of either flank, and breakage."""

        def summed(damage: Array) -> Pair:
            return float(damage[:, 0].sum()), float(damage[:, 1].sum())

        return {
            "pitting, drive": summed(self.contact[self.drive]),
            "pitting, coast": summed(self.contact[~self.drive]),
            "breakage": summed(self.bending),  # the root feels both flanks
        }


def spectrum_damage(
    bins: DutyBins, rate: Rate, *, ratio: float, repeats: float = 1.0,
    mates: tuple[int, int] = (1, 1), factor: float = 1.0,
) -> SpectrumDamage:  # fmt: skip
    """Return the damage of each bin.

    A tooth is loaded from zero at each mesh; load of both flanks on a root counts with the
    `mean_stress` of the gear. Source: [iso_6336_6].

    Parameters
    ----------
    bins, repeats
        Of one cycle; repeats of the cycle.
    rate
        Returns the rating at torque, its sign that of the flank [N.m], speed [rad/s] and
        temperature [K]; its cycles play no part.
    ratio, mates
        Teeth of the gear over those of the pinion [-]; meshes of a tooth in a turn of both.
    factor
        On all torques, for `torque_factor`.

    Examples
    --------
    >>> import gearlube as gl
    >>> load = gl.rating.FlankLoad.example()
    >>> def rate(torque, speed, temperature):
    ...     return gl.rating.cylindrical_rating(
    ...         load.pair, load.gears, gl.rating.LoadFactors(face=1.2), pinion_torque=abs(torque),
    ...         pinion_speed=speed, cycles=(1.0, 1.0), oil_viscosity=100e-6,
    ...     )
    >>> bins = gl.rating.duty_bins(
    ...     np.ones(2), np.array([900.0, -90.0]), np.full(2, 200.0), 350.0, widths=(50.0, 9.0, 9.0)
    ... )
    >>> damage = gl.rating.spectrum_damage(bins, rate, ratio=load.pair.ratio, repeats=1e5)
    >>> round(damage.sums()["pitting, drive"][0], 3)
    0.335
    """
    contact, bending = np.zeros((2, bins.torque.size, 2))
    turns = repeats * bins.revolutions
    outside: dict[str, None] = {}
    for n, (torque, speed, heat) in enumerate(zip(*bins[:3], strict=True)):
        if torque == 0.0 or turns[n] == 0.0:
            continue
        found = rate(factor * torque, speed, heat)
        outside.update(dict.fromkeys(found.outside))
        cycles = turns[n] * mates[0], turns[n] * mates[1] / ratio
        contact[n] = both(miner_sum, found.contact_lines, found.contact_stress, cycles)
        bending[n] = both(miner_sum, found.bending_lines, found.bending_stress, cycles)
    return SpectrumDamage(contact, bending, bins.torque > 0.0, tuple(outside))
