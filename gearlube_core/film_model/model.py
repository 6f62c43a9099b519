"""A frozen model of solved films: numbers for the kernel, with where they come from."""

from __future__ import annotations

import hashlib
import json
import logging
import re
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import read_content
from gearlube_core.errors import FileError, ParameterError
from gearlube_core.film_model import net
from gearlube_core.film_model.groups import FilmGroups
from gearlube_core.storage.atomic_file import write_text

FORMAT = "gearlube film model"
VERSION = 2
FLANK, LINE, ROLLER = "flank", "line", "roller"  # kinds of contact
SHIPPED = {FLANK: "hypoid_flank", LINE: "helical_line", ROLLER: "roller_race"}  # of each kind
# Of the load outside the domain, with which a number still counts as one of solved films: formulas
# lose up to four times as much, so that 5 % put in no more than the 20 % of laws among each other.
MOST_OUTSIDE = 0.05
_SHIPPED = Path(__file__).parent / "data"
_CURE = "Make one with `gearlube film-model fit`, or name a model of the package."

_ENTRIES = {"format", "version", "provenance", "checksum", "numbers"}
logger = logging.getLogger(__name__)

# blocks of the numbers with their shapes, in order
_BLOCKS: dict[str, tuple[int, ...]] = {
    "domain_low": (net.N_GROUPS,),
    "domain_high": (net.N_GROUPS,),
    "shift": (net.N_GROUPS,),
    "scale": (net.N_GROUPS,),
    "first": (net.N_GROUPS, net.WIDTH),
    "first_offset": (net.WIDTH,),
    "second": (net.WIDTH, net.WIDTH),
    "second_offset": (net.WIDTH,),
    "straight": (net.N_OUTPUTS, net.N_GROUPS),
    "last": (net.N_OUTPUTS, net.WIDTH),
    "last_offset": (net.N_OUTPUTS,),
    "bounds": (net.N_OUTPUTS,),
    "contact_modulus": (1,),
    "border": (1,),
}


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class FilmModel:
    """A surrogate of solved thermal Eyring films with its domain, bounds and provenance.

    Parameters
    ----------
    numbers : ndarray, shape (N_ARRAY,)
        For `solved_film`: domain, weights, bounds, and scratch that every call overwrites.
    provenance : dict
        Texts and numbers: `state` ("final" or "first", a trial), `oils`, `grid`, `solves`,
        `seed`, `date`, `errors` and whatever else says how it was made.

    Raises
    ------
    ParameterError
        The numbers have another shape, are not finite, or a domain is empty.

    Examples
    --------
    >>> model = FilmModel.named("hypoid_flank")
    >>> low, high = model.domain["psi"]
    >>> 0.0 < low < high < 1.6
    True
    """

    numbers: Array
    provenance: dict[str, Any]

    def __post_init__(self) -> None:
        shape = self.numbers.shape
        if shape != (net.N_ARRAY,):
            raise ParameterError(
                f"numbers of a film model must be of shape ({net.N_ARRAY},), got {shape}. {_CURE}"
            )
        if not np.isfinite(self.numbers[: net.N_NUMBERS]).all():
            raise ParameterError(f"numbers of a film model must be finite. {_CURE}")
        for group, (low, high) in self.domain.items():
            if not low < high:
                raise ParameterError(
                    f"the domain of {group} must not be empty, got {low:g} to {high:g}. {_CURE}"
                )
        bounds = (self.film_bound, self.friction_bound, *self.blocks["border"])
        if not (min(bounds) > 0.0 and self.contact_modulus > 0.0):
            raise ParameterError(
                "bounds, border and contact_modulus of a film model must be above 0, got "
                f"{bounds} and {self.contact_modulus:g} Pa. {_CURE}"
            )

    @property
    def blocks(self) -> dict[str, Array]:
        """Return the numbers by name, without the scratch."""
        parts, start = {}, 0
        for name, shape in _BLOCKS.items():
            end = start + int(np.prod(shape))
            parts[name] = self.numbers[start:end].reshape(shape).copy()
            start = end
        return parts

    @property
    def kind(self) -> str:
        """Return the kind of contact: "flank", an angled ellipse, "line", or "roller"."""
        return str(self.provenance.get("kind", FLANK))

    @property
    def name(self) -> str:
        """Return the name that the model was fitted under."""
        return str(self.provenance.get("name") or "without a name")

    @property
    def oils(self) -> tuple[str, ...]:
        """Return the oils that the model was trained for; files as they were named."""
        return tuple(
            str(oil)
            for key, oils in self.provenance.items()
            if key.startswith("oils_of_")
            for oil in oils
        )

    @property
    def words(self) -> str:
        """Return name, checksum and bounds for reports."""
        friction = "rolling friction" if self.kind == ROLLER else "friction"
        return (
            f"{self.name} (checksum {self.checksum}), bounds {100.0 * self.film_bound:.2g} % of "
            f"the central film and {100.0 * self.friction_bound:.2g} % of {friction}"
        )

    def __repr__(self) -> str:
        return f"FilmModel({self.name}, {self.kind}, {self.checksum})"

    @property
    def domain(self) -> dict[str, tuple[float, float]]:
        """Return the lowest and highest value of each group [-]."""
        low, high = self.numbers[net.LOW : net.HIGH], self.numbers[net.HIGH : net.SHIFT]
        return {name: (float(low[n]), float(high[n])) for n, name in enumerate(FilmGroups._fields)}

    @property
    def film_bound(self) -> float:
        """Return the half-width of the 95 % band of the central film, relative [-]."""
        return float(self.numbers[net.BOUNDS])

    @property
    def friction_bound(self) -> float:
        """Return the half-width of the 95 % band of the friction, relative [-]."""
        return float(self.numbers[net.BOUNDS + 1])

    @property
    def contact_modulus(self) -> float:
        """Return E* of the solids of the training [Pa]."""
        return float(self.numbers[net.MODULUS])

    def copied_numbers(self) -> Array:
        """Return the numbers with a scratch of their own, for one user of the kernel."""
        return self.numbers.copy()

    @classmethod
    def of_blocks(cls, blocks: dict[str, Array], provenance: dict[str, Any]) -> FilmModel:
        """Return a model from its numbers by name; shapes as in `blocks`.

        Raises
        ------
        ParameterError
            A block is missing, is not known or has another shape.
        """
        unknown, missing = sorted(set(blocks) - set(_BLOCKS)), sorted(set(_BLOCKS) - set(blocks))
        if unknown or missing:
            raise ParameterError(
                f"A film model needs the numbers {', '.join(_BLOCKS)}; missing "
                f"{missing or 'nothing'}, unknown {unknown or 'nothing'}. {_CURE}"
            )
        parts = []
        for name, shape in _BLOCKS.items():
            block = np.asarray(blocks[name], dtype=np.float64)
            if block.shape != shape:
                raise ParameterError(
                    f"{name} of a film model must be of shape {shape}, got {block.shape}. {_CURE}"
                )
            parts.append(block.ravel())
        return cls(np.concatenate([*parts, net.new_scratch()]), provenance)

    @classmethod
    def read(cls, path: Path | str) -> FilmModel:
        """Return the model of a file.

        Raises
        ------
        FileError
            The file is missing, is no film model, is of another version or is damaged.
        """
        return cls.of_content(read_model_content(path), str(path))

    @classmethod
    def of_content(cls, data: bytes, where: str) -> FilmModel:
        """Return the model in the bytes of a file; `where` names it in errors, as of `read`."""
        try:
            content = json.loads(data.decode("utf-8"))
        except (ValueError, RecursionError) as error:
            raise FileError(
                f"{where} must be a film model in JSON, got a file that is not JSON or is cut off "
                f"({error}). {_CURE}"
            ) from error
        if not isinstance(content, dict) or content.get("format") != FORMAT:
            raise FileError(f"{where} must have the format '{FORMAT}', got another file. {_CURE}")
        if content.get("version") != VERSION:
            raise FileError(
                f"{where} must be of version {VERSION}, got {content.get('version')}. {_CURE}"
            )
        try:
            blocks = {name: np.array(values) for name, values in content["numbers"].items()}
            provenance, checksum = dict(content["provenance"]), content["checksum"]
            model = cls.of_blocks(blocks, provenance)
        except (KeyError, TypeError, AttributeError, ValueError) as error:
            raise FileError(f"Film model {where} is damaged: {error}. {_CURE}") from error
        if checksum != model.checksum:
            raise FileError(
                f"Film model {where} is damaged: its numbers do not belong to its checksum "
                f"{checksum}. Do not edit it. {_CURE}"
            )
        whole = content.pop("file_checksum", None)
        if content.keys() != _ENTRIES or whole not in (None, _hash_of(content)):
            raise FileError(
                f"Film model {where} is damaged: its entries do not belong to the checksum of the "
                f"file. Do not edit it. {_CURE}"
            )
        if whole is None:
            logger.warning(
                "Film model %s has no checksum of the whole file, so damage to its provenance "
                "would not be seen. Write it again with this version.",
                where,
            )
        return model

    @classmethod
    def named(cls, name: str) -> FilmModel:
        """Return a model of the package by name, or of a file (.json).

        Raises
        ------
        FileError
        """
        shipped = _SHIPPED / f"{name}.json"
        if shipped.exists():
            return cls.read(shipped)
        if name.endswith(".json"):
            return cls.read(name)
        raise FileError(
            f"Film model must be one of {', '.join(model_names())} or a file (.json), got {name}. "
            f"{_CURE}"
        )

    @property
    def checksum(self) -> str:
        """Return the first 16 digits of SHA-256 of the numbers."""
        return hashlib.sha256(self.numbers[: net.N_NUMBERS].tobytes()).hexdigest()[:16]

    def write(self, path: Path | str) -> None:
        """Write the model as a file (.json)."""
        content = {
            "format": FORMAT,
            "version": VERSION,
            "provenance": self.provenance,
            "checksum": self.checksum,
            "numbers": {name: block.tolist() for name, block in self.blocks.items()},
        }
        text = json.dumps({**content, "file_checksum": _hash_of(content)}, indent=1)
        # rows of numbers on one line each
        rows = re.sub(r"\[[-+\s\d.,e]*\]", lambda row: re.sub(r"\s+", " ", row.group()), text)
        write_text(rows + "\n", Path(path))


def _hash_of(content: dict[str, Any]) -> str:
    """Return the first 16 digits of SHA-256 of all entries, however they are laid out."""
    return hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()[:16]


def read_model_content(path: Path | str) -> bytes:
    """Return the bytes of a model's file, with the ends of lines of all platforms alike.

    Raises
    ------
    FileError
        There is no file that can be read.
    """
    return read_content(path, "film model", FileError, _CURE).replace(b"\r\n", b"\n")


@cache
def shipped_model(kind: str) -> FilmModel:
    """Return the model in the package for a kind of contact."""
    return FilmModel.named(SHIPPED[kind])


def model_names() -> tuple[str, ...]:
    """Return the names of the models in the package."""
    return tuple(sorted(path.stem for path in _SHIPPED.glob("*.json")))
