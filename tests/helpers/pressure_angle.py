"""Pressure angles of the surfaces that the blades sweep, of gear and pinion."""

from __future__ import annotations

import math

import numpy as np
from scipy.spatial.transform import Rotation

from gearlube_core.hypoid_geometry.flank.cutting_motion import cut_state, unit_normal
from gearlube_core.hypoid_geometry.flank.flank import CURVES, Role, Side
from gearlube_core.hypoid_geometry.flank.machine_check import turn_to
from gearlube_core.hypoid_geometry.flank.machine_frames import gear_cut, pinion_cut
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile


def pressure_angle(file: HypoidGearFile, role: Role, side: Side) -> float:
    """Return the pressure angle [rad] of the surface that a cutter's blades sweep.

    Angle between its normal and the pitch plane, where the blades' path passes the mean reference
    point. For a form-cut gear this surface is the flank; the pinion's is the tooth that generates
    it and stands in for the gear's.
    """
    blank = file.blank()
    cut = (pinion_cut if role == "pinion" else gear_cut)(file, CURVES[role, side])
    axis, point = np.array(cut.motion.work_axis), np.array(cut.motion.work_point)
    state = cut_state(cut.motion, 0.0, cut.cutter_angle, cut.cradle_angle)
    turn = turn_to(axis, np.array(state.r) - point, blank, point)
    normal = Rotation.from_rotvec(turn * axis).apply(np.array(unit_normal(state)))
    return math.asin(abs(float(normal @ blank.pitch_normal())))


def pressure_angle_mismatch(file: HypoidGearFile, side: Side) -> float:
    """Return by how much the tooth that generates the pinion differs from the gear's [rad].

    Pinion's less gear's pressure angle of `pressure_angle`; positive: the pinion's flank is the
    flatter one, and bears at its root and the gear's tip.
    """
    return pressure_angle(file, "pinion", side) - pressure_angle(file, "gear", side)
