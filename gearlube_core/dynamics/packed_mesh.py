"""Mesh tables as flat arrays for the kernels of a time step."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.contact.hertz import ellipticity
from gearlube_core.friction.flank_data import contact_geometry
from gearlube_core.friction.flank_rolling import rolling_geometry
from gearlube_core.friction.thermal_eyring_data import circular_pressure_coefficient
from gearlube_core.kernels.jit import kernel
from gearlube_core.mesh_table.kernels import K_M, N_SERIES, R_G, R_P, E
from gearlube_core.mesh_table.sliding_direction import pair_sliding_direction, turned_on
from gearlube_core.mesh_table.table import MEMBERS, MeshTable

# the series whose mean is the linear stiffness of the mesh
STIFFNESS_SERIES = {"tangent": "k_t", "secant": "k_m"}
# the series that the kernels read, in their order
PACKED_SERIES = ("k_m", "R_p", "R_g", "n_x", "n_y", "n_z", "e")
# order of the channels of a packed window
SHARE, R_E, SIDE_FLOW, PRESSURE, ENTRAIN, ARM_P, ARM_G, XI_X, XI_Y, XI_Z = range(10)
# of the line that rolls: its radius, its length over load^(1/3), and the entrainment across it
LINE_RADIUS, LINE_LENGTH, ROLL = range(10, 13)
# of the ellipse: its other radius, major over minor semi-axis, entrainment from the minor axis, and
# sliding from the entrainment
R_Y, ELLIPTICITY, PSI, DELTA = range(13, 17)
N_CHANNELS = 17
_SAMPLES_PER_ORDER = 8  # of the period, where a quotient of series is made a series again


@dataclass(frozen=True, slots=True)
class PackedMesh:
    """Arrays of a mesh table for `mesh_table.kernels`.

    Parameters
    ----------
    levels : ndarray of shape (L,)
        Load levels, signed pinion torque [N.m].
    series : ndarray of shape (L * (N_SERIES * (2 H + 1) + tail),)
        Fourier coefficients grouped by load, then order, then cosine before sine; at each load
        followed by the tail that `mesh_table.kernels.shaft_error` reads, if teeth differ.
    windows : ndarray of shape (L * (N + 1) * N_CHANNELS,)
        Pair data at the nodes, the first node repeated at the end.
    orders, nodes : int
        Numbers of orders H and nodes N.
    """

    levels: Array
    series: Array
    windows: Array
    orders: int
    nodes: int

    @property
    def fields(self) -> tuple[Array, Array, int, Array, int]:
        """The table as kernels take it."""
        return self.levels, self.series, self.orders, self.windows, self.nodes

    @property
    def series_size(self) -> int:
        """Number of series coefficients at one load level."""
        return self.series.size // self.levels.size

    @property
    def window_size(self) -> int:
        """Number of window values at one load level."""
        return (self.nodes + 1) * N_CHANNELS


def pack_mesh(
    table: MeshTable,
    contact_modulus: float,
    radii: str,
    stiffness: str,
    pressure: str = "elliptical",
) -> PackedMesh:
    """Return the flat arrays of `table`.

    What depends on position alone (ellipse, film geometry) is evaluated here, once, by the same
    kernels that everything else uses.

    Parameters
    ----------
    table : MeshTable
    contact_modulus : float
        E* [Pa].
    radii : {"consistent", "paper", "mean"}
        "consistent": R_g = R_p z_g/z_p, since the unloaded transmission error already is the
        integral of the ratio error; "paper": both as tabulated, which counts it twice; "mean":
        both constant, at the teeth ratio.
    stiffness : {"tangent", "secant"}
        "tangent": the spring k_t through the loaded state of each level, so that vibration about
        that load has its stiffness. The flanks are softer below it, so the spring starts
        F (1/k_m - 1/k_t) further in; what varies of that with the mesh is added to e, so that the
        static transmission error under the level's load stays. "secant": the spring k_m from
        first contact.
    pressure : {"elliptical", "circular"}
        Mean pressure of a flank: that of Hertz' ellipse, or `circular_pressure_coefficient`.
    """
    levels, nodes = table.torque.size, table.nodes
    windows = np.empty((levels, nodes + 1, N_CHANNELS))
    data = table.windows
    psi = data["psi"]
    for channel, values in (
        (SHARE, data["share"]),
        (ENTRAIN, data["entrainment_arm"]),
        (ARM_P, data["friction_arm_p"]),
        (ARM_G, data["friction_arm_g"]),
        (XI_X, data["xi_x"]),
        (XI_Y, data["xi_y"]),
        (XI_Z, data["xi_z"]),
        (ROLL, data["entrainment_arm"] * np.cos(psi)),
        (R_E, data["R_x"]),
        (R_Y, data["R_y"]),
        (PSI, psi),
        (DELTA, _sliding_angles(table) - psi),
    ):
        windows[:, :nodes, channel] = values
    for level in windows[:, :nodes]:
        write_ellipses(level, contact_modulus, pressure == "circular")
    windows[:, nodes] = windows[:, 0]
    return PackedMesh(
        np.array(table.torque),  # writable like the others: kernels are compiled for either kind
        pack_series(table, radii, stiffness),
        windows.ravel(),
        table.orders,
        nodes,
    )


@kernel
def write_ellipses(nodes: Array, contact_modulus: float, circular: bool) -> int:
    """Write what films and rolling need of the Hertz ellipse at every node; return their number.

    Parameters
    ----------
    nodes : ndarray of shape (N, N_CHANNELS)
        Pair data; PSI and R_Y are read, and R_E holds R_x on entry.
    contact_modulus
        E* [Pa].
    circular
        Mean pressure is that of `circular_pressure_coefficient`.
    """
    for k in range(nodes.shape[0]):
        R_x, R_y = nodes[k, R_E], nodes[k, R_Y]
        geometry = contact_geometry(R_x, R_y, nodes[k, PSI], contact_modulus)
        line = rolling_geometry(R_x, R_y, contact_modulus)
        nodes[k, R_E], nodes[k, SIDE_FLOW] = geometry.R_e, geometry.side_flow
        nodes[k, PRESSURE] = geometry.pressure_coefficient
        if circular:
            nodes[k, PRESSURE] = circular_pressure_coefficient(R_x, R_y, contact_modulus)
        nodes[k, LINE_RADIUS], nodes[k, LINE_LENGTH] = line.R, line.length_coefficient
        nodes[k, ELLIPTICITY] = ellipticity(max(R_x, R_y) / min(R_x, R_y))
    return nodes.shape[0]


def _sliding_angles(table: MeshTable) -> Array:
    """Return the angle of sliding from the minor axis of each pair [rad], (L, N); without jumps."""
    by_level = [
        {key: values[level] for key, values in table.windows.items()}
        for level in range(table.torque.size)
    ]
    angles = np.stack([pair_sliding_direction(window, table.ratio) for window in by_level])
    coast = table.torque < 0.0
    for side in (coast, ~coast):
        if side.any():
            angles[side] = turned_on(angles[side])
    return angles


def pack_series(table: MeshTable, radii: str, stiffness: str) -> Array:
    """Return `series` of `PackedMesh`, the part without windows; arguments as in `pack_mesh`."""
    levels = table.torque.size
    series = np.empty((levels, 2 * table.orders + 1, N_SERIES))
    for column, key in enumerate(PACKED_SERIES):
        series[:, :, column] = _flat(table.series[key])
    if stiffness == "tangent":
        series[:, :, K_M] = _flat(table.series["k_t"])
        series[:, :, E] += _flat(_later_start(table))
    if radii == "mean":
        series[:, 1:, R_P] = 0.0
    if radii != "paper":
        series[:, :, R_G] = table.ratio * series[:, :, R_P]
    return np.concatenate([series.reshape(levels, -1), _shaft_tail(table)], axis=1).ravel()


def _shaft_tail(table: MeshTable) -> Array:
    """Return the tails of `shaft_error` at each load, shape (L, 0) where all teeth are alike."""
    levels = table.torque.size
    if not table.shaft_error:
        return np.zeros((levels, 0))
    none = np.zeros((levels, 0, 2))
    parts = [_even(table.shaft_error.get(member, none)) for member in MEMBERS]
    head = [parts[0].shape[1], parts[1].shape[1], 1.0 / table.ratio]
    flat = [part.reshape(levels, -1) for part in parts]
    return np.concatenate([np.tile(head, (levels, 1)), *flat], axis=1)


def _even(coefficients: Array) -> Array:
    """Return (L, N, 2) coefficients with one more order, of nothing, where N is odd."""
    more = coefficients.shape[1] % 2
    return np.pad(coefficients, ((0, 0), (0, more), (0, 0)))


def _flat(coefficients: Array) -> Array:
    """Return (L, H + 1, 2) coefficients as (L, 2 H + 1): the mean, then cosines and sines."""
    levels, size, _ = coefficients.shape
    flat = np.empty((levels, 2 * size - 1))
    flat[:, 0] = coefficients[:, 0, 0]
    flat[:, 1::2] = coefficients[:, 1:, 0]
    flat[:, 2::2] = coefficients[:, 1:, 1]
    return flat


def _later_start(table: MeshTable) -> Array:
    """Return the variation of F (1/k_m - 1/k_t) [m] at each level's own force, (L, H + 1, 2)."""
    count = _SAMPLES_PER_ORDER * (table.orders + 1)
    angle = 2.0 * np.pi * np.arange(count) / count
    order = np.arange(table.orders + 1)[:, None]
    cosine, sine = np.cos(order * angle), np.sin(order * angle)

    def samples(key: str) -> Array:
        values = table.series[key]
        return np.asarray(values[:, :, 0] @ cosine + values[:, :, 1] @ sine)

    force = table.torque[:, None] / samples("R_p")
    start = force * (1.0 / samples("k_m") - 1.0 / samples("k_t"))
    result = np.stack([start @ cosine.T, start @ sine.T], axis=-1) * (2.0 / count)
    result[:, 0] = 0.0
    return result
