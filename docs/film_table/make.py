"""stub."""

import logging
from pathlib import Path
from docs.film_table.contacts import solve_missing

logging.basicConfig(level=logging.INFO, format="%(asctime)s %(message)s")
solve_missing(Path("build/film_table/solved.csv"))
