# The public names of this module, and the only list of them: the package reads this file, type
# checkers and docs/api.py do too. "# -- " begins a group.

# -- Film formulas
from gearlube_core.film.point_film import central_film_thickness as chittenden_central_film
from gearlube_core.film.point_film import minimum_film_thickness as chittenden_minimum_film
from gearlube_core.film.line_film import central_line_film as dowson_toyoda_film
from gearlube_core.film.point_film import hamrock_dowson_films as hamrock_dowson_films
