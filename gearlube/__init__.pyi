# The public names, and the only list of them: the package reads this file, type checkers and
# docs/api.py do too. "# -- " begins a group.

__version__: str

# -- Hypoid axle
from gearlube_core.dynamics.hypoid_axle.model import HypoidAxle as HypoidAxle
from gearlube_core.dynamics.hypoid_mesh.parameters import (
    HypoidAxleParameters as HypoidAxleParameters,
)
from gearlube_core.dynamics.hypoid_axle.mohammadpour_2015 import (
    mohammadpour_2015_axle as mohammadpour_2015_axle,
)
from gearlube_core.bearings.tapered_roller_bearing import (
    TaperedRollerBearing as TaperedRollerBearing,
)
from drivetrain.axle_file.read_axle import read_axle as read_axle
from drivetrain.axle_file.axle_file import CarAxle as CarAxle

# -- Helical pair
from gearlube_core.dynamics.helical_pair.gear_file_pair import (
    helical_pair_parameters as helical_pair_parameters,
)
from gearlube_core.dynamics.helical_pair.linear.periodic_response import (
    periodic_response as periodic_response,
)
from gearlube_core.dynamics.helical_pair.march.gear_file_march import (
    ReplacedBearings as ReplacedBearings,
)
from gearlube_core.dynamics.helical_pair.march.gear_file_march import (
    helical_march_parameters as helical_march_parameters,
)
from gearlube_core.dynamics.helical_model.model import HelicalPairModel as HelicalPairModel

# -- Trains of bodies and elements
from gearlube_core.dynamics.train.model import Train as Train
from gearlube_core.dynamics.train.part import Body as TrainBody
from gearlube_core.dynamics.train.shaft import Shaft as Shaft
from gearlube_core.dynamics.train.contact_stations import contact_fields as contact_fields
from gearlube_core.dynamics.train.response import frequency_response as frequency_response
from gearlube_core.dynamics.train.response import order_response as order_response
from gearlube_core.shafts.rotor_matrices import read_rotor as read_rotor
from gearlube_core.shafts.rotor_matrices import rotor_beam as rotor_beam
from gearlube_core.shafts.section import ShaftDisc as ShaftDisc
from gearlube_core.shafts.section import ShaftMaterial as ShaftMaterial
from gearlube_core.shafts.section import ShaftSection as ShaftSection
from gearlube_core.dynamics.train.housing import Housing as Housing
from gearlube_core.housings.model_files import read_reduced_model as read_reduced_model
from gearlube_core.housings.reduced_model import InterfaceNode as InterfaceNode
from gearlube_core.housings.reduced_model import ReducedModel as ReducedModel
from gearlube_core.dynamics.train.part import Element as TrainElement
from gearlube_core.dynamics.train.elements.port import Port as Port
from gearlube_core.dynamics.train.elements.held_port import HeldPort as HeldPort
from gearlube_core.dynamics.train.elements.held_port import SpeedHolder as SpeedHolder
from gearlube_core.dynamics.train.elements.motor import Motor as Motor
from gearlube_core.dynamics.train.ripple_table import RippleTable as RippleTable
from gearlube_core.dynamics.train.ripple_table import skew_factor as skew_factor
from gearlube_core.dynamics.train.elements.helical_mesh import HelicalMesh as HelicalMesh
from gearlube_core.dynamics.train.elements.hypoid_mesh import HypoidMesh as HypoidMesh
from gearlube_core.dynamics.train.elements.spring_support import SpringSupport as SpringSupport
from gearlube_core.dynamics.train.elements.opposed_bearings import (
    OpposedBearings as OpposedBearings,
)
from gearlube_core.dynamics.train.elements.roller_bearing import RollerBearing as RollerBearing
from gearlube_core.dynamics.train.elements.ball_bearing import BallBearing as BallBearing
from gearlube_core.dynamics.train.elements.cylindrical_bearing import (
    CylindricalBearing as CylindricalBearing,
)
from gearlube_core.bearings.bearing_under_load import bearing_under_load as bearing_under_load
from gearlube_core.bearings.element_loads import element_loads as element_loads
from gearlube_core.bearings.element_loads import tapered_loads as tapered_loads
from gearlube_core.dynamics.train.elements.gear_mesh import GearMesh as GearMesh
from gearlube_core.dynamics.train.elements.joint import Joint as Joint
from gearlube_core.dynamics.train.elements.orbit import Orbit as Orbit
from gearlube_core.dynamics.train.elements.half_shaft import HalfShaft as HalfShaft
from gearlube_core.dynamics.train.elements.differential import Differential as Differential
from gearlube_core.dynamics.train.elements.drag import Seal as Seal
from gearlube_core.dynamics.train.elements.drag import Churning as Churning
from gearlube_core.dynamics.helical_model.pair import helical_pair as helical_pair_train
from gearlube_core.dynamics.hypoid_axle.as_train import axle_train as axle_train
from gearlube_core.dynamics.hypoid_axle.as_train import axle_values as axle_values
from gearlube_core.dynamics.hypoid_axle.as_train import hypoid_axle as hypoid_axle_train
from drivetrain.train.train_file import TrainFile as TrainFile
from gearlube.studies.drivetrain.cycle import train_cycle as train_cycle
from gearlube.studies.drivetrain.losses import map_losses as map_losses
from gearlube.studies.drivetrain.ramp import run_ramp as run_ramp
from gearlube.studies.drivetrain.run import run_drivetrain as run_drivetrain

