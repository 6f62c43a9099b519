"""The mesh table of a gear file, computed once and kept beside it.

The table of `my_gears.toml` is `my_gears.mesh.nc`. It says which content of the gear file, which
torques and which sources of the analysis it is from; when one of them has changed it is computed
again. Where nothing can be written beside the gear file, the user's cache folder keeps it.
"""

from __future__ import annotations

import hashlib
import logging
import shutil
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cache
from importlib.util import find_spec
from pathlib import Path

from gearlube_core.errors import TableError
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.kernels.source_code import code_of
from gearlube_core.kernels.source_files import source_files
from gearlube_core.mesh_table.netcdf import read_mesh_table, write_mesh_table
from gearlube_core.mesh_table.table import MeshTable
from gearlube_core.progress import Progress, no_progress
from gearlube_core.storage.folders import cache_folder

SUFFIX = ".mesh.nc"
_TAGS = ("gear_file_hash", "torques_hash", "analysis_hash")  # settings of a kept table
_CHANGED = {
    "gear_file_hash": "the gear file has changed",
    "torques_hash": "other torques are asked for",
    "analysis_hash": "it is from another version of the analysis",
}
_SOURCES = (
    "gearlube_core.hypoid_contact.contact_dataset",
    "gearlube_core.hypoid_contact.contact_table",
)

logger = logging.getLogger(__name__)


