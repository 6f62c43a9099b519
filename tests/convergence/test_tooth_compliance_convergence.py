"""Default mesh and hats against finer ones, on displacements under distributed loads."""

import numpy as np
import pytest

from gearlube_core.contact.solid import STEEL_MOHAMMADPOUR_2015 as STEEL
from gearlube_core.tooth_compliance.flank_compliance import (
    CondensationSettings,
    FlankCompliance,
    half_space_compliance,
    interpolation_weights,
    projected,
    tooth_compliance,
)
from gearlube_core.tooth_compliance.hat_grid import lengthwise_nodes, profile_nodes
from gearlube_core.tooth_compliance.tooth_geometry import Flank
from gearlube_core.tooth_compliance.tooth_mesh import (
    MeshDensity,
    normal_hat_loads,
    tooth_mesh,
    tooth_model,
)
from tests.helpers.compliance_cases import spiral_tooth

TOOTH = spiral_tooth(neighbour_pitches=1.0, base_depth=12e-3)


def distributed_loads(s, t):
    """Return unit loads as forces of hats: lines along the tooth, across it, and a patch."""
    areas = np.outer(*(np.convolve(np.diff(x), [0.5, 0.5]) for x in (s, t)))
    s, t = s[:, None], t[None, :]
    shapes = [np.exp(-(((s - s0) / 0.1) ** 2)) + 0.0 * t for s0 in (0.25, 0.5, 0.75, 0.9)]
    shapes.append(np.exp(-(((s - 0.5 - 2.0 * (t - 0.5)) / 0.25) ** 2)))
    shapes.append(np.exp(-(((s - 0.5) / 0.2) ** 2) - ((t - 0.5) / 0.15) ** 2))
    loads = np.array([(shape * areas).ravel() for shape in shapes])
    return loads / loads.sum(axis=1)[:, None]


@pytest.mark.slow
def test_refining_the_default_mesh_changes_displacements_by_less_than_one_percent():
    fine = MeshDensity(profile=18, lengthwise=36, thickness=5, growth=1.45, fillet=6)
    coarse, finer = (
        tooth_compliance(TOOTH, STEEL, CondensationSettings(density=density))
        for density in (MeshDensity(), fine)
    )
    for a, b in zip(coarse, finer, strict=True):
        loads = distributed_loads(a.s, a.t)
        ratio = np.einsum("ij,jk,ik->i", loads, a.elastic, loads) / np.einsum(
            "ij,jk,ik->i", loads, b.elastic, loads
        )
        # 1 % is what the mesh is to give; measured 0.12 %
        assert np.abs(ratio - 1.0).max() < 0.01


@pytest.mark.slow
def test_coarse_hats_carry_the_image_part():
    """Half-space of a fine pressure plus image of coarse hats is the finite elements' own."""
    mesh = tooth_mesh(TOOTH, MeshDensity())
    s, t = profile_nodes(7), lengthwise_nodes(13)
    s_fine, t_fine = profile_nodes(13), lengthwise_nodes(25)
    forces, gram = normal_hat_loads(mesh, "left", s, t)
    forces_fine, _ = normal_hat_loads(mesh, "left", s_fine, t_fine)
    whole = tooth_model(mesh, STEEL).compliance(np.hstack([forces, forces_fine]))
    n = s.size * t.size
    flank = Flank(TOOTH.left)
    image = projected(whole[:n, :n] - half_space_compliance(flank, s, t, STEEL), gram)
    compliance = FlankCompliance(s=s, t=t, image=image, elastic=whole[:n, :n])
    W = interpolation_weights(s_fine[:, None], t_fine[None, :], compliance)
    total = half_space_compliance(flank, s_fine, t_fine, STEEL) + W @ image @ W.T
    loads = distributed_loads(s_fine, t_fine)
    ratio = np.einsum("ij,jk,ik->i", loads, total, loads) / np.einsum(
        "ij,jk,ik->i", loads, whole[n:, n:], loads
    )
    assert np.abs(ratio - 1.0).max() < 0.01
