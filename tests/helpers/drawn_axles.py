"""Random axles: any legal parameters of the FMU, or those of an axle that can be driven."""

from __future__ import annotations

from fmu_src.axle_arguments import axle_parameters
from fmu_src.hypoid_axle import DEFINITION
from fmu_src.variable import OF_RUN
from gearlube_core.friction.flank_friction import friction_law

PARAMETERS = [v for v in DEFINITION.variables if v.is_model_parameter]


def drawn(rng):
    """Any legal parameters, by argument."""
    values = {}
    for variable in PARAMETERS:
        if variable.literals:
            values[variable.argument] = variable.literals[rng.integers(len(variable.literals))]
            continue
        low, high = variable.range
        value = rng.choice([low, high, rng.uniform(low, high), rng.uniform(low, high)])
        values[variable.argument] = variable.decoded(
            round(value) if variable.type == "Integer" else value
        )
    return values


def drivable(rng):
    """Parameters and inputs of a car's axle."""
    values = drawn(rng)
    values["bearing_preload"] = rng.uniform(100.0, 1e4)
    values["backlash"] = rng.uniform(0.0, 3e-4)
    values["pinion_speed"] = rng.uniform(-500.0, 500.0)
    values["modal_loss_factor"] = rng.uniform(0.01, 0.2)
    values["pinion_mass"], values["gear_mass"] = rng.uniform(5.0, 20.0), rng.uniform(20.0, 80.0)
    values["pinion_inertia"] = rng.uniform(1e-3, 3e-3)
    values["gear_inertia"] = rng.uniform(0.03, 0.1)
    values["gear_bearing_preload"] = rng.choice([-1.0, rng.uniform(100.0, 1e4)])
    for role in ("pinion", "gear"):
        for name, low, high in (("contact_angle", 0.2, 0.5), ("f0", 0.0, 12.0), ("f1", 0.0, 1e-3)):
            values[f"{role}_bearing_{name}"] = rng.uniform(low, high)
    values["steps_per_mesh_period"], values["steps_per_highest_period"] = 64, 22
    if not friction_law(values["friction"]).solved_film:
        values["film"] = "formula"
    values["governor_gain"], values["time_constant"] = rng.uniform(1.0, 50.0), 1e-3
    torque = rng.uniform(-400.0, 400.0)
    reference = values["pinion_speed"] * rng.uniform(0.9, 1.1)
    return values, [torque, torque * 36 / 13, rng.uniform(300.0, 380.0), reference]


def in_python(values):
    return axle_parameters({k: v for k, v in values.items() if k not in OF_RUN})
