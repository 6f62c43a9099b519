"""An axle whose motion is written down, to test the sweep apart from the physics."""

import math
import os
import time

import numpy as np
import xarray as xr

from gearlube.studies.sweep.point import failed_point, summarise
from gearlube.studies.sweep.recording import CHANNELS, LOSSES, record
from gearlube_core.errors import GearLubeError

TEETH, WHEEL_TEETH, RADIUS = 13, 36, 0.32
CAGE_ORDER = 0.4
MEAN_DTE, MESH_DTE, SECOND_DTE = 4e-6, 1e-6, 3e-7
INPUT_POWER = 2000.0
LOSS_POWERS = dict(zip(LOSSES, (10.0, 4.0, 0.5, 1.0, 20.0, 2.0, 1.5, 3.0), strict=True))


def pinion_speed_at(speed_kmh):
    return speed_kmh / 3.6 / RADIUS * WHEEL_TEETH / TEETH


class AnalyticAxle:
    """Constant speed; DTE of two mesh orders, roller load of one cage order."""

    def __init__(self, speed, offset=0.0):
        self.speed, self.offset, self.time = speed, offset, 0.0
        self.dte_offset = MEAN_DTE + offset

    def initialise(self, pinion_torque, wheel_torque, temperature):
        self.time = 0.0

    def step(self, h, pinion_torque, wheel_torque):
        self.time += h

    def read(self):
        t = self.time
        angle = self.speed * t
        mesh = TEETH * angle
        cage = CAGE_ORDER * angle
        values = dict.fromkeys(CHANNELS, 0.0)
        values |= {
            "pinion.angle": angle,
            "pinion.speed": self.speed,
            "wheel.angle": angle * TEETH / WHEEL_TEETH,
            "wheel.speed": self.speed * TEETH / WHEEL_TEETH,
            "mesh.dte": self.dte_offset
            + MESH_DTE * math.cos(mesh)
            + SECOND_DTE * math.cos(2.0 * mesh + 0.3),
            "mesh.force": 2000.0 + 200.0 * math.cos(mesh),
            "mesh.frequency": TEETH * self.speed / (2.0 * math.pi),
            "pinion.displacement.y": 3e-6 + 1e-6 * math.cos(mesh),
            "pinion.displacement.z": 0.0,
            "bearing[1].roller[1].load": 500.0 + 100.0 * math.cos(cage),
            "bearing[1].cage.angle": cage,
            "bearing[3].cage.angle": cage * TEETH / WHEEL_TEETH,
            "flank[1].load": 1000.0,
            "flank[1].film_thickness": 0.5e-6 * (1.1 + math.cos(mesh / 3.0) * 0.1),
            "flank[1].film_ratio": 1.1 + math.cos(mesh) * 0.1,
            "flank[1].temperature": 370.0,
            "energy.pinion_work": INPUT_POWER * t,
            "energy.wheel_work": (INPUT_POWER - sum(LOSS_POWERS.values())) * t,
        }
        values |= {f"energy.{name}": power * t for name, power in LOSS_POWERS.items()}
        return np.array([values[name] for name in CHANNELS])


class SteadyDriver:
    vehicle_speed = 16.7

    def initial_torques(self):
        return 30.0, 80.0

    def step(self, h, pinion_angle, pinion_speed, wheel_angle, wheel_speed):
        return 30.0, 80.0


def recorded(speed_kmh, settings):
    return record(AnalyticAxle(pinion_speed_at(speed_kmh)), SteadyDriver(), settings, CHANNELS)


def point(fmu, speed_kmh, preload, settings):
    """Same signature as `run_point`; the motion depends on speed only."""
    recording = recorded(speed_kmh, settings)
    return summarise(recording, speed_kmh, preload, settings)


def small_point(fmu, speed_kmh, preload, settings):
    """A point without a simulation, for tests of the bookkeeping."""
    guid = (fmu / "modelDescription.xml").read_bytes()
    bins = int(speed_kmh)
    return xr.Dataset(
        {
            "status": 1,
            "message": "",
            "dte_pp": speed_kmh * 1e-9 + preload * 1e-12,
            "guid_size": len(guid),
            "dte_spectrum": ("bin", np.full(bins, preload)),
        },
        coords={"speed": speed_kmh / 3.6, "speed_kmh": speed_kmh, "preload": preload},
    )


def slow_point(fmu, speed_kmh, preload, settings):
    time.sleep(0.15)
    return small_point(fmu, speed_kmh, preload, settings)


def refusing_point(fmu, speed_kmh, preload, settings):
    if speed_kmh == 40.0:
        return failed_point(speed_kmh, preload, "the FMU refused the step")
    if speed_kmh == 60.0:
        raise GearLubeError("unforeseen")
    return small_point(fmu, speed_kmh, preload, settings)


def dying_point(fmu, speed_kmh, preload, settings):
    """Kills its process at 40 km/h, but only while a marker file beside the FMU is missing."""
    marker = fmu / "died-once"
    if speed_kmh == 40.0 and not marker.exists():
        marker.touch()
        os._exit(9)
    return small_point(fmu, speed_kmh, preload, settings)


def interrupting_point(fmu, speed_kmh, preload, settings):
    """Sends Ctrl-C to the parent from the point at 60 km/h, then finishes."""
    import signal

    if speed_kmh == 60.0:
        os.kill(os.getppid(), signal.SIGINT)
        time.sleep(1.0)
    return small_point(fmu, speed_kmh, preload, settings)


def write_fmu(path):
    """Write the least archive that passes for an FMU and return its path."""
    import zipfile

    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("modelDescription.xml", '<fmiModelDescription guid="{test}"/>')
    return path
