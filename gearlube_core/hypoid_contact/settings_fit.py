"""Machine settings with which a measured flank would have been cut, and those that correct it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

from gearlube_core.arrays import Array
from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_contact.gap_map import along_normals
from gearlube_core.hypoid_contact.placement import ALIGNED, Placement, turned
from gearlube_core.hypoid_contact.sensitivity.parameter import MISALIGNMENT, Parameter
from gearlube_core.hypoid_geometry.flank.flank import Flank
from gearlube_core.hypoid_geometry.flank.vectors import Vector
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.hypoid_geometry.measured.deviation_grid import DeviationGrid

_FURTHEST = 0.05  # rad, to either side, where the other flank is looked for
_SEARCH = np.linspace(-_FURTHEST, _FURTHEST, 41)
_EXACT = 1e-14  # rad
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
        A field is none of the member's machine or cutter, or settings have nearly the same effect.

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


def flank_deviation(nominal: Flank, other: Flank, s: Array, t: Array) -> Array:
    """Return how far another flank stands out of a nominal one along its normals [m], (m, n).

    The other member is turned until the deviation at the middle of the grid is zero.

    Parameters
    ----------
    nominal, other : Flank
        Of the same member and side, as cut: corrections are left out.
    s, t : ndarray of shape (m,), (n,)
        Profile and face positions of the grid on the nominal flank [-].

    Raises
    ------
    ParameterError
        A normal of the grid does not meet the other flank, as beyond an undercut.

    Examples
    --------
    >>> from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
    >>> file = HypoidGearFile.named("mohammadpour_2015")
    >>> tilted = file.varied({"pinion.machine.tilt_angle_deg": 31.836})  # + 0.1 deg
    >>> flanks = [Flank.from_file(one, "pinion", "drive") for one in (file, tilted)]
    >>> found = flank_deviation(*flanks, np.array([0.3, 0.6, 0.9]), np.array([0.1, 0.5, 0.9]))
    >>> (1e6 * found).round(1).tolist()[0]  # um, lowest row from toe to heel
    [-9.4, -3.2, 3.8]
    """

    def deviation(s: Array, t: Array, angle: float) -> Array:
        profile, face = np.meshgrid(s, t, indexing="ij")
        points = nominal.sample(profile, face)
        found = along_normals(
            other.motion,
            turned(_own_frame(other), angle),
            _own_frame(nominal),
            points.r.reshape(-1, 3).copy(),
            points.normal.reshape(-1, 3).copy(),
            other.parameters(profile, face).reshape(-1, 3),
        )
        return np.asarray(found[:, 3].reshape(profile.shape))

    middle = np.array([0.5 * (s[0] + s[-1])]), np.array([0.5 * (t[0] + t[-1])])
    if s.size % 2 and t.size % 2:
        middle = s[[s.size // 2]], t[[t.size // 2]]
    at = np.array([float(deviation(*middle, angle)[0, 0]) for angle in _SEARCH])
    changes = np.flatnonzero(at[:-1] * at[1:] <= 0.0)
    if not changes.size:
        raise ParameterError(
            f"the other {nominal.role} flank must meet the nominal one in the middle of the grid "
            f"within {_FURTHEST:g} rad of rotation, but it does not. Change the settings by less."
        )
    k = int(changes[np.argmin(np.abs(_SEARCH[changes]))])
    turn = brentq(
        lambda angle: float(deviation(*middle, angle)[0, 0]), *_SEARCH[k : k + 2], xtol=_EXACT
    )
    found = deviation(s, t, float(turn))
    if np.isnan(found).any():
        i, j = np.argwhere(np.isnan(found))[0].tolist()
        raise ParameterError(
            f"normals of all points must meet the other flank, that at s = {s[i]:.3f}, t = "
            f"{t[j]:.3f} does not. Keep the grid above an undercut (`tooth_form` has it)."
        )
    return found


def _own_frame(flank: Flank) -> Placement:
    """Return the placement of a member where it is cut, at rotation zero."""
    motion = flank.motion
    return Placement(motion.work_point, motion.work_axis, 1.0, 0.0, 1.0, 0.0, Vector(0.0, 0.0, 0.0))
