"""A report as a page: self-contained, valid, with units, and readable by another program."""

import base64
import gzip
import logging
import re
from dataclasses import replace

import numpy as np
import pytest
import typer
import xarray as xr
from lxml import html as lxml_html

from gearlube.cli.study_run import tell_findings
from gearlube.command import COMMANDS, command_line
from gearlube.report.charts import (
    Axis,
    Line,
    add_line,
    add_map,
    bar_chart,
    heat_map,
    line_chart,
    mark_level,
    panels,
    stack_chart,
)
from gearlube.report.page import report_html, write_report
from gearlube.report.parts import (
    NOTE,
    WARNING,
    Column,
    Figure,
    Finding,
    Input,
    Number,
    Report,
    Table,
)
from gearlube.report.stored import read_report
from gearlube.studies.drive_cycle import report as drive_cycle
from gearlube.studies.runup import report as runup
from gearlube.studies.sweep import report as sweep
from gearlube.studies.sweep.settings import SweepSettings
from gearlube_core.errors import ParameterError

PNG = base64.b64decode(
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGAWjR9awAAAABJRU5ErkJggg=="
)
SPEED, LOSS = Axis("vehicle speed", "km/h"), Axis("power lost", "W")
X = np.array([20.0, 40.0, 60.0])


def charts():
    lines = [Line(name="a & b", x=X, y=X**2), Line(name="dashed", x=X, y=X, dash=1)]
    parts = np.array([[1.0, 2.0, 3.0], [0.5, 0.5, np.nan]])
    axes = (SPEED, Axis("frequency", "Hz"), Axis("level", "dB"))
    below = panels(["one", "two"], SPEED, [LOSS, LOSS])
    add_line(below, lines[0], 0, SPEED, LOSS, row=1, col=1)
    add_map(below, X, X, np.outer(X, X), axes, contours=True, row=2, col=1)
    levels = line_chart(lines, SPEED, LOSS)
    mark_level(levels, 1000.0, "limit")
    mark_level(levels, 30.0, "third gear", across=False)
    return {
        "levels": levels,
        "areas": stack_chart(["bearing", "seal"], X, parts, SPEED, LOSS),
        "cells": heat_map(X, X, np.outer(X, X), axes, limits=(0.0, 1.0)),
        "level_bars": bar_chart(["oil", "preload"], [3.0, 1.0], Axis("change", "%")),
        "below": below,
    }


@pytest.fixture(scope="module")
def report():
    return Report(
        study="map",
        title="Losses <of> an axle",
        findings=[
            Finding("note", "The loss is 123 W."),
            Finding("good", "Nothing left its range."),
            Finding("warning", "The film is 0.1 µm thin.", "Rough flanks touch & wear."),
        ],
        numbers=[Number("loss", 123.456, "W"), Number("nothing", float("nan"), "%")],
        figures=[
            *(
                Figure(name=name, title=name, caption=f"What {name} says.", chart=chart)
                for name, chart in charts().items()
            ),
            Figure(name="picture", title="Picture", caption="Small.", picture=PNG),
        ],
        tables=[
            Table(
                title="Points",
                columns=[Column("speed", "km/h"), Column("film", "µm", 2), Column("why")],
                rows=[[20.0, 0.123, "cold"], [100.0, None, "</script>"]],
            )
        ],
        inputs=[Input("oil", "75W-90"), Input("preload", "2500", "N", "assumed", "a guess")],
        limits=["Steady running only."],
        facts=[("command", "gearlube map <axle>")],
        files=["map.nc"],
    )


@pytest.fixture(scope="module")
def page(report):
    return report_html(report, "2026-01-02 03:04 UTC")


def test_page_loads_nothing_from_elsewhere(page):
    tree = lxml_html.document_fromstring(page)
    loaded = [*tree.xpath("//@src"), *tree.xpath("//link/@href"), *tree.xpath("//@srcset")]
    assert loaded
    assert all(one.startswith("data:") for one in loaded)
    assert "@import" not in page
    assert re.search(r"url\(", page) is None


