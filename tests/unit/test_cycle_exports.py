"""The one efficiency that FASTSim and CO2MPAS take of a final drive."""

from __future__ import annotations

import numpy as np
import pytest
import xarray as xr

from gearlube.studies.drive_cycle.tables import co2mpas_text, constant_efficiency, fastsim_text


def cycle(torque: list[float], loss: list[float]) -> xr.Dataset:
    """Steps of 10 s at 100 rad/s; torques [N.m] and losses [W]."""
    n = len(torque)
    return xr.Dataset(
        {
            "duration": ("step", np.full(n, 10.0)),
            "pinion_speed": ("step", np.full(n, 954.92966)),
            "pinion_torque": ("step", np.array(torque)),
            "loss": (("step", "source"), np.array(loss)[:, None]),
            "energy_lost": ("source", [1e-2 * sum(loss)]),
        }
    )


def test_driving_alone_has_the_efficiency_of_wheels_over_pinion() -> None:
    # 10 kW and 5 kW in, 0.5 and 0.4 kW lost
    found = constant_efficiency(cycle([100.0, 50.0], [500.0, 400.0]))
    assert found == pytest.approx(14.1 / 15.0, rel=1e-7)


def test_braking_alone_has_the_efficiency_of_pinion_over_wheels() -> None:
    # 2 kW reach the pinion, 0.3 kW are lost, so the wheels give 2.3 kW
    assert constant_efficiency(cycle([-20.0], [300.0])) == pytest.approx(2.0 / 2.3, rel=1e-7)


def test_one_number_loses_the_energy_of_driving_braking_and_idling() -> None:
    # kJ: 95 to the wheels, 23 from them, and a drag of 1 at no torque that the wheels bring
    eta = constant_efficiency(cycle([100.0, -20.0, 0.0], [500.0, 300.0, 100.0]))
    lost = 95.0 * (1.0 / eta - 1.0) + (23.0 + 1.0) * (1.0 - eta)
    assert lost == pytest.approx(5.0 + 3.0 + 1.0, rel=1e-7)  # seven digits of the speed


def test_drag_alone_has_no_efficiency() -> None:
    assert np.isnan(constant_efficiency(cycle([1.0, 0.0], [400.0, 400.0])))


def test_co2mpas_gets_ratio_and_efficiency_by_its_names() -> None:
    rows = co2mpas_text(0.965, 36 / 13).splitlines()
    assert rows == [
        "parameter,value", "final_drive_ratio,2.76923077", "final_drive_efficiency,0.965000"
    ]  # fmt: skip


@pytest.mark.slow
def test_fastsim_takes_the_file_and_divides_in_driving_and_multiplies_in_braking() -> None:
    fastsim = pytest.importorskip("fastsim")
    yaml = pytest.importorskip("yaml")
    given = yaml.safe_load(fastsim_text(0.965, "wltc"))["transmission"]
    described = fastsim.Vehicle.from_resource("2022_Renault_Zoe_ZE50_R135.yaml").to_dict()
    own = described["pt_type"]["BEV"]["transmission"]
    assert set(given) <= set(own)
    own.update(given)
    run = fastsim.SimDrive(
        fastsim.Vehicle.from_dict(described), fastsim.Cycle.from_resource("udds.csv")
    )
    run.run()
    history = run.to_dict()["veh"]["pt_type"]["BEV"]["transmission"]["history"]
    out, put_in = (np.array(history[f"pwr_{way}_watts"]) for way in ("out", "in"))
    assert out.max() > 1e4  # W
    assert out.min() < -1e3
    np.testing.assert_allclose(put_in, np.where(out > 0.0, out / 0.965, out * 0.965), rtol=1e-12)
