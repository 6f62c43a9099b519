"""Line meshes on disk: what is kept and what is refused."""

import numpy as np
import pytest
import xarray as xr

from gearlube_core.errors import TableError
from gearlube_core.mesh_table.line_mesh import LineMesh
from gearlube_core.mesh_table.line_mesh_file import read_line_mesh, write_line_mesh


@pytest.fixture
def mesh():
    rng = np.random.default_rng(5)
    shape = (2, 6, 3, 4)
    return LineMesh(
        name="any",
        source="random numbers",
        pinion_teeth=25,
        gear_teeth=31,
        base_pitch=9.04e-3,
        torque=np.array([50.0, 225.0]),
        phase=np.arange(6) / 6,
        station=(np.arange(4) + 0.5) / 4,
        density=1e10 * rng.random(shape),
        offset=1e-6 * rng.standard_normal(shape),
        provenance={"density": "computed: at random", "offset": "computed: at random"},
    )


def test_a_line_mesh_comes_back_bit_by_bit(mesh, tmp_path):
    back = read_line_mesh(write_line_mesh(mesh, tmp_path / "new" / "mesh.nc"))
    for name in ("torque", "phase", "station", "density", "offset"):
        np.testing.assert_array_equal(getattr(back, name), getattr(mesh, name))
    for name in ("name", "source", "pinion_teeth", "gear_teeth", "base_pitch", "provenance"):
        assert getattr(back, name) == getattr(mesh, name)
    assert [p.name for p in (tmp_path / "new").iterdir()] == ["mesh.nc"]


def test_every_datum_has_unit_and_name(mesh, tmp_path):
    with xr.open_dataset(write_line_mesh(mesh, tmp_path / "mesh.nc"), engine="scipy") as dataset:
        for name in ("torque", "phase", "station", "density", "offset"):
            assert dataset[name].attrs["units"]
            assert dataset[name].attrs["long_name"]
        assert dataset["density"].attrs["provenance"] == "computed: at random"


def test_files_that_are_no_line_mesh_are_refused(mesh, tmp_path):
    with pytest.raises(TableError, match=r"line mesh absent\.nc was not found in "):
        read_line_mesh(tmp_path / "absent.nc")
    text = tmp_path / "text.nc"
    text.write_text("torque 1 2 3")
    with pytest.raises(TableError, match="not a readable NetCDF 3"):
        read_line_mesh(text)
    whole = write_line_mesh(mesh, tmp_path / "whole.nc").read_bytes()
    cut = tmp_path / "cut.nc"
    cut.write_bytes(whole[: len(whole) // 2])
    with pytest.raises(TableError, match="not a readable NetCDF 3"):
        read_line_mesh(cut)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda d: d.attrs.pop("gearlube_line_mesh"), "not a gearlube line mesh"),
        (lambda d: d.attrs.update(gearlube_line_mesh=0), "an older gearlube"),
        (lambda d: d.attrs.update(gearlube_line_mesh=99), "a newer gearlube"),
        (lambda d: d.attrs.pop("base_pitch"), "lacks base_pitch"),
        (lambda d: d["offset"].attrs.update(units="mm"), "offset must be in m, got mm"),
        (lambda d: d["density"].values.__setitem__((0, 0, 0, 0), -1.0), "density must not be"),
        (lambda d: d["offset"].values.__setitem__((0, 0, 0, 0), np.nan), "offset must be finite"),
    ],
)
def test_contradictions_are_named(mesh, tmp_path, change, message):
    dataset = xr.load_dataset(write_line_mesh(mesh, tmp_path / "mesh.nc"), engine="scipy")
    change(dataset)
    dataset.to_netcdf(tmp_path / "bad.nc", engine="scipy")
    with pytest.raises(TableError, match=message):
        read_line_mesh(tmp_path / "bad.nc")


def test_a_missing_or_transposed_datum_is_named(mesh, tmp_path):
    dataset = xr.load_dataset(write_line_mesh(mesh, tmp_path / "mesh.nc"), engine="scipy")
    dataset.drop_vars("density").to_netcdf(tmp_path / "less.nc", engine="scipy")
    with pytest.raises(TableError, match="lacks density"):
        read_line_mesh(tmp_path / "less.nc")
    turned = dataset.transpose("phase", "torque", "line", "station")
    turned.to_netcdf(tmp_path / "turned.nc", engine="scipy")
    with pytest.raises(TableError, match="must have the dimensions"):
        read_line_mesh(tmp_path / "turned.nc")
