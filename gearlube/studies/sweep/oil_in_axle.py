"""An axle file with another oil, for a sweep."""

from __future__ import annotations

import shutil
from pathlib import Path

from drivetrain.axle_file.axle_file import AxleFile
from drivetrain.axle_file.read_axle import read_axle, table_file
from fmu_src.hypoid_axle import PAPER, check_one_table
from gearlube.output.toml_text import toml_text
from gearlube_core.mesh_table.netcdf import read_mesh_table
from gearlube_core.oil.oil_file import read_oil_file
from gearlube_core.storage.atomic_file import write_text

_TABLES = (("gear_set", "mesh_table"), ("gear_set", "asperity_table"))
_MODELS = (("film", "flank_model"), ("film", "roller_model"))


def axle_with_oil(
    axle: Path | str | None, mesh_table: Path | None, oil: Path | str, folder: Path
) -> Path:
    """Return an axle file in `folder` that has the oil of an oil file; copies lie beside it.

    Parameters
    ----------
    axle : path, optional
        Axle file, or the name of a shipped one; by default the paper's.
    mesh_table : path, optional
        Of the paper's axle with other gears.
    oil : path
    folder : path

    Raises
    ------
    ParameterError, TableError
        A file is missing or wrong, or a mesh table comes with an axle file.
    """
    read_oil_file(Path(oil))
    if axle is not None:
        check_one_table(mesh_table)
    read_axle(axle or PAPER)  # with its tables, before any is copied
    file = AxleFile.given(str(axle or PAPER))
    data = file.model_dump(exclude_none=True)
    data["oil"] = {"file": "oil.toml"}
    gears = data["gear_set"]
    if file.gear_set.gear_file is not None:
        table = table_file(file, Path(axle or "").parent)
        gears["mesh_table"] = str(Path(table or "").resolve())
        del gears["gear_file"]
        gears.pop("contact_torques_n_m", None)
    shutil.copyfile(oil, folder / "oil.toml")
    if mesh_table is not None:
        read_mesh_table(mesh_table)
        gears["mesh_table"] = str(mesh_table.resolve())
    for section, key in (*_TABLES, *_MODELS):
        fields = data.get(section, {})
        suffix = Path(fields.get(key, "")).suffix
        if suffix in (".nc", ".json"):
            shutil.copyfile(Path(axle or "").parent / fields[key], folder / f"{key}{suffix}")
            fields[key] = f"{key}{suffix}"
    path = folder / "axle.toml"
    write_text(toml_text(data), path)
    return path
