"""Error bars of the losses of a point: the uncertain data of the axle drawn."""

from __future__ import annotations

import numpy as np
import xarray as xr

from gearlube.studies.sweep.quantities import described
from gearlube_core.dynamics.hypoid_axle.loss_draws import drawn_losses
from gearlube_core.dynamics.hypoid_axle.losses import LOSS_SOURCES
from gearlube_core.dynamics.hypoid_axle.parameters import HypoidAxleParameters
from gearlube_core.errors import ParameterError

_BOUNDS = 2.5, 97.5  # percent


def with_error_bars(point: xr.Dataset, axle: HypoidAxleParameters) -> xr.Dataset:
    """Return a point with the bounds of 95 % of the draws of its loss and efficiency.

    The loss that was marched is scaled as the loss in steady running at its mean torque, speed and
    oil temperature; see `drawn_losses`. NaN where the axle cannot run steadily there.
    """
    power = point["loss"].sel(source=list(LOSS_SOURCES)).values
    power_in = float(point["power_in"])
    try:
        drawn = drawn_losses(
            axle,
            np.maximum(power, 0.0),
            torque=float(point["pinion_torque"]),
            speed=float(point["pinion_speed"]),
            temperature=float(point["oil_temperature"]),
        )
        low, high = (float(one) for one in np.percentile(drawn, _BOUNDS))
    except ParameterError:
        low = high = np.nan
    whole = float(power.sum())
    # more loss is more input at the same output
    shares = [
        1.0 - lost / (power_in + lost - whole) if power_in + lost > whole else np.nan
        for lost in (high, low)
    ]
    bounds = {
        "loss_low": low,
        "loss_high": high,
        "efficiency_axle_low": shares[0],
        "efficiency_axle_high": shares[1],
    }
    return described(point.assign(bounds))
