"""A loss map as an FMU: linear between its points, which hosts see and change as one map."""

from __future__ import annotations

import zipfile
from pathlib import Path

import fmpy
import numpy as np
import pytest
import xarray as xr
from lxml import etree

import gearlube as gl
from fmu_src.check import fmpy_problems
from fmu_src.native.model_description_3 import STRUCT
from fmu_src.native.platforms import platform_of_this_machine
from gearlube.output.exports.export import _write_map_fmu as write_map_fmu
from gearlube_core.errors import ParameterError
from tests.helpers.reference_run import check_reference
from tests.helpers.schemas import FMI_3, complaints

GRID = {"temperature": [40.0, 80.0, 100.0], "speed": [500.0, 1000.0, 3000.0, 4000.0],
        "torque": [-50.0, 0.0, 20.0, 100.0, 200.0]}  # fmt: skip
KIND = "org.fmi-standard.fmi-ls-struct.map"
SIGNALS = ("pinion.speed", "pinion.torque", "oil.temperature")


def loss_map() -> xr.Dataset:
    rng = np.random.default_rng(7)
    loss = 1.0 + rng.random([len(one) for one in GRID.values()])
    values = {"loss_torque": loss, "loss_torque_low": 0.8 * loss, "loss_torque_high": 1.3 * loss}
    return xr.Dataset(
        {name: (tuple(GRID), value) for name, value in values.items()},
        coords=GRID,
        attrs={"mesh": "some mesh", "oil": "some oil"},
    )


@pytest.fixture(scope="module")
def fmu(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("map") / "LossMap.fmu"
    assert write_map_fmu(loss_map(), path, [platform_of_this_machine()]) == [path]
    return path


def at(fmu: Path, rpm: float, torque: float, degc: float, **more: object) -> dict[str, float]:
    """Return the outputs after a step at an operating point."""
    values = dict(zip(SIGNALS, (rpm * np.pi / 30.0, torque, degc + 273.15), strict=True))
    found = fmpy.simulate_fmu(
        str(fmu), start_values=values | more, stop_time=0.01, output_interval=0.01
    )
    return {name: float(found[name][-1]) for name in found.dtype.names}


def test_the_fmu_is_sound(fmu: Path) -> None:
    assert fmpy_problems(fmu) == []


def test_its_reference_results_come_out_again(fmu: Path, tmp_path: Path) -> None:
    expected = check_reference(fmu, tmp_path)
    assert expected["loss_torque"][0] != expected["loss_torque"][-1]


@pytest.mark.parametrize("seed", range(4))
def test_values_between_points_are_those_of_linear_interpolation(fmu: Path, seed: int) -> None:
    rng = np.random.default_rng(seed)
    rpm, torque, degc = rng.uniform([500.0, -50.0, 40.0], [4000.0, 200.0, 100.0])
    found = at(fmu, rpm, torque, degc)
    expected = loss_map().interp(speed=rpm, torque=torque, temperature=degc)
    for name in expected:  # rounding
        assert found[str(name)] == pytest.approx(float(expected[name]), rel=1e-12)
    power = found["loss_torque"] * rpm * np.pi / 30.0
    assert found["power_loss"] == pytest.approx(power, rel=1e-12)
    assert found["range.exceeded"] == 0


def test_the_ends_are_held_and_said(fmu: Path) -> None:
    found = at(fmu, 100.0, 300.0, 60.0)
    expected = loss_map().interp(speed=500.0, torque=200.0, temperature=60.0)
    assert found["loss_torque"] == pytest.approx(float(expected["loss_torque"]), rel=1e-12)
    assert found["range.exceeded"] == 1 + 2


def test_a_host_may_calibrate_the_map(fmu: Path) -> None:
    flat = np.full([len(GRID[one]) for one in ("speed", "torque", "temperature")], 2.5).ravel()
    assert at(fmu, 700.0, 10.0, 90.0, **{"map.loss_torque": flat})["loss_torque"] == 2.5


def test_axes_that_do_not_rise_are_refused(fmu: Path) -> None:
    with pytest.raises(Exception, match="fmi3ExitInitializationMode"):
        at(fmu, 700.0, 10.0, 90.0, **{"map.temperature": np.array([300.0, 290.0, 310.0])})


def test_points_are_grouped_as_the_layered_standard_has_it(fmu: Path) -> None:
    """Domain, its input, and so on in the order of the axes of the codomain."""
    with zipfile.ZipFile(fmu) as archive:
        terminals = archive.read("terminalsAndIcons/terminalsAndIcons.xml")
        manifest = etree.fromstring(archive.read(STRUCT))
    assert complaints(FMI_3 / "fmi3TerminalsAndIcons.xsd", terminals) == []
    (terminal,) = etree.fromstring(terminals).iter("Terminal")
    assert (terminal.get("terminalKind"), terminal.get("matchingRule")) == (
        f"{KIND}.rectilinearGrid", KIND,
    )  # fmt: skip
    members = [(one.get("variableName"), one.get("variableKind")) for one in terminal]
    assert members == [
        ("map.speed", f"{KIND}.domain"), ("pinion.speed", f"{KIND}.domainInput"),
        ("map.torque", f"{KIND}.domain"), ("pinion.torque", f"{KIND}.domainInput"),
        ("map.temperature", f"{KIND}.domain"), ("oil.temperature", f"{KIND}.domainInput"),
        ("map.loss_torque", f"{KIND}.codomain"), ("loss_torque", f"{KIND}.codomainOutput"),
        ("map.loss_torque_low", f"{KIND}.codomain"),
        ("loss_torque_low", f"{KIND}.codomainOutput"),
        ("map.loss_torque_high", f"{KIND}.codomain"),
        ("loss_torque_high", f"{KIND}.codomainOutput"),
    ]  # fmt: skip
    ls = "{http://fmi-standard.org/fmi-ls-manifest}fmi-ls-"
    assert (manifest.get(f"{ls}name"), manifest.get(f"{ls}version")) == (
        "org.fmi-standard.fmi-ls-struct", "1.0.0-rc.1",
    )  # fmt: skip
    sizes = {
        v.name: [int(d.start) for d in v.dimensions]
        for v in fmpy.read_model_description(str(fmu)).modelVariables
    }
    assert [sizes[f"map.{name}"] for name in ("speed", "torque", "temperature")] == [[4], [5], [3]]
    assert sizes["map.loss_torque"] == [4, 5, 3]


def test_a_map_with_holes_or_one_temperature_is_refused(tmp_path: Path) -> None:
    hollow = loss_map()
    hollow["loss_torque"][0, 0, :2] = np.nan
    with pytest.raises(ParameterError, match="loss_torque lacks 2 of 60"):
        write_map_fmu(hollow, tmp_path / "a.fmu")
    with pytest.raises(ParameterError, match="temperatures of a sampled map must be at least 2"):
        write_map_fmu(loss_map().isel(temperature=[0]), tmp_path / "a.fmu")
    loss_map().rename(loss_torque="other").to_netcdf(tmp_path / "other.nc")
    with pytest.raises(ParameterError, match="must hold loss_torque over speed"):
        gl.export_results(tmp_path / "other.nc", "fmu", tmp_path / "a.fmu")
    assert not (tmp_path / "a.fmu").exists()
