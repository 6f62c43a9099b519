"""Many parts by a quick model: distributions, shares above limits, and which tolerance pays."""

import numpy as np
import pytest
from scipy.stats import norm

from gearlube.variation.design import Axis, Design, Sampling, Spread
from gearlube.variation.parts import (
    METHODS,
    check_parts,
    counted_share,
    quick_model,
    regression_shares,
    scattered_parts,
    share_above,
)
from gearlube.variation.parts_report import findings
from gearlube.variation.run import run_variation
from gearlube.variation.scatter import spreads_in
from gearlube.variation.store import open_variation
from gearlube_core.errors import ParameterError
from tests.helpers.variation_stand_in import AreaStudy

# area = width times length: about 10 and 2 it is nearly 20 + 2 dw + 10 dl
SPREADS = (
    Spread(key="width_mm", low=9.0, high=11.0, mean=10.0, deviation=0.3),
    Spread(key="length_mm", low=1.8, high=2.2, mean=2.0, deviation=0.03),
)
DESIGN = Design(spreads=SPREADS, sampling=Sampling("lhs", 80))


@pytest.fixture(scope="module")
def runs(tmp_path_factory):
    """Full runs of a plane area."""
    folder = tmp_path_factory.mktemp("runs")
    run_variation(AreaStudy(), DESIGN, out=folder, jobs=1)
    return open_variation(folder)


@pytest.mark.slow
def test_a_linear_result_is_predicted_exactly():
    rng = np.random.default_rng(5)
    inputs = rng.standard_normal((40, 3))
    model = quick_model(3).fit(inputs, 7.0 + inputs @ [3.0, -1.0, 0.5])
    # the least noise that the process allows is 0.1 % of the scatter, 3
    assert model.predict(np.array([[1.0, 2.0, 4.0]])) == pytest.approx([10.0], abs=3e-3)


@pytest.mark.slow
def test_the_share_of_areas_above_a_limit_is_that_of_the_normal_distribution(runs):
    limit = 21.0
    many = scattered_parts(runs, DESIGN, parts=20_000, limits={"area": limit})
    value, low, high = many["share_above"].sel(quantity="area").values
    # variances of a product add up: (2 * 0.3)^2 + (10 * 0.03)^2, and their product 0.009^2
    exact = norm.sf(limit, 20.0, np.sqrt(0.36 + 0.09 + 0.009**2))
    # ends cut off at 3.3 and 6.7 deviations take less than 0.1 % away
    deviation = np.sqrt(exact * (1.0 - exact) / 2e4)
    assert value == pytest.approx(exact, abs=1e-3 + 3.0 * deviation)
    # an exact model adds nothing to the scatter of the parts; the share scatters by 3 %
    assert high - low == pytest.approx(2.0 * 1.96 * deviation, rel=0.05)


def test_both_methods_give_the_variance_shares_of_a_product(runs):
    many = scattered_parts(runs, DESIGN, parts=200)
    for method in METHODS:
        shares = many[method].sel(quantity="area", input=["width_mm", "length_mm"]).values
        # 0.36 and 0.09 of 0.45; 80 runs have their own variances to 2 / sqrt(2 80), the squares of
        # a design lhs much closer; Sobol by 1024 samples scatters by 0.02
        assert shares == pytest.approx([0.8, 0.2], abs=0.03), method


def test_a_run_out_that_raises_the_result_either_way_has_its_share():
    inputs = np.random.default_rng(2).standard_normal((20_000, 2))
    # y = x1 + x2^2 with deviations of one: variances 1 and 2
    shares = regression_shares(inputs, inputs[:, 0] + inputs[:, 1] ** 2)
    assert shares == pytest.approx([1.0 / 3.0, 2.0 / 3.0], abs=0.02)  # 1 / sqrt(20,000), thrice


