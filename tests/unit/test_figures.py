"""Figures: folders, scales that are shared."""

from types import SimpleNamespace

import numpy as np
import pytest
import xarray as xr
from matplotlib.figure import Figure

from gearlube.plotting.figure_files import save_figure_folder
from gearlube.plotting.style import label_contours
from gearlube.studies.bearing.figures import torque_of_laws
from gearlube.studies.helical.figures.catalogue import pair_losses
from gearlube.studies.sound.figures import heard_orders

SPEED = np.array([500.0, 1000.0, 2000.0])


def bearing() -> xr.Dataset:
    """Return torques that grow tenfold from the first temperature, hence panel, to the second."""
    torque = np.array([[0.4, 4.0], [0.5, 5.0], [0.6, 6.0]]).reshape(1, 3, 1, 1, 2)
    axes = ("law", "speed", "axial_load", "radial_load", "temperature")
    variables = dict.fromkeys(("torque", "torque_low", "torque_high"), (axes, torque))
    coords = {
        "law": ["palmgren"], "speed": SPEED, "axial_load": [1e3], "radial_load": [0.0],
        "temperature": [40.0, 90.0],
    }  # fmt: skip
    return xr.Dataset(variables, coords, {"name": "a", "oil": "b"})


def helical() -> xr.Dataset:
    loss = np.array([[[0.4, 0.5, 0.6]], [[4.0, 5.0, 6.0]]])
    coords = {"temperature": [40.0, 90.0], "torque": [100.0], "speed": SPEED}
    variables = {"loss_torque": (("temperature", "torque", "speed"), loss)}
    return xr.Dataset(variables, coords, {"not_modelled": "churning"})


def heard(largest: float) -> SimpleNamespace:
    time = np.array([0.0, 1.0, 2.0])
    dataset = xr.Dataset(
        {
            "order_contribution": (("order", "time"), largest * np.array([[0.2, 0.5, 1.0]])),
            "steady_loudness": ("time", np.full(3, 0.1)),
            "pinion_speed": ("time", np.full(3, 100.0)),
        },
        {"order": [13.0], "time": time},
        {"name": "a", "pinion_teeth": 13, "study": "sweep"},
    )
    return SimpleNamespace(dataset=dataset)


@pytest.mark.parametrize(
    "draw",
    [
        lambda: torque_of_laws(bearing()),
        lambda: pair_losses(helical()),
        lambda: heard_orders([heard(0.6), heard(6.0)]),
    ],
    ids=["bearing", "helical", "sound"],
)
def test_the_common_scale_holds_the_largest_curve(draw):
    first, second, *_ = draw().axes
    for panel in (first, second):
        assert panel.get_ylim()[0] == 0.0
        assert 6.0 < panel.get_ylim()[1] < 7.0


def test_figures_of_an_earlier_run_do_not_stay(tmp_path):
    folder = tmp_path / "figures"
    save_figure_folder({"lines": Figure(figsize=(1, 1)), "bars": Figure(figsize=(1, 1))}, folder)
    assert save_figure_folder({"bars": Figure(figsize=(1, 1))}, folder) == [folder / "bars.png"]
    assert [path.name for path in folder.iterdir()] == ["bars.png"]
    assert save_figure_folder({}, folder) == []
    assert not folder.exists()


def test_what_no_study_drew_stays(tmp_path):
    (tmp_path / "mine.txt").write_text("a note")
    save_figure_folder({}, tmp_path)
    assert [path.name for path in tmp_path.iterdir()] == ["mine.txt"]


def test_labels_of_contours_stand_inside_the_panel_and_on_their_lines():
    """Lines x y = c leave the square at its edges; the middle of each is at x = y = sqrt(c)."""
    ax, x = Figure().subplots(), np.linspace(0.0, 1.0, 201)
    lines = ax.contour(x, x, np.outer(x, x), [0.01, 0.25, 0.64, 0.995], colors="k")
    label_contours(ax, lines, "%g")
    places = {one.get_text(): one.get_position() for one in ax.texts}
    assert places.keys() == {"0.01", "0.25", "0.64"}  # the last one has no room in its corner
    for level, place in places.items():
        # one cell: contours are straight between grid points
        assert place == pytest.approx([float(level) ** 0.5] * 2, abs=1.5 / 200), level
