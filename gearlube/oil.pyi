# The public names of this module, and the only list of them: the package reads this file, type
# checkers and docs/api.py do too. "# -- " begins a group.

# -- Oils
from gearlube_core.oil.lubricant import lubricant_names as lubricant_names
from gearlube_core.oil.oil_file import DescribedOil as DescribedOil
from gearlube_core.oil.film_oil import FilmOil as FilmOil
from gearlube_core.oil.oil_heat import OilHeat as OilHeat
from gearlube_core.oil.film_oil import pressure_viscosity as pressure_viscosity
from gearlube_core.oil.film_oil_data import film_oil as film_oil
from gearlube_core.kernels.jit import kernel as kernel
from gearlube_core.oil.film_oil_data import film_oil_of as film_oil_of
