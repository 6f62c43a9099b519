"""The helical pair of He et al. 2007 as a list of bodies and elements."""

from __future__ import annotations

import math

from gearlube_core.dynamics.helical_pair.march.flanks import SupportConstants
from gearlube_core.dynamics.helical_pair.march.parameters import HelicalMarchParameters
from gearlube_core.dynamics.train.elements.helical_mesh import HelicalMesh
from gearlube_core.dynamics.train.elements.port import Port
from gearlube_core.dynamics.train.elements.spring_support import SpringSupport
from gearlube_core.dynamics.train.part import Body, Element


def helical_pair(parameters: HelicalMarchParameters) -> tuple[list[Body], list[Element]]:
    """Return the bodies and elements of a pair, in the axes of `HelicalPairModel`.

    Ports are "input" on the pinion, which drives about -z, and "output", a load on the wheel. The
    train then has the motion of `HelicalPairModel` to the last bit.

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
    plane, motion = parameters.pair.plane, parameters.constants().motion
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
    return bodies, [
        Port(name="input", body="pinion", sign=-1.0),
        Port(name="output", body="wheel", sign=-1.0),
        mesh,
        spring_support("pinion bearings", "pinion", motion.pinion),
        spring_support("wheel bearings", "wheel", motion.gear),
    ]


def spring_support(name: str, body: str, constants: SupportConstants) -> SpringSupport:
    """Return the springs and dampers of a member of a helical pair."""
    given = constants._asdict()
    taken = {one: given[one] for one in given if one.startswith(("K_", "c_"))}
    return SpringSupport(name=name, body=body, **taken)
