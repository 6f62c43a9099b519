"""Machine settings with which a measured flank would have been cut, and those that correct it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_contact.flank_deviation import flank_deviation
from gearlube_core.hypoid_contact.placement import ALIGNED
from gearlube_core.hypoid_contact.sensitivity.parameter import MISALIGNMENT, Parameter
from gearlube_core.hypoid_geometry.flank.flank import Flank
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.hypoid_geometry.measured.deviation_grid import DeviationGrid

_STEPS = 5  # of Gauss and Newton
_DONE = 1e-3  # of the tolerances of the settings, change that ends them
_ALIKE = 1e-3  # least over largest singular value: settings do the same to the flanks


@dataclass(frozen=True, slots=True, kw_only=True)
class SettingsFit:
    """Settings fitted to measured deviations.

    Parameters
    ----------
    fields : tuple of str
        Dotted fields of the gear file.
    units : tuple of str
    nominal, change : ndarray of shape (P,)
        Value in the gear file, and how much more the flanks were cut with [unit].
    uncertainty : ndarray of shape (P,)
        Standard deviation of the change from the scatter of the rest [unit].
    before, after : float
        Root mean square of the deviations, and of what the settings leave [m]; means of flanks
        left out.
    """

    fields: tuple[str, ...]
    units: tuple[str, ...]
    nominal: Array
    change: Array
    uncertainty: Array
    before: float
    after: float

    @property
    def corrective(self) -> Array:
        """Settings that would bring the flanks back to nominal, to first order [unit], (P,)."""
        return self.nominal - self.change


def fit_settings(
    nominal: HypoidGearFile, grids: Sequence[DeviationGrid], fields: Sequence[str]
) -> SettingsFit:
    """Return the changes of settings that explain measured deviations best, by least squares.

    Parameters
    ----------
    nominal : HypoidGearFile
    grids : sequence of DeviationGrid
        Of one member, one or both sides; the mean of its teeth counts, less the mean of each flank.
    fields : sequence of str
        Settings that may differ, e.g. "pinion.machine.tilt_angle_deg".

    Raises
    ------
    ParameterError
        A field is none of the member's machine or cutter, or settings cannot be told apart.

    Examples
    --------
    >>> from gearlube_core.hypoid_geometry.measured.measured_flanks import read_measured_flanks
    >>> flanks = read_measured_flanks("axle_17.toml")  # doctest: +SKIP
    >>> pinion = [grid for (role, _), grid in flanks.grids.items() if role == "pinion"]
    ... # doctest: +SKIP
    >>> fit_settings(flanks.nominal, pinion, ["pinion.machine.tilt_angle_deg"])  # doctest: +SKIP
    """
    role = grids[0].role
    chosen = [_parameter(name, nominal, role) for name in fields]
    names = [one.name for one in chosen]
    scale = np.array([one.tolerance for one in chosen])
    start = np.array([one.value for one in chosen])
    wanted = np.concatenate([_centred(grid.deviation.mean(axis=0)) for grid in grids])

    def deviations(change: Array) -> Array:
        cut = nominal.varied(dict(zip(names, (start + change).tolist(), strict=True)))
        return np.concatenate([_of_flank(nominal, cut, grid) for grid in grids])

    change = np.zeros(len(chosen))
    for _ in range(_STEPS):
        here = deviations(change)
        slopes = np.stack(
            [
                (deviations(change + step * unit) - here) / step * width
                for step, width, unit in zip(0.1 * scale, scale, np.eye(scale.size), strict=True)
            ],
            axis=1,
        )
        move, _, _, singular = np.linalg.lstsq(slopes, wanted - here, rcond=None)
        if singular[-1] < _ALIKE * singular[0]:
            raise ParameterError(
                f"settings must change the flanks in different ways, but {', '.join(names)} do "
                "not. Leave one of them out."
            )
        change = change + scale * move
        if np.max(np.abs(move)) < _DONE:
            break
    rest = wanted - deviations(change)
    free = max(rest.size - len(grids) - len(chosen), 1)
    spread = np.sqrt(np.diag(np.linalg.inv(slopes.T @ slopes)) * float(rest @ rest) / free)
    return SettingsFit(
        fields=tuple(names),
        units=tuple(one.unit for one in chosen),
        nominal=start,
        change=change,
        uncertainty=scale * spread,
        before=float(np.sqrt(np.mean(wanted**2))),
        after=float(np.sqrt(np.mean(rest**2))),
    )


def _parameter(name: str, file: HypoidGearFile, role: str) -> Parameter:
    section = name.split(".")
    if section[0] == MISALIGNMENT or section[:1] != [role] or section[1:2] not in _OWN:
        raise ParameterError(
            f"a setting to fit must be of {role}.machine or {role}.cutter, as the measured flanks, "
            f"got {name!r}."
        )
    return Parameter.named(name, file, ALIGNED)


_OWN = (["machine"], ["cutter"])


def _of_flank(nominal: HypoidGearFile, cut: HypoidGearFile, grid: DeviationGrid) -> Array:
    before, after = (Flank.from_file(one, grid.role, grid.side) for one in (nominal, cut))
    return _centred(flank_deviation(before, after, grid.places.s, grid.places.t))


def _centred(values: Array) -> Array:
    return np.asarray((values - values.mean()).ravel())
