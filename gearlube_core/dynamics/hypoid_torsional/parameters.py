"""Checked parameters of the torsional hypoid pair."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Literal

from gearlube_core.checks import check_within
from gearlube_core.contact.greenwood_tripp_1971 import ROUGHNESS
from gearlube_core.contact.solid import STEEL_MOHAMMADPOUR_2015, Solid
from gearlube_core.dynamics.flank_force import BACKLASH
from gearlube_core.dynamics.hypoid_torsional.kernel_parameters import (
    EVANS_JOHNSON,
    FRICTION_OFF,
    ONE_DOF,
    THERMAL_EYRING,
    TWO_DOF,
)
from gearlube_core.errors import ParameterError
from gearlube_core.mesh_table.netcdf import shipped_mesh_table
from gearlube_core.mesh_table.table import MeshTable
from gearlube_core.number import Number, Positive, check_fields
from gearlube_core.oil.lubricant import Lubricant

Form = Literal["two_dof", "one_dof"]
Radii = Literal["consistent", "paper", "mean"]
MeshStiffness = Literal["tangent", "secant"]
MeshDamping = Literal["constant", "modal"]
DampingGate = Literal["gated", "as_printed"]
Equations = Literal["consistent", "as_printed"]
LoadTorque = Literal["mean", "instantaneous"]
Friction = Literal["off", "evans_johnson", "thermal_eyring"]
Film = Literal["consistent", "as_printed"]
ContactPressure = Literal["elliptical", "circular"]
FilmTemperature = Literal["inlet", "effective", "inlet_shear_heating"]
Entrainment = Literal["vector_mean", "along_sliding"]

FORMS = {"one_dof": ONE_DOF, "two_dof": TWO_DOF}
FRICTION_FORMS = {
    "off": FRICTION_OFF,
    "evans_johnson": EVANS_JOHNSON,
    "thermal_eyring": THERMAL_EYRING,
}
KARAGIANNIS_DAMPING = 2278.1  # N s/m, [karagiannis_2012 Table 1]
KARAGIANNIS_DAMPING_RATIO = 0.03  # [-], [karagiannis_2012 Table 1]

KARAGIANNIS_OIL = "karagiannis_2012"  # in the library


@dataclass(frozen=True, slots=True, kw_only=True)
class HypoidTorsionalParameters:
    """Everything that defines one gear pair between a driving and a load torque.

    Parameters
    ----------
    mesh : MeshTable
        Read at `pinion_torque`, once. The drive flanks' data serve both sides.
    pinion_inertia, gear_inertia : float
        About the members' axes [kg m2].
    pinion_torque : float
        Mean driving torque [N.m].
    backlash : float
        Total backlash 2b along the line of action [m].
    form : {"two_dof", "one_dof"}
        The pair, or its reduction to the relative motion at constant speed and mean radii.
    radii : {"consistent", "paper", "mean"}
        R_g = R_p z_g/z_p with all ratio error in e; both as in the table (counts the ratio error
        twice if e holds it too); both constant.
    mesh_stiffness : {"tangent", "secant"}
        Spring of the mesh about its load, see `pack_mesh`.
    mesh_damping : {"constant", "modal"}
        c = `damping`, or c = 2 damping_ratio sqrt(k0 m_eq).
    damping : float
        [N s/m]
    damping_ratio : float
        Of the mesh mode [-].
    damping_gate : {"gated", "as_printed"}
        No damping force within the backlash and no adhesion; or c x' acts everywhere.
    equations : {"consistent", "as_printed"}
        With or without the terms by which the mesh conserves energy, see `pair_rates`.
    torque_ripple : float
        Swing of the pinion torque over its mean, once a revolution [-].
    load_torque : {"mean", "instantaneous"}
        Constant, or following R_g/R_p through the mesh.
    hold_gain : float
        Slow speed hold on the pinion [N.m s/rad].
    friction : {"off", "evans_johnson", "thermal_eyring"}
        On the flanks of all pairs: `flank_friction`, `thermal_eyring_flank`; the 1-DOF form has
        none.
    film, film_temperature, flash_temperature, contact_pressure
        Options of "thermal_eyring", see `thermal_eyring_options`, `grubin_contact_geometry`.
    entrainment : {"vector_mean", "along_sliding"}
        Likewise: the mean of both surface velocities, or as printed its part along sliding.
    oil : Lubricant
    oil_temperature : float
        [K]
    solid : Solid
        Both flanks.
    roughness_rms : float
        Composite root-mean-square roughness of the flanks [m].

    References
    ----------
    [karagiannis_2012 Table 1] [karagiannis_2012 Table 2]
    """

    mesh: MeshTable
    pinion_inertia: Annotated[float, Positive("kg m2")]
    gear_inertia: Annotated[float, Positive("kg m2")]
    pinion_torque: float
    backlash: Annotated[float, BACKLASH]
    form: Form
    radii: Radii
    mesh_stiffness: MeshStiffness
    mesh_damping: MeshDamping
    damping: Annotated[float, Number("N s/m", 0.0, 1e6)]
    damping_ratio: Annotated[float, Number("1", 0.0, 1.0)]
    damping_gate: DampingGate
    equations: Equations
    torque_ripple: Annotated[float, Number("1", 0.0, 1.0, "10 % is 0.1.")]
    load_torque: LoadTorque
    hold_gain: Annotated[float, Number("N.m s/rad", 0.0, 100.0, "Default 0.05.")]
    friction: Friction
    oil: Lubricant
    oil_temperature: float
    solid: Solid
    roughness_rms: Annotated[float, ROUGHNESS]
    film: Film = "consistent"
    film_temperature: FilmTemperature = "inlet"
    flash_temperature: bool = False
    contact_pressure: ContactPressure = "elliptical"
    entrainment: Entrainment = "vector_mean"

    def __post_init__(self) -> None:
        check_fields(self)
        check_within(
            "pinion_torque",
            self.pinion_torque,
            0.1,
            1e4,
            "N.m",
            "The pair is driven by its pinion; 50 N.m is usual.",
        )
        self.oil.check_temperature(self.oil_temperature, "oil_temperature")
        if self.form == "one_dof" and self.friction != "off":
            raise ParameterError(
                f"friction must be 'off' with form 'one_dof', got {self.friction!r}. "
                "Friction acts on the two shafts; choose form 'two_dof'."
            )
        if self.mesh.shaft_error:
            raise ParameterError(
                "The mesh table must repeat with the mesh period, as the wanted motions do, but "
                f"{self.mesh.name} has errors that repeat with a shaft. Give "
                "`mesh.without_shaft_error()`, or simulate the axle."
            )


def karagiannis_2012_pair(mesh: MeshTable | None = None) -> HypoidTorsionalParameters:
    """Return the gear pair of Karagiannis et al. 2012 (Tables 1 and 2), dry, at 50 N.m and 40 degC.

    Use `dataclasses.replace` for other options, torques or oils.

    Parameters
    ----------
    mesh : MeshTable, optional
        By default the table that ships; `synthetic_mesh` gives the paper's reconstructed numbers.

    Notes
    -----
    The paper has results at 50 N.m, at 40 and 100 degC, and a torque ripple of 0.1 in
    [karagiannis_2012 (31)]; 20 to 250 N.m is a car's range. It prints no inertias; those of the
    same gear pair in [mohammadpour_2015 Table 1] are used. Its normal backlash of 150 um is the
    total.

    Examples
    --------
    >>> from dataclasses import replace
    >>> pair = replace(karagiannis_2012_pair(), friction="thermal_eyring", oil_temperature=373.15)
    >>> pair.pinion_torque
    50.0
    """
    return HypoidTorsionalParameters(
        mesh=mesh or shipped_mesh_table("mohammadpour_2015"),
        pinion_inertia=1734e-6,
        gear_inertia=5.81e-2,
        pinion_torque=50.0,
        backlash=150e-6,
        form="two_dof",
        radii="consistent",
        mesh_stiffness="tangent",
        mesh_damping="constant",
        damping=KARAGIANNIS_DAMPING,
        damping_ratio=KARAGIANNIS_DAMPING_RATIO,
        damping_gate="gated",
        equations="consistent",
        torque_ripple=0.0,
        load_torque="mean",
        hold_gain=0.05,
        friction="off",
        oil=Lubricant.named(KARAGIANNIS_OIL),
        oil_temperature=313.15,
        solid=STEEL_MOHAMMADPOUR_2015,
        roughness_rms=0.5e-6,
    )
