"""Checked parameters of the lubricated hypoid axle."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Literal

from gearlube_core.arrays import Array
from gearlube_core.bearings.bearing_type import Bearing
from gearlube_core.bearings.followed_shaft import BEARING_LAWS, TORQUE_LOSSES
from gearlube_core.bearings.losses.laws import DEFAULT_LAW
from gearlube_core.bearings.losses.race_rolling import roller_film_model
from gearlube_core.checks import check_option
from gearlube_core.contact.greenwood_tripp_1971 import (
    FLANK_SIGMA_OVER_BETA,
    FLANK_XI_BETA_SIGMA,
    ROUGHNESS,
    SurfaceParameters,
)
from gearlube_core.contact.solid import Solid, contact_modulus, solid_parameters
from gearlube_core.drag import (
    CHURNING_LAWS,
    ChurningConstants,
    ChurningLaw,
    Immersion,
    OilVolume,
    RingDiameter,
    RingWidth,
)
from gearlube_core.dynamics.hypoid_mesh.kernel_parameters import AxleParameters, AxleScalars
from gearlube_core.dynamics.hypoid_mesh.mesh_at_load import NO_FILM_MODEL
from gearlube_core.dynamics.hypoid_mesh.mesh_force import (
    MeshForceConstants,
    equivalent_mass,
    modal_damping,
)
from gearlube_core.dynamics.packed_mesh import STIFFNESS_SERIES, PackedMesh, pack_mesh
from gearlube_core.dynamics.ranges import Range, model_ranges, range_limits
from gearlube_core.errors import ParameterError
from gearlube_core.film_model.chosen_model import check_oil, of_kind
from gearlube_core.film_model.model import FLANK, ROLLER, FilmModel, shipped_model
from gearlube_core.friction.flank_film import flank_film_model
from gearlube_core.friction.flank_friction import FlankFriction, friction_law
from gearlube_core.friction.flank_law import FlankLaw, FlankLawMaker
from gearlube_core.friction.flank_laws import FILM_MODELS, MixedFlankFriction
from gearlube_core.friction.flank_rolling import FLANK_ROLLING_LAWS, FlankRolling
from gearlube_core.mesh_table.table import MeshTable
from gearlube_core.number import Number, check_fields, constants_of
from gearlube_core.oil.lubricant import LIMITING_SLOPE, Lubricant

Equations = Literal["consistent", "as_printed"]
Radii = Literal["consistent", "paper", "mean"]
MeshStiffness = Literal["tangent", "secant"]
MeshDamping = Literal["hysteretic", "modal"]
Film = Literal["formula", "solved"]

NO_MODAL_LOSS = (
    "modal_loss_factor must be above 0 with mesh_damping 'modal', got 0. "
    "Give about 0.06, or choose 'hysteretic'."
)
PRINTED_WITH_SOLVED_FILM = (
    "a solved film must come with the friction law consistent, or another one without a film of "
    "its own, such as zhou_hoeprich_1991 or off. Change one of the two."
)
REFERENCE_TORQUE = 50.0  # N.m at the pinion, Karagiannis et al. 2012


MARCH_WITH_WARM_FLANKS = (
    "flank_bulk_resistance must be 0 K/W in a march in time: teeth warm up in minutes, a march "
    "lasts a second. Take `gearlube map` or `gearlube cycle`, which use mean losses, or leave "
    "film.bulk_resistance_k_w out."
)


@dataclass(frozen=True, slots=True, kw_only=True)
class HypoidAxleParameters(AxleScalars):
    """Everything that defines one hypoid axle: give it to `HypoidAxle`.

    More fields, such as masses and backlash, are those of `kernel_parameters.AxleScalars` and
    `mesh_force.MeshForceScalars`.

    Parameters
    ----------
    mesh : MeshTable
        Stiffness, contact radii and transmission error of the gears.
    bearing : Bearing
        Each shaft has two, mounted as an opposed pair, e.g. a `TaperedRollerBearing` with preload,
        interference or clearance set.
    gear_bearing : Bearing, optional
        Bearings of the gear's shaft, of the same class; default: as those of the pinion.
    oil : Lubricant
    solid : Solid
        Material of both flanks.
    roughness_rms : float
        Composite root-mean-square roughness of the flanks [m].
    xi_beta_sigma, sigma_over_beta : float
        Asperities in Greenwood and Tripp's law [-]: density times tip radius times roughness, and
        roughness over tip radius. `greenwood_tripp_fit` gives those of computed asperities.
    equations : {"consistent", "as_printed"}
        "as_printed": the equations as the paper prints them. "consistent" differs in the sign of
        the mesh force in the lateral equations, in their flank friction, and in terms that make
        the mesh conserve energy.
    radii : {"consistent", "paper", "mean"}
        Contact radii. "consistent": R_g = R_p z_g/z_p, and the whole ratio error is in e.
        "paper": both as in the table, which counts the ratio error twice. "mean": both constant.
    mesh_stiffness : {"tangent", "secant"}
        Stiffness of the mesh about its load, see `pack_mesh`.
    mesh_damping : {"hysteretic", "modal"}
        Damping by [mohammadpour_2015 (4)], or c = modal_loss_factor sqrt(k0 m_eq) with k0 at
        REFERENCE_TORQUE.
    modal_loss_factor : float
        Twice the damping ratio of the mesh mode [-].
    friction : str or callable
        Friction law of the flanks: a name among `friction_laws`, such as "consistent" or "off", a
        `FlankFriction` with numbers of its own, or a function that makes a law, see `flank_law`.
    film : {"formula", "solved"}
        Central film and friction of the oil on the flanks: "formula", Chittenden 1985 with Evans
        and Johnson 1986, or "solved", by a model of solved thermal Eyring films, see `solved_film`;
        outside its domain formulas are used. Friction of asperities is as `friction` says.
    flank_film_model, roller_film_model : FilmModel, optional
        Models of solved films, of flanks for `film` and of rollers for `bearing_torque_loss`;
        default: those in the package. `FilmModel.named` reads a file. Where a model says nothing
        of the oil, formulas are used; `check_oil_of_models` reports it.
    film_limiting_slope : float
        Limiting shear stress of the film over pressure [-], 0 for none: the film model knows none,
        so contacts whose mean stress comes near it count as outside.
    flank_bulk_resistance : float
        Rise of the flanks' bulk over the oil for each watt of their mean friction [K/W]; in mean
        losses alone, a march refuses it. See `flank_bulk`.
    rolling : {"none", "biboulet_houpert_2010"}
        Law of the rolling loss of the flanks, see `flank_rolling_force`.
    bearing_torque_loss : str
        Drag torque of the bearings, one of `followed_shaft.TORQUE_LOSSES`. "none". "palmgren":
        under the preload. "palmgren_loaded", "skf_2013": laws of catalogues under the forces on
        each bearing. The others: a law of rolling for the raceways, with ribs, hysteresis and oil
        drag, under the load of each roller. "solved_films": rolling and films of the raceways by a
        model of solved films, see `solved_race`.
    churning : {"none", "changenet_velex_2007", "boness_1989", "iso_tr_14179_2"}
        Law of the gear's churning loss, see `churning_torque`.
    ring_diameter, ring_width : float
        Outside diameter and width of the teeth of the gear [m].
    immersion : float
        Depth of the lowest tooth below the oil level at standstill [m]; a value above
        ring_diameter counts as ring_diameter.
    oil_volume : float
        Volume of oil in the axle [m3].
    steps_per_mesh_period, steps_per_highest_period : int
        Integrator steps per mesh period and per period of the highest mode.

    References
    ----------
    [mohammadpour_2015 Table 1] and its Tables A1 to A4.

    Examples
    --------
    >>> from dataclasses import replace
    >>> from gearlube_core.dynamics.hypoid_axle import mohammadpour_2015_axle
    >>> dry = replace(mohammadpour_2015_axle(), friction="off")
    >>> round(dry.equivalent_mass, 2)  # kg
    3.39
    """

    mesh: MeshTable
    bearing: Bearing
    gear_bearing: Bearing | None = None
    oil: Lubricant
    solid: Solid
    roughness_rms: Annotated[float, ROUGHNESS]
    xi_beta_sigma: Annotated[float, Number("1", 1e-4, 10.0)] = FLANK_XI_BETA_SIGMA
    sigma_over_beta: Annotated[float, Number("1", 1e-9, 10.0)] = FLANK_SIGMA_OVER_BETA
    equations: Equations = "consistent"
    radii: Radii = "consistent"
    mesh_stiffness: MeshStiffness = "tangent"
    mesh_damping: MeshDamping = "hysteretic"
    modal_loss_factor: Annotated[float, Number("1", 0.0, 1.0)] = 0.06
    friction: str | FlankLawMaker = "consistent"
    film: Film = "formula"
    flank_film_model: FilmModel | None = None
    roller_film_model: FilmModel | None = None
    film_limiting_slope: Annotated[float, LIMITING_SLOPE] = 0.0
    flank_bulk_resistance: Annotated[float, Number("K/W", 0.0, 10.0, "Try 0.03 K/W.")] = 0.0
    rolling: FlankRolling = "none"
    bearing_torque_loss: str = DEFAULT_LAW
    churning: ChurningLaw = "none"
    ring_diameter: RingDiameter = 0.165
    ring_width: RingWidth = 0.030
    immersion: Immersion = 0.040
    oil_volume: OilVolume = 1.2e-3
    steps_per_mesh_period: Annotated[int, Number("1", 16, 4096, "Default 56.")] = 56
    steps_per_highest_period: Annotated[int, Number("1", 8, 4096, "Default 17.")] = 17

    def __post_init__(self) -> None:
        check_fields(self)
        friction_law(self.friction)
        check_option("bearing_torque_loss", self.bearing_torque_loss, TORQUE_LOSSES)
        if self.flank_film_model is not None:
            of_kind(self.flank_film_model, FLANK, "flank_film_model")
        if self.roller_film_model is not None:
            of_kind(self.roller_film_model, ROLLER, "roller_film_model")
        if self.mesh_damping == "modal" and self.modal_loss_factor == 0.0:
            raise ParameterError(NO_MODAL_LOSS)
        kinds = [type(one).__name__ for one in self.bearings]
        if kinds[0] != kinds[1]:
            raise ParameterError(
                f"gear_bearing must be a {kinds[0]} as bearing is, got a {kinds[1]}. The kernels "
                "of an axle are compiled for one class of bearing."
            )

    @property
    def bearings(self) -> tuple[Bearing, Bearing]:
        """The bearings of the pinion's and of the gear's shaft."""
        return self.bearing, self.bearing if self.gear_bearing is None else self.gear_bearing

    @property
    def mean_pinion_radius(self) -> float:
        """Mean contact radius of the pinion without load [m]."""
        return self.mesh.mean("R_p", 0.0)

    @property
    def equivalent_mass(self) -> float:
        """Mass of the torsional mesh mode [kg], [karagiannis_2012 (30)]."""
        return equivalent_mass(
            self.mean_pinion_radius,
            self.mesh.ratio,
            float(self.pinion_inertia),
            float(self.gear_inertia),
        )

    @property
    def modal_damping(self) -> float:
        """Coefficient c of the modal option [N s/m], zero for [mohammadpour_2015 (4)]."""
        if self.mesh_damping == "hysteretic":
            return 0.0
        return modal_damping(
            float(self.modal_loss_factor), self.reference_stiffness, self.equivalent_mass
        )

    @property
    def reference_stiffness(self) -> float:
        """Mean mesh stiffness at REFERENCE_TORQUE [N/m]."""
        return self.mesh.mean(STIFFNESS_SERIES[self.mesh_stiffness], REFERENCE_TORQUE)

    @property
    def torque_range(self) -> tuple[float, float]:
        """Pinion torques at the ends of the mesh table [N.m]; below 0 on the coast flanks.

        A table without coast levels takes the data of the drive flanks for both.
        """
        low, high = float(self.mesh.torque[0]), float(self.mesh.torque[-1])
        return (low if low < 0.0 else -high), high

    @property
    def ranges(self) -> tuple[Range, ...]:
        """Ranges of the mesh table, the oil and the formulas of film and traction."""
        law = self.friction_law
        return model_ranges(
            self.torque_range,
            "Run `gearlube contact` with higher torques.",
            self.oil,
            law.film_load,
            law.film_material,
        )

    @property
    def friction_law(self) -> FlankFriction:
        """The law that `friction` names, with its numbers."""
        return friction_law(self.friction)

    def _flank_law(self) -> FlankLaw:
        """Return the law of friction; without friction it still gives the film."""
        surface = SurfaceParameters(
            float(self.roughness_rms), float(self.xi_beta_sigma), float(self.sigma_over_beta)
        )
        law = self.friction_law(surface, solid_parameters(self.solid, self.solid))
        if isinstance(law, MixedFlankFriction):
            law = law._replace(
                film=float(FILM_MODELS.index(self.film)),
                limiting_slope=float(self.film_limiting_slope),
            )
        return law

    @property
    def film_models(self) -> dict[str, FilmModel]:
        """The models of solved films that the axle takes, by kind: "flank", "roller"."""
        found = {}
        if self.film == "solved":
            found[FLANK] = self.flank_film_model or shipped_model(FLANK)
        if self.bearing_torque_loss == "solved_films":
            found[ROLLER] = self.roller_film_model or shipped_model(ROLLER)
        return found

    def check_oil_of_models(self) -> None:
        """Raise ParameterError where a model of one's own says nothing of the oil."""
        for model, what in (
            (self.flank_film_model, "film.flank_model"),
            (self.roller_film_model, "film.roller_model"),
        ):
            if model is not None:
                check_oil(model, self.oil, self.solid, what)

    def film_model(self) -> Array:
        """Return the numbers of the film model for one axle; empty with the formulas.

        Raises
        ------
        ParameterError
            The film is solved and the friction law has a film of its own.
        """
        if self.film == "formula":
            return NO_FILM_MODEL
        if not self.friction_law.solved_film:
            raise ParameterError(f"{PRINTED_WITH_SOLVED_FILM} Got {self.friction!r}.")
        return flank_film_model(self.film_models[FLANK])

    def roller_model(self) -> Array:
        """Return the numbers of the film model of rollers for one axle; empty with other laws."""
        law = BEARING_LAWS.get(self.bearing_torque_loss, "")
        return roller_film_model(law, self.roller_film_model)

    def packed_mesh(self) -> PackedMesh:
        """Return the mesh table packed for the kernels."""
        modulus, pressure = contact_modulus(self.solid, self.solid), self.friction_law.pressure
        return pack_mesh(self.mesh, modulus, self.radii, self.mesh_stiffness, pressure)

    def kernel_parameters(self) -> AxleParameters:
        """Return the floats for the kernels."""
        of_pinion, of_gear = self.bearings
        as_printed = self.equations == "as_printed"
        return constants_of(
            AxleParameters,
            self,
            I_p=self.pinion_inertia,
            I_g=self.gear_inertia,
            m_p=self.pinion_mass,
            m_g=self.gear_mass,
            ratio=self.mesh.ratio,
            mesh=constants_of(
                MeshForceConstants,
                self,
                z_p=float(self.mesh.pinion_teeth),
                consistent=0.0 if as_printed else 1.0,
            ),
            lateral_sign=-1.0 if as_printed else 1.0,
            friction=1.0 if self.friction_law.rubs else 0.0,
            churning=ChurningConstants(
                law=float(CHURNING_LAWS.index(self.churning)),
                ring_diameter=float(self.ring_diameter),
                ring_width=float(self.ring_width),
                immersion=float(self.immersion),
                oil_volume=float(self.oil_volume),
            ),
            rolling=float(FLANK_ROLLING_LAWS.index(self.rolling)),
            drag=float(TORQUE_LOSSES.index(self.bearing_torque_loss)),
            reduced_modulus=2.0 * contact_modulus(self.solid, self.solid),
            ranges=range_limits(self.ranges),
            preload_p=of_pinion.preload_force(),
            preload_g=of_gear.preload_force(),
            bearing_p=of_pinion.parameters(),
            bearing_g=of_gear.parameters(),
            flank_law=self._flank_law(),
            oil=self.oil.parameters(),
        )
