"""Inputs of flank modifications are refused with what, limit and cure."""

import numpy as np
import pytest

from gearlube_core.errors import ParameterError
from gearlube_core.helical_geometry.lay_angle import lay_angles
from gearlube_core.helical_geometry.meshing_steps import (
    MeshingSteps,
    meshing_steps,
    position_of_line,
)
from gearlube_core.helical_geometry.modification import (
    Crown,
    FlankModification,
    ModifiedPair,
    PowerTipRelief,
    TipRelief,
)
from gearlube_core.helical_geometry.undeformed_gap import UndeformedGap
from tests.helpers.each import each
from tests.helpers.jamali_2015 import jamali_2015, jamali_2015_steps
from tests.helpers.named_pairs import named_pair

PAIR = named_pair("jamali_2015_a")


@each(
    ("make", "named"),
    [
        (lambda: TipRelief(amount=70.0, extent=2e-3, k=1.0), "amount"),
        (lambda: TipRelief(amount=7e-5, extent=0.0, k=1.0), "extent"),
        (lambda: TipRelief(amount=7e-5, extent=2e-3, k=1.5), "k must"),
        (lambda: PowerTipRelief(amount=7e-5, extent=2e-3, beta=0.5), "beta"),
        (lambda: Crown(amount=-8e-6, start=0.0), "amount"),
        (lambda: FlankModification(lead_slope=15.0), "lead_slope"),
        (lambda: FlankModification(profile_slope=float("nan")), "profile_slope"),
        (lambda: FlankModification(facets=-1), "facets"),
        (lambda: FlankModification(facets=20.5), "facets"),
        (lambda: jamali_2015("c"), "design"),
        (lambda: UndeformedGap(modified=jamali_2015("a"), form="circle"), "form"),
        (lambda: lay_angles(0.0, PAIR, form="chord"), "form"),
        (lambda: lay_angles(0.0, PAIR, distance=0.0), "distance"),
        (lambda: meshing_steps(jamali_2015("a"), 4e-5, 0.95), "smallest_share"),
        (lambda: MeshingSteps(pair=PAIR, first_position=0.0, step=0.0, count=3), "step"),
    ],
)
def test_bad_inputs_are_refused_by_name(make, named):
    with pytest.raises(ParameterError, match=named):
        make()


@pytest.mark.parametrize(
    ("flank", "named"),
    [
        (FlankModification(crown=Crown(amount=8e-6, start=22e-3)), r"gear\.crown\.start"),
        (
            FlankModification(tip_relief=TipRelief(amount=7e-5, extent=0.02, k=1.0)),
            r"gear\.tip_relief\.extent",
        ),
    ],
)
def test_modifications_that_do_not_fit_the_pair_are_refused(flank, named):
    with pytest.raises(ParameterError, match=named):
        ModifiedPair(pair=PAIR, gear=flank)


def test_pair_without_modifications_removes_nothing():
    plain = ModifiedPair(pair=PAIR)
    assert np.all(plain.removal(np.linspace(0.018, 0.039, 5), 0.01) == 0.0)
    assert plain.contact_start == pytest.approx(PAIR.contact_start, rel=1e-14)
    assert plain.contact_end == pytest.approx(PAIR.contact_end, rel=1e-14)


def test_steps_name_positions_and_lines_alike():
    steps = jamali_2015_steps("b")
    n = np.array([0, 75, 300, 575])
    assert steps.step_at(steps.position(n)) == pytest.approx(n, abs=1e-9)
    assert position_of_line(steps.line(n), steps.pair) == pytest.approx(
        steps.position(n), abs=1e-15
    )
