"""The finite elements of the tooth against exact elasticity and beam theory."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.sparse import csr_array, eye_array
from scipy.sparse.linalg import spsolve
from skfem import Basis, ElementHexS2

from gearlube_core.contact.solid import STEEL_MOHAMMADPOUR_2015 as STEEL
from gearlube_core.errors import ConvergenceError, ParameterError
from gearlube_core.tooth_compliance.tooth_mesh import (
    energy_products,
    normal_hat_loads,
    stiffness_matrix,
    tooth_mesh,
    tooth_model,
)
from tests.helpers.compliance_cases import COARSE, box_mesh, spiral_tooth


@pytest.fixture(scope="module")
def tooth():
    mesh = tooth_mesh(spiral_tooth(neighbour_pitches=0.5, base_depth=10e-3), COARSE)
    basis = Basis(mesh.solid, ElementHexS2(), intorder=4)
    return mesh, basis, stiffness_matrix(basis, STEEL)


def test_linear_displacement_passes_the_patch_test_on_the_distorted_tooth(tooth):
    mesh, basis, K = tooth
    gradient = np.array([[1.0, 0.4, -0.3], [0.2, -0.7, 0.5], [0.1, 0.6, 0.3]]) * 1e-3
    exact = (gradient @ basis.doflocs).T.ravel()
    boundary = basis.get_dofs(mesh.solid.boundary_facets()).flatten()
    given = np.zeros(basis.N, dtype=bool)
    given[boundary] = True
    given = np.repeat(given, 3)
    solved = spsolve(K[~given][:, ~given].tocsc(), -(K[~given][:, given] @ exact[given]))
    # round-off of the sparse solution
    assert (~given).sum() > 300
    assert solved == pytest.approx(exact[~given], abs=1e-10 * np.abs(exact).max())


def test_rigid_motions_store_no_energy(tooth):
    _, basis, K = tooth
    x = basis.doflocs - basis.doflocs.mean(axis=1)[:, None]
    scale = np.abs(x).max()
    motions = [np.tile(axis, (x.shape[1], 1)) for axis in np.eye(3)]
    motions += [np.cross(axis, x.T) / scale for axis in np.eye(3)]
    stretch = np.array([[1.0, 0, 0]]).T * x / scale
    reference = stretch.T.ravel() @ (K @ stretch.T.ravel())
    for motion in motions:
        energy = motion.ravel() @ (K @ motion.ravel())
        assert abs(energy) < 1e-10 * reference  # round-off


def test_unknowns_couple_to_their_own_and_the_next_of_layers_counted_from_zero(tooth):
    model = tooth_model(tooth[0], STEEL)
    # six elements along the tooth: a layer is a plane of nodes with the mid-side nodes behind it
    assert list(np.unique(model.layer)) == list(range(7))
    entries = model.stiffness.tocoo()
    apart = np.abs(model.layer[entries.row] - model.layer[entries.col])
    assert apart.max() == 1
    sizes = np.bincount(model.layer)
    assert np.all(sizes[:6] == sizes[0])
    assert sizes[6] < sizes[0]  # the last plane has none behind it


def test_cantilever_prism_bends_as_a_timoshenko_beam():
    L, h, b = 80e-3, 10e-3, 10e-3
    mesh = box_mesh(
        np.linspace(0.0, h, 5), np.linspace(0.0, L, 17), np.linspace(0.0, b, 5), profile=16
    )
    ends = np.array([0.0, 1.0])
    forces, gram = normal_hat_loads(mesh, "left", ends, ends)
    # pressure rising linearly from nothing at the held end: the hats of the tip's two corners
    load = forces @ np.array([0.0, 0.0, 0.5, 0.5])
    assert gram.sum(axis=1) == pytest.approx(np.full(4, L * b / 4.0), rel=1e-12)
    # without Poisson's effect a clamp holds a beam as the theory has it
    beam = replace(STEEL, poisson_ratio=0.0)
    deflection = tooth_model(mesh, beam).compliance(load[:, None])[0, 0]

    E, I_b = beam.youngs_modulus, b * h**3 / 12.0
    G, kappa = 0.5 * E, 5.0 / 6.0  # Cowper 1966, rectangle without Poisson's effect

    def shear(x):
        return 1.0 - x**2 / L**2

    def moment(x):
        return (L - x) - (L**3 - x**3) / (3.0 * L**2)

    bending = quad(lambda x: moment(x) ** 2, 0.0, L)[0] / (E * I_b)
    shearing = quad(lambda x: shear(x) ** 2, 0.0, L)[0] / (kappa * G * b * h)
    # 0.1 %: the load squeezes the beam's thickness, (h/L)^2 of bending in order, and warping
    # is hindered at the clamp
    assert deflection == pytest.approx(bending + shearing, rel=1e-3)
    assert shearing > 0.01 * bending  # so that the test sees shear


def test_layer_elimination_equals_a_dense_solution():
    rng = np.random.default_rng(5)
    layer = np.sort(rng.integers(0, 4, 40))
    K = rng.standard_normal((40, 40))
    K[np.abs(layer[:, None] - layer[None, :]) > 1] = 0.0
    K = K + K.T + 60.0 * np.eye(40)  # diagonally dominant
    F = rng.standard_normal((40, 3))
    expected = F.T @ np.linalg.solve(K, F)
    shuffled = rng.permutation(40)
    got = energy_products(csr_array(K[np.ix_(shuffled, shuffled)]), F[shuffled], layer[shuffled])
    assert got == pytest.approx(expected, rel=1e-12, abs=1e-14)  # round-off


@pytest.mark.slow
def test_a_body_that_is_not_held_is_refused(tooth):
    _, basis, K = tooth
    layer = np.zeros(3 * basis.N, dtype=int)
    shift = 1e-6 * K.diagonal().max()
    with pytest.raises(ConvergenceError, match="must be held"):
        energy_products(
            (K - shift * eye_array(3 * basis.N)).tocsr(), np.zeros((3 * basis.N, 1)), layer
        )


def test_distorted_elements_are_refused_in_words(tooth):
    mesh, _, _ = tooth
    shaken = mesh.solid.p + 2e-3 * np.random.default_rng(1).standard_normal(mesh.solid.p.shape)
    distorted = replace(mesh, solid=replace(mesh.solid, doflocs=shaken))
    ends = np.linspace(0.0, 1.0, 3)
    with pytest.raises(ParameterError, match=r"on the left flank .* nearly bricks, got distorted"):
        normal_hat_loads(distorted, "left", ends, ends)
