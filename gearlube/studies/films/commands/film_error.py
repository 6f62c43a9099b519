"""The option `--film-error`, a share such as 1% or 0.01."""

from __future__ import annotations

import math
from typing import Annotated

import typer

from gearlube_core.checks import check_within
from gearlube_core.errors import ParameterError

FilmErrorOption = Annotated[
    str | None,
    typer.Option(
        help="Halve the spacing until the estimated error of the films is below this, such as 1%.",
        metavar="PERCENT%",
    ),
]


def film_error_of(text: str | None) -> float | None:
    """Return the share that "1%" or "0.01" stands for.

    Raises
    ------
    ParameterError
        It is no number, or not within 0.01 % to 100 %.

    Examples
    --------
    >>> film_error_of("1%")
    0.01
    """
    if text is None:
        return None
    number = text.strip().removesuffix("%")
    try:
        value = float(number) * (0.01 if text.strip().endswith("%") else 1.0)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise ParameterError(
            f"--film-error must be a percentage or a fraction, got {text!r}. Write 1% or 0.01."
        )
    return check_within("--film-error", value, 1e-4, 1.0, "", "1 % is 1% or 0.01.")
