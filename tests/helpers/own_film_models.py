"""Film models of one's own: shipped ones with other weights, as files."""

import math
from pathlib import Path

from gearlube_core.film_model.model import FilmModel

OIL_FILE = """
name = "own"
base_oil = "mineral"
density_kg_m3 = 880.0
viscosity_40_degc_mm2_s = 120.0
viscosity_100_degc_mm2_s = 12.0
"""


def altered(name: str, film: float = 1.0, friction: float = 1.0) -> FilmModel:
    """Return a shipped model whose film and friction over it are multiplied by factors.

    The net's outputs are the logarithms of film and friction over their references, so that the
    last offsets carry a factor; the reference of a flank's or line's friction follows the film.
    """
    shipped = FilmModel.named(name)
    blocks = shipped.blocks
    blocks["last_offset"] = blocks["last_offset"] + [math.log(film), math.log(friction)]
    return FilmModel.of_blocks(blocks, {**shipped.provenance, "name": "altered"})


def copy_of(name: str, path: Path) -> Path:
    """Write a shipped model as a file."""
    FilmModel.named(name).write(path)
    return path
