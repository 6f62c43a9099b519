"""Settings of a sweep: all inputs of a point except speed and preload."""

from __future__ import annotations

import hashlib
import json
from dataclasses import asdict, dataclass, fields
from typing import Annotated

from drivetrain.driveline.model import COMMUNICATION_STEP
from drivetrain.sump_heat import SumpHeat
from fmu_src.axle_arguments import CUSTOM_OIL
from fmu_src.variables import HYPOID_AXLE
from gearlube_core.bearings.losses.laws import DEFAULT_LAW
from gearlube_core.checks import check_option, check_positive, check_within
from gearlube_core.contact.greenwood_tripp_1971 import ROUGHNESS
from gearlube_core.dynamics.flank_force import BACKLASH
from gearlube_core.friction.flank_friction import friction_laws
from gearlube_core.number import Number, Positive, check_fields
from gearlube_core.oil.lubricant import Lubricant
from gearlube_core.units import celsius_to_kelvin

DRIVERS = ("vehicle", "hold")
GIVEN, STEADY = "given", "steady"

# FMI parameter name of every field that is passed on to the FMU.
FMU_PARAMETERS = {
    "oil": "oil.name",
    "roughness_rms": "flank.roughness_rms",
    "backlash": "mesh.backlash",
    "equations": "model.equations",
    "radii": "model.radii",
    "mesh_stiffness": "model.mesh_stiffness",
    "mesh_damping": "mesh.damping",
    "modal_loss_factor": "mesh.modal_loss_factor",
    "friction": "friction.model",
    "bearing_approach": "bearing.approach",
    "bearing_torque_loss": "bearing.torque_loss",
    "steps_per_mesh_period": "solver.steps_per_mesh_period",
    "steps_per_highest_period": "solver.steps_per_highest_period",
}
_TABLE = {variable.name: variable for variable in HYPOID_AXLE}
_FMU_VARIABLES = {name: _TABLE[fmi] for name, fmi in FMU_PARAMETERS.items()}
OILS = _FMU_VARIABLES["oil"].literals
SPEED_RANGE = (1.0, 300.0)  # of the vehicle [km/h]
PRELOAD_RANGE = (1.0, 1e5)  # of a bearing [N]