def test_page_is_whole_and_says_units_date_versions_and_its_own_size(page, report):
    tree = lxml_html.document_fromstring(page)
    parts = tree.xpath("//section/@id")
    assert parts == ["findings", "numbers", "figures", "tables", "inputs", "limits", "origin"]
    assert tree.xpath("//h1/text()") == ["Losses <of> an axle"]
    heads = [" ".join(one.text_content().split()) for one in tree.xpath("//thead/tr/th")]
    assert heads[:3] == ["speedkm/h", "filmµm", "why"]
    cells = [[one.text for one in row] for row in tree.xpath("//section[@id='tables']//tbody/tr")]
    assert cells == [["20.0", "0.12", "cold"], ["100.0", "–", "</script>"]]
    text = tree.text_content()
    assert "123 W" in text
    assert "2026-01-02 03:04 UTC" in text
    assert "numpy" in text
    said = float(re.search(r"one file of ([\d.]+) MB", text).group(1))
    assert said == pytest.approx(len(page.encode()) / 1e6, abs=0.06)  # one decimal is said
    assert "gearlube map <axle>" in text


def test_the_answer_comes_first_then_warnings(page):
    tree = lxml_html.document_fromstring(page)
    assert tree.xpath("//ul[@class='findings']/li/@class") == ["note", "warning", "good"]


def test_contents_lead_to_every_section_and_figure(page, report):
    tree = lxml_html.document_fromstring(page)
    places = tree.xpath("//section/@id") + [one.name for one in report.figures]
    assert tree.xpath("//nav//a/@href") == [f"#{one}" for one in places]
    assert set(places) <= set(tree.xpath("//@id"))


@pytest.mark.parametrize(("main", "first"), [((), "levels"), (("areas", "gone", "cells"), "areas")])
def test_main_figures_stand_open_and_the_others_are_folded(report, main, first):
    many = [replace(one, name=f"{one.name}2") for one in report.figures]
    figures = [*report.figures, *many]
    whole = replace(report, figures=figures, main_figures=main)
    section = lxml_html.document_fromstring(report_html(whole)).xpath("//section[@id='figures']")[0]
    shown = section.xpath("./figure/@id")
    assert shown[0] == first
    assert len(shown) == (2 if main else 8)
    folded = section.xpath("./details[not(@open)]/figure/@id")
    assert sorted([*shown, *folded]) == sorted(one.name for one in figures)


def test_a_key_number_without_a_value_has_no_tile(page):
    tree = lxml_html.document_fromstring(page)
    assert tree.xpath("//dl[@class='numbers']/div/dt/text()") == ["loss"]


def test_a_key_number_has_its_band_and_an_empty_column_is_not_shown():
    columns = [Column("point"), Column("lost", "W"), Column("limit", "W")]
    table = Table(title="Losses", columns=columns, rows=[["a", 5.0, None], ["b", 7.0, None]])
    lost = Number("power lost", 706.0, "W", band=(457.0, 1179.0))
    shown = report_html(Report(study="map", title="Losses", numbers=[lost], tables=[table]))
    assert "706 <small>W</small><br><small>457 to 1179 (95 %)</small>" in shown
    assert ">lost<small>W</small>" in shown
    assert ">limit<" not in shown


def test_plotly_lies_inside_once_and_whole(page):
    from plotly.offline import get_plotlyjs

    packed = lxml_html.document_fromstring(page).xpath("//script[@id='plotly-packed']")
    assert len(packed) == 1
    assert gzip.decompress(base64.b64decode(packed[0].text)).decode() == get_plotlyjs()


def test_a_report_without_charts_has_no_plotly_and_is_small(report):
    bare = report_html(Report(study="map", title="Bare", findings=report.findings))
    assert "plotly-packed" not in bare
    assert len(bare) < 20_000


@pytest.mark.parametrize("drawn", [True, False])
def test_plotly_lies_inside_where_a_chart_does_not_where_only_pictures_do(report, drawn):
    figures = [one for one in report.figures if (one.chart is not None) == drawn]
    assert figures
    found = report_html(Report(study="map", title="Figures alone", figures=figures))
    assert ("plotly-packed" in found) == drawn


def test_every_chart_has_named_axes_with_units_and_a_caption(page, report):
    for figure in report.figures[:-1]:
        layout = figure.chart.layout
        titles = [
            one.title.text
            for name, one in layout.to_plotly_json().items()
            if name.startswith(("xaxis", "yaxis"))
            for one in [layout[name]]
            if one.title.text
        ]
        assert any("[" in one for one in titles), figure.name
        assert f"What {figure.name} says." in page


def test_a_picture_is_enlarged_by_a_tap_and_a_chart_is_not(page, report):
    found = lxml_html.fromstring(page)
    pictures = found.xpath("//label[@class='picture'][input[@type='checkbox']]/img")
    assert [one.get("alt") for one in pictures] == [
        one.title for one in report.figures if one.chart is None
    ]
    assert not found.xpath("//label//div[contains(@class, 'plot')]")


