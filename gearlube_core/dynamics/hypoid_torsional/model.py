"""The torsional pair as an object: mesh data at its load, natural frequency, rates."""

from __future__ import annotations

import math

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_within
from gearlube_core.contact.greenwood_tripp_1971 import gear_flanks
from gearlube_core.contact.solid import contact_modulus, solid_parameters
from gearlube_core.dynamics.hypoid_torsional.kernel_parameters import (
    DE,
    N_ROW,
    R_G,
    R_P,
    K,
    TorsionalParameters,
    mesh_row,
    mesh_rows,
)
from gearlube_core.dynamics.hypoid_torsional.parameters import (
    FORMS,
    FRICTION_FORMS,
    HypoidTorsionalParameters,
)
from gearlube_core.dynamics.hypoid_torsional.rates import (
    MICRO,
    PairRates,
    ReducedRates,
    contact_mode,
    pair_approach,
    pair_rates,
    reduced_approach,
    reduced_rates,
)
from gearlube_core.dynamics.packed_mesh import (
    N_CHANNELS,
    PRESSURE,
    R_E,
    SIDE_FLOW,
    PackedMesh,
    pack_mesh,
)
from gearlube_core.friction.thermal_eyring_data import (
    PRESSURES,
    grubin_contact_geometry,
    thermal_eyring_oil,
    thermal_eyring_options,
)
from gearlube_core.mesh_table import kernels as series
from gearlube_core.mesh_table.kernels import blend_levels, load_bracket
from gearlube_core.oil.houpert_1985 import houpert_parameters
from gearlube_core.oil.lubricant_state import lubricant_state

MAX_SPEED = 5e3  # rad/s