# -- Oils
from gearlube_core.oil.lubricant import Lubricant as Lubricant
from gearlube_core.oil.lubricant import lubricant_names as lubricant_names
from gearlube_core.oil.oil_file import read_oil as read_oil
from gearlube_core.oil.oil_file import DescribedOil as DescribedOil
from gearlube_core.oil.film_oil import FilmOil as FilmOil
from gearlube_core.oil.oil_heat import OilHeat as OilHeat
from gearlube_core.oil.film_oil_data import film_oil as film_oil
from gearlube_core.oil.film_oil_data import film_oil_of as film_oil_of

# -- Gear files and mesh tables
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile as HypoidGearFile
from gearlube_core.helical_geometry.gear_file import HelicalGearFile as HelicalGearFile
from gearlube_core.rexs.document import RatedLoad as RatedLoad
from gearlube_core.rexs.exchange import read_rexs as read_rexs
from gearlube_core.rexs.exchange import write_rexs as write_rexs
from gearlube_core.mesh_table.table import MeshTable as MeshTable
from gearlube_core.mesh_table.netcdf import read_mesh_table as read_mesh_table
from gearlube_core.mesh_table.netcdf import shipped_mesh_table as shipped_mesh_table

# -- Film formulas
from gearlube_core.film.point_film import central_film_thickness as chittenden_central_film
from gearlube_core.film.point_film import minimum_film_thickness as chittenden_minimum_film
from gearlube_core.film.line_film import central_line_film as dowson_toyoda_film
from gearlube_core.film.point_film import hamrock_dowson_films as hamrock_dowson_films

# -- Films solved in full
from gearlube_core.ehl.line.problem import LineProblem as LineProblem
from gearlube_core.ehl.line.problem import LineSettings as LineSettings
from gearlube_core.ehl.line.solver import solve_line as solve_line
from gearlube_core.ehl.point.problem import PointContactProblem as PointContactProblem
from gearlube_core.ehl.point.contact_domain import ContactDomain as ContactDomain
from gearlube_core.ehl.point.contact_domain import line_section as line_section
from gearlube_core.ehl.point.contact_domain import elliptical_contact as elliptical_contact
from gearlube_core.ehl.point.settings import PointSolverSettings as PointSolverSettings
from gearlube_core.ehl.point.solver import solve_point_contact as solve_point_contact

