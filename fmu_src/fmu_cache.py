"""The axle FMU of this installation, built once and stored in the user's cache."""

from __future__ import annotations

from pathlib import Path


def cached_hypoid_axle(mesh_table: Path | None = None) -> Path:
    """Return HypoidAxle.fmu from the user's cache; build it if sources or mesh table are new.

    The folder carries the GUID, which changes with everything that decides the results.
    """
    from platformdirs import user_cache_path

    from fmu_src.build import build_hypoid_axle
    from fmu_src.hypoid_axle import DEFINITION, definition_with_table
    from fmu_src.identity import guid_of

    definition = DEFINITION if mesh_table is None else definition_with_table(mesh_table)
    folder = user_cache_path("gearlube") / "fmu" / str(guid_of(definition))
    path = folder / f"{definition.name}.fmu"
    if not path.is_file():
        folder.mkdir(parents=True, exist_ok=True)
        build_hypoid_axle(folder, mesh_table)
    return path
