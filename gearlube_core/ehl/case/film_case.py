"""Common part of all case files of lubricated films."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Annotated, ClassVar, Literal

from pydantic import Field

from gearlube_core.errors import ParameterError
from gearlube_core.input_file.input_file import InputFile
from gearlube_core.storage.file_names import Name

Text = Annotated[str, Field(min_length=1)]
Heat = Literal["isothermal", "thermal"]
Wedge = Literal["upwind-1", "upwind-2", "central", "quick"]


class FilmCase(InputFile):
    """A lubricated contact with its name; shipped cases lie in gearlube_core/ehl/case/data."""

    package: ClassVar[str] = "gearlube_core.ehl.case"

    name: Name = Field(description="Name of the case in reports and figures")
    source: Text = Field(description="Where the numbers come from")


@contextmanager
def refused(head: str = "") -> Iterator[None]:
    """Turn a ParameterError into the ValueError that pydantic expects of a validator.

    `head` begins the message.
    """
    try:
        yield
    except ParameterError as reason:
        raise ValueError(f"{head}{str(reason).removesuffix('.')}") from None
