"""Loads of all rollers over one turn of the pinion where the bearing forces are largest."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from gearlube.studies.runup.record import RampRecord
from gearlube.studies.runup.settings import RunupSettings
from gearlube_core.arrays import Array
from gearlube_core.bearings.bearing_type import ShaftMotion
from gearlube_core.bearings.parameters import BearingParameters
from gearlube_core.bearings.roller_loads import roller_loads
from gearlube_core.dynamics.hypoid_mesh.mesh_force import reference_frequency
from gearlube_core.oil.lubricant_state import lubricant_state

RINGS = (1, 2, 3, 4)  # bearings as in docs/conventions.md
_FRAMES_PER_MESH = 4
# axes of r1, r2 and the shaft, and the shaft's speed
_SHAFTS = (("pinion", ("z", "y", "x"), "pinion.speed"), ("wheel", ("x", "y", "z"), "wheel.speed"))

Variables = dict[str, tuple[object, Array]]


def roller_variables(settings: RunupSettings, record: RampRecord, time: float) -> Variables:
    """Return angle and load of every roller over the turn of the pinion about `time` [s].

    Empty for bearings without rollers. Rollers that a bearing has fewer than another are NaN.
    """
    from scipy.interpolate import CubicSpline

    p = settings.car_axle.axle.kernel_parameters()
    bearings: list[Any] = [
        b for b in (p.bearing_p, p.bearing_g) if isinstance(b, BearingParameters)
    ]
    if len(bearings) < len(_SHAFTS):
        return {}
    angle = record.channels["pinion.angle"]
    turn = 2.0 * math.pi
    last = math.floor(angle[-1] / turn) - 1
    start = min(math.floor(float(np.interp(time, record.time, angle)) / turn), last)
    start = max(start, math.ceil(angle[0] / turn))
    count = int(p.mesh.z_p) * _FRAMES_PER_MESH
    wanted = turn * (start + np.arange(count) / count)
    near = (angle > wanted[0] - turn) & (angle < wanted[-1] + turn)
    at = np.interp(wanted, angle[near], record.time[near])
    oil = lubricant_state(p.oil, settings.oil_temperature)
    most = max(int(one.n_rollers) for one in bearings)
    load = np.full((count, len(RINGS), most), np.nan)
    place = np.full((count, len(RINGS), most), np.nan)
    for shaft, ((member, axes, speed), bearing) in enumerate(zip(_SHAFTS, bearings, strict=True)):
        motions = [
            CubicSpline(record.time[near], record.channels[f"{member}.displacement.{axis}"][near])
            for axis in axes
        ]
        turning = CubicSpline(record.time[near], record.channels[speed][near])(at)
        # cage and shaft start at angle zero together
        ratio = 1.0 if shaft == 0 else 1.0 / settings.car_axle.axle.mesh.ratio
        cage = bearing.cage_ratio * ratio * wanted
        number = int(bearing.n_rollers)
        rollers = np.zeros(number)
        for k in range(count):
            r1, r2, axial = (float(one(at[k])) for one in motions)
            v1, v2, v_axial = (float(one(at[k], 1)) for one in motions)
            motion = ShaftMotion(r1, r2, axial, v1, v2, v_axial, float(cage[k]), float(turning[k]))
            f_ref = reference_frequency(p.mesh, float(turning[k]) / ratio)
            for end, side in enumerate((1.0, -1.0)):
                roller_loads(motion, f_ref, oil.eta0, oil.alpha, bearing, side, rollers)
                load[k, 2 * shaft + end, :number] = rollers
                place[k, 2 * shaft + end, :number] = cage[k] + turn * np.arange(number) / number
    dims = ("frame", "ring", "roller")
    return {
        "frame_time": ("frame", at),
        "frame_angle": ("frame", wanted - wanted[0]),
        "roller_load": (dims, load),
        "roller_angle": (dims, np.mod(place, turn)),
        "ring": ("ring", np.array(RINGS)),
    }
