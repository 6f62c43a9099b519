"""The helical pair of He et al. 2007 as a list of bodies and elements, and its numbers.

`write_numbers` gives the numbers of its train from packed parameters, for a native FMU.
"""

from __future__ import annotations

import math

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.dynamics.helical_pair.march.given_pair import GivenBody, GivenPair, MarchChoices
from gearlube_core.dynamics.helical_pair.march.parameters import Body as Member
from gearlube_core.dynamics.helical_pair.march.parameters import HelicalMarchParameters
from gearlube_core.dynamics.helical_pair.supports import (
    bearing_at_gear,
    damping_constant,
    member_stiffness,
)
from gearlube_core.dynamics.train.element import N_COORDINATES, Axes
from gearlube_core.dynamics.train.elements.held_port import (
    HeldPort,
    HeldPortKernels,
    SpeedHolder,
)
from gearlube_core.dynamics.train.elements.helical_mesh import HelicalMesh
from gearlube_core.dynamics.train.elements.helical_mesh_kernels import HelicalMeshKernels
from gearlube_core.dynamics.train.elements.port import Port
from gearlube_core.dynamics.train.elements.spring_support import SpringKernels, SpringSupport
from gearlube_core.dynamics.train.part import Body, Element
from gearlube_core.helical_geometry.gear_body import SupportStiffness
from gearlube_core.kernels.array_part import part
from gearlube_core.kernels.flat_tuples import (
    count_floats,
    flatten,
    tuple_from_array,
    tuple_to_array,
)
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.lubricant_state import LubricantParameters

N_BEARINGS = 4
BEARING_FIELDS = 8  # of one bearing: K_x, K_x_ay, K_y, K_y_ax, K_z, c_x, c_y, c_z
# places in the numbers of the train: oil, sign of each port, mesh, springs and mobility of each
# member
_PORTS = count_floats(LubricantParameters)
_MESH = _PORTS + count_floats(HeldPortKernels) + 1
_SPRINGS = _MESH + count_floats(HelicalMeshKernels)
_N_SPRINGS = count_floats(SpringKernels)
_MOBILITY = _SPRINGS + 2 * _N_SPRINGS
N_NUMBERS = _MOBILITY + 2 * N_COORDINATES


def helical_pair(
    parameters: HelicalMarchParameters, holder: SpeedHolder | None = None
) -> tuple[list[Body], list[Element]]:
    """Return the bodies and elements of a pair, in the axes of `HelicalPairModel`.

    Ports are "input" on the pinion, which drives about -z and whose speed `holder` may hold, and
    "output", a load on the wheel.

    Notes
    -----
    The paper's equations of motion with consistent signs (the pinion's torque drives along -z),
    about a motion that follows the actual rotation of the pinion; flanks press, never pull.
    Products of rotation and tilt (gyroscopic terms) are left out as in the paper. Mesh damping as
    in `mesh_damping`, for either flank by itself.
    Source: [he_2007 (38a)] [he_2007 (38b)] [he_2007 (38c)] [he_2007 (39a)] [he_2007 (39b)]
    [he_2007 (39c)] [he_2007 (40a)] [he_2007 (40b)] [he_2007 (40c)] [he_2007 (41a)] [he_2007 (41b)]
    [he_2007 (41c)]

    Examples
    --------
    >>> from gearlube_core.dynamics.helical_pair.march import gear_file_march
    >>> from gearlube_core.dynamics.train.model import Train
    >>> from gearlube_core.helical_geometry.gear_file import HelicalGearFile
    >>> gears = HelicalGearFile.named("he_2007")
    >>> pair = gear_file_march.helical_march_parameters(gears)
    >>> train = Train(*helical_pair(pair), pair.oil)
    >>> train.initialise({"wheel": 84.4}, {"input": 226.0, "output": 280.0}, 333.15)
    >>> train.step(1e-4, {"input": 226.0, "output": 280.0}, 333.15)
    >>> round(1e6 * train.outputs()["mesh.dte"], 1)  # um
    14.2
    """
    plane = parameters.pair.plane
    held = ("z", "rx", "ry") if parameters.form == "six_dof" else ()
    members = {"pinion": parameters.pinion, "wheel": parameters.gear}
    bodies = [
        Body(
            name=name,
            mass=one.mass,
            inertia=one.inertia,
            polar_inertia=one.polar_inertia,
            held=held,
        )
        for name, one in members.items()
    ]
    mesh = HelicalMesh(
        name="mesh",
        pinion="pinion",
        gear="wheel",
        parameters=parameters,
        angle=math.atan2(plane.r_bp + plane.r_bg, plane.x_g),
        torque_of="input",
    )
    ratio = parameters.support_damping_ratio
    return bodies, [
        HeldPort(name="input", body="pinion", sign=-1.0, holder=holder or SpeedHolder()),
        Port(name="output", body="wheel", sign=-1.0),
        mesh,
        *(spring_support(f"{name} bearings", name, one, ratio) for name, one in members.items()),
    ]


