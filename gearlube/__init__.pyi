# The public names, and the only list of them: the package reads this file, and so do type checkers.

# axle
# FMUs
from fmu_src.build import build_helical_pair as build_helical_pair
from fmu_src.build import build_hypoid_axle as build_hypoid_axle

# speed sweeps of an axle FMU
from gearlube.studies.sweep.datasets import load_sweep as load_sweep
from gearlube.studies.sweep.report import write_sweep_report as write_sweep_report
from gearlube.studies.sweep.run import run_sweep as run_sweep
from gearlube.studies.sweep.settings import SweepSettings as SweepSettings
from gearlube.studies.sweep.settings import quick_sweep_settings as quick_sweep_settings
from gearlube_core.bearings.tapered_roller_bearing import (
    TaperedRollerBearing as TaperedRollerBearing,
)
from gearlube_core.dynamics.helical_pair.march.gear_file_march import (
    helical_march as helical_march,
)

# helical pair
from gearlube_core.dynamics.helical_pair.march.model import HelicalPairModel as HelicalPairModel
from gearlube_core.dynamics.hypoid_axle.model import HypoidAxle as HypoidAxle
from gearlube_core.dynamics.hypoid_axle.parameters import (
    HypoidAxleParameters as HypoidAxleParameters,
)
from gearlube_core.dynamics.hypoid_axle.parameters import (
    mohammadpour_2015_axle as mohammadpour_2015_axle,
)

# films solved in full
from gearlube_core.ehl.line.problem import LineProblem as LineProblem
from gearlube_core.ehl.line.problem import LineSettings as LineSettings
from gearlube_core.ehl.line.solver import solve_line as solve_line
from gearlube_core.ehl.point.problem import (
    PointContactProblem as PointContactProblem,
)
from gearlube_core.ehl.point.problem import (
    elliptical_contact as elliptical_contact,
)
from gearlube_core.ehl.point.settings import PointSolverSettings as PointSolverSettings
from gearlube_core.ehl.point.solver import solve_point_contact as solve_point_contact

# units and errors
from gearlube_core.errors import GearLubeError as GearLubeError
from gearlube_core.errors import ParameterError as ParameterError

# film formulas
from gearlube_core.film.hamrock_dowson_1977 import hamrock_dowson_films as hamrock_dowson_films
from gearlube_core.helical_geometry.gear_file import HelicalGearFile as HelicalGearFile

# gear files and mesh data
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile as HypoidGearFile
from gearlube_core.mesh_table.netcdf import read_mesh_table as read_mesh_table
from gearlube_core.mesh_table.shipped import shipped_mesh_table as shipped_mesh_table
from gearlube_core.mesh_table.table import MeshTable as MeshTable

# oils
from gearlube_core.oil.lubricant import Lubricant as Lubricant
from gearlube_core.oil.lubricant import lubricant_names as lubricant_names
from gearlube_core.units import celsius_to_kelvin as celsius_to_kelvin
from gearlube_core.units import rpm_to_rads as rpm_to_rads
