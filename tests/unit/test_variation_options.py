"""What is typed after --vary, --design and --limit."""

import pytest

from gearlube.cli.multi_value_options import repeat_flags
from gearlube.variation.command import VaryCommand
from gearlube.variation.design import Axis, Sampling, Spread
from gearlube.variation.file_variants import axle_keys
from gearlube.variation.keys import Key, understood
from gearlube.variation.points.losses import _OPERANDS
from gearlube.variation.vary_option import limits_from, sampling_from, varied_from
from gearlube_core.errors import ParameterError

KEYS = {**axle_keys(), **_OPERANDS}


def test_the_usual_words_give_axes_and_ranges():
    found = varied_from(
        [
            "bearing.preload=2000:6000:1000",
            "oil.temperature=40,80",
            "gear_set.radii=paper,mean",
            "pinion.bearing.rollers=12,13",
            "gear_set.backlash=100:200",
        ],
        KEYS,
    )
    assert found.axes == (
        Axis("bearing.preload", (2000.0, 3000.0, 4000.0, 5000.0, 6000.0)),
        Axis("oil.temperature_degc", (40.0, 80.0)),
        Axis("gear_set.radii", ("paper", "mean")),
        Axis("pinion.bearing.rollers", (12, 13)),
    )
    assert found.spreads == (Spread(key="gear_set.backlash_um", low=100.0, high=200.0),)


@pytest.mark.parametrize("text", ["gear_set.backlash=150+-30", "gear_set.backlash=150±30"])
def test_a_width_is_three_standard_deviations(text):
    (found,) = varied_from([text], KEYS).spreads
    assert (found.low, found.mean, found.high) == (120.0, 150.0, 180.0)
    assert found.deviation == pytest.approx(10.0)


def test_several_variations_follow_one_flag():
    typed = ["map", "--vary", "a.b=1", "c=2,3", "--out", "x=y", "--vary", "d=4", "axle.toml"]
    assert repeat_flags(typed, VaryCommand.multi_value, VaryCommand.value) == [
        "map", "--vary", "a.b=1", "--vary", "c=2,3", "--out", "x=y", "--vary", "d=4", "axle.toml",
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("bering.preload=1", "Is it bearing.preload"),
        ("preload=1", "Is it bearing.preload or wheel.bearing.preload"),
        ("zzz=1", "--keys"),
        ("oil.temperature", "must be KEY=VALUES"),
        ("oil.temperature=", "must be KEY=VALUES"),
        ("oil.temperature=300", "within -60 to 250 degC, got 300 degC"),
        ("oil.temperature=40:300", "within -60 to 250 degC, got 300 degC"),
        ("oil.temperature=80:40", "upper end"),
        ("oil.temperature=40:80:0", "step"),
        ("oil.temperature=warm", "must be a number"),
        ("oil.temperature=nan:80", "finite"),
        ("pinion.bearing.rollers=12.5", "whole number"),
        ("pinion.bearing.rollers=12:14", "cannot be sampled"),
        ("pinion.bearing.rollers=12+-1", "cannot be sampled"),
        ("oil.temperature=240+-30", "ends must be in range"),
        ("oil.temperature=60+-0", "above 0"),
        ("oil.temperature=60+-warm", "must be a number"),
        ("gear_set.radii=paper,,mean", "commas"),
        ("gearbox.ratios=1,2", "must name a parameter"),
    ],
)
def test_a_wrong_variation_is_refused_in_words(text, said):
    with pytest.raises(ParameterError, match=said):
        varied_from([text], KEYS)


def test_designs_and_limits_are_read():
    assert sampling_from(None, 1) is None
    assert sampling_from("lhs:200", 7) == Sampling("lhs", 200, 7)
    assert limits_from(["loss=5e2"], ["loss"]) == {"loss": 500.0}


@pytest.mark.parametrize("text", ["lhs", "lhs:", "lhs:-3", "lhs:1.5", "grid:4", "", "lhs:1e9"])
def test_a_wrong_design_text_is_refused(text):
    with pytest.raises(ParameterError, match="--design must be"):
        sampling_from(text, 1)


@pytest.mark.parametrize("text", ["los=5", "loss", "loss=x", "loss=nan"])
def test_a_wrong_limit_is_refused(text):
    with pytest.raises(ParameterError, match="--limit"):
        limits_from([text], ["loss", "efficiency"])


@pytest.mark.parametrize(("unit", "name"), [("km/h", "kmh"), ("m/s", "m_s"), ("N.m", "n_m")])
def test_the_unit_of_an_operating_condition_may_be_left_out(unit, name):
    key = Key(f"vehicle.speed_{name}", "number", unit, "Of the vehicle", "operand")
    assert understood("vehicle.speed", {key.name: key}) is key
