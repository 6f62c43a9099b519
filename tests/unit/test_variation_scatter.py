"""Tolerances of an axle file as distributions of its fields."""

import math
from dataclasses import replace
from functools import reduce

import numpy as np
import pytest

from drivetrain.axle_file.axle_file import AxleFile
from gearlube.variation.design import Design, Sampling
from gearlube.variation.file_variants import AxleVariants
from gearlube.variation.point_study import point_study, scatter
from gearlube.variation.points.bearing import BearingPoint
from gearlube.variation.points.losses import LossPoint
from gearlube_core.bearings.bearing_file import BearingFile
from gearlube_core.errors import ParameterError
from tests.helpers.each import each

FILE = """
name = "scattering"
[gear_set]
mesh_table = "mohammadpour_2015"
backlash_um = 120.0
[tolerances]
gear_set.backlash_um = { plus_minus = 30 }
"gear_set.roughness_rms_um" = { plus_minus_percent = 20.0, distribution = "uniform" }
[tolerances.pinion.bearing]
preload_n = { standard_deviation = 100.0 }
"""


@pytest.fixture
def variants(tmp_path):
    path = tmp_path / "axle.toml"
    path.write_text(FILE)
    return AxleVariants.read(str(path))


def test_fields_scatter_about_their_values_or_defaults(variants):
    found = {one.key: one for one in scatter(LossPoint(axle=variants))}
    backlash = found["gear_set.backlash_um"]
    assert (backlash.low, backlash.high, backlash.mean) == (90.0, 150.0, 120.0)
    assert backlash.deviation == pytest.approx(10.0)  # three to the tolerance
    roughness = found["gear_set.roughness_rms_um"]  # 0.5 um is the default
    assert (roughness.low, roughness.high) == pytest.approx((0.4, 0.6))
    assert roughness.mean is None
    preload = found["pinion.bearing.preload_n"]  # 2500 N is the default
    assert (preload.low, preload.mean, preload.deviation) == (-math.inf, 2500.0, 100.0)


def test_the_loss_of_a_bearing_follows_its_preload_as_its_law_says(variants):
    """Drag by preload is f1 F d (Palmgren): linear, so deviations scale alike."""
    study = LossPoint(axle=variants)
    preload = next(one for one in scatter(LossPoint(axle=variants)) if "preload" in one.key)
    design = Design(spreads=(preload,), sampling=Sampling("lhs", 12))
    column = [one.name for one in study.quantities].index("loss_bearing_torque")
    losses = np.array([study.compute(design.point(i))[column] for i in range(12)])
    ends = [study.compute({"pinion.bearing.preload_n": p})[column] for p in (2400.0, 2600.0)]
    slope = (ends[1] - ends[0]) / 200.0
    # samples lie within 250 N of the middle; that far the law bends by less than 1 % of the slope
    assert losses.std() == pytest.approx(slope * design.column(preload.key).std(), rel=0.01)


def test_a_part_of_the_scatter_is_an_axle_without_tolerances(variants):
    varied = variants.varied({"gear_set.backlash_um": 100.0})
    assert varied.gear_set.backlash_um == 100.0
    assert varied.tolerances == {}


@each(
    ("tolerances", "said"),
    [
        ({"gear_set.backlash": {"plus_minus": 1.0}}, "is it gear_set.backlash_um"),
        ({"gear_set.radii": {"plus_minus": 1.0}}, "fields that are numbers"),
        ({"gear_set.backlash_um": 30.0}, "must be a table such as { plus_minus"),
        ({"gear_set.backlash_um": {}}, "one of plus_minus, .*got none"),
        ({"gear_set.backlash_um": {"plus_minus": -1.0}}, "greater than 0, got -1"),
        (
            {"gear_set.backlash_um": {"plus_minus": 1.0, "standard_deviation": 1.0}},
            "got plus_minus, standard_deviation",
        ),
        (
            {"gear_set.backlash_um": {"standard_deviation": 1.0, "distribution": "uniform"}},
            r"1\.732 standard deviations",
        ),
    ],
)
def test_a_wrong_tolerance_is_refused(tolerances, said):
    with pytest.raises(ParameterError, match=said):
        AxleFile.named("mohammadpour_2015").varied({"tolerances": tolerances})


