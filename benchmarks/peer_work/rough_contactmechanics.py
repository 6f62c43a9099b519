"""Rough contact by ContactMechanics: its constrained conjugate gradients under a given force."""

import ContactMechanics
import numpy as np
from cases import MODULUS, SIDE, rough_loads, serve
from SurfaceTopography import Topography


def press(height, load, tolerance):
    nodes, size = height.shape, (SIDE, SIDE)
    system = ContactMechanics.make_system(
        substrate=ContactMechanics.PeriodicFFTElasticHalfSpace(nodes, MODULUS, size),
        surface=Topography(height, size, periodic=True),
    )
    force = load * SIDE**2
    found = system.minimize_proxy(
        external_force=force,
        pentol=tolerance * height.std(),
        forcetol=tolerance * force / height.size,
        maxiter=5000,
    )
    if not found.success:
        raise RuntimeError(str(found.message))
    return np.abs(np.asarray(found.jac)) * height.size / SIDE**2


if __name__ == "__main__":
    serve(rough_loads(press), ContactMechanics.__version__)
