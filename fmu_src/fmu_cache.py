"""The axle FMU of this installation, built once and kept."""

from __future__ import annotations

from pathlib import Path


def cached_hypoid_axle() -> Path:
    """Return HypoidAxle.fmu from the user's cache; build it when the sources are new.

    The folder carries the GUID, which changes with every source that decides the results.
    """
    from platformdirs import user_cache_path

    from fmu_src.build import build_hypoid_axle
    from fmu_src.hypoid_axle import DEFINITION
    from fmu_src.identity import guid_of

    folder = user_cache_path("gearlube") / "fmu" / str(guid_of(DEFINITION))
    path = folder / f"{DEFINITION.name}.fmu"
    if not path.is_file():
        folder.mkdir(parents=True, exist_ok=True)
        build_hypoid_axle(folder)
    return path