class Rough(AreaStudy):
    """An area with a bend and with noise, as of what no input tells."""

    def compute(self, point):
        area, width, *rest = super().compute(point)
        seed = int(np.float64(width).view(np.uint64))
        noise = 0.1 * np.random.default_rng(seed).standard_normal()
        return (area + np.sin(3.0 * width) * 0.5 + noise, width, *rest)


@pytest.mark.slow
def test_the_bars_of_the_quick_model_hold_their_share_of_runs_that_it_has_not_seen(tmp_path):
    design = Design(spreads=SPREADS, sampling=Sampling("random", 300, seed=8))
    run_variation(Rough(), design, out=tmp_path, jobs=1)
    many = scattered_parts(open_variation(tmp_path), design, parts=200).sel(quantity="area")
    assert int(many["quick"].notnull().sum()) == 90
    # 0.95 of 90, a deviation of 0.023, and nearly as much for the bar from 210 runs: three of them
    assert 0.86 < float(many["coverage"]) <= 1.0
    assert 0.08 < float(many["rms"]) < 0.13  # noise 0.1: the bend of the sine is learnt
    assert abs(float(many["bias"])) < 3.0 * float(many["bias_error"])


@pytest.mark.slow
def test_confidence_of_a_share_covers_the_truth_and_grows_with_the_error_of_the_model():
    rng = np.random.default_rng(3)
    truth, held, noise, count = norm.sf(1.0), 0, 0.5, 200
    for _ in range(count):
        quick = rng.standard_normal(1000) * np.sqrt(1.0 - noise**2)  # together a deviation of 1
        share = share_above(1.0, quick, noise * rng.standard_normal(60))
        held += share.low <= truth <= share.high
    # 95 % wanted; a deviation of the count is 3, resampling 60 errors takes as much
    assert held >= 182
    sharp = share_above(1.0, rng.standard_normal(1000), np.zeros(60))
    assert share.high - share.low > 1.5 * (sharp.high - sharp.low)


def test_a_limit_that_no_part_reaches_has_an_upper_end_above_nothing(runs):
    many = scattered_parts(runs, DESIGN, parts=1000, limits={"area": 40.0})
    value, _, high = many["share_above"].sel(quantity="area").values
    # Wilson: z^2 / (n + z^2) of 1000 parts, and of 80 runs
    assert (value, high) == (0.0, pytest.approx(0.00383, abs=1e-5))
    assert counted_share(0, 80).high == pytest.approx(0.0458, abs=1e-4)
    assert findings(runs, many)[0].headline.startswith("0 % (95 % confidence 0 to 0.38 %)")


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("width = { plus_minus = 1.0 }", "with their unit, got width. Write width_mm [mm]"),
        ("weight_kg = { plus_minus = 1.0 }", "must name a parameter of the study, got 'weight_kg'"),
        ("width_mm = { plus_minus = -1.0 }", "width_mm"),
        ("shape = { plus_minus = 1.0 }", "shape is a text"),
        ("width_mm = 3.0", "must be a table such as"),
    ],
)
def test_a_wrong_tolerance_is_refused_with_its_cure(text, said, tmp_path):
    path = tmp_path / "tolerances.toml"
    path.write_text(f"[tolerances]\n{text}\n")
    with pytest.raises(ParameterError, match=said.replace("[", r"\[")):
        spreads_in(path, AreaStudy())


@pytest.mark.parametrize(
    ("parts", "samples", "widths", "said"),
    [
        (1000, 20, (10.0,), r"at least 40 samples .* got 20"),
        (5, 80, (10.0,), r"--parts must be within 100 to"),
        (1000, 80, (10.0, 11.0), r"one value of length_mm, got 2"),
    ],
)
def test_a_design_that_cannot_train_a_model_is_refused_before_any_run(parts, samples, widths, said):
    axes = (Axis("length_mm", widths),)
    design = Design(axes=axes, spreads=SPREADS[:1], sampling=Sampling("lhs", samples))
    with pytest.raises(ParameterError, match=said):
        check_parts(design, parts)
