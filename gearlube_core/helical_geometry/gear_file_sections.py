"""The sections of a helical gear file: every field's unit, meaning and range."""

from __future__ import annotations

import math
from functools import partial
from typing import Annotated, Literal

from pydantic import Field, model_validator

from gearlube_core.helical_geometry.gear_body import (
    BACKLASH,
    COUPLING,
    DAMPING_RATIO,
    INERTIA,
    MASS,
    POSITION,
    STIFFNESS,
    TILTING,
)
from gearlube_core.helical_geometry.modification import (
    WIDEST_RELIEF,
    Crown,
    FlankModification,
    PowerTipRelief,
    TipRelief,
)
from gearlube_core.helical_geometry.pair import LARGEST_SHIFT, HelicalPair
from gearlube_core.helical_geometry.tooth_limits import USUAL_FILLET
from gearlube_core.input_file.field_notes import Declared, Usual
from gearlube_core.input_file.input_file import Section

_pair = partial(Declared, HelicalPair)
Nodes = Annotated[int, Field(ge=17, le=2049)]
Steps = Annotated[int, Field(ge=1, le=1_000_000)]
ShownSteps = Annotated[tuple[Annotated[int, Field(ge=0)], ...], Field(strict=False)]
Position = Annotated[float, Field(ge=-1000.0, le=1000.0, allow_inf_nan=False), Usual(0.0, 200.0)]
Teeth = Annotated[int, _pair("teeth", "pinion_teeth")]
Module = Annotated[float, _pair("normal_module_mm"), Usual(0.5, 30.0)]
PressureAngle = Annotated[float, _pair("normal_pressure_angle_deg"), Usual(12.0, 30.0)]
HelixAngle = Annotated[float, _pair("helix_angle_deg"), Usual(3.0, 45.0)]
Length = Annotated[float, Field(gt=0.0, le=10000.0, allow_inf_nan=False), Usual(5.0, 2000.0)]
Width = Annotated[float, Field(gt=0.0, le=2000.0, allow_inf_nan=False), Usual(2.0, 600.0)]
Depth = Annotated[
    float, Field(gt=0.0, le=1e3 * WIDEST_RELIEF, allow_inf_nan=False), Usual(0.05, 30.0)
]
Step = Annotated[Width, Usual(1e-3, 20.0)]
Backlash = Annotated[float, Declared(BACKLASH, "backlash_mm"), Usual(1e-3, 1.5)]
Removal = Annotated[float, Declared(Crown, "crown_um", "amount"), Usual(0.5, 300.0)]
Slope = Annotated[float, Declared(FlankModification, "lead_slope_um"), Usual(0.5, 300.0)]
Share = Annotated[float, Declared(TipRelief, "k")]
Exponent = Annotated[float, Declared(PowerTipRelief, "beta")]
Start = Annotated[float, Declared(Crown, "crown_start_mm", "start"), Usual(0.1, 300.0)]
Facets = Annotated[int, Field(ge=0, le=10000)]
Shift = Annotated[float, Field(ge=-LARGEST_SHIFT, le=LARGEST_SHIFT, allow_inf_nan=False)]
Fillet = Annotated[float, _pair("fillet_factor")]
Mass = Annotated[float, Declared(MASS, "mass_kg"), Usual(0.02, 5000.0)]
Inertia = Annotated[float, Declared(INERTIA, "polar_inertia_kg_mm2"), Usual(1.0, 1e9)]
Distance = Annotated[float, Declared(POSITION, "distance_mm"), Field(gt=0.0), Usual(5.0, 2000.0)]
Stiffness = Annotated[
    float, Declared(STIFFNESS, "stiffness_x_n_per_um"), Field(gt=0.0), Usual(5.0, 20000.0)
]
Tilt = Annotated[float, Declared(TILTING, "tilt_x_knm_per_rad"), Usual(1.0, 1e6)]
Coupling = Annotated[float, Declared(COUPLING, "coupling_x_kn_per_rad"), Usual(1.0, 1e7)]
Damping = Annotated[float, Declared(DAMPING_RATIO, "mesh")]
Torque = Annotated[float, Field(gt=0.0, le=1e8, allow_inf_nan=False), Usual(0.5, 200000.0)]
Speed = Annotated[float, Field(gt=0.0, le=1e5, allow_inf_nan=False), Usual(10.0, 50000.0)]
Viscosity = Annotated[float, Field(ge=1e-4, le=10.0, allow_inf_nan=False), Usual(0.001, 2.0)]
PressureViscosity = Annotated[float, Field(ge=1.0, le=100.0, allow_inf_nan=False), Usual(5.0, 50.0)]
Text = Annotated[str, Field(min_length=1)]
Modulus = Annotated[float, Field(ge=0.1, le=1000.0, allow_inf_nan=False), Usual(20.0, 600.0)]
OilTemperature = Annotated[float, Field(ge=20.0, le=120.0, allow_inf_nan=False), Usual(20.0, 120.0)]
Stress = Annotated[float, Field(ge=0.1, le=1000.0, allow_inf_nan=False), Usual(0.5, 50.0)]


