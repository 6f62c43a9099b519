"""A chart made from a picture has its data, axes, names and colours."""

import numpy as np
import pytest
from matplotlib.figure import Figure

from gearlube.report.redrawn import redrawn

X = np.array([1.0, 10.0, 100.0])


def test_lines_keep_data_scale_limits_names_and_hollow_markers():
    figure = Figure()
    ax = figure.subplots()
    ax.loglog(X, X**2, "o--", color="#D55E00", mfc="white", label="$f_m$ cut")
    ax.plot(X, X, label="plain")
    ax.set(xlabel="speed [km/h]", ylabel="power [W]", xlim=(1.0, 100.0))
    chart = redrawn(figure)
    dashed, plain = chart.data
    np.testing.assert_allclose([dashed.x, dashed.y], [X, X**2])
    assert (dashed.name, dashed.line.color, dashed.marker.symbol) == (
        "f<sub>m</sub> cut", "#d55e00", "circle-open",
    )  # fmt: skip
    assert dashed.line.dash != plain.line.dash == "solid"
    assert chart.layout.xaxis.type == chart.layout.yaxis.type == "log"
    assert chart.layout.xaxis.range == (0.0, 2.0)  # powers of ten
    assert chart.layout.xaxis.title.text == "speed [km/h]"
    assert "W at" in dashed.hovertemplate


def test_panels_keep_their_places_and_share_one_legend():
    figure = Figure()
    axes = figure.subplots(2, 2, sharex=True)
    for ax in axes.flat:
        ax.plot(X, X, label="same")
        ax.plot(X, -X)
    axes[0, 0].legend(handles=[*axes[0, 0].get_legend_handles_labels()[0],
                               *Figure().subplots().plot([], [], "k:", label="key")])  # fmt: skip
    chart = redrawn(figure)
    assert chart.layout.meta["places"] == [[0, 0], [0, 1], [1, 0], [1, 1]]
    first, last = chart.layout.xaxis, chart.layout.xaxis4
    assert first.domain[1] < last.domain[0]
    assert chart.layout.yaxis.domain[0] > chart.layout.yaxis4.domain[1]
    named = [one.name for one in chart.data if one.showlegend is not False and one.name]
    assert named == ["same", "key"]


def test_levels_spans_bars_areas_and_cells_are_where_they_were():
    figure = Figure()
    ax, other = figure.subplots(1, 2)
    ax.axhline(3.0, color="#009E73")
    ax.axvspan(1.0, 2.0, color="#E69F00")
    ax.bar([1.0, 2.0], [4.0, 5.0], 0.5, bottom=1.0, hatch="//")
    ax.fill_between([0.0, 1.0], 0.0, 2.0)
    mesh = other.pcolormesh([0.0, 1.0, 3.0], [0.0, 2.0], [[7.0, 9.0]])
    figure.colorbar(mesh, ax=other, label="level [dB]")
    chart = redrawn(figure)
    level, span = chart.layout.shapes
    assert (level.y0, level.xref, level.yref) == (3.0, "x domain", "y")
    assert (span.x0, span.x1, span.xref, span.yref) == (1.0, 2.0, "x", "y domain")
    (bars,) = (one for one in chart.data if one.type == "bar")
    for drawn, given in ((bars.x, [1, 2]), (bars.y, [4, 5]), (bars.base, [1, 1])):
        np.testing.assert_allclose(np.asarray(drawn, float), given)
    assert bars.marker.pattern.shape
    (cells,) = (one for one in chart.data if one.type == "heatmap")
    np.testing.assert_allclose(cells.z, [[7.0, 9.0]])
    np.testing.assert_allclose(cells.x, [0.0, 1.0, 3.0])
    assert cells.colorbar.title.text == "level [dB]"
    (area,) = (one for one in chart.data if one.type == "scatter" and one.fill)
    assert max(area.y) == 2.0


def test_names_beside_the_axes_have_room():
    figure = Figure()
    ax = figure.subplots()
    ax.annotate("a mode", (1.0, 0.5), (1.03, 0.6), "axes fraction", "axes fraction")
    chart = redrawn(figure)
    (name,) = chart.layout.annotations
    assert (name.text, name.x, name.y, name.xref) == ("a mode", 1.03, 0.6, "x domain")
    assert chart.layout.margin.r > 40  # px, for six letters


@pytest.mark.parametrize("draw", ["contourf", "imshow", "twiny", "polar"])
def test_what_only_a_picture_shows_is_left_to_it(draw):
    figure = Figure()
    ax = figure.subplots(subplot_kw={"projection": "polar"} if draw == "polar" else {})
    if draw in ("contourf", "imshow"):
        getattr(ax, draw)([[1.0, 2.0], [3.0, 4.0]])
    elif draw == "twiny":
        ax.plot(X, X)
        ax.twiny().plot(X, X)
    assert redrawn(figure) is None


def test_a_second_scale_stands_on_the_right_of_its_panel():
    figure = Figure()
    panels = figure.subplots(2, 1)
    for ax in panels:
        ax.plot(X, X, label="pressure")
        film = ax.twinx()
        film.plot(X, 2.0 * X, label="film")
        film.set_ylabel("film [µm]", color="#D55E00")
        film.set_ylim(0.0, 5.0)
    chart = redrawn(figure)
    places = {(one.name, one.xaxis, one.yaxis) for one in chart.data}
    films = {("film", "x3", "y3"), ("film", "x4", "y4")}
    assert places == {("pressure", "x", "y"), ("pressure", "x2", "y2"), *films}
    scale = chart.layout.yaxis4
    assert (scale.overlaying, scale.anchor, scale.side) == ("y2", "x2", "right")
    assert (scale.title.text, scale.title.font.color) == ("film [µm]", "#d55e00")
    assert scale.range == (0.0, 5.0)
    assert chart.layout.xaxis4.matches == "x2"  # zooms with it
    assert chart.layout.meta["places"] == [[0, 0], [1, 0]]


def test_greek_letters_and_lines_of_titles_are_kept_and_labels_of_decades_are_few():
    figure = Figure()
    ax = figure.subplots()
    ax.plot(X, X)
    ax.set(yscale="log", ylim=(1e-17, 1.0), ylabel=r"$\dot\delta_x$ [mm/s]")
    figure.suptitle("one\ntwo")
    chart = redrawn(figure)
    assert chart.layout.yaxis.title.text == "δ\u0307<sub>x</sub> [mm/s]"
    assert chart.layout.yaxis.dtick == 3  # 17 decades, about six labels
    assert chart.layout.margin.t == 34 + 2 * 17
    (title,) = chart.layout.annotations
    assert title.text == "one<br>two"
