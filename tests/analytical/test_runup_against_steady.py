"""A slow ramp passes through the states of the steady sweep."""

import numpy as np
import pytest

from drivetrain.axle_file.read_axle import read_axle
from gearlube.studies.runup.run import run_runup
from gearlube.studies.runup.settings import RunupSettings
from gearlube.studies.sweep.axle_in_fmu import settings_of
from gearlube.studies.sweep.point import march

OIL = 353.15  # K


@pytest.mark.slow
@pytest.mark.parametrize("speed_kmh", [60.0, 100.0])
def test_a_ramp_has_the_levels_of_a_steady_point_where_it_passes_it(speed_kmh: float) -> None:
    car = read_axle("mohammadpour_2015")
    settings = settings_of(car.axle, driver="hold", oil_temperature=OIL, record_time=0.6)
    steady = march(car, speed_kmh, settings)
    speed = float(steady["pinion_speed"])
    ramp = run_runup(
        RunupSettings(
            car_axle=car,
            start_speed=speed - 6.0,
            end_speed=speed + 6.0,
            duration=4.0,
            pinion_torque=float(steady["pinion_torque"]),
            oil_temperature=OIL,
        )
    )
    block = int(np.argmin(np.abs(ramp["block_speed"].values - speed)))
    bins = [int(np.argmin(np.abs(steady["order"].values - 13 * m))) for m in (1, 2, 3)]
    expected = steady["dte_spectrum"].values[bins]
    # Within a block the speed changes by 0.3 %, and the ramp lags by less than 0.1 rad/s: 1 %.
    found = ramp["dte_track"].values[block, :3]
    assert found == pytest.approx(expected, rel=0.01)
    assert float(ramp["dte_overall"][block]) == pytest.approx(float(steady["dte_rms"]), rel=0.01)
    near = np.abs(ramp["pinion_speed"].values - speed) < 1.0
    mean = float(ramp["bearing_force"].sel(bearing="pinion", direction="axial")[near].mean())
    of_steady = float(steady["bearing_force_mean"].sel(bearing=[1, 2], axis="x").sum())
    assert mean == pytest.approx(of_steady, rel=1e-3)
