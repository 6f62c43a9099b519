"""Variables that the datasets of line and point contacts share."""

from __future__ import annotations

from typing import Any

import numpy as np

from gearlube.studies.films.formulas import FilmFormula


def unit_note(unit: str, name: str) -> dict[str, str]:
    """Return the attributes of a variable."""
    return {"units": unit, "long_name": name}


def formula_variables(formulas: list[FilmFormula]) -> dict[str, Any]:
    """Return films of formulas, their names and what they stand for, along `formula`."""
    if not formulas:
        return {}
    return {
        "formula_film": (
            "formula",
            np.array([one.film for one in formulas]),
            unit_note("m", "film of a published formula"),
        ),
        "formula_quantity": ("formula", np.array([one.quantity for one in formulas])),
        "formula_source": ("formula", np.array([one.source for one in formulas])),
    }
