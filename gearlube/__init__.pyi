# The public names of this module, and the only list of them: the package reads this file, type
# checkers and docs/api.py do too. "# -- " begins a group.

__version__: str

from gearlube import bearing as bearing
from gearlube import ehl as ehl
from gearlube import film as film
from gearlube import gears as gears
from gearlube import oil as oil
from gearlube import rating as rating
from gearlube import studies as studies
from gearlube import surface as surface
from gearlube import train as train

# -- Models of gears in a drivetrain
from drivetrain.axle_file.read_axle import read_axle as read_axle
from gearlube_core.dynamics.hypoid_axle.mohammadpour_2015 import (
    mohammadpour_2015_axle as mohammadpour_2015_axle,
)
from gearlube_core.dynamics.hypoid_axle.model import HypoidAxle as HypoidAxle
from gearlube_core.dynamics.helical_model.model import HelicalPairModel as HelicalPairModel
from gearlube_core.dynamics.train.model import Train as Train

# -- Files
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile as HypoidGearFile
from gearlube_core.helical_geometry.gear_file import HelicalGearFile as HelicalGearFile
from gearlube_core.mesh_table.netcdf import read_mesh_table as read_mesh_table
from gearlube_core.oil.lubricant import Lubricant as Lubricant
from gearlube_core.oil.oil_file import read_oil as read_oil

# -- Studies
from gearlube.studies.loss_map.settings import LossMapSettings as LossMapSettings
from gearlube.studies.loss_map.run import run_loss_map as run_loss_map
from gearlube.studies.drive_cycle.settings import DriveCycleSettings as DriveCycleSettings
from gearlube.studies.drive_cycle.run import run_cycle as run_cycle
from gearlube.studies.sweep.settings import SweepSettings as SweepSettings
from gearlube.studies.sweep.run import run_sweep as run_sweep
from gearlube.studies.runup.settings import RunupSettings as RunupSettings
from gearlube.studies.runup.run import run_runup as run_runup
from gearlube.output.exports.export import export_results as export_results

# -- FMUs
from fmu_src.build import build_hypoid_axle as build_hypoid_axle
from fmu_src.build import build_helical_pair as build_helical_pair
from fmu_src.build import cached_hypoid_axle as cached_hypoid_axle

# -- Units and errors
from gearlube_core.units import celsius_to_kelvin as celsius_to_kelvin
from gearlube_core.units import rpm_to_rads as rpm_to_rads
from gearlube_core.errors import GearLubeError as GearLubeError
from gearlube_core.errors import ParameterError as ParameterError
