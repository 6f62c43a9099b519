"""The page on the film model."""

from docs.film_model.make import KEPT, MODEL, PAGE, page, read_tests
from gearlube_core.film_model.model import FilmModel


def test_page_is_up_to_date():
    model = FilmModel.named(MODEL)
    assert model.provenance["state"] == "final"
    assert page(model, read_tests(KEPT)) == PAGE.read_text(encoding="utf-8")