@dataclass(frozen=True, slots=True)
class KeptTable:
    """Where the mesh table of a gear file is kept, and whether it is up to date.

    Parameters
    ----------
    gear_file : Path
        A gear file (TOML) of a hypoid pair.
    torques : sequence of float, optional
        Pinion torques of the analysis [N.m], rising; by default those of `CycleSettings`.

    Examples
    --------
    >>> KeptTable(Path("gears/my_gears.toml")).beside.as_posix()
    'gears/my_gears.mesh.nc'
    """

    gear_file: Path
    torques: Sequence[float] | None = None

    @property
    def beside(self) -> Path:
        """Path of the table beside the gear file."""
        return self.gear_file.with_name(self.gear_file.stem + SUFFIX)

    @property
    def places(self) -> tuple[Path, Path]:
        """Where the table may be: beside the gear file, or in the cache."""
        file = hashlib.sha256(str(self.gear_file.resolve()).encode()).hexdigest()[:16]
        name = f"{self.gear_file.stem}_{file}{SUFFIX}"
        return self.beside, cache_folder("contact") / name

    def tags(self) -> dict[str, str]:
        """Return what the table must be from: hashes of gear file, torques and analysis.

        Raises
        ------
        ParameterError
            The gear file is missing or wrong.
        """
        file = HypoidGearFile.from_toml(self.gear_file)
        of_file = file.model_dump_json(exclude={"tolerances"})
        torques = "" if self.torques is None else repr([float(one) for one in self.torques])
        return dict(zip(_TAGS, (_hash(of_file), _hash(torques), _analysis_hash()), strict=True))

    def current(self) -> Path | None:
        """Return the path of the table that is up to date; None: it is to be computed.

        Raises
        ------
        ParameterError
            The gear file is missing or wrong.
        TableError
            A mesh table of other origin has the name of the kept one.
        """
        wanted = self.tags()
        return next((path for path in self.places if _tags_in(path) == wanted), None)

    def up_to_date(self, *, jobs: int | None = None, progress: Progress = no_progress) -> Path:
        """Return the path of the table; analyse the loaded contact first where that is due.

        Parameters
        ----------
        jobs : int, optional
            Processes; default: all processors.
        progress : callable, optional
            Called with the share of positions that is done [-] and a sentence on what runs.

        Raises
        ------
        ParameterError
            The gear file is missing or wrong, or its flanks do not meet.
        ConvergenceError
            A position finds no equilibrium.
        TableError
            More tooth pairs carry than a mesh table holds, at any torque, or a mesh table of
            other origin has the name of the kept one.

        Notes
        -----
        Takes minutes. Finished positions are kept in the cache folder: the same call goes on after
        a stop. The file appears in one atomic step. Log messages say why it is computed.
        """
        found = self.current()
        if found is not None:
            return found
        wanted = self.tags()
        logger.warning("%s", self._reason(wanted))
        return self.keep(self._computed(wanted, jobs, progress))

    def keep(self, table: MeshTable) -> Path:
        """Write the table that the analysis gave, with its tags; return where it is.

        Raises
        ------
        TableError
            It can be written nowhere, or a mesh table of other origin has its name.
        """
        self.current()  # nobody's own table is replaced
        tagged = replace(table, settings={**table.settings, **self.tags()})
        for path in self.places:
            try:
                return write_mesh_table(tagged, path)
            except OSError as reason:
                logger.warning(
                    "%s cannot be written: %s. The cache folder keeps the mesh table.",
                    path,
                    (reason.strerror or str(reason)).lower(),
                )
        raise TableError(
            f"The mesh table of {self.gear_file} can be written neither beside it nor to "
            f"{self.places[1]}. Make one of the two folders writable."
        )

    def _computed(self, wanted: dict[str, str], jobs: int | None, progress: Progress) -> MeshTable:
        from gearlube_core.hypoid_contact.contact_dataset import ContactSettings, analyse_contact
        from gearlube_core.hypoid_contact.contact_table import contact_table, levels_left_out
        from gearlube_core.hypoid_contact.mesh_cycle import CycleSettings
        from gearlube_core.hypoid_contact.refusal import check_pair, pair_warnings

        file = HypoidGearFile.from_toml(self.gear_file)
        cycle = CycleSettings()
        if self.torques is not None:
            cycle = replace(cycle, torques=tuple(float(one) for one in self.torques))
        check_pair(file)
        for sentence in pair_warnings(file):
            logger.warning("%s: %s", self.gear_file.name, sentence)
        store = cache_folder("contact") / _hash(repr(sorted(wanted.items())))
        dataset = analyse_contact(
            file, ContactSettings(cycle=cycle), store=store, jobs=jobs, progress=progress
        )
        for sentence in levels_left_out(dataset):
            logger.warning("%s: %s", self.gear_file.name, sentence)
        table = contact_table(file, dataset)
        shutil.rmtree(store, ignore_errors=True)
        return table

    def _reason(self, wanted: dict[str, str]) -> str:
        kept = next((path for path in self.places if path.is_file()), None)
        start = f"{self.gear_file.name} has no mesh table yet"
        if kept is not None:
            tags = _tags_in(kept)
            changed = [why for tag, why in _CHANGED.items() if tags.get(tag) != wanted[tag]]
            said = " and ".join(changed) if tags else "it cannot be read"
            start = f"{kept.name} is out of date: {said}"
        return (
            f"{start}. The loaded contact is analysed now, which takes minutes; finished positions "
            "are kept if it is stopped."
        )


def _tags_in(path: Path) -> dict[str, str]:
    """Return the tags of a kept table; {}: there is none that can be read."""
    if not path.is_file():
        return {}
    try:
        settings = read_mesh_table(path).settings
    except TableError:  # damaged, or of an older format
        return {}
    tags = {tag: str(settings[tag]) for tag in _TAGS if tag in settings}
    if not tags:
        raise TableError(
            f"{path} must be the mesh table of the gear file beside it, but it comes from "
            "elsewhere. Give it another name, or use it as gear_set.mesh_table instead of "
            "gear_file."
        )
    return tags


def _hash(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()[:16]


@cache
def _analysis_hash() -> str:
    """Return a hash of the code of the analysis; comments and docstrings do not count."""
    files: set[str] = set()
    for name in _SOURCES:
        # not imported: a table that is up to date needs none of it
        origin = getattr(find_spec(name), "origin", None)
        files |= source_files(origin) if origin else set()
    digest = hashlib.sha256()
    for code in sorted(code_of(Path(path).read_text(encoding="utf-8")) for path in files):
        digest.update(code.encode())
    return digest.hexdigest()[:16]
