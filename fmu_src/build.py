"""Build HypoidAxle.fmu with pythonfmu, then complete what pythonfmu leaves out."""

from __future__ import annotations

import shutil
import sys
import tempfile
import zipfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from fmu_src.archive import write_archive
from fmu_src.definition import Definition
from fmu_src.documentation import index_html
from fmu_src.hypoid_axle import DEFINITION, definition_with_table
from fmu_src.identity import IDENTITY_FILE, guid_of, identity_text
from fmu_src.model_description import model_description
from gearlube_core.errors import GearLubeError

_HERE = Path(__file__).parent
_HYPOID_AXLE_SCRIPT = _HERE / "hypoid_axle_slave.py"


@contextmanager
def _clean_imports(module: str) -> Iterator[None]:
    """Undo what pythonfmu's builder leaves in `sys.path` and `sys.modules`."""
    path = list(sys.path)
    try:
        yield
    finally:
        sys.path[:] = path
        sys.modules.pop(module, None)


def _packed_by_pythonfmu(script: Path) -> dict[str, bytes]:
    """Return binaries and loader files of the FMU that pythonfmu makes of `script`."""
    try:
        from pythonfmu import FmuBuilder
    except ImportError as error:
        raise GearLubeError(
            f"Building an FMU needs pythonfmu, not found: {error}. "
            "Install it with `pip install pythonfmu`."
        ) from error
    with tempfile.TemporaryDirectory() as name, _clean_imports(script.stem):
        folder = Path(name)
        copy = Path(shutil.copy(script, folder))
        packed = FmuBuilder.build_FMU(copy, dest=folder / "out")
        with zipfile.ZipFile(packed) as archive:
            content = {entry: archive.read(entry) for entry in archive.namelist()}
    # pythonfmu itself is left out: it is installed with gearlube, and one copy is enough.
    kept = ("binaries/", f"resources/{script.name}", "resources/slavemodule.txt")
    return {entry: data for entry, data in content.items() if entry.startswith(kept)}


def _build(definition: Definition, script: Path, out_dir: Path) -> Path:
    content = _packed_by_pythonfmu(script)
    content["modelDescription.xml"] = model_description(definition, str(guid_of(definition)))
    content[f"resources/{IDENTITY_FILE}"] = identity_text(definition).encode()
    content |= {f"resources/{name}": data for name, data in definition.resources.items()}
    content["documentation/index.html"] = index_html(definition).encode()
    content["model.png"] = (_HERE / "model.png").read_bytes()
    for licence in sorted((_HERE / "licences").glob("*.txt")):
        content[f"documentation/licenses/{licence.name}"] = licence.read_bytes()
    path = out_dir / f"{definition.name}.fmu"
    write_archive(path, content)
    return path


def build_hypoid_axle(out_dir: str | Path, mesh_table: str | Path | None = None) -> Path:
    """Build HypoidAxle.fmu in `out_dir` and return its path.

    Parameters
    ----------
    out_dir : path
    mesh_table : path, optional
        Mesh table of another gear pair, which the FMU then carries.

    Raises
    ------
    TableError
        When `mesh_table` is missing, no mesh table, or of another format.

    Notes
    -----
    The same sources give the same bytes. The file appears in one atomic move.
    """
    definition = DEFINITION if mesh_table is None else definition_with_table(mesh_table)
    return _build(definition, _HYPOID_AXLE_SCRIPT, Path(out_dir))
