"""Train files of two rotors on a shaft, whose motion has a closed form."""

from tests.helpers.coulomb_brake import CoulombBrake

FIRST, SECOND = 0.2, 2.0  # kg.m2
STIFFNESS, DAMPING = 1e4, 2.0  # N.m/rad, N.m.s/rad
BRAKE = 3.0  # N.m

ROTORS = f"""
name = "two rotors on a shaft"
steps_per_highest_period = 64

[oil]
name = "mohammadpour_2015"

[start]
speed_rpm = {{ engine = 1000.0 }}
torque_n_m = {{ drive = 0.0 }}

[bodies.engine]
mass_kg = 1.0
inertia_kg_m2 = 1.0
polar_inertia_kg_m2 = {FIRST}
held = ["x", "y", "z", "rx", "ry"]

[bodies.load]
mass_kg = 1.0
inertia_kg_m2 = 1.0
polar_inertia_kg_m2 = {SECOND}
held = ["x", "y", "z", "rx", "ry"]

[elements.drive]
kind = "port"
body = "engine"

[elements.shaft]
kind = "half_shaft"
first = "engine"
second = "load"
stiffness_n_m_per_rad = {STIFFNESS}
damping_n_m_s_per_rad = {DAMPING}
"""
WITH_BRAKE = f"""{ROTORS}
[elements.brake]
kind = "{CoulombBrake.kind}"
body = "load"
torque_n_m = {BRAKE}
"""
