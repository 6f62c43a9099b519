"""The reference pages of the input files say what the data models say."""

import re
from pathlib import Path

import pytest

from docs import (
    axle_file,
    blank_file,
    ehl_case_file,
    gear_file,
    helical_gear_file,
    measured_file,
    problem_file,
)
from drivetrain.axle_file.axle_file import AxleFile
from gearlube_core.ehl.case.contact_case import LineCase, PointCase
from gearlube_core.ehl.case.hypoid_case import HypoidCase
from gearlube_core.flank_optimisation.problem_file import OptimisationFile
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.hypoid_design.blank_file import BlankFile
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.hypoid_geometry.measured.measured_file import MeasuredFile
from gearlube_core.input_file.field_notes import field_notes

FOLDER = Path(__file__).parents[2] / "docs"
PAGES = {
    gear_file: (HypoidGearFile,),
    blank_file: (BlankFile,),
    helical_gear_file: (HelicalGearFile,),
    ehl_case_file: (LineCase, PointCase, HypoidCase),
    axle_file: (AxleFile,),
    problem_file: (OptimisationFile,),
    measured_file: (MeasuredFile,),
}


def stored(script):
    return Path(script.__file__).with_suffix(".md").read_text(encoding="utf-8")


@pytest.mark.parametrize("script", PAGES)
def test_page_is_up_to_date(script):
    """If not: python -m docs.gear_file, or another of the scripts above."""
    assert script.page() == stored(script)


@pytest.mark.parametrize(
    ("script", "model"), [(script, model) for script, models in PAGES.items() for model in models]
)
def test_every_field_stands_on_the_page(script, model):
    for name, note in field_notes(model).items():
        field = name.rpartition(".")[2]
        assert re.search(rf"\| `{field}` \|.*{re.escape(note.meaning)} \|", stored(script)), name


@pytest.mark.parametrize("script", PAGES)
def test_what_the_page_points_to_exists(script):
    text = stored(script)
    links = re.findall(r"\]\(([^)#]+)", text)
    assert links
    for link in links:
        assert (FOLDER / link).is_file(), link
    for path in re.findall(r"`((?:examples|tests|gearlube_core|drivetrain)/[\w./]+)`", text):
        assert (FOLDER.parent / path).exists(), path
