"""A helical pair's mesh table at one torque and its derivatives by reliefs, crowns and slopes."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_within
from gearlube_core.errors import ParameterError
from gearlube_core.helical_contact.flank_rates import FlankRates, flank_rates
from gearlube_core.helical_contact.loaded_contact import LoadedSettings
from gearlube_core.helical_contact.tooth_body import HelicalBodySettings, pair_stiffness
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.input_file.field_units import field_unit
from gearlube_core.progress import Progress, no_progress
from gearlube_core.tooth_contact.coupled_strips import PairStiffness
from gearlube_core.tooth_contact.series_rates import SeriesRates, series_of_records, torques_about

_SLOPES = ("lead_slope_um", "profile_slope_um")  # of flanks that have none, too
_AMOUNTS = {"crown_um": "crown_um", "tip_relief_um": "tip_relief_um",
            "tip_relief_depth_mm": "tip_relief_um"}  # fmt: skip
_TOLERANCES = {"um": 1.0, "mm": 0.01}


@dataclass(frozen=True, slots=True)
class FlankParameter:
    """A field of a helical pair's flanks.

    Parameters
    ----------
    name : str
        Dotted field, such as "pinion.flank.crown_um".
    unit : str
    value : float
        [unit]
    """

    name: str
    unit: str
    value: float

    @property
    def tolerance(self) -> float:
        """A small change to compare parameters by: 1 um, 0.01 mm, a hundredth of a number."""
        return _TOLERANCES.get(self.unit, 0.01)


@dataclass(frozen=True, slots=True, kw_only=True)
class HelicalSeriesSettings:
    """Parameters of derivatives of the mesh table of a helical pair, and their places.

    Parameters
    ----------
    parameters : tuple of str
        Fields of "pinion.flank" and "gear.flank"; empty: slopes of both, and the crown and
        tip relief that they have.
    torque : float
        On the pinion [N.m], 0.01 to 1e5.
    positions : int
        Mesh phases in a period, 4 to 400.
    loaded : LoadedSettings
    body : HelicalBodySettings
    """

    parameters: tuple[str, ...] = ()
    torque: float = 50.0
    positions: int = 16
    loaded: LoadedSettings = field(default_factory=LoadedSettings)
    body: HelicalBodySettings = field(default_factory=HelicalBodySettings)

    def __post_init__(self) -> None:
        check_within("torque", self.torque, 1e-2, 1e5, "N.m", "The pinion's torque.")
        check_within("positions", self.positions, 4, 400, "", "Positions over the mesh period.")


def helical_series_rates(
    file: HelicalGearFile,
    settings: HelicalSeriesSettings,
    *,
    stiffness: PairStiffness | None = None,
    jobs: int | None = None,
    progress: Progress = no_progress,
) -> SeriesRates:
    """Return a helical pair's mesh table at one torque and its derivatives by its flanks.

    Force and arms are those of the line of action in the transverse plane, so the arms are the base
    radii and do not move.

    Parameters
    ----------
    file : HelicalGearFile
    settings : HelicalSeriesSettings
    stiffness : PairStiffness, optional
        Absent: finite elements.
    jobs : int, optional
        Processes for the elastic teeth; None: all processors.
    progress : callable, optional
        Called with the share that is done [-] and a sentence on what runs.

    Raises
    ------
    ParameterError
        A parameter is no field of the flanks, or has no derivative.
    ConvergenceError
        A position finds no equilibrium.
    """
    names = settings.parameters or usual_flank_parameters(file)
    parameters = [_parameter(file, name) for name in names]
    pair = file.helical_pair()
    if stiffness is None:
        progress(0.0, "tooth compliance")
        stiffness = pair_stiffness(pair, settings.body, jobs=jobs)
    phases = np.arange(settings.positions) / settings.positions
    torques = torques_about(settings.torque)
    found = []
    for torque in torques:
        parts = []
        for n, phase in enumerate(phases):
            done = (torques.index(torque) + n / phases.size) / len(torques)
            progress(done, f"mesh phase {phase:.2f} at {torque:.4g} N.m")
            parts.append(
                flank_rates(
                    file,
                    names,
                    torque=torque,
                    phases=np.array([phase]),
                    stiffness=stiffness,
                    settings=settings.loaded,
                )
            )
        found.append(flank_records(parts, torque, pair.pinion_base_radius, pair.ratio))
    records = {name: np.stack([one[name] for one in found], axis=1) for name in found[0]}
    teeth = pair.pinion_teeth, pair.gear_teeth
    return series_of_records(file, teeth, parameters, records, settings.torque)


def flank_records(
    parts: list[FlankRates], torque: float, radius: float, ratio: float
) -> dict[str, Array]:
    """Return what `series_of_records` reads of N phases at one torque: (N,) and rates (N, P)."""
    rotation, secant = (
        np.concatenate([getattr(one, name) for one in parts])
        for name in ("rotation", "secant_stiffness")
    )
    rotation_rate, secant_rate = (
        np.concatenate([getattr(one, name).T for one in parts])
        for name in ("rotation_rate", "secant_stiffness_rate")
    )
    closing = torque / (radius**2 * secant)
    constant = np.zeros_like(rotation_rate)
    return {
        "rotation": rotation,
        "rotation_rate": rotation_rate,
        "touching": rotation - closing,
        "touching_rate": rotation_rate + (closing / secant)[:, None] * secant_rate,
        "force": np.full(rotation.size, torque / radius),
        "force_rate": constant,
        "gear_torque": np.full(rotation.size, torque * ratio),
        "gear_torque_rate": constant,
    }


def usual_flank_parameters(file: HelicalGearFile) -> tuple[str, ...]:
    """Return the slopes of both members' flanks, and the crown and tip relief that they have."""
    names = [f"{role}.flank.{key}" for role in ("pinion", "gear") for key in _SLOPES]
    for role in ("pinion", "gear"):
        flank = getattr(file, role).flank
        names += [
            f"{role}.flank.{key}" for key, amount in _AMOUNTS.items() if getattr(flank, amount)
        ]
    return tuple(names)


def _parameter(file: HelicalGearFile, name: str) -> FlankParameter:
    role, _, rest = name.partition(".")
    section, _, key = rest.partition(".")
    value = getattr(getattr(getattr(file, role, None), section, None), key, None)
    if section != "flank" or not isinstance(value, int | float):
        known = ", ".join(usual_flank_parameters(file))
        raise ParameterError(
            f"A parameter of a helical pair must be a number of its flanks that has a value, got "
            f"{name!r}. Give one of {known}."
        )
    return FlankParameter(name, field_unit(key)[0] or "1", float(value))