class Pair(Section):
    """Data shared by both members; module and pressure angle are normal or transverse."""

    normal_module_mm: Module | None = Field(
        default=None,
        description="Normal module of the basic rack; give this or the transverse module",
    )
    transverse_module_mm: Module | None = Field(
        default=None,
        description="Transverse module: reference diameter divided by the number of teeth; 25.4 "
        "mm divided by the transverse diametral pitch",
    )
    normal_pressure_angle_deg: PressureAngle | None = Field(
        default=None,
        description="Normal pressure angle of the basic rack; give this or the transverse "
        "pressure angle",
    )
    transverse_pressure_angle_deg: PressureAngle | None = Field(
        default=None,
        description="Pressure angle at the reference cylinder, in the transverse plane",
    )
    helix_angle_deg: HelixAngle = Field(
        description="Helix angle at the reference cylinder; 0: spur gears"
    )
    centre_distance_mm: Length = Field(description="Distance between the parallel axes")
    face_width_mm: Width = Field(description="Face width that both members have in common")
    backlash_mm: Backlash | None = Field(
        default=None,
        description="Normal backlash, along the line of action; left out: what the profile shifts "
        "leave at the centre distance, 0 without them",
    )
    fillet_radius_factor: Fillet = Field(
        default=USUAL_FILLET,
        description="Fillet radius of the basic rack divided by the normal module, for undercut; "
        "ISO 53 has 0.38 (A), 0.3 (B), 0.25 (C)",
    )
    reduced_modulus_gpa: Modulus | None = Field(
        default=None,
        description="Reduced modulus E' = 2 E* of both flanks, for films; left out: that of steel",
    )

    @model_validator(mode="after")
    def _check_alternatives(self) -> Pair:
        for kind in ("module_mm", "pressure_angle_deg"):
            names = (f"normal_{kind}", f"transverse_{kind}")
            given = [name for name in names if getattr(self, name) is not None]
            if len(given) != 1:
                raise ValueError(
                    f"exactly one of {names[0]} and {names[1]} must be given, got "
                    f"{'both' if given else 'neither'}"
                )
        return self


class Flank(Section):
    """Material removed from one member's involute helicoids, in the transverse plane."""

    tip_relief_um: Removal = Field(
        default=0.0, description="Material removed at the tip; 0: no tip relief"
    )
    tip_relief_depth_mm: Depth | None = Field(
        default=None, description="Radial distance from the start of the tip relief to the tip"
    )
    tip_relief_form: Literal["blended", "power"] = Field(
        default="blended",
        description="blended: a parabola that goes on as its tangent; power: a power of the depth",
    )
    tip_relief_parabola: Share = Field(
        default=1.0,
        description="k: share of the depth of a blended relief that is parabolic; 0: all "
        "linear, 1: all parabolic",
    )
    tip_relief_exponent: Exponent = Field(
        default=2.0, description="beta: exponent of a power relief"
    )
    crown_um: Removal = Field(
        default=0.0,
        description="c_r: axial crown, material removed at both face edges; 0: no crown",
    )
    crown_start_mm: Start = Field(
        default=0.0, description="F_o: distance from mid-face at which the crown begins"
    )
    lead_slope_um: Slope = Field(
        default=0.0,
        description="Lead slope: material removed at the face z = +W/2 minus that at z = -W/2",
    )
    profile_slope_um: Slope = Field(
        default=0.0,
        description="Profile slope: material removed at the tip end of the active profile minus "
        "that at its root end",
    )
    facets: Facets = Field(
        default=0,
        description="n_f: number of flat facets along the path of contact that replace the "
        "involute; 0: smooth involute",
    )

    @model_validator(mode="after")
    def _check_relief_depth(self) -> Flank:
        if self.tip_relief_um > 0.0 and self.tip_relief_depth_mm is None:
            raise ValueError(
                "tip_relief_depth_mm is missing; it must be above 0 mm where there is relief"
            )
        return self


