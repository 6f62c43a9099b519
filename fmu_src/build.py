"""Build FMUs, native or with pythonfmu, and keep built ones."""

from __future__ import annotations

import hashlib
import logging
import shutil
import sys
import tempfile
import zipfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING

from fmu_src.definition import Definition
from fmu_src.documentation import index_html
from fmu_src.identity import IDENTITY_FILE, guid_of, identity_text, licence_texts, write_archive
from fmu_src.model_description import model_description
from fmu_src.native.build import NativeOptions, build_native
from gearlube_core.checks import check_option
from gearlube_core.errors import ParameterError

if TYPE_CHECKING:
    from drivetrain.driveline.parameters import DrivelineParameters

_LOGGER = logging.getLogger(__name__)
MODELS = ("hypoid-axle", "helical-pair", "driveline")
_HERE = Path(__file__).parent


def can_build_native() -> bool:
    """Return whether the compiler of native FMUs is installed."""
    return find_spec("ziglang") is not None


def cached_hypoid_axle(
    mesh_table: Path | None = None,
    *,
    axle: str | Path | None = None,
    native: bool | None = None,
    report: Callable[[str], None] = _LOGGER.info,
) -> Path:
    """Return HypoidAxle.fmu from the user's cache; build it if sources or files are new.

    Parameters
    ----------
    mesh_table : path, optional
        Of another gear pair; by default the one that ships.
    axle : path, optional
        Axle file, or the name of a shipped one; names its own mesh table.
    native : bool, optional
        Whether the FMU computes by itself, or in this package. By default native where the
        compiler is installed.
    report : callable, optional
        Called with each line of progress of a native build.

    Raises
    ------
    GearLubeError
        A file is wrong, both are given, or `native` is asked for without the compiler.

    Notes
    -----
    The folder's name changes with everything that decides the results.

    Examples
    --------
    >>> cached_hypoid_axle(axle="my_axle.toml").name  # doctest: +SKIP
    'HypoidAxle.fmu'
    """
    from fmu_src.native.build import NativeOptions
    from fmu_src.native.platforms import platform_of_this_machine

    native = can_build_native() if native is None else native
    path = cached_axle_path(mesh_table, axle=axle, native=native)
    if not path.is_file():
        folder = path.parent
        folder.mkdir(parents=True, exist_ok=True)
        options = None
        if native:
            report("building the native FMU of this machine, once")
            platform = platform_of_this_machine()
            options = NativeOptions(platforms=[platform], fmi=["2"], reference=False, report=report)
        build_models(folder, "hypoid-axle", mesh_table, axle=axle, native=options)
    return path


def cached_axle_path(
    mesh_table: Path | None = None, *, axle: Path | str | None = None, native: bool | None = None
) -> Path:
    """Return where `cached_hypoid_axle` keeps its FMU, whether it is there or not."""
    from fmu_src.identity import guid_of
    from gearlube_core.storage.folders import user_folder

    definition = axle_definition(mesh_table, axle)
    native = can_build_native() if native is None else native
    key = f"native-{_native_digest()}-" if native else ""
    return user_folder() / "fmu" / f"{key}{guid_of(definition)}" / f"{definition.name}.fmu"


def _native_digest() -> str:
    """Return a digest of what makes a native FMU of the kernels."""
    here = Path(__file__).parent
    digest = hashlib.sha256((here / "object_code.py").read_bytes())
    for path in sorted((here / "native").rglob("*.[pch]*")):
        if path.is_file() and path.suffix in (".py", ".c", ".h"):
            digest.update(path.read_bytes())
    return digest.hexdigest()[:16]


@contextmanager
def _clean_imports(module: str) -> Iterator[None]:
    """Remove the entries that pythonfmu's builder leaves in `sys.path` and `sys.modules`."""
    path = list(sys.path)
    try:
        yield
    finally:
        sys.path[:] = path
        sys.modules.pop(module, None)


def _packed_by_pythonfmu(script: Path) -> dict[str, bytes]:
    """Return binaries and loader files of the FMU that pythonfmu makes of `script`."""
    from pythonfmu import FmuBuilder

    with tempfile.TemporaryDirectory() as name, _clean_imports(script.stem):
        folder = Path(name)
        copy = Path(shutil.copy(script, folder))
        packed = FmuBuilder.build_FMU(copy, dest=folder / "out")
        with zipfile.ZipFile(packed) as archive:
            content = {entry: archive.read(entry) for entry in archive.namelist()}
    # pythonfmu itself is left out: it is installed with gearlube, and one copy is enough.
    kept = ("binaries/", f"resources/{script.name}", "resources/slavemodule.txt")
    return {entry: data for entry, data in content.items() if entry.startswith(kept)}


def _build(definition: Definition, out_dir: Path) -> Path:
    content = _packed_by_pythonfmu(_HERE / f"{definition.slave}.py")
    content["modelDescription.xml"] = model_description(definition, str(guid_of(definition)))
    content[f"resources/{IDENTITY_FILE}"] = identity_text(definition).encode()
    content |= {f"resources/{name}": data for name, data in definition.resources.items()}
    content["documentation/index.html"] = index_html(definition).encode()
    content["model.png"] = (_HERE / "model.png").read_bytes()
    content |= licence_texts("python")
    path = out_dir / f"{definition.name}.fmu"
    write_archive(path, content)
    return path


