# The public names of this module, and the only list of them: the package reads this file, type
# checkers and docs/api.py do too. "# -- " begins a group.

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
