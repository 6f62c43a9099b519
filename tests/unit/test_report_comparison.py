"""Two reports side by side: differences, lines in one chart, inputs that differ."""

import math

import pytest
from typer.testing import CliRunner

from gearlube.command import COMMANDS, command_line
from gearlube.report.charts import Axis, Line, heat_map, line_chart
from gearlube.report.comparison import changes_of, comparison, differing_inputs
from gearlube.report.numbers import column_texts, number_text
from gearlube.report.page import report_html, write_report
from gearlube.report.parts import Figure, Finding, Input, Number, Report
from gearlube.report.stored import read_report
from gearlube_core.errors import ParameterError

SPEED, LOSS = Axis("speed", "rpm"), Axis("loss", "W")


def report(study="map", *, loss=100.0, preload="2500", extra=()):
    line = Line(name="preload", x=[1.0, 2.0], y=[loss, 2.0 * loss])
    axes = (SPEED, SPEED, LOSS)
    cells = heat_map([1.0, 2.0], [1.0, 2.0], [[1.0, 2.0], [3.0, loss]], axes)
    return Report(
        study=study,
        title="Losses",
        findings=[Finding("note", f"The loss is {loss:g} W.")],
        numbers=[Number("largest loss", loss, "W"), Number("same", 1.0), *extra],
        inputs=[Input("oil", "an_oil"), Input("preload", preload, "N")],
        figures=[
            Figure(name="lines", title="Loss", caption="c", chart=line_chart([line], SPEED, LOSS)),
            Figure(name="cells", title="Map", caption="c", chart=cells),
        ],
    )


@pytest.fixture
def folders(tmp_path):
    only = Number("only in B", 3.0, "N")
    write_report(report(), tmp_path / "a")
    write_report(report(loss=80.0, preload="2000", extra=[only]), tmp_path / "b")
    write_report(report("cycle"), tmp_path / "other")
    return tmp_path


def both(folders):
    return read_report(folders / "a"), read_report(folders / "b")


def test_differences_are_absolute_and_in_percent(folders):
    by_name = {one.name: one for one in changes_of(*both(folders))}
    assert by_name["largest loss"].difference == -20.0
    assert by_name["largest loss"].percent == pytest.approx(-20.0)
    assert by_name["same"].is_equal
    assert math.isnan(by_name["only in B"].difference)
    assert differing_inputs(*both(folders)) == [("preload", "2500 N", "2000 N")]


def test_findings_name_the_largest_change_and_the_inputs(folders):
    found = comparison(*both(folders), ("old", "new"))
    assert [one.headline for one in found.findings] == [
        "Largest loss: 100 W in A, 80.0 W in B (−20.0 %).",
        "1 input differs.",
    ]
    assert found.findings[1].detail == "preload: 2500 N in A, 2000 N in B."
    html = report_html(found)
    assert "The loss is 80 W." in html  # findings of both stand in it


def test_lines_lie_in_one_chart_and_maps_one_after_the_other(folders):
    found = comparison(*both(folders), ("old", "new"))
    assert [one.name for one in found.figures] == ["lines", "cells_A", "cells_B"]
    names = [trace.name for trace in found.figures[0].chart.data]
    assert names == ["A: preload", "B: preload"]
    assert [trace.line.dash for trace in found.figures[0].chart.data] == ["solid", "dot"]


def test_figures_that_move_stay_in_motion_beside_each_other(tmp_path):
    for name, height in (("a", 2.0), ("b", 3.0)):
        chart = line_chart([Line(name="now", x=[1.0, 2.0], y=[1.0, height])], SPEED, LOSS)
        chart.frames = [{"name": step, "data": [{"y": [1.0, height]}]} for step in ("0", "1")]
        moved = Figure(name="moving", title="Moving", caption="c", chart=chart)
        write_report(Report(study="runup", title="Run-up", figures=[moved]), tmp_path / name)
    a, b = comparison(*both(tmp_path), ("old", "new")).figures
    assert (a.title, b.title) == ("Moving, A", "Moving, B")
    assert [frame.name for frame in b.chart.frames] == ["0", "1"]
    assert list(b.chart.frames[1].data[0].y) == [1.0, 3.0]


