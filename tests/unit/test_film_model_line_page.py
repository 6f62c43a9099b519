"""The page on the film model of lines."""

from docs.film_model.lines import KEPT, MODEL, PAGE, page
from docs.film_model.make import read_tests
from gearlube_core.film_model.model import FilmModel


def test_page_of_lines_is_up_to_date():
    model = FilmModel.named(MODEL)
    assert model.kind == "line"
    assert page(model, read_tests(KEPT)) == PAGE.read_text(encoding="utf-8")
