"""Whether a line mesh belongs to a pair, and the inertia that the mesh moves."""

from __future__ import annotations

from gearlube_core.checks import check_within
from gearlube_core.errors import ParameterError
from gearlube_core.helical_geometry.contact_line import line_count
from gearlube_core.helical_geometry.pair import HelicalPair
from gearlube_core.mesh_table.line_mesh import LineMesh

_SAME = 1e-6  # of the base pitch


def check_line_mesh(mesh: LineMesh, pair: HelicalPair, most_lines: int) -> None:
    """Raise ParameterError unless the mesh is one of the pair with enough lines, not too many."""
    if (mesh.pinion_teeth, mesh.gear_teeth) != (pair.pinion_teeth, pair.gear_teeth):
        raise ParameterError(
            f"mesh must belong to the pair of {pair.pinion_teeth} and {pair.gear_teeth} "
            f"teeth, got {mesh.pinion_teeth} and {mesh.gear_teeth}. Compute it for this pair."
        )
    close = pair.base_pitch * (1.0 - _SAME), pair.base_pitch * (1.0 + _SAME)
    check_within("mesh.base_pitch", mesh.base_pitch, *close, "m", "Compute it for this pair.")
    check_within("mesh.lines", mesh.lines, line_count(pair.plane), most_lines, "", "Add lines.")


def effective_mass(pair: HelicalPair, pinion_inertia: float, gear_inertia: float) -> float:
    """Return m_e of the relative rotation along the line of action [kg].

    1/m_e = r_bp^2/J_zp + r_bg^2/J_zg

    Parameters
    ----------
    pair
        Base radii.
    pinion_inertia, gear_inertia
        Polar [kg m2].
    """
    r_bp, r_bg = pair.pinion_base_radius, pair.gear_base_radius
    return 1.0 / (r_bp**2 / pinion_inertia + r_bg**2 / gear_inertia)
