"""The shortest ramp of the paper's axle whose orders can be told."""

from drivetrain.axle_file.read_axle import read_axle
from gearlube.studies.runup.settings import RunupSettings

SHORT = RunupSettings(
    car_axle=read_axle("mohammadpour_2015"),
    start_speed=280.0,
    end_speed=300.0,
    duration=0.8,
    pinion_torque=80.0,
    sample_rate=8192.0,
    highest_frequency=3000.0,
    settling_time=0.1,
)
