"""Datasets and figures of pairs' geometry: what is drawn, kept, left out and refused."""

from dataclasses import replace

import numpy as np
import pytest
import xarray as xr
from matplotlib.axes import Axes

from gearlube.studies.helical.figures.catalogue import (
    GEOMETRY_CATALOGUE,
    drawn_datasets,
    save_geometry_figures,
)
from gearlube.studies.helical.geometry_dataset import gear_file_geometry, geometry_dataset
from gearlube_core.errors import ParameterError
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.helical_geometry.meshing_steps import line_at_position

OPERATION = {"torque": 1060.0, "pinion_speed": 235.62}


@pytest.fixture(scope="module")
def designs():
    return [gear_file_geometry(HelicalGearFile.named(f"jamali_2015_{d}")) for d in "ab"]


@pytest.fixture(scope="module")
def helical():
    return HelicalGearFile.named("jamali_2015_a").modified_pair()


@pytest.fixture(scope="module")
def spur(helical):
    """A pair of the same module and teeth with straight teeth, less relieved."""
    pair = replace(
        helical.pair, name="spur", helix_angle=0.0, centre_distance=0.151,
        pinion_tip_radius=0.0790, gear_tip_radius=0.0812,
        pinion_root_radius=0.069, gear_root_radius=0.071,
    )  # fmt: skip
    flank = replace(helical.pinion, tip_relief=replace(helical.pinion.tip_relief, extent=0.4e-3))
    return replace(helical, pair=pair, pinion=flank, gear=flank)


def drawn_points(ax):
    lines = [np.asarray(line.get_ydata(), dtype=float) for line in ax.lines]
    return sum(np.isfinite(values).sum() for values in lines) + len(ax.collections)


@pytest.mark.parametrize("name", GEOMETRY_CATALOGUE)
def test_every_figure_shows_both_designs_with_named_axes(designs, name):
    figure = GEOMETRY_CATALOGUE[name](designs)
    panels = figure.findobj(Axes)
    assert len(panels) >= 2 or name == "contact_characteristics"
    for ax in panels:
        assert drawn_points(ax) > 0
    assert any(ax.get_xlabel() for ax in panels)
    units = [ax.get_ylabel() for ax in panels if ax.get_ylabel()]
    assert units
    assert all("[" in label and "]" in label for label in units)
    shown = " ".join(
        [ax.get_title() for ax in panels]
        + [text.get_text() for legend in figure.legends for text in legend.get_texts()]
    )
    for dataset in designs:
        assert dataset.attrs["name"] in shown


def test_dataset_says_what_everything_is_and_survives_being_written(designs, tmp_path):
    path = tmp_path / "geometry.nc"
    for dataset in designs:
        for name, variable in dataset.variables.items():
            assert variable.attrs["long_name"], name
            assert "units" in variable.attrs, name
    designs[0].to_netcdf(path)
    with xr.open_dataset(path) as read:
        xr.testing.assert_identical(read.load(), designs[0])


@pytest.mark.slow
def test_pair_without_modifications_leaves_their_figures_out(tmp_path):
    dataset = gear_file_geometry(HelicalGearFile.named("he_2007"))
    files = save_geometry_figures([dataset], tmp_path / "figures")
    wanted = set(GEOMETRY_CATALOGUE) - {
        "lines_relieved", "crown_forms", "relief_gaps", "equal_relief"
    }  # fmt: skip
    assert {file.stem for file in files} == wanted
    # an empty page has 0.6 kB
    assert all(file.stat().st_size > 3000 for file in files)
    assert "No tip relief" in dataset.attrs["left_out"]
    assert "No crown" in dataset.attrs["left_out"]


def test_spur_pair_has_no_figures_of_inclined_lines(spur):
    dataset = geometry_dataset(spur, **OPERATION)
    drawn = {name for name in GEOMETRY_CATALOGUE if drawn_datasets(name, [dataset])}
    left = {"sliding_on_line", "relief_gaps", "equal_relief", "lay_angles"}
    assert drawn == set(GEOMETRY_CATALOGUE) - left
    assert dataset.attrs["left_out"].startswith("Spur pair")
    for name in drawn:
        GEOMETRY_CATALOGUE[name]([dataset])
    # one or two lines of the whole face, so the load halves at a step
    length = dataset["length"].sel(relief="unmodified").values
    width = spur.pair.face_width
    assert set(np.unique(length).round(12).tolist()) == {0.0, width}
    load = dataset["load"].sel(relief="unmodified", convention="normal").values
    force = OPERATION["torque"] / spur.pair.pinion_base_radius
    assert np.unique(load.round(6)) == pytest.approx([0.0, 0.5 * force, force], rel=1e-9)


def test_relief_that_leaves_gaps_in_the_contact_shares_no_load(spur):
    flank = replace(spur.pinion, tip_relief=replace(spur.pinion.tip_relief, extent=3e-3))
    deep = replace(spur, pinion=flank, gear=flank)
    dataset = geometry_dataset(deep, **OPERATION)
    assert dataset["relief"].values.tolist() == ["unmodified"]
    assert "without unrelieved contact" in dataset.attrs["left_out"]
    assert drawn_datasets("lines_relieved", [dataset]) == []


def test_pair_relieved_on_one_member_draws_that_member(helical):
    one = replace(helical, gear=replace(helical.gear, tip_relief=None))
    dataset = geometry_dataset(one, **OPERATION)
    assert dataset["relieved"].values.tolist() == ["pinion"]
    assert np.isnan(dataset["gear_relief_start"].values).all()
    for name in ("relief_gaps", "equal_relief", "contact_plane"):
        GEOMETRY_CATALOGUE[name]([dataset])


def test_relief_that_no_shown_line_meets_is_not_drawn(helical):
    # the middle line alone, in relief of 0.3 mm that it leaves out
    flank = replace(helical.pinion, tip_relief=replace(helical.pinion.tip_relief, extent=0.3e-3))
    slight = replace(helical, pinion=flank, gear=flank)
    everything = geometry_dataset(slight, **OPERATION)
    assert set(everything["relief_line_shown"].values.tolist()) == {1, 3}
    middle = line_at_position(everything["shown_position"].values[1:2], helical.pair)
    dataset = geometry_dataset(slight, **OPERATION, lines=middle)
    assert drawn_datasets("equal_relief", [dataset]) == []
    assert "No shown line meets tip relief" in dataset.attrs["left_out"]


def test_generic_lines_lie_where_the_thesis_puts_its_own(helical, designs):
    # his cycle starts 0.06 mm before the share 0.16 and is 0.36 mm longer: see meshing_steps
    found = geometry_dataset(helical, **OPERATION)["shown_position"].values
    assert found == pytest.approx(designs[0]["shown_position"].values, abs=0.35e-3)


def test_lines_outside_the_plane_of_contact_and_idle_pairs_are_refused(helical):
    with pytest.raises(ParameterError, match=r"lines must be .* m"):
        geometry_dataset(helical, **OPERATION, lines=[0.0])
    with pytest.raises(ParameterError, match="torque"):
        geometry_dataset(helical, torque=0.0, pinion_speed=1.0)
    file = HelicalGearFile.named("he_2007").model_copy(update={"operation": None})
    with pytest.raises(ParameterError, match=r"torque and pinion_speed .* no \[operation\]"):
        gear_file_geometry(file)
