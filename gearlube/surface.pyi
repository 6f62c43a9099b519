# The public names of this module, and the only list of them: the package reads this file, type
# checkers and docs/api.py do too. "# -- " begins a group.

# -- Rough surfaces
from gearlube_core.surface.heights import Profile as Profile
from gearlube_core.surface.heights import HeightMap as HeightMap
from gearlube_core.surface.files import read_surface as read_surface
from gearlube_core.surface.files import write_surface as write_surface
from gearlube_core.surface.gaussian_filter import levelled as levelled
from gearlube_core.surface.gaussian_filter import filtered as filtered
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
