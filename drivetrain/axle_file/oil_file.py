"""An oil in a file of its own: the fields of the axle file's [oil]."""

from __future__ import annotations

from typing import ClassVar

from drivetrain.axle_file.oil_section import OilSection
from gearlube_core.input_file.input_file import InputFile
from gearlube_core.oil.lubricant import Lubricant, lubricant_names


class OilFile(OilSection, InputFile):
    """A shipped oil, or what differs from it, in a TOML file."""

    package: ClassVar[str] = "drivetrain.axle_file"
    title: ClassVar[str] = "oil file"


def given_oil(name: str) -> Lubricant:
    """Return the oil of a file whose name ends in .toml, or a shipped one by its name.

    Raises
    ------
    ParameterError
        The file has a wrong field, or there is no such oil.

    Examples
    --------
    >>> given_oil("fva_3").density  # kg/m3
    866.6
    """
    if name.endswith(".toml"):
        return OilFile.from_toml(name).oil()
    if name not in lubricant_names():
        from gearlube_core.errors import ParameterError

        raise ParameterError(
            f"The oil must be one of {', '.join(lubricant_names())} or a file, got {name!r}. "
            "A file's name ends in .toml; its fields are those of [oil] in docs/axle_file.md."
        )
    return Lubricant.named(name)