def test_every_contour_has_one_line_white_on_dark_and_black_on_light():
    # the product runs from 400 to 3600; colours are light above 55 % of it, 2160
    _, filled, *lines = charts()["below"].data
    assert filled.contours.showlines is False
    inks = {one.line.color: np.arange(one.contours.start, one.contours.end, 500.0) for one in lines}
    np.testing.assert_allclose(inks["white"], [500.0, 1000.0, 1500.0, 2000.0])
    np.testing.assert_allclose(inks["black"], [2500.0, 3000.0, 3500.0, 4000.0])  # the last unseen
    assert all(one.contours.size == filled.contours.size == 500.0 for one in lines)


def test_units_of_input_files_are_written_as_in_the_rest_of_a_page():
    inputs = [Input("relief.torque_n_m", "300", "N.m"), Input("angle", "148.4", "deg", "assumed")]
    found = report_html(Report(study="design", title="Pair", inputs=inputs))
    assert "300 N·m" in found
    assert "148.4 °" in found


def test_what_a_page_keeps_is_read_back(report, tmp_path):
    write_report(report, tmp_path)
    data = read_report(tmp_path)
    assert data["study"] == "map"
    assert data["numbers"] == [["loss", 123.456, "W", 3], ["nothing", None, "%", 3]]
    assert data["inputs"][1] == ["preload", "2500", "N", "assumed", "a guess"]
    assert set(data["charts"]) == set(charts())
    drawn = data["charts"]["levels"]["data"][0]["y"]
    values = np.frombuffer(base64.b64decode(drawn["bdata"]), dtype=drawn["dtype"])
    np.testing.assert_allclose(values, X**2, rtol=1e-6)  # 32 bit


def test_a_folder_without_a_report_is_refused_with_a_cure(tmp_path):
    with pytest.raises(ParameterError, match=r"must hold a report.html, got none. Give a folder"):
        read_report(tmp_path)
    (tmp_path / "report.html").write_text("<html></html>")
    with pytest.raises(ParameterError, match="numbers of a report, got none"):
        read_report(tmp_path)


def test_wrong_parts_are_refused():
    with pytest.raises(ParameterError, match="level"):
        Finding("bad", "It is.")
    with pytest.raises(ParameterError, match="must have 1 cells, one for each column, got 2"):
        Table(title="T", columns=[Column("a")], rows=[[1.0, 2.0]])
    with pytest.raises(ParameterError, match="must have a chart or a picture"):
        Figure(name="f", title="F", caption="c")


def test_the_console_has_every_finding_of_the_report(caplog, tmp_path):
    told = [Finding(NOTE, f"Note {i}.", "More.") for i in range(9)]
    with caplog.at_level(logging.INFO, "gearlube"):
        tell_findings(
            [*told, Finding(WARNING, "Look.", "Law A left its range at 3 rpm.")], tmp_path
        )
    lines = [record.getMessage() for record in caplog.records]
    assert lines[1] == "Look. Law A left its range at 3 rpm."
    assert [lines[0], *lines[2:-1]] == [f"Note {i}." for i in range(9)]


@pytest.mark.parametrize(
    ("command", "typed", "inputs", "attributes", "said"),
    [
        ("cycle", ["--air-temperature", "5"], drive_cycle._settings,
         {"cycle": "nedc", **dict.fromkeys(drive_cycle._SETTINGS, 5.0)},
         {"cycle: air temperature": "option", "cycle: name": "default"}),
        ("sweep", ["--roughness-um", "0.4", "--quick"], sweep._settings,
         {f"setting_{name}": value for name, value in SweepSettings().as_dict().items()},
         {"sweep: roughness rms": "option", "sweep: friction": "axle file or its default",
          "sweep: driver": "default", "sweep: settling time": "option"}),
        ("runup", ["--rate", "3", "--to", "80"], lambda one: runup._settings(one, ""),
         {"ramp": "run-up", **{f"setting_{row[0]}": 300.0 for row in runup._INPUTS}},
         {"ramp: duration": "option", "ramp: end speed of the pinion": "option",
          "ramp: start speed of the pinion": "default", "ramp: driver": "default"}),
    ],
)  # fmt: skip
def test_inputs_say_whether_an_option_a_file_or_a_default_gave_them(
    command, typed, inputs, attributes, said
):
    group = typer.main.get_command(command_line(COMMANDS))
    whole = group.make_context("gearlube", [command], resilient_parsing=True)
    with group.get_command(whole, command).make_context(command, typed, parent=whole):
        found = {one.name: one.why for one in inputs(xr.Dataset(attrs=attributes))}
    assert {name: found[name] for name in said} == said
