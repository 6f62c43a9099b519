"""Rough contact by tamaas: its Polonsky-Keer solver under a given pressure."""

import numpy as np
import tamaas as tm
from cases import MODULUS, SIDE, rough_loads, serve


def press(height, load, tolerance):
    nodes = len(height)
    model = tm.ModelFactory.createModel(tm.model_type.basic_2d, [SIDE, SIDE], [nodes, nodes])
    model.E, model.nu = MODULUS, 0.0
    kind = tm.PolonskyKeerRey.pressure
    solver = tm.PolonskyKeerRey(model, height, tolerance, kind, kind)
    solver.max_iter = 5000
    solver.solve(load)
    return np.array(model.traction).reshape(nodes, nodes)


if __name__ == "__main__":
    tm.initialize(1)
    tm.set_log_level(tm.LogLevel.warning)
    serve(rough_loads(press), tm.__version__)
