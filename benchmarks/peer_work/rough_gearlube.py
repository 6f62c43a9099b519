"""Rough contact by `press_patch` of gearlube."""

from importlib.metadata import version

from cases import MODULUS, SIDE, rough_loads, serve

import gearlube as gl
from gearlube_core.rough_patch.table import press_patch


def press(height, load, tolerance):
    step = SIDE / len(height)
    patch = gl.surface.HeightMap(height=height, spacing=(step, step), periodic=(True, True))
    return press_patch(patch, load, MODULUS, tolerance=tolerance).pressure


if __name__ == "__main__":
    serve(rough_loads(press), version("gearlube"))