def test_scatter_without_tolerances_or_values_is_refused():
    with pytest.raises(ParameterError, match="needs \\[tolerances\\] in the file"):
        scatter(point_study("map"))
    with pytest.raises(ParameterError, match="got none in the file of wingertszahn_2023"):
        scatter(point_study("bearing"))
    tolerances = {"housing.immersion_mm": {"plus_minus": 1.0}}
    file = AxleFile.named("mohammadpour_2015").varied({"tolerances": tolerances})
    with pytest.raises(ParameterError, match="needs a value to scatter about"):
        scatter(LossPoint(axle=AxleVariants(file=file)))


@pytest.mark.parametrize(
    ("study", "field", "unread"),
    [
        ("helical", "pair.backlash_mm", "meshing_steps.step_mm"),
        ("contact", "gear.cutter.point_radius_mm", None),
        ("bearing", "rib.roughness_um", None),
    ],
)
def test_fields_of_gear_and_bearing_files_scatter_about_their_values(study, field, unread):
    shipped = point_study(study)
    value = reduce(getattr, field.split("."), shipped.file)
    file = shipped.file.varied({"tolerances": {field: {"plus_minus_percent": 3.0}}})
    (found,) = scatter(replace(shipped, file=file))
    assert found.key == field
    assert (found.low, found.mean, found.high) == pytest.approx((0.97 * value, value, 1.03 * value))
    assert found.deviation == pytest.approx(0.01 * value)
    assert replace(shipped, file=file).varied({field: value}).tolerances == {}
    if unread is not None:
        file = shipped.file.varied({"tolerances": {unread: {"plus_minus": 1.0}}})
        with pytest.raises(ParameterError, match=f"but the study {study} does not use"):
            scatter(replace(shipped, file=file))
    with pytest.raises(ParameterError, match="fields that are numbers"):
        shipped.file.varied({"tolerances": {"nothing_mm": {"plus_minus": 1.0}}})


def bearing_with(tolerances):
    return BearingFile.named("wingertszahn_2023").varied({"tolerances": tolerances})


def test_fields_of_a_bearing_scatter_about_their_values():
    file = bearing_with(
        {"rib.contact_height_mm": {"plus_minus": 0.3}, "bearing.f0": {"plus_minus_percent": 10.0}}
    )
    height, f0 = scatter(BearingPoint(file=file))
    assert (height.low, height.high, height.mean) == pytest.approx((2.2, 2.8, 2.5))
    assert height.deviation == pytest.approx(0.1)  # three to the tolerance
    assert (f0.low, f0.high) == pytest.approx((5.4, 6.6))  # 6 is the default
    part = BearingPoint(file=file).varied({"rib.contact_height_mm": 2.3})
    assert part.rib.contact_height_mm == 2.3
    assert part.tolerances == {}


def test_the_viscous_torque_of_scattering_bearings_is_proportional_to_their_f0():
    """M0 = 1e-7 f0 (nu n)^(2/3) dm^3 (Palmgren): so mean and deviation follow those of f0."""
    study = BearingPoint(file=bearing_with({"bearing.f0": {"plus_minus": 1.5}})).prepared({})
    design = Design(spreads=scatter(study), sampling=Sampling("lhs", 16))
    column = [one.name for one in study.quantities].index("torque_viscous")
    torques = np.array(
        [study.compute({"law": "palmgren", **design.point(i)})[column] for i in range(16)]
    )
    f0 = design.column("bearing.f0")
    assert f0.std() > 0.3
    assert torques / torques.mean() == pytest.approx(f0 / f0.mean(), rel=1e-12)  # roundings


@pytest.mark.parametrize(
    ("tolerances", "said"),
    [
        ({"rib.contact_height": {"plus_minus": 0.3}}, "is it rib.contact_height_mm"),
        ({"operation.speed_rpm": {"plus_minus": 1.0}}, "fields that are numbers"),
    ],
)
def test_a_wrong_tolerance_of_a_bearing_is_refused(tolerances, said):
    with pytest.raises(ParameterError, match=said):
        bearing_with(tolerances)


def test_a_bearing_scatters_about_no_field_that_its_file_leaves_out():
    data = {"tolerances": {"bearing.rolling_scale": {"plus_minus": 0.1}}}
    file = BearingFile.named("wingertszahn_2023").varied(data)
    with pytest.raises(
        ParameterError, match=r"bearing\.rolling_scale needs a value .*does not use"
    ):
        scatter(BearingPoint(file=file))
