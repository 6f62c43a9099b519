"""The pages on the film models of flanks and of lines."""

import pytest

from docs.film_model import lines, make
from docs.page import Page
from gearlube_core.film_model.model import FilmModel


@pytest.mark.parametrize(
    ("script", "kind", "name"), [(make, "flank", "film_model"), (lines, "line", "film_model_line")]
)
def test_page_is_up_to_date(script, kind, name):
    """If not: python -m docs.film_model.make, or lines."""
    model = FilmModel.named(script.MODEL)
    assert model.kind == kind
    assert model.provenance["state"] == "final"
    page = script.refreshed(model, make.read_tests(script.KEPT))
    assert page.text == Page(name).text