# -- Rough surfaces
from gearlube_core.surface.heights import Profile as SurfaceProfile
from gearlube_core.surface.heights import HeightMap as HeightMap
from gearlube_core.surface.files import read_surface as read_surface
from gearlube_core.surface.files import write_surface as write_surface
from gearlube_core.surface.gaussian_filter import levelled as levelled_surface
from gearlube_core.surface.gaussian_filter import filtered as filtered_surface
from gearlube_core.surface.statistics import profile_statistics as profile_statistics
from gearlube_core.surface.statistics import map_statistics as map_statistics
from gearlube_core.surface.generator_request import RoughnessRequest as RoughnessRequest
from gearlube_core.surface.generator import generated_profile as generated_profile
from gearlube_core.surface.generator import generated_map as generated_map
from gearlube_core.surface.extrusion import Lay as Lay
from gearlube_core.surface.extrusion import ExtrudedProfile as ExtrudedProfile
from gearlube_core.surface.extrusion import periodic_section as periodic_section
from gearlube_core.surface.gaussian_filter import peaks_cut as peaks_cut
from gearlube_core.surface.stand_ins import stand_in as stand_in
from gearlube_core.surface.moving import MovingSurface as MovingSurface
from gearlube_core.surface.moving import MovingRoughness as MovingRoughness
from gearlube_core.surface.moving import FedFromInlet as FedFromInlet
from gearlube_core.surface.moving import GrownInPlace as GrownInPlace
from gearlube_core.surface.schedule import RoughSchedule as RoughSchedule
from gearlube_core.rough_patch.table import gaussian_patches as gaussian_patches
from gearlube_core.rough_patch.table import patch_table as patch_table
from gearlube_core.rough_patch.asperity_file import greenwood_tripp_fit as greenwood_tripp_fit
from gearlube_core.rough_patch.flow import flow_factors as flow_factors
from gearlube_core.rough_patch.table import press_patch as press_patch
from gearlube_core.contact.half_space_stress import HalfSpaceStress as HalfSpaceStress
from gearlube_core.contact.half_space_stress import greatest_shear as greatest_shear
from gearlube_core.contact.half_space_stress import mises_stress as mises_stress
from gearlube_core.contact.dang_van import FatigueLimits as FatigueLimits
from gearlube_core.contact.dang_van import dang_van_number as dang_van_number
from gearlube_core.contact.dang_van import followed_history as followed_history
from gearlube_core.contact.dang_van import passage_history as passage_history
from gearlube_core.ehl.statistics.zone import FilmZone as FilmZone
from gearlube_core.ehl.statistics.rough_film import FilmFriction as FilmFriction
from gearlube_core.ehl.statistics.rough_film import RoughFilmStatistics as RoughFilmStatistics
from gearlube_core.ehl.statistics.rough_film import statistics_of_run as statistics_of_run

# -- Study: design of a hypoid pair
from gearlube_core.hypoid_design.blank_file import BlankFile as BlankFile
from gearlube.studies.design.run import run_design as run_design

# -- Study: quieter flanks of a pair
from gearlube_core.flank_optimisation.problem_file import OptimisationFile as OptimisationFile
from gearlube_core.flank_optimisation.optimise import OptimiseSettings as OptimiseSettings
from gearlube.studies.optimise.run import run_optimise as run_optimise

# -- Study: measured gears
from gearlube_core.hypoid_geometry.measured.measured_file import MeasuredFile as MeasuredFile
from gearlube.studies.measured.run import run_measured as run_measured
from gearlube.studies.measured.teeth import run_tooth_errors as run_tooth_errors

