# The public names of this module, and the only list of them: the package reads this file, type
# checkers and docs/api.py do too. "# -- " begins a group.

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
from gearlube_core.ehl.point.solid_contact import SolidContact as SolidContact

# -- Rough surfaces
from gearlube_core.ehl.statistics.zone import FilmZone as FilmZone
from gearlube_core.ehl.statistics.rough_film import FilmFriction as FilmFriction
from gearlube_core.ehl.statistics.rough_film import RoughFilmStatistics as RoughFilmStatistics
from gearlube_core.ehl.statistics.rough_film import statistics_of_run as statistics_of_run

# -- Lubricated films
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
