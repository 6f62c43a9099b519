"""The FMUs of gearlube as the tests of the common checklist see them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from fmu_src import build, helical_pair, hypoid_axle
from fmu_src.axle_arguments import axle_parameters
from fmu_src.definition import Definition
from fmu_src.variable import OF_HOLDER
from gearlube_core.dynamics.helical_model.model import HelicalPairModel
from gearlube_core.dynamics.hypoid_axle import HypoidAxle, mohammadpour_2015_axle
from gearlube_core.dynamics.hypoid_axle.loss_band import loss_sensitivities
from gearlube_core.dynamics.hypoid_mesh.parameters import HypoidAxleParameters
from gearlube_core.dynamics.train.elements.held_port import Hold, SpeedHolder
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.mesh_table.line_mesh_file import named_line_mesh
from tests.helpers.axle_cases import axle_with
from tests.helpers.helical_march_cases import march_of

OF_BEARINGS = ("gear_bearing_preload", *(f"{role}_bearing_{name}" for role in ("pinion", "gear")
               for name in ("contact_angle", "f0", "f1")))  # fmt: skip
H = 2.0**-10  # s; exact in binary, so that t + h is exact too


@dataclass(frozen=True, kw_only=True, eq=False)
class Case:
    """One FMU.

    `changed` holds start values of parameters away from their defaults; the first is a Real, the
    second an Enumeration. `bad_parameters` are (name, value, part of the message).
    """

    definition: Definition
    build: Callable[..., Path]
    snapshot: str
    arguments: dict[str, str]
    parameters: Callable[..., Any]
    model: Callable[..., Any]
    changed: dict[str, float]
    reals: dict[str, float]
    integers: dict[str, int]
    bad_parameters: list[tuple[str, float, str]]
    load: str  # output
    torque_limits: tuple[float, float]  # N.m
    display: dict[str, str]
    units_unused: set[str] = field(default_factory=set)

    @property
    def script(self) -> str:
        return f"{self.definition.slave}.py"

    @property
    def name(self) -> str:
        return self.definition.name

    @property
    def real(self) -> str:
        """A Real parameter among `changed`."""
        return next(iter(self.changed))

    @property
    def option(self) -> str:
        """An Enumeration among `changed`."""
        return list(self.changed)[1]

    def start(self, name: str) -> float:
        return self.definition.variables[self.definition.references[name]].start

    @property
    def torques(self) -> tuple[float, float]:
        """Start values of both torques [N.m]."""
        return self.start("pinion.torque"), self.start("wheel.torque")

    def enumerations(self) -> list[tuple[str, tuple[str, ...]]]:
        return [(v.name, v.literals) for v in self.definition.variables if v.literals]

    def direct(
        self,
        steps: int,
        *,
        speed: float | None = None,
        torques: list[tuple[float, float]] | None = None,
        oil_temperature: float = 333.15,
        mode: Hold = "none",
        **settings: Any,
    ) -> list[float]:
        """Outputs of the model in Python, without FMI, after steps of H.

        In the order of the FMU's variables: younger ones stand at the end there.
        """
        torques = torques or steps * [self.torques] or [self.torques]
        model = self.model(self.parameters(**settings), holder=SpeedHolder(mode=mode))
        model.initialise(
            pinion_speed=self.start("pinion.speed_start") if speed is None else speed,
            pinion_torque=torques[0][0],
            wheel_torque=torques[0][1],
            oil_temperature=oil_temperature,
        )
        for k in range(steps):
            model.step(H, *torques[k], oil_temperature)
        places = self.definition.output_names
        computed = [v.name for v in self.definition.variables if v.is_computed]
        return [float(model.outputs[places.index(name)]) for name in computed]


def helical(gear_name: str = "he_2007", stiffness_model: str = "uniform", **settings: Any) -> Any:
    mesh = named_line_mesh(gear_name) if stiffness_model == "line_mesh" else None
    # in the FMU the oil is chosen beside the gear, which may have one of its own
    settings.setdefault("oil", "mohammadpour_2015")
    return march_of(HelicalGearFile.named(gear_name), line_mesh=mesh, **settings)


def hypoid(**settings: Any) -> Any:
    """The paper's axle with changes; arguments that the FMU alone has come last."""
    late = {n: settings.pop(n) for n in list(settings) if n.startswith(OF_BEARINGS)}
    axle = axle_with(**settings)
    return axle_parameters(late, axle) if late else axle


def with_band(parameters: HypoidAxleParameters, holder: SpeedHolder | None = None) -> HypoidAxle:
    """The axle as its FMU has it: the band of its loss is that of the paper's axle."""
    return HypoidAxle(parameters, loss_sensitivities(mohammadpour_2015_axle()), holder)


