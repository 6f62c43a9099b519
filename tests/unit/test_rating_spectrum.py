"""Bins of a duty cycle, Miner's sums over them, and the torque factor at which damage is 1."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

import gearlube as gl
from gearlube_core.errors import ParameterError
from gearlube_core.rating.gears import StrengthRating
from gearlube_core.rating.life import BENDING, PITTING, strength_line
from gearlube_core.rating.spectrum import DutyBins, duty_bins, spectrum_damage

LINE = strength_line(PITTING["case_hardened"], 1.5e9, 1.0)
ROOT = strength_line(BENDING["case_hardened"], 0.9e9, 1.0)


def rate(torque: float, speed: float, temperature: float) -> StrengthRating:
    """Pitting by the root of the torque, breakage by the torque; 100 N.m is 1500 and 900 MPa."""
    share = abs(torque) / 100.0
    return StrengthRating(
        contact_stress=(1.5e9 * math.sqrt(share), 1.5e9 * math.sqrt(share)),
        bending_stress=(0.9e9 * share, 0.45e9 * share),
        contact_lines=(LINE, LINE),
        bending_lines=(ROOT, ROOT),
        cycles=(1.0, 1.0),
        factors={},
        outside=("too fast",) if speed > 500.0 else (),
        standard="test",
    )


def cycle(rng: np.random.Generator) -> tuple[np.ndarray, ...]:
    n = 500
    return (
        rng.uniform(0.1, 2.0, n), rng.uniform(-60.0, 150.0, n), rng.uniform(0.0, 400.0, n),
        rng.uniform(300.0, 360.0, n),
    )  # fmt: skip


def test_bins_keep_time_turns_and_heat_and_flanks_apart():
    time, torque, speed, heat = cycle(np.random.default_rng(1))
    bins = duty_bins(time, torque, speed, heat, widths=(40.0, 100.0, 20.0))
    assert bins.time.sum() == pytest.approx(time.sum())
    assert bins.revolutions.sum() == pytest.approx((time * speed).sum() / (2.0 * math.pi))
    assert (bins.time * bins.temperature).sum() == pytest.approx((time * heat).sum())
    drive = bins.torque > 0.0
    assert bins.time[drive].sum() == pytest.approx(time[torque > 0.0].sum())
    assert bins.torque.size < 150


def test_damage_of_bins_is_that_of_their_samples_on_one_slope():
    rng = np.random.default_rng(2)
    time, torque = rng.uniform(0.1, 2.0, 300), rng.uniform(100.0, 240.0, 300)
    speed, heat = rng.uniform(100.0, 200.0, 300), np.full(300, 330.0)
    fine = DutyBins(torque, speed, heat, time)
    coarse = duty_bins(time, torque, speed, heat, widths=(200.0, 1e3, 1e3))
    whole = [
        spectrum_damage(b, rate, ratio=3.0).sums()["pitting, drive"][0] for b in (fine, coarse)
    ]
    assert coarse.torque.size <= 2
    # 6.611 has four digits
    assert whole[0] == pytest.approx(whole[1], rel=1e-3)


def test_sums_take_ratio_mates_repeats_and_both_flanks_of_a_root():
    ones = np.ones(2)
    bins = DutyBins(np.array([130.0, -130.0]), 100.0 * ones, 330.0 * ones, 10.0 * ones)
    plain = spectrum_damage(bins, rate, ratio=4.0).sums()
    more = spectrum_damage(bins, rate, ratio=4.0, repeats=5.0, mates=(1, 3)).sums()
    assert plain["pitting, drive"] == pytest.approx(plain["pitting, coast"])
    assert plain["pitting, drive"][0] == pytest.approx(4.0 * plain["pitting, drive"][1])
    assert more["pitting, drive"][1] == pytest.approx(15.0 * plain["pitting, drive"][1])
    half = spectrum_damage(DutyBins(*(x[:1] for x in bins)), rate, ratio=4.0).sums()
    assert plain["breakage"][0] == pytest.approx(2.0 * half["breakage"][0])


def test_the_torque_factor_makes_the_damage_1():
    time, torque, speed, heat = cycle(np.random.default_rng(3))
    bins = duty_bins(time, torque, speed, heat, widths=(20.0, 100.0, 20.0))

    def damage(factor: float) -> float:
        found = spectrum_damage(bins, rate, ratio=3.0, repeats=2e5, factor=factor)
        return found.sums()["pitting, drive"][0]

    safety = gl.rating.torque_factor(damage)
    assert 0.1 < safety < 10.0
    assert damage(safety) == pytest.approx(1.0, rel=1e-6)


def test_the_torque_factor_of_few_cycles_is_that_of_the_static_strength():
    bins = DutyBins(*(np.array([x]) for x in (100.0, 1.0, 330.0, 1e-3)))
    factor = gl.rating.torque_factor(
        lambda f: spectrum_damage(bins, rate, ratio=1.0, factor=f).sums()["pitting, drive"][0]
    )
    assert factor == pytest.approx(1.6**2, rel=1e-6)


def test_limits_that_a_bin_exceeds_are_kept():
    bins = DutyBins(*(np.array([x, x]) for x in (100.0, 600.0, 330.0, 1.0)))
    assert spectrum_damage(bins, rate, ratio=1.0).outside == ("too fast",)


def test_damage_of_a_gear_pair_over_bins_runs_by_its_standard():
    pair = gl.HelicalGearFile.named("he_2007").helical_pair()
    gear = gl.rating.RatedGear(treatment="case_hardened", contact_limit=1.5e9, bending_limit=4.3e8)

    def by_standard(torque: float, speed: float, temperature: float) -> StrengthRating:
        return gl.rating.cylindrical_rating(
            pair, (gear, replace(gear, mean_stress=0.7)), gl.rating.LoadFactors(face=1.2),
            pinion_torque=abs(torque), pinion_speed=speed, cycles=(1e6, 1e6), oil_viscosity=1e-4,
        )  # fmt: skip

    time, torque, speed, heat = cycle(np.random.default_rng(4))
    bins = duty_bins(time, 10.0 * torque, speed, heat, widths=(500.0, 200.0, 100.0))
    sums = spectrum_damage(bins, by_standard, ratio=pair.ratio, repeats=1e4).sums()
    assert 0.0 < sums["pitting, coast"][0] < sums["pitting, drive"][0] < math.inf


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"time": np.array([1.0, -1.0])}, "durations that are not negative"),
        ({"torque": np.ones(3)}, r"one shape \(n,\), got \(2,\), \(3,\), \(2,\), \(2,\)"),
        ({"temperature": np.full(3, 330.0)}, r"one shape \(n,\), got .* \(3,\)\. Give each"),
        ({"speed": np.array([1.0, math.nan])}, "finite numbers"),
        ({"widths": (0.0, 1.0, 1.0)}, "width of torque must be above 0"),
    ],
)
def test_a_cycle_that_is_none_is_refused(changes, words):
    given = {
        "time": np.ones(2), "torque": np.ones(2), "speed": np.ones(2), "temperature": 330.0,
        "widths": (1.0, 1.0, 1.0), **changes,
    }  # fmt: skip
    with pytest.raises(ParameterError, match=words):
        duty_bins(**given)
