"""Load of every ball, or of every slice of every roller, of a bearing under load."""

from __future__ import annotations

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.bearings.ball_rings import BallRings
from gearlube_core.bearings.bearing_under_load import HasRings
from gearlube_core.bearings.cylinder_rings import CylinderRings
from gearlube_core.bearings.losses.geometry import BearingGeometry
from gearlube_core.bearings.roller_loads import ring_loads
from gearlube_core.errors import ParameterError


def element_loads(bearing: HasRings, displacement: Array, *, cage_angle: float = 0.0) -> Array:
    """Return the elastic load of each ball, or of each slice of each roller.

    Parameters
    ----------
    bearing : BallBearing or CylindricalBearing
        As for `bearing_under_load`.
    displacement
        x, y, z [m], rx, ry [rad] of the inner ring, as `bearing_under_load` finds it.
    cage_angle
        Of the first element, from x towards y [rad].

    Returns
    -------
    ndarray, shape (balls,) or (rollers, slices)
        [N]; 0 without contact. For `bearing_life`.

    Examples
    --------
    >>> import gearlube as gl
    >>> bearing = gl.train.BallBearing(
    ...     name="6205", body="shaft", n_balls=9, ball_diameter=7.94e-3, pitch_diameter=38.5e-3,
    ...     inner_groove=0.52, outer_groove=0.53, f0=2.0, f1=3e-4,
    ... )
    >>> found = gl.bearing.bearing_under_load(bearing, [2000.0, 0.0, 0.0, 0.0, 0.0])
    >>> round(float(gl.bearing.element_loads(bearing, found.displacement).max()))  # N
    974
    """
    rings, gaps = bearing.rings()
    x, y, z, rx, ry = np.asarray(displacement, dtype=float)
    angle = cage_angle + 2.0 * np.pi * np.arange(int(rings.n_elements)) / rings.n_elements
    radial, tilted = x * np.cos(angle) + y * np.sin(angle), ry * np.cos(angle) - rx * np.sin(angle)
    if isinstance(rings, BallRings):
        distance = np.hypot(rings.radial + radial, rings.axial + z - rings.arm * tilted)
        return rings.stiffness * np.maximum(distance - rings.centres, 0.0) ** 1.5
    if isinstance(rings, CylinderRings):
        along = (np.arange(gaps.size) - 0.5 * (gaps.size - 1)) * rings.length / gaps.size
        approach = radial[:, None] + tilted[:, None] * along - gaps
        return rings.stiffness * np.maximum(approach, 0.0) ** (10.0 / 9.0)
    raise ParameterError(
        f"element_loads takes ball and cylindrical roller bearings, got {type(bearing).__name__}. "
        "Tapered rollers have `tapered_loads`."
    )


def tapered_loads(geometry: BearingGeometry, *, axial_load: float, radial_load: float) -> Array:
    """Return the load of each roller of a row of tapered rollers, of rigid, coaxial rings.

    Parameters
    ----------
    geometry
        Geometry of the tapered roller bearing.
    axial_load, radial_load
        Of the row, not negative [N].

    Returns
    -------
    ndarray, shape (rollers,)
        [N], on the outer race. For `bearing_life`.

    Raises
    ------
    ParameterError
        The axial load is too small to hold the row together.

    Examples
    --------
    >>> from gearlube_core.bearings.bearing_file import BearingFile
    >>> bearing = BearingFile.named("wingertszahn_2023").geometry()
    >>> loads = tapered_loads(bearing, axial_load=6000.0, radial_load=4000.0)
    >>> round(float(loads.sum() * np.sin(bearing.outer_angle)))
    6000
    """
    loads = np.zeros(geometry.n_rollers)
    if ring_loads(axial_load, radial_load, geometry.dry_rollers(), loads):
        raise ParameterError(
            "axial_load must hold the rollers of a row against radial_load, got "
            f"{axial_load:g} and {radial_load:g} N. Give at least F_r tan(contact angle)/0.8."
        )
    return loads
