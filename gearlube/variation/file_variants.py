"""Variants of an input file, and the files that it names, in memory."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from functools import cache
from pathlib import Path
from typing import Any

from drivetrain.axle_file.axle_file import AxleFile, CarAxle
from drivetrain.axle_file.axle_sections import OwnFilmModels
from drivetrain.axle_file.read_axle import mesh_of
from fmu_src.axle_arguments import axle_parameters
from fmu_src.variables import HYPOID_AXLE
from gearlube.variation.design import Point
from gearlube.variation.keys import Key, Keys, file_keys
from gearlube_core.film_model.model import FilmModel
from gearlube_core.input_file.field_notes import field_notes
from gearlube_core.mesh_table.table import MeshTable
from gearlube_core.oil.oil_file import DescribedOil
from gearlube_core.rough_patch.asperity_file import GreenwoodTrippFit

GEAR_FILE = "gear_set.gear_file"
_START_SPEED = "pinion.speed_start"  # the operating point has it


@cache
def _fmu_arguments() -> dict[str, str]:
    """Return the argument of each parameter of the FMU by its FMI name."""
    return {
        variable.name: variable.argument
        for variable in HYPOID_AXLE
        if variable.is_model_parameter and variable.argument and variable.name != _START_SPEED
    }


@cache
def axle_keys() -> Keys:
    """Return the fields of the axle file and the parameters of the axle FMU, by their names."""
    fields = file_keys(field_notes(AxleFile))
    arguments = _fmu_arguments()
    for variable in HYPOID_AXLE:
        if variable.name in arguments and variable.name not in fields:
            kind = {"Real": "number", "Integer": "whole number"}.get(variable.type, "text")
            key = Key(variable.name, kind, variable.unit, variable.description, "fmu")  # type: ignore[arg-type]
            fields[variable.name] = key
    return fields


@dataclass(frozen=True, slots=True, kw_only=True)
class AxleVariants:
    """An axle file and all files that its variants name; a worker elsewhere needs no file.

    Parameters
    ----------
    file : AxleFile
    folder : Path
        Of the file.
    meshes, asperities, oils, films : mapping
        What was read, by the text that names it in the file.
    """

    file: AxleFile
    folder: Path = field(default_factory=Path)
    meshes: Mapping[str, MeshTable] = field(default_factory=dict)
    asperities: Mapping[str, GreenwoodTrippFit] = field(default_factory=dict)
    oils: Mapping[str, DescribedOil] = field(default_factory=dict)
    films: Mapping[str, FilmModel] = field(default_factory=dict)

    @classmethod
    def read(cls, name: str) -> AxleVariants:
        """Return an axle file, by its path or the name of a shipped one, with its tables.

        Raises
        ------
        ParameterError, TableError
            A file is missing or wrong.
        """
        return cls(file=AxleFile.given(name), folder=Path(name).parent).with_files(())

    def with_files(self, changes: Iterable[tuple[str, str]]) -> AxleVariants:
        """Return a copy with all tables read that the file names, and variants of it.

        Parameters
        ----------
        changes
            Field and text of each file that a variant names.
        """
        folder = self.folder
        meshes, asperities, oils = dict(self.meshes), dict(self.asperities), dict(self.oils)
        films = dict(self.films)
        for one in [self.file, *(self.file.varied({key: text}) for key, text in changes)]:
            table, roughness, oil = (one.gear_set.named, one.gear_set.asperity_table, one.oil.file)
            if table not in meshes:
                meshes[table] = mesh_of(one, folder)
            if roughness is not None and (fit := one.asperities(folder)) is not None:
                asperities[roughness] = fit
            if oil is not None and (described := one.described_oil(folder)) is not None:
                oils[oil] = described
            of_film = one.film.own_models(folder)
            for text, model in zip(_film_texts(one), of_film, strict=True):
                if text is not None and model is not None:
                    films[text] = model
        return replace(self, meshes=meshes, asperities=asperities, oils=oils, films=films)

    @property
    def identity(self) -> str:
        """Content of the file and of all that it names, as text."""
        named = {**self.meshes, **self.asperities, **self.oils}
        hashes = {text: content_hash(self.folder / text) for text in named}
        hashes |= {text: model.checksum for text, model in self.films.items()}
        return json.dumps([self.file.model_dump(mode="json"), hashes], sort_keys=True)

    def varied(self, point: Point) -> AxleFile:
        """Return the file with the fields of a point that are its own."""
        keys = axle_keys()
        own = {name: one for name, one in point.items() if _origin(keys, name) == "file"}
        if not own:
            return self.file
        # one part has no tolerances; they need not be checked again for each
        return self.file.model_copy(update={"tolerances": {}}).varied(own)

    def car_axle(self, point: Point, *, notes: bool = False) -> CarAxle:
        """Return axle and car at a point; keys that are not of the axle are left out."""
        file = self.varied(point)
        asperities, oil = file.gear_set.asperity_table, file.oil.file
        folder = self.folder
        car = file.car_axle(
            self.meshes.get(file.gear_set.named) or mesh_of(file, folder),
            self.asperities.get(asperities or "") or file.asperities(folder),
            self.oils.get(oil or "") or file.described_oil(folder),
            self._films(file),
            notes=notes,
        )
        arguments = _fmu_arguments()
        given = {
            arguments[name]: one
            for name, one in point.items()
            if _origin(axle_keys(), name) == "fmu"
        }
        return replace(car, axle=axle_parameters(given, car.axle)) if given else car

    def _films(self, file: AxleFile) -> OwnFilmModels:
        texts = _film_texts(file)
        if all(text is None or text in self.films for text in texts):
            return OwnFilmModels(*(None if text is None else self.films[text] for text in texts))
        return file.film.own_models(self.folder)


def _film_texts(file: AxleFile) -> tuple[str | None, str | None]:
    return file.film.flank_model, file.film.roller_model


def _origin(keys: Keys, name: str) -> str:
    key = keys.get(name)
    return "" if key is None else key.origin


def content_hash(name: str | Path) -> str:
    """Return a hash of a file; "" for what ships with the package, which its version fixes."""
    path = Path(name)
    return hashlib.sha256(path.read_bytes()).hexdigest() if path.is_file() else ""


def files_named(point_values: Mapping[str, Iterable[Any]]) -> list[tuple[str, str]]:
    """Return the files that axes name: field and text."""
    return [(key, str(text)) for key in AxleFile.files for text in point_values.get(key, ())]
