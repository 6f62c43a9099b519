"""A source of loss has one name and one colour in every figure and report."""

import numpy as np
import pytest
import xarray as xr
from matplotlib.colors import to_hex

from gearlube.plotting.words import SOURCE_COLOURS, source_colour, source_words
from gearlube.studies.drive_cycle.figures import cycle_figure
from gearlube.studies.drive_cycle.report import loss_chart
from gearlube.studies.loss_map.figures import loss_split
from gearlube.studies.loss_map.report import split_chart
from gearlube.studies.runup.figures.catalogue import overview
from gearlube.studies.sweep.figures.charts import efficiency
from gearlube_core.dynamics.hypoid_axle.losses import LOSS_SOURCES
from tests.helpers.each import each

# as results list them, and turned round with one that loses nothing: places must not decide
SOURCES = LOSS_SOURCES
FEWER = tuple(reversed([one for one in LOSS_SOURCES if one != "bearing_torque"]))
X = np.array([1.0, 2.0, 4.0])


def loss(sources, *sizes):
    """Return powers of sources [W], all large enough to be drawn."""
    power = 10.0 + np.arange(len(sources))
    return np.broadcast_to(power, (*sizes, len(sources))).copy()


def sweep(sources):
    each = ("preload", "speed")
    data = {f"efficiency_{one}": (each, np.full((1, 3), 0.95)) for one in ("mesh", "axle")}
    data["loss"] = ((*each, "source"), loss(sources, 1, 3))
    places = {"preload": [2500.0], "speed": X, "speed_kmh": ("speed", X), "source": list(sources)}
    return xr.Dataset(data, places)


def loss_map(sources):
    grid = ("temperature", "speed", "torque")
    places = {"temperature": [80.0], "speed": X, "torque": X, "source": list(sources)}
    attrs = {"not_modelled": "windage"}
    return xr.Dataset({"loss": ((*grid, "source"), loss(sources, 1, 3, 3))}, places, attrs)


def cycle(sources):
    return xr.Dataset(
        {
            "loss": (("step", "source"), loss(sources, 3)),
            "energy_lost": ("source", loss(sources)),
            "vehicle_speed": ("step", X),
            "pinion_torque": ("step", X),
            "efficiency": 0.95,
            "time": ("point", X),
            **{f"oil_temperature{end}": ("point", X) for end in ("", "_low", "_high")},
        },
        {"step": X, "source": list(sources)},
        {"cycle": "c", "not_modelled": "windage", "air_temperature_degc": 20.0},
    )


def runup(sources):
    return xr.Dataset(
        {
            "block_speed": ("block_time", X),
            "pinion_torque": ("torque_time", X),
            "loss": (("slow_time", "source"), loss(sources, 3)),
        },
        {"block_time": X, "torque_time": X, "slow_time": X, "source": list(sources)},
        {"setting_duration": 4.0, "setting_pinion_torque": 80.0, "ramp": "run-up"},
    )


def legends(figure):
    """Return colour by label of a drawn figure, of the parts that are filled."""
    found = {}
    for legend in [*figure.legends, *(ax.get_legend() for ax in figure.axes)]:
        if legend is None:
            continue
        for patch, text in zip(legend.get_patches(), legend.get_texts(), strict=False):
            found[text.get_text().partition(",")[0]] = to_hex(patch.get_facecolor())
    return found


def traces(chart):
    """Return colour by name of a chart of plotly."""
    filled = [one for one in chart.data if one.type == "bar" or one.fillcolor]
    return {one.name: one.marker.color if one.type == "bar" else one.fillcolor for one in filled}


@pytest.mark.slow
@each("sources", [SOURCES, FEWER])
@each(
    ("colours", "data", "draw"),
    [
        (legends, sweep, efficiency),
        (legends, loss_map, loss_split),
        (legends, cycle, cycle_figure),
        (legends, runup, overview),
        (traces, loss_map, split_chart),
        (traces, cycle, loss_chart),
    ],
)
def test_a_source_has_its_colour(sources, colours, data, draw):
    found = colours(draw(data(sources)))
    for source in sources:
        assert found[source_words(source)].lower() == source_colour(source).lower()


@pytest.mark.parametrize("speeds", [1, 2, 3])
def test_no_text_of_the_losses_is_cut_off_at_few_speeds(speeds):
    data = loss_map(SOURCES).isel(speed=slice(speeds))
    data["loss_torque_low"] = data["loss_torque_high"] = data["loss"].sum("source")
    data.attrs["not_modelled"] = ", ".join(f"bearings of the wheel end {i}" for i in range(8))
    figure = loss_split(data)
    figure.canvas.draw()
    for part in (figure._suptitle, *figure.legends):
        box = part.get_window_extent()
        assert box.x0 >= 0.0
        assert box.x1 <= figure.bbox.x1


def test_every_source_has_a_colour_of_its_own():
    assert set(SOURCE_COLOURS) == set(LOSS_SOURCES)
    assert len(set(SOURCE_COLOURS.values())) == len(LOSS_SOURCES)