# -- Study: tooth contact of a hypoid pair
from gearlube_core.hypoid_contact.contact_dataset import ContactSettings as ContactSettings
from gearlube.studies.contact.run import run_contact as run_contact
from gearlube_core.hypoid_contact.sensitivity.analysis import (
    SensitivitySettings as SensitivitySettings,
)
from gearlube.studies.contact.sensitivity import run_sensitivity as run_sensitivity
from gearlube.studies.contact.sensitivity import sensitivity_rows as sensitivity_rows

# -- Study: whine of a hypoid pair against its settings
from gearlube_core.hypoid_contact.sensitivity.series_rates import SeriesSettings as SeriesSettings
from gearlube.studies.whine.run import WhineSettings as WhineSettings
from gearlube.studies.whine.run import run_whine as run_whine

# -- Study: friction of a bearing
from gearlube_core.bearings.bearing_file import BearingFile as BearingFile
from gearlube_core.bearings.losses.geometry import BearingGeometry as BearingGeometry
from gearlube_core.bearings.losses.loss import LossModel as BearingLossModel
from gearlube_core.bearings.losses.loss import bearing_loss as bearing_loss
from gearlube.studies.bearing.run import BearingSettings as BearingSettings
from gearlube.studies.bearing.run import run_bearing as run_bearing

# -- Study: loss map of an axle
from gearlube.studies.loss_map.settings import LossMapSettings as LossMapSettings
from gearlube.studies.loss_map.run import run_loss_map as run_loss_map

# -- Study: drive cycle of an axle
from drivetrain.cycle.traces import DriveCycle as DriveCycle
from gearlube.studies.drive_cycle.settings import DriveCycleSettings as DriveCycleSettings
from gearlube.studies.drive_cycle.settings import LossGrid as LossGrid
from drivetrain.sump_heat import SumpHeat as SumpHeat
from gearlube.studies.drive_cycle.run import run_cycle as run_cycle
from drivetrain.steady_temperature import steady_temperature as steady_temperature

# -- Rating of gears and bearings
from gearlube_core.rating.gears import RatedGear as RatedGear
from gearlube_core.rating.gears import LoadFactors as LoadFactors
from gearlube_core.rating.load_factors import face_load_factor as face_load_factor
from gearlube_core.rating.load_factors import bevel_face_factor as bevel_face_factor
from gearlube_core.rating.iso_6336 import cylindrical_rating as cylindrical_rating
from gearlube_core.rating.bevel_mesh import BevelMesh as BevelMesh
from gearlube_core.rating.iso_10300 import bevel_rating as bevel_rating
from gearlube_core.rating.bearing_life import RatedBearing as RatedBearing
from gearlube_core.rating.bearing_life import equivalent_load as equivalent_load
from gearlube_core.rating.bearing_life import bearing_life as bearing_life
from gearlube_core.rating.bearing_life import life_of_spectrum as life_of_spectrum
from gearlube_core.rating.contact_temperature import contact_temperature as contact_temperature
from gearlube_core.rating.contact_temperature import scuffing_probability as scuffing_probability
from gearlube_core.rating.flank_load import FlankOil as FlankOil
from gearlube_core.rating.flank_load import FlankLoad as FlankLoad
from gearlube_core.rating.scuffing import flash_rating as flash_rating
from gearlube_core.rating.scuffing import integral_rating as integral_rating
from gearlube_core.rating.micropitting import specific_film as specific_film
from gearlube_core.rating.micropitting import permissible_film as permissible_film
from gearlube_core.rating.micropitting import micropitting_rating as micropitting_rating
from gearlube_core.rating.subsurface import hardness_profile as hardness_profile
from gearlube_core.rating.subsurface import shear_amplitude as shear_amplitude
from gearlube_core.rating.subsurface import CaseHardening as CaseHardening
from gearlube_core.rating.subsurface import flank_fracture as flank_fracture
from gearlube_core.rating.wear import wear_per_cycle as wear_per_cycle
from gearlube_core.rating.life import miner_sum as miner_sum
from gearlube_core.rating.life import torque_factor as torque_factor
from gearlube_core.rating.spectrum import duty_bins as duty_bins
from gearlube_core.rating.spectrum import spectrum_damage as spectrum_damage

