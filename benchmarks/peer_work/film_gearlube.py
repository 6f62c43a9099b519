"""Point film by gearlube."""

import time
from importlib.metadata import version

from cases import FILM, serve

from gearlube_core.ehl.point.contact_domain import ContactDomain, elliptical_contact
from gearlube_core.ehl.point.settings import PointSolverSettings
from gearlube_core.ehl.point.solver import solve_point_contact
from gearlube_core.oil.film_laws import DowsonHigginson
from gearlube_core.oil.film_oil_data import film_oil


def run(nodes: int, wedge: str = "upwind-2") -> dict:
    pressure, size = FILM["density_pressure"], FILM["half_width"]
    density = DowsonHigginson(FILM["density_factor"] / pressure, 1.0 / pressure)
    began = time.perf_counter()
    problem = elliptical_contact(
        R_x=FILM["radius"],
        R_y=FILM["radius"],
        entrainment=(FILM["speed"], 0.0),
        load=FILM["load"],
        contact_modulus=0.5 * FILM["reduced_modulus"],
        lubricant=film_oil(eta0=FILM["eta0"], alpha=FILM["alpha"], density_law=density),
        nodes=(nodes, nodes),
        domain=ContactDomain(inlet=size, outlet=size, side=size),
        oil_beyond=False,
    )
    settings = PointSolverSettings(cavitation="mass_conserving", wedge=wedge)
    film = solve_point_contact(problem, settings)
    return {
        "seconds": time.perf_counter() - began,
        "central": film.central_film,
        "minimum": film.minimum_film,
    }


if __name__ == "__main__":
    serve(run, version("gearlube"))
