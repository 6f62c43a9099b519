"""MeshTable: all tooth contact data that mesh dynamics needs."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Literal, NamedTuple, get_args

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.errors import TableError

Kind = Literal["table", "inferred", "completed"]

SERIES_UNITS: Mapping[str, str] = {
    "k_m": "N/m",
    "R_p": "m",
    "R_g": "m",
    "n_x": "1",
    "n_y": "1",
    "n_z": "1",
    "e": "m",
    "k_t": "N/m",
}
WINDOW_UNITS: Mapping[str, str] = {
    "share": "1",
    "R_x": "m",
    "R_y": "m",
    "psi": "rad",
    "entrainment_arm": "m",
    "friction_arm_p": "m",
    "friction_arm_g": "m",
    "xi_x": "1",
    "xi_y": "1",
    "xi_z": "1",
    "chi": "rad",
    "pressure_max": "Pa",
}
# where a pair meets on the drawn gear tooth: in a table of contact analysis, for drawings alone
TOOTH_UNITS: Mapping[str, str] = {
    "tooth_along": "m",
    "tooth_up": "m",
    "minor_along": "1",
    "minor_up": "1",
    "major_along": "1",
    "major_up": "1",
}
ABOVE_ZERO = ("k_m", "R_p", "R_g", "k_t", "R_x", "R_y")  # means of series, every node of windows
PAIRS = 3
MEMBERS = ("pinion", "gear")
SHARE_TOLERANCE = 1e-9  # shares are normalised in double precision before they are stored
ORDERS = 5  # mesh orders kept of each series at least, zero where positions do not resolve them
_POSITIONS_PER_ORDER = 4  # the corners of a series fold what is above half of them onto the rest
ZERO_PHASE = -0.5 * PAIRS  # of tooth pair 0 at pinion angle zero, so that it meets mid-window


class Provenance(NamedTuple):
    """Where a datum comes from: printed in a source, inferred from it, or completed by us."""

    kind: Kind
    derivation: str


@dataclass(frozen=True, slots=True, kw_only=True)
class MeshTable:
    """Mesh data of a gear pair over pinion angle and load, from contact analysis to dynamics.

    A *series* is periodic in one mesh period: value(phi) = sum_h [c_h cos(h z_p phi) +
    s_h sin(h z_p phi)], h = 0 .. H. A *window* follows one tooth pair over `PAIRS` mesh periods;
    pair j = 0, 1, 2 sits at ((z_p phi / 2 pi + j) mod 3) / 3 of the window, and its share is zero
    outside its contact. Phase zero: the window of pair 0 begins.

    Parameters
    ----------
    name : str
    pinion_teeth, gear_teeth : int
        Numbers of teeth [-].
    torque : ndarray of shape (L,)
        Signed pinion torque of each load level [N.m], increasing, none zero. Positive levels hold
        the drive flanks, negative ones the coast flanks; without negative levels the drive flanks'
        data serve both. Between levels of one side data are interpolated linearly, outside them
        the value at the end is kept. Nothing is interpolated across zero torque.
    contact_ratio : float
        Length of contact of a pair in mesh periods [-], at most `PAIRS`.
    series : mapping of str to ndarray of shape (L, H + 1, 2)
        Cosine and sine coefficients of k_m [N/m] (secant stiffness along the line of action),
        R_p, R_g [m] (contact radii), n_x, n_y, n_z [-] (unit normal: of the drive flanks from
        the pinion into the gear, of the coast flanks from the gear into the pinion, so that both
        radii are positive), e [m] (unloaded transmission error: how far the gear lags with these
        flanks touching) and k_t [N/m] (tangent stiffness).
    windows : mapping of str to ndarray of shape (L, N)
        Per pair, at N nodes over the window, N divisible by `PAIRS`: load share [-], R_x and R_y
        [m] (relative radii along the minor and the major axis of the contact ellipse), psi [rad]
        (entrainment from the minor axis), entrainment_arm [m] (mean surface speed per pinion
        speed), friction_arm_p/g [m], xi [-] (unit sliding direction, pinion relative to gear),
        chi [rad] (sliding direction from the minor axis), pressure_max [Pa] (highest contact
        pressure of the pair). Where the share is zero the others must have the nearest loaded
        value, because they are interpolated from there to the first loaded node. A table of contact
        analysis also has where the pair meets on the drawn gear tooth: tooth_along, tooth_up
        (centre of force from toe and root line [m]), and how a step of one metre along the axes of
        the ellipse is drawn there, minor_along, minor_up, major_along, major_up [-]: less than
        one metre, as the tooth winds. All six or none.
    provenance : mapping of str to Provenance
        One entry for each series and window.
    source : str
        What the data were computed from, e.g. the name of a gear file.
    shaft_error : mapping of str to ndarray of shape (L, N, 2)
        "pinion", "gear" or both, or none: cosine and sine coefficients [m] of orders 1 to N in
        turns of that member, added to e. Angles count from pinion angle zero; the gear's is the
        pinion's over the teeth ratio.
    settings : mapping of str to str or float
        How they were computed, e.g. numbers of positions; names of letters, digits, "_", "." and
        "-".
    tooth_size : tuple of float, optional
        Face width and height of the drawn gear tooth [m].

    Raises
    ------
    TableError
        A datum is missing, has the wrong shape, is not finite or contradicts another.

    Notes
    -----
    chi, pressure_max and the places on the tooth are for reading only; the dynamics does not use
    them.

    References
    ----------
    [mohammadpour_2015 (5)] [mohammadpour_2015 (23)]
    [karagiannis_2012 (26)] [karagiannis_2012 (27)] [karagiannis_2012 (28)] [karagiannis_2012 (29)]
    The papers' flank functions of period contact_ratio do not repeat with the mesh for non-integer
    contact ratios; windows in a period of `PAIRS` mesh periods do.

    Examples
    --------
    >>> from gearlube_core.mesh_table.netcdf import shipped_mesh_table
    >>> table = shipped_mesh_table("mohammadpour_2015")
    >>> table.pinion_teeth, table.gear_teeth
    (13, 36)
    """

    name: str
    pinion_teeth: int
    gear_teeth: int
    torque: Array
    contact_ratio: float
    series: Mapping[str, Array]
    windows: Mapping[str, Array]
    provenance: Mapping[str, Provenance]
    source: str = ""
    settings: Mapping[str, str | float] = field(default_factory=dict)
    shaft_error: Mapping[str, Array] = field(default_factory=dict)
    tooth_size: tuple[float, float] | None = None

    def __post_init__(self) -> None:
        levels = self.torque.size
        rising = self.torque.ndim == 1 and levels > 0 and bool(np.all(np.diff(self.torque) > 0.0))
        if not rising or not np.all(np.isfinite(self.torque)):
            raise TableError(f"{self.name}: torque must be a rising list [N.m], got {self.torque}.")
        if np.any(self.torque == 0.0) or self.torque[-1] < 0.0:
            raise TableError(
                f"{self.name}: torque must have a level above 0 N.m and none at 0 N.m, got "
                f"{self.torque}. Give the drive flanks about 5 N.m instead of no load."
            )
        if min(self.pinion_teeth, self.gear_teeth) < 1:
            raise TableError(
                f"{self.name}: numbers of teeth must be at least 1, got {self.pinion_teeth} and "
                f"{self.gear_teeth}. Give the numbers of teeth of the gear pair."
            )
        if not 1.0 <= self.contact_ratio <= PAIRS:
            raise TableError(
                f"{self.name}: contact_ratio must be within 1 to {PAIRS}, got "
                f"{self.contact_ratio:g}. A mesh table cannot hold more tooth pairs in contact."
            )
        self._check("series", self.series, SERIES_UNITS, 3)
        drawn = TOOTH_UNITS if self.windows.keys() & TOOTH_UNITS.keys() else {}
        self._check("windows", self.windows, {**WINDOW_UNITS, **drawn}, 2)
        self._check_signs()
        nodes = self.nodes
        if nodes % PAIRS:
            raise TableError(f"{self.name}: the window needs {PAIRS} n nodes, got {nodes}.")
        share = self.windows["share"].reshape(levels, PAIRS, nodes // PAIRS).sum(axis=1)
        worst = float(np.max(np.abs(share - 1.0)))
        if worst > SHARE_TOLERANCE:
            raise TableError(f"{self.name}: load shares must sum to 1, off by {worst:.3g}.")
        self._check_shaft_error()
        if self.tooth_size is not None and not min(self.tooth_size) > 0.0:
            raise TableError(
                f"{self.name}: tooth_size must be face width and height above 0 m, got "
                f"{self.tooth_size}."
            )
        for key, value in self.settings.items():
            if not re.fullmatch(r"[\w.-]+", key, re.ASCII) or not isinstance(
                value, str | float | int
            ):
                raise TableError(
                    f"{self.name}: a setting must be a text or a number under a name of letters, "
                    f"digits, '_', '.' and '-', got {key!r}: {value!r}."
                )

    def _check(
        self, kind: str, data: Mapping[str, Array], wanted: Mapping[str, str], ndim: int
    ) -> None:
        shape = None
        for key in wanted:
            if key not in data:
                raise TableError(f"{self.name}: {kind} lacks {key!r} [{wanted[key]}].")
            values = data[key]
            shape = values.shape if shape is None else shape
            if values.ndim != ndim or values.shape[0] != self.torque.size or values.shape != shape:
                raise TableError(
                    f"{self.name}: {kind} {key!r} has shape {values.shape}, expected {shape} "
                    f"with {self.torque.size} load levels first."
                )
            if not np.all(np.isfinite(values)):
                raise TableError(f"{self.name}: {kind} {key!r} holds a NaN or an infinity.")
            origin = self.provenance.get(key)
            if origin is None or origin.kind not in get_args(Kind) or not origin.derivation:
                raise TableError(f"{self.name}: {key!r} needs a provenance and its derivation.")

    def _check_shaft_error(self) -> None:
        for key, values in self.shaft_error.items():
            if key not in MEMBERS:
                raise TableError(
                    f"{self.name}: shaft_error must be of pinion or gear, got {key!r}."
                )
            levels = self.torque.size
            if values.ndim != 3 or values.shape[::2] != (levels, 2) or values.shape[1] < 1:
                raise TableError(
                    f"{self.name}: shaft_error of the {key} has shape {values.shape}, expected "
                    f"({levels}, orders, 2): load levels first."
                )
            if not np.all(np.isfinite(values)):
                raise TableError(f"{self.name}: shaft_error holds a NaN or an infinity.")

    def _check_signs(self) -> None:
        for key in ABOVE_ZERO:
            values = self.series[key][:, 0, 0] if key in self.series else self.windows[key]
            level, *_ = np.unravel_index(int(np.argmin(values)), values.shape)
            if not np.min(values) > 0.0:
                raise TableError(
                    f"{self.name}: {key!r} must be above 0, got {np.min(values):g} at "
                    f"{self.torque[level]:g} N.m. The normal of the coast flanks points from the "
                    "gear into the pinion; nodes without load hold the nearest loaded value."
                )
        if np.min(self.windows["share"]) < 0.0:
            raise TableError(
                f"{self.name}: load shares must not be below 0, got "
                f"{np.min(self.windows['share']):g}."
            )

    def without_shaft_error(self) -> MeshTable:
        """Return the same table repeating with the mesh: all teeth alike."""
        return replace(self, shaft_error={}) if self.shaft_error else self

    @property
    def has_tooth_places(self) -> bool:
        """Whether the table says where on the drawn gear tooth each pair meets."""
        return self.tooth_size is not None and "tooth_along" in self.windows

    @property
    def has_coast_levels(self) -> bool:
        """Whether the coast flanks have separate data."""
        return bool(self.torque[0] < 0.0)

    @property
    def nodes(self) -> int:
        """Number of nodes in a window [-]."""
        return int(self.windows["share"].shape[1])

    @property
    def orders(self) -> int:
        """Highest mesh order of the series [-]."""
        return int(self.series["k_m"].shape[1]) - 1

    @property
    def ratio(self) -> float:
        """Teeth ratio gear / pinion [-]."""
        return self.gear_teeth / self.pinion_teeth

    def mean(self, key: str, torque: float) -> float:
        """Return the mean over a mesh period of series `key` at pinion torque `torque` [N.m].

        A negative torque reads the coast flanks' data where there are any.
        """
        means = self.series[key][:, 0, 0]
        if torque < 0.0 and self.has_coast_levels:
            coast = self.torque < 0.0
            return float(np.interp(torque, self.torque[coast], means[coast]))
        drive = self.torque > 0.0
        return float(np.interp(abs(torque), self.torque[drive], means[drive]))


def orders_kept(positions: int) -> int:
    """Return the highest mesh order kept of so many positions in a mesh period [-]."""
    return max(ORDERS, positions // _POSITIONS_PER_ORDER)


def fourier(samples: Array, orders: int) -> Array:
    """Return the (orders + 1, 2) cosine and sine coefficients of samples over one mesh period.

    The mesh phase of the first sample is zero; the series counts from the pinion angle at which
    the phase is `ZERO_PHASE`.
    """
    spectrum = np.zeros(orders + 1, dtype=complex)
    resolved = min(orders, (samples.size - 1) // 2)  # an order needs more than two samples
    spectrum[: resolved + 1] = (np.fft.rfft(samples) / samples.size)[: resolved + 1]
    order = np.arange(orders + 1)
    # value(angle) = samples(phase = angle + ZERO_PHASE)
    spectrum = spectrum * np.exp(2j * np.pi * order * ZERO_PHASE)
    result = np.stack([2.0 * spectrum.real, -2.0 * spectrum.imag], axis=1)
    result[0] = spectrum[0].real, 0.0
    return result