# -- Damage of an axle or a pair over a duty cycle
from gearlube_core.dynamics.hypoid_axle.flank_states import flank_states as flank_states
from gearlube.damage.bins import read_bins as read_bins
from gearlube.damage.bins import cycle_bins as cycle_bins
from gearlube.damage.settings import DamageSettings as DamageSettings
from gearlube.damage.run import run_damage as run_damage
from gearlube.damage.pair import pair_settings as pair_settings
from gearlube.damage.pair import helical_teeth as helical_teeth
from gearlube_core.dynamics.helical_pair.flank_states import (
    helical_flank_states as helical_flank_states,
)

# -- Study: helical pair
from gearlube.studies.helical.settings import HelicalSettings as HelicalSettings
from gearlube.studies.helical.run import run_helical as run_helical
from gearlube_core.helical_contact.flank_rates import flank_rates as flank_rates

# -- Study: resonance
from gearlube.studies.resonance.settings import ResonanceSettings as ResonanceSettings
from gearlube.studies.resonance.run import run_resonance as run_resonance

# -- Study: lubricated films
from gearlube_core.ehl.case.contact_case import LineCase as LineCase
from gearlube_core.ehl.case.contact_case import PointCase as PointCase
from gearlube_core.ehl.case.hypoid_case import HypoidCase as HypoidCase
from gearlube.studies.films.helical_case import HelicalLineCase as HelicalLineCase
from gearlube.studies.films.run_steady import run_line as run_line
from gearlube.studies.films.run_steady import run_point as run_point
from gearlube_core.ehl.case.rough_case import RoughCase as RoughCase
from gearlube.studies.films.rough.run import run_rough as run_rough
from gearlube.studies.films.run_steady import run_helical_line as run_helical_line
from gearlube.studies.films.run_march import MarchSteps as MarchSteps
from gearlube.studies.films.run_march import run_helical_march as run_helical_march
from gearlube.studies.films.run_hypoid import run_hypoid as run_hypoid
from gearlube.studies.films.run_march import compare_marches as compare_marches

# -- Study: vehicle speed sweep
from gearlube.studies.sweep.settings import SweepSettings as SweepSettings
from gearlube.studies.sweep.settings import quick_sweep_settings as quick_sweep_settings
from gearlube.studies.sweep.run import run_sweep as run_sweep
from gearlube.studies.sweep.datasets import load_sweep as load_sweep
from gearlube.studies.sweep.report import write_sweep_report as write_sweep_report

# -- Study: run-up and coast-down
from gearlube.studies.runup.settings import RunupSettings as RunupSettings
from gearlube.studies.runup.run import run_runup as run_runup
from gearlube.studies.runup.run import load_runup as load_runup
from gearlube.studies.sound.settings import SoundSettings as SoundSettings
from gearlube.studies.sound.run import run_sound as run_sound

# -- Variation of any parameter
from gearlube.variation.point_study import point_study as point_study
from gearlube.variation.design import Axis as Axis
from gearlube.variation.design import Spread as Spread
from gearlube.variation.design import Sampling as Sampling
from gearlube.variation.design import Design as Design
from gearlube.variation.run import run_variation as run_variation
from gearlube.variation.store import open_variation as open_variation
from gearlube.variation.store import gridded as gridded

# -- Results for other tools
from gearlube.output.exports.export import export_results as export_results

# -- FMUs
from fmu_src.build import build_hypoid_axle as build_hypoid_axle
from fmu_src.build import build_helical_pair as build_helical_pair

# -- Units and errors
from gearlube_core.units import celsius_to_kelvin as celsius_to_kelvin
from gearlube_core.units import rpm_to_rads as rpm_to_rads
from gearlube_core.errors import GearLubeError as GearLubeError
from gearlube_core.errors import ParameterError as ParameterError