def settings_of(definition: Definition) -> dict[str, str]:
    """Names of the parameters of a model, without its start speed and numbers of its holder."""
    of_run = {"pinion_speed", *OF_HOLDER[1:]}
    return {n: a for n, a in definition.arguments.items() if a not in of_run}


HYPOID_AXLE = Case(
    definition=hypoid_axle.DEFINITION,
    build=build.build_hypoid_axle,
    snapshot="value_references.json",
    arguments=settings_of(hypoid_axle.DEFINITION),
    parameters=hypoid,
    model=with_band,
    changed={"bearing.preload": 4000.0, "oil.name": 2, "pinion.speed_start": 150.0},
    reals={
        "pinion.torque": 80.0,
        "wheel.torque": 200.0,
        "oil.temperature": 333.15,
        "bearing.preload": 4000.0,
        "pinion.speed_start": 150.0,
    },
    integers={"solver.steps_per_mesh_period": 128},
    bad_parameters=[
        ("bearing.preload", -1.0, "bearing.preload must be within 0 to 100000 N, got -1.0"),
        ("bearing.preload", float("nan"), "got nan"),
        ("flank.roughness_rms", 0.0, "flank.roughness_rms must be within 1e-09 to 2e-05 m"),
        ("flank.roughness_rms", 0.5, "got 0.5"),
        ("mesh.backlash", -1e-4, "mesh.backlash must be within 0 to 0.002 m"),
        ("pinion.speed_start", float("inf"), "speed_start must be within -5000 to 5000 rad/s"),
        ("mesh.modal_loss_factor", 2.0, "mesh.modal_loss_factor must be within 0 to 1, got 2.0"),
        ("oil.name", 9, "1 (mohammadpour_2015), 2 (karagiannis_2012), 3 (jamali_2015), 4 (fva_3)"),
        ("oil.name", 0, "got 0"),
        ("model.radii", -1, "1 (consistent), 2 (paper), 3 (mean), got -1"),
        ("solver.steps_per_mesh_period", 1, "must be within 16 to 4096, got 1"),
    ],
    load="mesh.force",
    torque_limits=(1e4, 3e4),
    display={
        "oil.temperature": "degC",
        "pinion.speed": "rpm",
        "mesh.dte": "um",
        "bearing.preload": "kN",
    },
    units_unused={"N/m2"},
)

HELICAL_PAIR = Case(
    definition=helical_pair.DEFINITION,
    build=build.build_helical_pair,
    snapshot="helical_value_references.json",
    arguments=settings_of(helical_pair.DEFINITION),
    parameters=helical,
    model=HelicalPairModel,
    changed={"support.radial_stiffness": 2e9, "friction.model": 2, "pinion.speed_start": 150.0},
    reals={
        "pinion.torque": 200.0,
        "wheel.torque": 240.0,
        "oil.temperature": 343.15,
        "support.radial_stiffness": 2e9,
        "pinion.speed_start": 150.0,
    },
    integers={"solver.steps_per_mesh_period": 128},
    bad_parameters=[
        ("support.radial_stiffness", -1.0, "radial_stiffness must be within 0 to 1e+13 N/m"),
        ("support.radial_stiffness", float("nan"), "got nan"),
        ("support.bearing_distance", 50.8, "support.bearing_distance must be within 0 to 10 m"),
        ("flank.roughness_rms", 0.5, "flank.roughness_rms must be within 1e-09 to 2e-05 m"),
        ("mesh.backlash", -1e-4, "mesh.backlash must be within 0 to 0.01 m"),
        ("friction.coefficient", 1.5, "friction.coefficient must be within 0 to 1, got 1.5"),
        ("mesh.stiffness_density", 1e13, "must be within 0 to 1e+12 N/m2"),
        ("gear.name", 5, "2 (jamali_2015_a), 3 (jamali_2015_b), 4 (custom), got 5"),
        ("friction.model", 0, "1 (film), 2 (constant), 3 (off), 4 (arana_2019), got 0"),
        ("solver.steps_per_highest_period", 1, "must be within 6 to 4096, got 1"),
        ("friction.updates_per_mesh_period", 1, "must be within 4 to 4096, got 1"),
    ],
    load="mesh.load",
    torque_limits=(1e5, 1e5),
    display={
        "oil.temperature": "degC",
        "pinion.speed": "rpm",
        "mesh.dte": "um",
        "line[1].length": "mm",
        "mesh.stiffness_density": "N/(mm.um)",
    },
    units_unused={"kg", "kg.m2", "m3"},
)

CASES = (HYPOID_AXLE, HELICAL_PAIR)