class Bearing(Section):
    """Shaft and bearing on one side of a member, as springs at one place."""

    distance_mm: Distance = Field(
        description="Distance from mid-face; bearing 1 is on the side z > 0, bearing 2 on the "
        "side z < 0"
    )
    stiffness_x_n_per_um: Stiffness = Field(description="K_xx: stiffness along the line of action")
    stiffness_y_n_per_um: Stiffness = Field(
        description="K_yy: stiffness normal to the line of action, off-line"
    )
    stiffness_z_n_per_um: Stiffness = Field(description="K_zz: axial stiffness")
    tilt_x_knm_per_rad: Tilt = Field(
        default=0.0, description="K_thx,thx: stiffness against tilt about x"
    )
    tilt_y_knm_per_rad: Tilt = Field(
        default=0.0, description="K_thy,thy: stiffness against tilt about y"
    )
    coupling_x_kn_per_rad: Coupling = Field(
        default=0.0, description="K_x,thy: force along x per angle of tilt about y"
    )
    coupling_y_kn_per_rad: Coupling = Field(
        default=0.0, description="K_y,thx: force along y per angle of tilt about x"
    )

    @model_validator(mode="after")
    def _check_positive_definite(self) -> Bearing:
        for along, about in (("x", "y"), ("y", "x")):
            stiffness = 1e3 * getattr(self, f"stiffness_{along}_n_per_um")  # kN/m
            limit = math.sqrt(stiffness * getattr(self, f"tilt_{about}_knm_per_rad"))
            coupling = getattr(self, f"coupling_{along}_kn_per_rad")
            if abs(coupling) > limit:
                raise ValueError(
                    f"coupling_{along}_kn_per_rad must be within {0.0 - limit:.4g} to {limit:.4g} "
                    f"kN/rad, got {coupling:.4g} kN/rad; or raise tilt_{about}_knm_per_rad"
                )
        return self


class Body(Section):
    """Inertia of one member; what is absent is that of a steel disc of the root diameter."""

    mass_kg: Mass | None = Field(
        default=None,
        description="Mass of the gear and all that turns with it; left out: that of a steel "
        "disc of the root diameter",
    )
    polar_inertia_kg_mm2: Inertia | None = Field(
        default=None,
        description="J_z: moment of inertia about the axis; left out: that of a disc of this "
        "mass and the root diameter",
    )
    diametral_inertia_kg_mm2: Inertia | None = Field(
        default=None,
        description="J_x = J_y: moment of inertia about a diameter; left out: J_z/2 + m W^2/12",
    )


class Member(Section):
    """One gear."""

    teeth: Teeth = Field(description="Number of teeth")
    tip_diameter_mm: Length = Field(description="Tip diameter")
    root_diameter_mm: Length | None = Field(
        default=None,
        description="Root diameter; left out: with a profile shift of either gear the rack's "
        "dedendum of 1.25 normal modules, else the tip diameter minus 4.5 normal modules (full "
        "depth 2.25)",
    )
    profile_shift_coefficient: Shift | None = Field(
        default=None,
        description="Profile shift coefficient x; left out for one gear: what the centre distance "
        "needs without backlash; left out for both: guessed from centre distance and tip diameters",
    )
    flank: Flank = Flank()
    body: Body = Body()
    bearing_1: Bearing | None = None
    bearing_2: Bearing | None = None

    @model_validator(mode="after")
    def _check_root(self) -> Member:
        root, tip = self.root_diameter_mm, self.tip_diameter_mm
        if root is not None and not root < tip:
            raise ValueError(
                f"root_diameter_mm must be below tip_diameter_mm, {tip:g} mm, got {root:g} mm"
            )
        return self