class HypoidTorsional:
    """Torsional hypoid pair at one mean load.

    Parameters
    ----------
    parameters : HypoidTorsionalParameters
    packed : PackedMesh, optional
        Of a model that differs in the torque alone; packing takes most of the time.

    Attributes
    ----------
    packed : PackedMesh
        Mesh data of all load levels.
    stiffness : float
        Mean mesh stiffness k0 at the load [N/m].
    kernel_parameters : TorsionalParameters
        For the kernels.

    References
    ----------
    [karagiannis_2012]
    """

    def __init__(
        self, parameters: HypoidTorsionalParameters, *, packed: PackedMesh | None = None
    ) -> None:
        self.parameters = parameters
        self.packed = packed = _packed(parameters) if packed is None else packed
        bracket = load_bracket(parameters.pinion_torque, 1.0, packed.levels, packed.levels.size)
        self._orders, self._nodes = packed.orders, packed.nodes
        self._series = np.zeros(packed.series_size)
        self._window = np.zeros(packed.window_size)
        blend_levels(packed.series, packed.series_size, bracket, self._series)
        blend_levels(packed.windows, packed.window_size, bracket, self._window)
        self.stiffness = float(self._series[series.K_M])
        self.kernel_parameters = self._kernel_parameters()

    def _kernel_parameters(self) -> TorsionalParameters:
        p = self.parameters
        R_p0, R_g0 = float(self._series[series.R_P]), float(self._series[series.R_G])
        m_eq = 1.0 / (R_p0**2 / p.pinion_inertia + R_g0**2 / p.gear_inertia)
        c = p.damping
        if p.mesh_damping == "modal":
            c = 2.0 * p.damping_ratio * math.sqrt(self.stiffness * m_eq)
        return TorsionalParameters(
            form=FORMS[p.form],
            I_p=p.pinion_inertia,
            I_g=p.gear_inertia,
            z_p=float(p.mesh.pinion_teeth),
            ratio=p.mesh.ratio,
            R_p0=R_p0,
            R_g0=R_g0,
            m_eq=m_eq,
            backlash=p.backlash,
            c=c,
            gated=1.0 if p.damping_gate == "gated" else 0.0,
            consistent=1.0 if p.equations == "consistent" else 0.0,
            pinion_torque=p.pinion_torque,
            ripple=p.torque_ripple,
            instantaneous_load=1.0 if p.load_torque == "instantaneous" else 0.0,
            hold_gain=p.hold_gain,
            friction_form=FRICTION_FORMS[p.friction],
            surface=gear_flanks(p.roughness_rms),
            solid=solid_parameters(p.solid, p.solid),
            oil=lubricant_state(p.oil.parameters(), p.oil_temperature),
            along_sliding=1.0 if p.entrainment == "along_sliding" else 0.0,
            thermal_oil=thermal_eyring_oil(
                houpert_parameters(p.oil), p.oil.parameters(), p.oil_temperature
            ),
            thermal=thermal_eyring_options(
                contact_modulus(p.solid, p.solid), p.film, p.film_temperature, p.flash_temperature
            ),
        )

    @property
    def equivalent_mass(self) -> float:
        """m_eq [kg], [karagiannis_2012 (30)]."""
        return self.kernel_parameters.m_eq

    @property
    def natural_frequency(self) -> float:
        """Of the mesh mode, sqrt(k0/m_eq)/(2 pi) [Hz], [karagiannis_2012 (30)]."""
        return math.sqrt(self.stiffness / self.equivalent_mass) / (2.0 * math.pi)

    @property
    def damping_ratio(self) -> float:
        """Of the mesh mode, c/(2 sqrt(k0 m_eq)) [-]."""
        return self.kernel_parameters.c / (2.0 * math.sqrt(self.stiffness * self.equivalent_mass))

    @property
    def static_deflection(self) -> float:
        """Transmission error x under the mean torque at mean stiffness, T_p0/(R_p0 k0) [m]."""
        p = self.kernel_parameters
        return p.pinion_torque / (p.R_p0 * self.stiffness)

    @property
    def mean_load_torque(self) -> float:
        """T_g of the mean pinion torque without losses [N.m]; [karagiannis_2012 (32)]."""
        p = self.kernel_parameters
        return p.pinion_torque * p.R_g0 / p.R_p0

    def pinion_speed(self, mesh_frequency: float) -> float:
        """Return the pinion speed [rad/s] at a mesh frequency [Hz]."""
        speed = 2.0 * math.pi * mesh_frequency / self.kernel_parameters.z_p
        return check_within("pinion speed", speed, 1.0, MAX_SPEED, "rad/s")

    def rows(self, steps: int) -> Array:
        """Return `mesh_rows` for `steps` integrator steps per mesh period, (2 steps, N_ROW)."""
        check_within("steps per mesh period", steps, 16, 16384, "", "Default 256.")
        rows = np.zeros((2 * steps, N_ROW))
        mesh_rows(
            self._series, self._orders, self._window, self._nodes, self.kernel_parameters.z_p, rows
        )
        return rows

    def row(self, phi: float) -> Array:
        """Return the mesh data at pinion angle `phi` [rad], shape (1, N_ROW), see `mesh_row`."""
        row = np.zeros((1, N_ROW))
        z_p = self.kernel_parameters.z_p
        mesh_row(self._series, self._orders, self._window, self._nodes, z_p, phi, row[0])
        return row

    def pair_rates(
        self, x: float, w_p: float, w_g: float, phi: float, load_torque: float, speed: float
    ) -> PairRates:
        """Return the rates of the 2-DOF pair for any time integrator, see `rates.pair_rates`."""
        p, row = self.kernel_parameters, self.row(phi)
        mode = contact_mode(x, pair_approach(w_p, w_g, row, 0), row[0, K], p)
        return pair_rates(x, w_p, w_g, phi, load_torque, speed, row, 0, mode, p)

    def reduced_rates(self, x: float, v: float, phi: float, speed: float) -> ReducedRates:
        """Return the rates of the 1-DOF reduction, see `rates.reduced_rates`."""
        p, row = self.kernel_parameters, self.row(phi)
        mode = contact_mode(x, reduced_approach(v, speed, row, 0), row[0, K], p)
        return reduced_rates(x, v, phi, speed, row, 0, mode, p)

    def initial_state(self, speed: float) -> Array:
        """Return y of `mode_march` at pinion angle and time zero: static deflection, x' = 0."""
        row = self.row(0.0)[0]
        x = MICRO * self.static_deflection
        if self.parameters.form == "one_dof":
            return np.array([x, float(row[DE]) * speed, 0.0, 0.0])
        w_g = (row[R_P] - row[DE]) * speed / row[R_G]
        return np.array([x, speed, w_g, 0.0])


def _packed(parameters: HypoidTorsionalParameters) -> PackedMesh:
    solid = parameters.solid
    packed = pack_mesh(
        parameters.mesh,
        contact_modulus(solid, solid),
        parameters.radii,
        parameters.mesh_stiffness,
    )
    if parameters.friction == "thermal_eyring":
        _use_grubin_geometry(packed, parameters)
    return packed


def _use_grubin_geometry(packed: PackedMesh, parameters: HypoidTorsionalParameters) -> None:
    """Overwrite the geometry channels of the packed windows with those of a Grubin film."""
    data = parameters.mesh.windows
    angle = data["chi" if parameters.entrainment == "along_sliding" else "psi"]
    modulus = contact_modulus(parameters.solid, parameters.solid)
    pressure = PRESSURES[parameters.contact_pressure]
    windows = packed.windows.reshape(packed.levels.size, packed.nodes + 1, N_CHANNELS)
    for level in range(packed.levels.size):
        for node in range(packed.nodes + 1):
            at = level, node % packed.nodes
            windows[level, node, [R_E, SIDE_FLOW, PRESSURE]] = grubin_contact_geometry(
                data["R_x"][at], data["R_y"][at], angle[at], modulus, pressure
            )
