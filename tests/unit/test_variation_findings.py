"""A variation: known answers of made results."""

import json

import numpy as np
import xarray as xr

from gearlube.report.page import report_html
from gearlube.report.parts import GOOD, NOTE, WARNING
from gearlube.variation.report import _varies, findings, numbers, variation_report
from tests.helpers.known_answers import assert_findings, assert_numbers, assert_tables, named


def a_variation(*, sampled):
    """Loss 10 W for each N of preload at 40 degC, half of it at 80 degC; 20 preloads."""
    preload = np.linspace(1.0, 20.0, 20)
    loss = np.array([10.0 * preload, 5.0 * preload])
    inputs = [
        {"key": "oil", "unit": "degC", "meaning": "Of the oil", "sampled": False},
        {"key": "preload", "unit": "N", "meaning": "Of a bearing", "sampled": sampled},
    ]
    results = xr.Dataset(
        {"loss": ("point", loss.ravel(), {"units": "W", "long_name": "power lost in all"})},
        coords={
            "oil": ("point", np.repeat([40.0, 80.0], 20)),
            "preload": ("point", np.tile(preload, 2)),
        },
        attrs={
            "title": "map of made, oil, preload varied",
            "study": "map",
            "shown": ["loss"],
            "shape": [2, 20] if sampled else [2, 20, 1],
            "inputs": json.dumps(inputs),
        },
    )
    names = ["mean", "low", "p2.5", "p50", "p97.5", "high", "deviation"]
    if sampled:
        columns = [
            [r.mean(), r.min(), *np.percentile(r, [2.5, 50.0, 97.5]), r.max(), r.std()]
            for r in loss
        ]
        axes, failed = ["oil"], np.zeros(2, dtype=int)
        statistics = np.array(columns)[:, None, :]
    else:
        axes, failed = ["oil", "preload"], np.zeros((2, 20), dtype=int)
        statistics = np.repeat(loss[..., None, None], len(names), axis=-1)
    sampled_inputs = ["preload"] if sampled else []
    ranks = np.ones((*failed.shape, 1, len(sampled_inputs)))
    summary = xr.Dataset(
        {
            "statistics": ((*axes, "quantity", "statistic"), statistics),
            "rank_correlation": ((*axes, "quantity", "input"), ranks),
            "failed": (axes, failed),
        },
        coords={
            "oil": [40.0, 80.0],
            **({} if sampled else {"preload": preload}),
            "quantity": ["loss"],
            "unit": ("quantity", ["W"]),
            "statistic": names,
            "input": np.array(sampled_inputs, dtype=object),
        },
    )
    return results, summary


def test_a_sampled_variation_has_its_known_key_numbers_findings_and_table():
    results, summary = a_variation(sampled=True)
    # 10 and 5 times 1 to 20 N, whose mean is 10.5
    expected = [
        ("power lost in all: least", 5.0, "W", "5.00"),
        ("power lost in all: mean", 7.5 * 10.5, "W", "78.8"),
        ("power lost in all: largest", 200.0, "W", "200"),
    ]
    assert_numbers(numbers(results, summary), expected)
    # 2.5 and 97.5 % of 1 to 20 lie at 1 + 19 * 0.025 = 1.475 and 19.525; times 7.5
    spread = (NOTE, "mean … Over oil … changes by −50.0 % … follows most preload … lie between",
              "5.00, 200 W, 78.8 W, 40, 80, −50.0 %, +1.00, 95 %, 11.1, 146 W")  # fmt: skip
    assert_findings(findings(results, summary), [spread])
    limited = summary.assign(
        share_above=(("oil", "limited"), [[0.5], [0.0]]), failed=("oil", [0, 3])
    ).assign_coords(limited=["loss"], limit=("limited", [100.0]))
    left = results.assign(range_exceeded=("point", np.repeat([0.0, 2.0, np.nan], [30, 8, 2])))
    said = [
        (WARNING, "of the points have a loss above", "25 %, 100 W"),
        spread,
        (WARNING, "points failed", "3, 40"),
        # 8 of 38: 11 to 18 N in the warmer oil
        (
            WARNING,
            "are extrapolated … All lie within oil … preload … elsewhere",
            "21.1 %, 80.0, 80.0, 11.0, 18.0",
        ),
    ]
    assert_findings(findings(left, limited), said)
    none = left.assign(range_exceeded=0.0 * left["range_exceeded"])
    assert findings(none, summary)[-1].level == GOOD
    report = variation_report(results, summary)
    assert report_html(report).count('class="plot"') == 3  # over the axis, distributions, ranks
    lines, histograms, ranks = (one.chart for one in report.figures)
    # 2.5, 50 and 97.5 % of the samples over the oil: 5 and 10 times 1.475, 10.5 and 19.525
    band, middle = (line.y for line in lines.data)
    np.testing.assert_allclose(middle, [105.0, 52.5])
    np.testing.assert_allclose(sorted(set(band)), [7.375, 14.75, 97.625, 195.25])
    assert [one.x.tolist() for one in histograms.data] == [
        [factor * k for k in range(1, 21)] for factor in (10.0, 5.0)
    ]
    assert histograms.layout.xaxis.title.text == "power lost in all [W]"
    assert histograms.layout.yaxis.title.text == "points"
    assert list(ranks.data[0].x) == [1.0]
    deviation = np.sqrt((20.0**2 - 1.0) / 12.0)  # of 1 to 20
    words = ("mean", "standard deviation", "least", "2.5 %", "median", "97.5 %", "largest")
    table = [
        ["oil [°C]", *(f"{one} [W]" for one in words)],
        *([degc, *(f * one for one in (10.5, deviation, 1.0, 1.475, 10.5, 19.525, 20.0))]
          for degc, f in ((40.0, 10.0), (80.0, 5.0))),
    ]  # fmt: skip
    assert_tables(report.tables, {"power lost in all": table})


def test_a_variation_on_a_grid_has_a_line_of_all_values_for_each_other_axis():
    results, summary = a_variation(sampled=False)
    report = variation_report(results, summary)
    (figure,) = report.figures
    assert [len(line.x) for line in figure.chart.data] == [20, 20]
    np.testing.assert_allclose(figure.chart.data[1].y, 5.0 * np.linspace(1.0, 20.0, 20), rtol=1e-6)
    said = (NOTE, "Over oil … Over preload",
            "5.00, 200 W, 78.8 W, 40, 80, −50.0 %, 1, 20, +1900 %")  # fmt: skip
    assert_findings(findings(results, summary), [said])
    (table,) = report.tables
    preload = np.arange(1.0, 21.0)
    assert table.rows == [
        [degc, p, f * p] for degc, f in ((40.0, 10.0), (80.0, 5.0)) for p in preload
    ]


def test_only_a_quantity_of_several_different_values_varies():
    values = {"none": [np.nan], "one": [3.0, np.nan], "same": [3.0, 3.0], "two": [3.0, 4.0]}
    results = xr.Dataset({name: ("point", [*row, np.nan][:2]) for name, row in values.items()})
    found = {name: _varies(results, named(name=name)) for name in values}
    assert found == {"none": False, "one": False, "same": False, "two": True}