class DampingRatios(Section):
    """Modal damping, as shares of the critical."""

    mesh: Damping = Field(
        default=0.05, description="Damping ratio of the relative rotation on the mesh stiffness"
    )
    translation: Damping = Field(
        default=0.05, description="Damping ratio of each translation on its bearings"
    )
    tilt: Damping = Field(default=0.05, description="Damping ratio of each tilt on its bearings")


class Operation(Section):
    """The operating point that the source studies."""

    pinion_torque_n_m: Torque = Field(description="Torque that drives the pinion")
    pinion_speed_rpm: Speed = Field(description="Speed of the pinion")


class LineSteps(Section):
    """Equal steps of one contact line through its meshing cycle, as the source counts them."""

    first_position_mm: Position = Field(
        description="s_0: position of the line's end on the face z = -W/2 at step 0, measured "
        "from the pitch line along the line of action"
    )
    step_mm: Step = Field(
        description="Distance along the line of action that the contact line moves in one step"
    )
    count: Steps = Field(description="Number of the last step")
    shown: ShownSteps = Field(
        default=(),
        description="Numbers of the steps whose contact lines `gearlube helical` shows; 0 to count",
    )

    @model_validator(mode="after")
    def _check_shown_steps(self) -> LineSteps:
        if any(step > self.count for step in self.shown):
            raise ValueError(f"shown must hold steps up to count, {self.count}, got {self.shown}")
        return self


class FilmMesh(Section):
    """Nodes of the films on the pair's contact lines."""

    nodes_across: Nodes = Field(
        default=97, description="Number of nodes across the line, with the border"
    )
    nodes_along: Nodes = Field(
        default=257, description="Number of nodes along the line, with the border"
    )
    spacing: Literal["uniform", "exit"] = Field(
        default="uniform",
        description="Spacing of the nodes across the line. exit: half the spacing where the "
        "film leaves the contact, twice the spacing in the inlet, compared with the inside of "
        "the contact",
    )


class Film(Section):
    """Film and friction of the oil on the flanks."""

    model: Literal["formula", "solved"] = Field(
        default="formula",
        description="formula: Dowson and Toyoda 1979 with Evans and Johnson 1986; solved: a model "
        "of solved thermal Eyring films, and the formulas outside its domain",
    )
    oil_file: Text | None = Field(
        default=None,
        description="Oil file (.toml) of friction, losses and HelicalPair.fmu, its path relative "
        "to the gear file; left out: [oil], or mohammadpour_2015 without it",
    )
    line_model: Text | None = Field(
        default=None,
        description="Film model of lines for model = solved: file (.json) of `gearlube film-model "
        "fit`, its path relative to the gear file, or the name of a shipped one; left out: "
        "helical_line",
    )

    @model_validator(mode="after")
    def _check_line_model(self) -> Film:
        if self.line_model is not None and self.model != "solved":
            raise ValueError(
                f"line_model is only for model = solved, got {self.line_model!r} with model "
                f'{self.model}; write model = "solved", or leave line_model out'
            )
        return self


class Oil(Section):
    """The lubricant that the source names; films, friction and losses take it."""

    viscosity_pa_s: Viscosity = Field(
        description="eta_0: dynamic viscosity at ambient pressure and bulk temperature"
    )
    pressure_viscosity_per_gpa: PressureViscosity = Field(
        description="alpha: pressure-viscosity coefficient at low pressure"
    )
    eyring_stress_mpa: Stress | None = Field(
        default=None,
        description="tau_0: shear stress at which shear thinning begins (Eyring); left out: "
        "Newtonian",
    )
    viscosity_temperature_degc: OilTemperature = Field(
        default=80.0,
        description="Temperature of this viscosity; friction and losses at others take the slope "
        "of mohammadpour_2015",
    )
