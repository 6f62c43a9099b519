"""Other speeds and torques of a train: what drives it, and what its loads then take."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from drivetrain.train.train_file import TrainCase
from gearlube_core.dynamics.train.elements.port import Port
from gearlube_core.dynamics.train.model import Train
from gearlube_core.errors import ParameterError

LOSS = ".power_loss"
_ROUNDS = 4  # losses change little with the loads: a percent of a percent after two
_NO_POWER = 1e-9  # W


@dataclass(frozen=True, kw_only=True)
class Operation:
    """How a train is driven: by the port that puts in most at its start, against the others.

    Parameters
    ----------
    case : TrainCase
    drive, shaft : str
        Its port and the node or body on which that acts.
    turns : float
        1 where the shaft turns about +z, else -1.
    speed, torque : float
        Of the shaft at the start, both positive where it drives [rad/s], [N.m].
    load : float
        Torque of all loads at that shaft, at the start [N.m].
    loads : tuple of str
    ratio : float
        Speed of the shaft over the mean speed of what the loads act on [-].

    Examples
    --------
    >>> from drivetrain.train.train_file import TrainFile
    >>> axle = Operation.of(TrainFile.named("e_axle").case())
    >>> axle.drive, axle.loads, axle.torque
    ('motor_torque', ('left_wheel', 'right_wheel'), 120.0)
    """

    case: TrainCase
    drive: str
    shaft: str
    turns: float
    speed: float
    torque: float
    load: float
    loads: tuple[str, ...]
    ratio: float

    @classmethod
    def of(cls, case: TrainCase) -> Operation:
        """Return how a train is driven.

        Raises
        ------
        ParameterError
            No port puts power in at the start, or none takes any.
        """
        found = case.start().outputs()
        ports = [one for one in case.train.elements if isinstance(one, Port)]
        # the mean torque of a motor, without its ripple now
        powers = {
            one.name: case.torques[one.name] * one.sign * found[f"{one.body}.speed"]
            for one in ports
        }
        drive = max(powers, key=lambda name: powers[name], default="")
        loads = tuple(name for name, power in powers.items() if power < -_NO_POWER)
        if not drive or powers[drive] < _NO_POWER or not loads:
            listed = [
                f"{name} {powers[name] + 0.0:.4g} W"  # no -0
                + ("" if case.torques[name] else " with torque 0")
                + ("" if found[f"{body}.speed"] else " at speed 0")
                for name, body in ((one.name, one.body) for one in ports)
            ]
            raise ParameterError(
                "A run-up, map or cycle needs a port that puts power into the train at the start "
                f"and one that takes it, got {', '.join(listed) or 'no port'}. Correct "
                "start.torque_n_m and start.speed_rpm."
            )
        turning = {one.name: found[f"{one.body}.speed"] for one in ports}
        shaft = next(one.body for one in ports if one.name == drive)
        speed = turning[drive]
        return cls(
            case=case,
            drive=drive,
            shaft=shaft,
            turns=1.0 if speed > 0.0 else -1.0,
            speed=abs(speed),
            torque=powers[drive] / abs(speed),
            load=-sum(powers[name] for name in loads) / abs(speed),
            loads=loads,
            ratio=abs(speed) * len(loads) / sum(abs(turning[name]) for name in loads),
        )

    def torques(self, torque: float, load: float) -> dict[str, float]:
        """Return the torques of all ports for those of drive and loads at the shaft [N.m]."""
        factors = dict.fromkeys(self.loads, load / self.load) | {self.drive: torque / self.torque}
        return {name: factors.get(name, 1.0) * t for name, t in self.case.torques.items()}

    def at(self, speed: float, torque: float, temperature: float | None = None) -> TrainCase:
        """Return the case, in equilibrium, at another speed and torque of its shaft.

        The loads share what losses leave as they do at the start.

        Parameters
        ----------
        speed, torque : float
            [rad/s], [N.m]; a torque below 0 brakes.
        temperature : float, optional
            Of the oil [K]; default: that of the case.

        Raises
        ------
        ParameterError, ConvergenceError
            See `Train.initialise`.
        """
        kelvin = self.case.oil_temperature if temperature is None else temperature
        speeds = {name: w * speed / self.speed for name, w in self.case.speeds.items()}
        load, case = torque, self.case
        for _ in range(_ROUNDS):
            case = replace(
                self.case,
                speeds=speeds,
                torques=self.torques(torque, load),
                oil_temperature=kelvin,
            )
            load = torque - lost_power(case.start()) / speed
        return case

    def load_of(self, case: TrainCase) -> float:
        """Return the torque that the loads of a case take at the shaft [N.m]."""
        name = self.loads[0]
        return self.load * case.torques[name] / self.case.torques[name]

    @property
    def title(self) -> str:
        """Words for the shaft."""
        return self.shaft.replace("_", " ").replace(".", ", ")


def lost_power(train: Train) -> float:
    """Return all power lost [W]: the mean over the last step, or now before the first."""
    return sum(losses_of(train.outputs()).values())


def losses_of(outputs: Mapping[str, float]) -> dict[str, float]:
    """Return the powers lost among outputs by what loses them [W]."""
    return {n.removesuffix(LOSS): v for n, v in outputs.items() if n.endswith(LOSS)}
