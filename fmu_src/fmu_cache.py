"""The axle FMU of this installation, built once and stored in the user's cache."""

from __future__ import annotations

import hashlib
import logging
from importlib.util import find_spec
from pathlib import Path

_LOGGER = logging.getLogger(__name__)


def can_build_native() -> bool:
    """Return whether the compiler of native FMUs is installed."""
    return find_spec("ziglang") is not None


def cached_hypoid_axle(
    mesh_table: Path | None = None,
    *,
    axle: str | Path | None = None,
    native: bool | None = None,
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

    Raises
    ------
    GearLubeError
        A file is wrong, both are given, or `native` is asked for without the compiler.

    Notes
    -----
    The folder's name changes with everything that decides the results.
    """
    from fmu_src.build import axle_definition, build_models
    from fmu_src.identity import guid_of
    from fmu_src.native.build import NativeOptions
    from fmu_src.native.platforms import platform_of_this_machine
    from gearlube_core.storage.cache_folder import user_folder

    definition = axle_definition(mesh_table, axle)
    native = can_build_native() if native is None else native
    key = f"native-{_native_digest()}-" if native else ""
    folder = user_folder() / "fmu" / f"{key}{guid_of(definition)}"
    path = folder / f"{definition.name}.fmu"
    if not path.is_file():
        folder.mkdir(parents=True, exist_ok=True)
        options = None
        if native:
            _LOGGER.info("building the native FMU of this machine, once")
            options = NativeOptions(
                platforms=[platform_of_this_machine()], fmi=["2"], reference=False
            )
        build_models(folder, "hypoid-axle", mesh_table, axle=axle, native=options)
    return path


def _native_digest() -> str:
    """Return a digest of what makes a native FMU of the kernels."""
    here = Path(__file__).parent
    digest = hashlib.sha256((here / "object_code.py").read_bytes())
    for path in sorted((here / "native").rglob("*.[pch]*")):
        if path.is_file() and path.suffix in (".py", ".c", ".h"):
            digest.update(path.read_bytes())
    return digest.hexdigest()[:16]
