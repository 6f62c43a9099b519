"""Point film by slippy, set as in the example of its `IterSemiSystem`."""

import math
import time

import numpy as np
import slippy
from cases import FILM, serve

slippy.CUDA, slippy.CORES = False, 1
import slippy.contact as c  # noqa: E402
import slippy.surface as s  # noqa: E402

NU = 0.3  # of both solids, whose E gives the reduced modulus; names of solids are used once
SOLID = c.Elastic("solid", {"E": FILM["reduced_modulus"] * (1.0 - NU**2), "v": NU})


def run(nodes):
    began = time.perf_counter()
    radius, a, p_h = FILM["radius"], FILM["hertz_radius"], FILM["hertz_pressure"]
    count = nodes - 1  # even, so that the centre of the ball is a node
    size = 2.0 * FILM["half_width"] * a
    ball = s.RoundSurface((radius,) * 3, shape=(count, count), extent=(size, size), generate=True)
    flat = s.FlatSurface()
    ball.material = flat.material = SOLID
    oil = c.Lubricant("oil")
    laws = c.lubricant_models
    oil.add_sub_model(
        "nd_viscosity",
        laws.nd_roelands(FILM["eta0"], FILM["roelands_pressure"], p_h, FILM["roelands_z"]),
    )
    oil.add_sub_model("nd_density", laws.nd_dowson_higginson(p_h))
    model = c.ContactModel("film", ball, flat, oil)
    reynolds = c.UnifiedReynoldsSolver(
        time_step=0, grid_spacing=ball.grid_spacing, hertzian_pressure=p_h,
        radius_in_rolling_direction=radius, hertzian_half_width=a,
        dimentional_viscosity=FILM["eta0"], dimentional_density=850,
    )  # fmt: skip
    x, y = np.array(ball.get_points_from_extent()) + np.reshape(ball._total_shift, (2, 1, 1))
    start = p_h * (1.0 - (x**2 + y**2) / a**2).clip(0.0) ** 0.5
    step = c.IterSemiSystem(
        "film", reynolds, FILM["speed"], 1, no_time=True, normal_load=FILM["load"],
        initial_guess=[a**2 / radius, start], relaxation_factor=0.05, max_it_interference=3000,
    )  # fmt: skip
    model.add_step(step)
    state = model.solve()
    seconds = time.perf_counter() - began
    if not state["converged"]:
        raise RuntimeError("not converged")
    film = state["gap"]
    central = float(film[count // 2, count // 2])
    if not math.isfinite(central):
        raise RuntimeError("film is not a number")
    return {"seconds": seconds, "central": central, "minimum": float(film.min())}


if __name__ == "__main__":
    serve(run, slippy.__version__)