def spring_support(name: str, body: str, member: Member, ratio: float) -> SpringSupport:
    """Return springs and dampers of all bearings of a member, of a damping ratio."""
    return SpringSupport(name=name, body=body, **member_springs(member.given(), ratio)._asdict())


def bearing_shares(parameters: HelicalMarchParameters) -> Array:
    """Return the share of every bearing in the support of its member, see `write_bearing_shares`.

    The shape is (N_BEARINGS * BEARING_FIELDS,).
    """
    shares = np.zeros(N_BEARINGS * BEARING_FIELDS)
    ratio = float(parameters.support_damping_ratio)
    write_bearing_shares(flatten(parameters.given()), ratio, shares)
    return shares


@kernel
def member_springs(body: GivenBody, ratio: float) -> SpringKernels:
    """Return springs and dampers of both bearings of a member together."""
    K = member_stiffness(body.first, body.second)
    return SpringKernels(
        K.K_xx,
        K.K_yy,
        K.K_zz,
        K.K_ax,
        K.K_ay,
        K.K_x_ay,
        K.K_y_ax,
        damping_constant(K.K_xx, body.mass, ratio),
        damping_constant(K.K_yy, body.mass, ratio),
        damping_constant(K.K_zz, body.mass, ratio),
        damping_constant(K.K_ax, body.inertia, ratio),
        damping_constant(K.K_ay, body.inertia, ratio),
    )


@kernel
def _write_share(bearing: SupportStiffness, member: SpringKernels, first: int, out: Array) -> None:
    own = bearing_at_gear(bearing)
    out[first] = own.K_xx
    out[first + 1] = own.K_x_ay
    out[first + 2] = own.K_yy
    out[first + 3] = own.K_y_ax
    out[first + 4] = own.K_zz
    out[first + 5] = member.c_x * own.K_xx / member.K_xx if member.K_xx > 0.0 else 0.0
    out[first + 6] = member.c_y * own.K_yy / member.K_yy if member.K_yy > 0.0 else 0.0
    out[first + 7] = member.c_z * own.K_zz / member.K_zz if member.K_zz > 0.0 else 0.0


@kernel
def write_bearing_shares(given: Array, ratio: float, shares: Array) -> None:
    """Write the share of every bearing in the support force of its member.

    Parameters
    ----------
    given : ndarray
        A `GivenPair` as flat array.
    ratio : float
        Damping ratio of the supports [-].
    shares : ndarray
        BEARING_FIELDS of each of the four bearings. A member's damping is shared in the ratio of
        the bearings' stiffness.
    """
    pair: GivenPair = tuple_from_array(given, GivenPair)
    pinion, gear = member_springs(pair.pinion, ratio), member_springs(pair.gear, ratio)
    _write_share(pair.pinion.first, pinion, 0, shares)
    _write_share(pair.pinion.second, pinion, BEARING_FIELDS, shares)
    _write_share(pair.gear.first, gear, 2 * BEARING_FIELDS, shares)
    _write_share(pair.gear.second, gear, 3 * BEARING_FIELDS, shares)


@kernel
def _write_mobility(body: GivenBody, held: float, first: int, out: Array) -> None:
    out[first] = out[first + 1] = 1.0 / body.mass
    out[first + 2] = (1.0 - held) / body.mass
    out[first + 3] = out[first + 4] = (1.0 - held) / body.inertia
    out[first + 5] = 1.0 / body.polar_inertia


@kernel
def write_numbers(
    given: Array,
    oil: LubricantParameters,
    choices: Array,
    per_mesh_period: float,
    holder: Array,
    numbers: Array,
) -> None:
    """Write the numbers of the train of a pair.

    Parameters
    ----------
    given, choices : ndarray
        Flattened GivenPair and MarchChoices.
    oil : LubricantParameters
    per_mesh_period : float
        Integrator steps per mesh period.
    holder : ndarray of shape (3,)
        Numbers of `SpeedHolder`.
    numbers : ndarray of shape (N_NUMBERS,)
    """
    pair: GivenPair = tuple_from_array(given, GivenPair)
    chosen: MarchChoices = tuple_from_array(choices, MarchChoices)
    ratio = chosen.support_damping_ratio
    tuple_to_array(oil, numbers)
    numbers[_PORTS] = numbers[_MESH - 1] = -1.0
    numbers[_PORTS + 1] = pair.pinion.polar_inertia
    for i in range(holder.size):
        numbers[_PORTS + 2 + i] = holder[i]
    mesh = HelicalMeshKernels(Axes(1.0, 0.0, 1.0, 1.0), 0.0, 0.0, per_mesh_period, 1.0)
    tuple_to_array(mesh, part(numbers, _MESH, _SPRINGS - _MESH))
    of_gear = _SPRINGS + _N_SPRINGS
    tuple_to_array(member_springs(pair.pinion, ratio), part(numbers, _SPRINGS, _N_SPRINGS))
    tuple_to_array(member_springs(pair.gear, ratio), part(numbers, of_gear, _N_SPRINGS))
    _write_mobility(pair.pinion, chosen.held, _MOBILITY, numbers)
    _write_mobility(pair.gear, chosen.held, _MOBILITY + N_COORDINATES, numbers)