@dataclass(frozen=True, slots=True, kw_only=True)
class SweepSettings:
    """Model options, driver and timing of a speed sweep, the same for all its points.

    Parameters
    ----------
    oil_temperature : float
        Temperature of the oil at the flank inlet [K]; not used if `oil_state` is "steady".
    oil_state : str
        "given": `oil_temperature`. "steady": each point runs at the oil temperature at which the
        air takes as much heat as the axle loses, see `drivetrain.steady_temperature`.
    air_temperature, conductance_at_rest, conductance_at_100_kmh : float
        Data for the steady temperature [K], [W/K], [W/K].
    driver : str
        "vehicle": the axle is coupled to the driveline and the road; "hold": road load and a slow
        speed controller act on it directly.
    oil, equations, radii, mesh_stiffness, mesh_damping, friction : str
    bearing_approach, bearing_torque_loss : str
        Options of the axle model, passed to the FMU. Oil "custom" is that of its axle file.
    roughness_rms, backlash : float
        Composite roughness of the flanks, total normal backlash [m].
    modal_loss_factor : float
        Used only with mesh_damping = "modal" [-].
    steps_per_mesh_period, steps_per_highest_period : int
        Inner time steps of the FMU [-].
    communication_step : float
        Largest communication step [s]. The step used is the mesh period divided by an integer.
        With 1e-4 s the record reaches 5 kHz, so that bearing modes at 2 to 3 kHz are resolved.
    settling_time : float
        Shortest time before the record starts [s]; it is at least 20 mesh periods.
    record_time : float
        Shortest length of the record [s].
    cage_turns : float
        Shortest length of the record in turns of the pinion bearing cages [-].

    Examples
    --------
    >>> SweepSettings(oil_temperature=353.15, oil="karagiannis_2012").oil
    'karagiannis_2012'
    """

    oil_temperature: float = celsius_to_kelvin(95.0)
    oil_state: str = GIVEN
    air_temperature: float = celsius_to_kelvin(23.0)
    conductance_at_rest: float = 7.0
    conductance_at_100_kmh: float = 18.0
    driver: str = "vehicle"
    oil: str = "mohammadpour_2015"
    roughness_rms: Annotated[float, ROUGHNESS] = 0.5e-6
    backlash: Annotated[float, BACKLASH] = 150e-6
    equations: str = "consistent"
    radii: str = "consistent"
    mesh_stiffness: str = "tangent"
    mesh_damping: str = "hysteretic"
    modal_loss_factor: float = 0.06
    friction: str = "consistent"
    bearing_approach: str = "full"
    bearing_torque_loss: str = DEFAULT_LAW
    steps_per_mesh_period: int = 56
    steps_per_highest_period: int = 17
    communication_step: float = COMMUNICATION_STEP
    settling_time: Annotated[float, Number("s", 0.0, 60.0)] = 0.3
    record_time: Annotated[float, Number("s", 0.02, 60.0)] = 0.5
    cage_turns: Annotated[float, Positive("1")] = 2.0

    def __post_init__(self) -> None:
        check_option("driver", self.driver, DRIVERS)
        check_option("oil_state", self.oil_state, (GIVEN, STEADY))
        SumpHeat(
            conductance_at_rest=self.conductance_at_rest,
            conductance_at_100_kmh=self.conductance_at_100_kmh,
        )
        check_fields(self)
        for name, variable in _FMU_VARIABLES.items():
            value = getattr(self, name)
            if name == "oil" and value == CUSTOM_OIL:
                continue  # that of the axle's file
            if variable.literals:
                own = friction_laws() if name == "friction" else ()
                check_option(name, value, own or variable.literals)
            else:
                check_within(name, value, *variable.range, variable.unit)
        name, temperature = self.lowest_oil_temperature
        check_positive(name, temperature, "K")
        if self.oil != CUSTOM_OIL:
            Lubricant.named(self.oil).check_temperature(temperature, name)
        check_within(
            "communication_step",
            self.communication_step,
            1e-6,
            1e-4,
            "s",
            "Bearing modes lie at 2-3 kHz and need at least 10 000 samples a second.",
        )

    @property
    def lowest_oil_temperature(self) -> tuple[str, float]:
        """Name of the setting that says how cold the oil can be at a point, and its value [K]."""
        name = "air_temperature" if self.oil_state == STEADY else "oil_temperature"
        return name, getattr(self, name)

    def as_dict(self) -> dict[str, str | float | int]:
        """Return all settings by name."""
        return asdict(self)

    @property
    def fmu_parameters(self) -> dict[str, str | float | int]:
        """Values of the FMU's parameters by FMI name (without preload and start speed)."""
        return {fmi: getattr(self, name) for name, fmi in FMU_PARAMETERS.items()}

    def key(self, *, speed_kmh: float, preload: float, fmu_guid: str, version: str) -> str:
        """Return a hash of everything that determines the result of a point."""
        everything = {
            "settings": self.as_dict(),
            "speed_kmh": float(speed_kmh),
            "preload": float(preload),
            "fmu_guid": fmu_guid,
            "version": version,
        }
        text = json.dumps(everything, sort_keys=True)
        return hashlib.sha256(text.encode()).hexdigest()[:20]


def quick_sweep_settings(settings: SweepSettings) -> SweepSettings:
    """Return `settings` with the shortest settling time and record, for a first look at a sweep.

    Examples
    --------
    >>> quick_sweep_settings(SweepSettings()).oil
    'mohammadpour_2015'
    """
    values = {field.name: getattr(settings, field.name) for field in fields(settings)}
    values.update(settling_time=0.15, record_time=0.15, cage_turns=0.9)
    return SweepSettings(**values)