def build_hypoid_axle(
    out_dir: str | Path, mesh_table: str | Path | None = None, axle: str | Path | None = None
) -> Path:
    """Build HypoidAxle.fmu, which computes in Python, in `out_dir`; return its path.

    Parameters
    ----------
    out_dir : path
    mesh_table : path, optional
        Mesh table of another gear pair, which becomes part of the FMU.
    axle : path, optional
        Axle file (TOML), which becomes part of the FMU together with its mesh table.

    Raises
    ------
    TableError
        The mesh table is missing, no mesh table, or of another format.
    ParameterError
        The axle file is missing or wrong, or both files are given.

    Notes
    -----
    The same sources give the same bytes. The file appears in one atomic move.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as folder:
    ...     build_hypoid_axle(folder).name
    'HypoidAxle.fmu'
    """
    return _build(axle_definition(mesh_table, axle), Path(out_dir))


def build_helical_pair(
    out_dir: str | Path, gear: str | Path | None = None, line_mesh: str | Path | None = None
) -> Path:
    """Build HelicalPair.fmu, which computes in Python, in `out_dir`; return its path.

    Parameters
    ----------
    out_dir : path
    gear : path, optional
        Gear file (TOML) of another pair, which becomes part of the FMU as gear.name = custom.
    line_mesh : path, optional
        Line mesh (NetCDF) of that pair; needs `gear`.

    Raises
    ------
    GearLubeError
        A file is missing or wrong, or the two do not belong together.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as folder:
    ...     build_helical_pair(folder).name
    'HelicalPair.fmu'
    """
    return _build(pair_definition(gear, line_mesh), Path(out_dir))


def build_models(
    out_dir: Path,
    model: str | None = None,
    mesh_table: Path | None = None,
    gear: Path | None = None,
    line_mesh: Path | None = None,
    *,
    axle: str | Path | None = None,
    train: str | Path | None = None,
    native: NativeOptions | None = None,
) -> list[Path]:
    """Build the FMUs asked for and return their paths.

    Parameters
    ----------
    out_dir : path
    model : {"hypoid-axle", "helical-pair", "driveline"}, optional
        By default those that a file is given for; without files all. The driveline is native.
    mesh_table : path, optional
        Mesh table built into HypoidAxle.fmu.
    gear, line_mesh : path, optional
        Gear file and line mesh built into HelicalPair.fmu.
    axle : path, optional
        Axle file of HypoidAxle.fmu and of the car, or the name of a shipped one.
    train : path, optional
        Train file, or the name of a shipped one: an FMU with the name of the train, native only.
    native : NativeOptions, optional
        Of native FMUs; by default FMUs that compute in the installed package.

    Raises
    ------
    ParameterError
        A file for a model that is not built, or a mesh table beside an axle file.
    GearLubeError
        A file is wrong, or a native FMU cannot be linked.
    """
    if model is not None:
        check_option("--model", model, MODELS)
    needs = {
        "--mesh-table": (mesh_table, ("hypoid-axle",)),
        "--axle": (axle, ("hypoid-axle", "driveline")),
        "--gear": (gear, ("helical-pair",)),
        "--line-mesh": (line_mesh, ("helical-pair",)),
    }
    given = {name: owners for name, (path, owners) in needs.items() if path is not None}
    of_files = {owner for owners in given.values() for owner in owners}
    if train is not None and (model is not None or native is None):
        raise ParameterError(
            f"--train cannot be combined with {'--model' if model else '--python'}: it builds the "
            "FMU of the train, which is native only. Leave one of them out."
        )
    wanted = {model} if model else of_files or set(() if train else MODELS)
    for name, owners in given.items():
        if not wanted & set(owners):
            raise ParameterError(f"{name} can only be given with --model {owners[0]}, got {model}.")
    if native is None and model == "driveline":
        raise ParameterError(
            "--model driveline cannot be combined with --python: this FMU is "
            "native only. Leave out --python."
        )
    definitions = []
    if "hypoid-axle" in wanted:
        definitions.append(axle_definition(mesh_table, axle))
    if "helical-pair" in wanted:
        definitions.append(pair_definition(gear, line_mesh))
    if native is None:
        return [_build(definition, out_dir) for definition in definitions]
    models = []
    if definitions:
        from fmu_src.native.models import native_model

        models += [native_model(definition) for definition in definitions]
    if train is not None:
        from fmu_src.native.train import train_model

        models.append(train_model(train))
    if "driveline" in wanted:
        from fmu_src.native.driveline import driveline_model

        models.append(driveline_model(_car(axle)))
    return [path for one in models for path in build_native(one, out_dir, native)]


def _car(axle: str | Path | None) -> DrivelineParameters | None:
    """Return the car of an axle file."""
    if axle is None:
        return None
    from fmu_src import hypoid_axle

    resources = _with_axle(axle).resources
    return hypoid_axle.car_axle_in(resources).driveline


def _with_axle(axle: str | Path) -> Definition:
    """Return the definition with an axle file; its gear file is analysed where that is due."""
    from drivetrain.axle_file.axle_file import AxleFile
    from drivetrain.axle_file.read_axle import table_file
    from fmu_src import hypoid_axle

    table = table_file(AxleFile.given(str(axle)), Path(axle).parent)
    return hypoid_axle.definition_with_axle(axle, table)


def axle_definition(
    mesh_table: str | Path | None = None, axle: str | Path | None = None
) -> Definition:
    """Return the definition of HypoidAxle.fmu with a mesh table, an axle file or neither."""
    from fmu_src import hypoid_axle

    if axle is not None:
        hypoid_axle.check_one_table(mesh_table)
        return _with_axle(axle)
    if mesh_table is None:
        return hypoid_axle.DEFINITION
    return hypoid_axle.definition_with_table(mesh_table)


def pair_definition(
    gear: str | Path | None = None, line_mesh: str | Path | None = None
) -> Definition:
    """Return the definition of HelicalPair.fmu, with a gear file and its line mesh if given."""
    from fmu_src import helical_pair

    return helical_pair.definition_with(gear, line_mesh)
