"""Axles of files with a few fields."""

from functools import reduce

from drivetrain.axle_file.axle_file import AxleFile
from gearlube_core.mesh_table.netcdf import shipped_mesh_table

MESH = shipped_mesh_table("mohammadpour_2015")
BARE = {"gear_set": {"mesh_table": "mohammadpour_2015"}}


def with_fields(changes):
    """Return the data of a file with these dotted fields and the shipped mesh table."""
    data = {"gear_set": dict(BARE["gear_set"])}
    for field, value in changes.items():
        *sections, key = field.split(".")
        reduce(lambda at, name: at.setdefault(name, {}), sections, data)[key] = value
    return data


def car_axle(changes):
    """Return axle and car of a file with these dotted fields."""
    return AxleFile.from_data(with_fields(changes), "my.toml").car_axle(MESH)