def test_equal_reports_are_called_equal(folders):
    a = read_report(folders / "a")
    assert [one.headline for one in comparison(a, a, ("x", "y")).findings] == [
        "All key numbers are the same."
    ]


def test_command_writes_a_report_and_refuses_other_studies(folders, caplog):
    def run(*words):
        return CliRunner().invoke(command_line(COMMANDS), ["compare", *map(str, words)])

    ended = run(f"old={folders / 'a'}", folders / "b", "--out", folders / "out")
    assert ended.exit_code == 0, ended.output
    assert "old and b: map" in (folders / "out" / "report.html").read_text(encoding="utf-8")
    refused = run(folders / "a", folders / "other", "--out", folders / "not")
    assert refused.exit_code == 2
    assert "got `gearlube map` in a and `gearlube cycle` in other" in caplog.text
    assert not (folders / "not").exists()
    with pytest.raises(ParameterError, match="Both folders must be of one study"):
        comparison(read_report(folders / "a"), read_report(folders / "other"), ("a", "b"))


def test_small_differences_show_and_long_lists_end(tmp_path):
    """Six numbers differ; the largest five are told, with the digits that they need."""
    values = {"a": 100.0, "b": 1000.0, "c": 5.0, "d": 8.0, "e": 16.0, "f": 0.0, "same": 3.0}
    other = {"a": 100.3, "b": 1000.0001, "c": 6.0, "d": 4.0, "e": 12.0, "f": 2.0, "same": 3.0}
    for name, chosen in (("a", values), ("b", other)):
        numbers = [Number(key, value, "W") for key, value in chosen.items()]
        inputs = [Input(f"i{k}", f"{k}{name}") for k in range(7)]
        one = Report(study="map", title="T", numbers=numbers, inputs=inputs)
        write_report(one, tmp_path / name)
    found = comparison(*both(tmp_path), ("old", "new"))
    assert [one.headline for one in found.findings] == [
        "F: 0 W in A, 2.00 W in B.",
        "D: 8.00 W in A, 4.00 W in B (−50.0 %).",
        "E: 16.0 W in A, 12.0 W in B (−25.0 %).",
        "C: 5.00 W in A, 6.00 W in B (+20.0 %).",
        "A: 100.0 W in A, 100.3 W in B (+0.300 %).",
        "6 of 7 key numbers differ; the table lists all.",
        "7 inputs differ.",
    ]
    assert found.findings[-1].detail.endswith("i4: 4a in A, 4b in B; and 2 more.")
    numbers, inputs, *_ = found.tables
    assert numbers.rows[0] == ["a", "W", "100.0", "100.3", "+0.300", "+0.300"]
    assert numbers.rows[1][2:4] == ["1000.00", "1000.00"]  # six digits at most
    assert numbers.rows[5] == ["f", "W", "0", "2.00", "+2.00", "–"]
    assert numbers.rows[6] == ["same", "W", "3.00", "3.00", "0", "0"]
    assert inputs.rows[0] == ["i0", "0a", "0b"]


def test_numbers_of_any_size_are_written_with_their_digits():
    texts = {1.236e-5: "0.00001236", 9.9e-6: "9.900·10⁻⁶", 0.5: "0.5000", 123456.0: "123456"}
    texts |= {-1.5: "−1.500", 1e7: "1.000·10⁷", -0.0: "0", math.inf: "∞", -math.inf: "−∞"}
    assert {value: number_text(value, 4) for value in texts} == texts
    assert column_texts([1.0, 12.345, 1e-6]) == ["1.00", "12.3", "1.00·10⁻⁶"]
