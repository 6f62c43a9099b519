# The public names of this module, and the only list of them: the package reads this file, type
# checkers and docs/api.py do too. "# -- " begins a group.

# -- Hypoid axle
from gearlube_core.dynamics.hypoid_mesh.parameters import (
    HypoidAxleParameters as HypoidAxleParameters,
)
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

# -- Gear files and mesh tables
from gearlube_core.rexs.document import RatedLoad as RatedLoad
from gearlube_core.rexs.exchange import read_rexs as read_rexs
from gearlube_core.rexs.exchange import write_rexs as write_rexs
from gearlube_core.mesh_table.table import MeshTable as MeshTable
from gearlube_core.mesh_table.netcdf import shipped_mesh_table as shipped_mesh_table

# -- Checks of a hypoid pair
from gearlube_core.hypoid_contact.refusal import check_pair as check_pair
from gearlube_core.hypoid_contact.refusal import pair_warnings as pair_warnings
from gearlube_core.hypoid_geometry.flank.tooth_form import tooth_form as tooth_form

# -- Design of a hypoid pair
from gearlube_core.hypoid_design.blank_file import BlankFile as BlankFile

# -- Quieter flanks of a pair
from gearlube_core.flank_optimisation.problem_file import OptimisationFile as OptimisationFile

# -- Measured gears
from gearlube_core.hypoid_geometry.measured.measured_file import MeasuredFile as MeasuredFile

# -- Damage of an axle or a pair over a duty cycle
from gearlube_core.dynamics.hypoid_axle.flank_states import flank_states as flank_states
from gearlube.damage.pair import helical_teeth as helical_teeth
from gearlube_core.dynamics.helical_pair.flank_states import (
    helical_flank_states as helical_flank_states,
)

# -- Helical pair
from gearlube_core.helical_contact.flank_rates import flank_rates as flank_rates
