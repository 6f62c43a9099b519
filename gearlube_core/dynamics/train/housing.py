"""A housing as a body of a train: modes of a reduced model, with nodes where elements act."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Annotated

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.dynamics.train.elements.housing_motion import CarriedInterface, free_modes
from gearlube_core.dynamics.train.part import GROUND, AxisPlace, Body, Element, Hidden, Node
from gearlube_core.errors import ParameterError
from gearlube_core.helical_geometry.gear_body import DAMPING_RATIO
from gearlube_core.housings.housing_modes import HousingMotion, housing_motion
from gearlube_core.housings.reduced_model import LENGTHS, ReducedModel
from gearlube_core.number import Number, check_fields

_LIMIT = Number("Hz", 0.0, 1e6, text="Modes up to this frequency move; 0: the housing is rigid")


@dataclass(frozen=True, kw_only=True)
class Housing:
    """A housing or case by a reduced finite element model: its rigid motion and its modes.

    Elements act on its nodes: `case.left` is the node `left` of the housing `case`. A free one
    needs mounts, such as a `Joint` from a node to the ground.

    Parameters
    ----------
    name : str
    model : ReducedModel
    free : bool
        Whether the model floats, so that it has six rigid motions; False: it is fixed somewhere.
    highest_frequency : float
        Modes up to this one move [Hz]; all others give their static flexibility at the nodes.
        0: the housing is rigid.
    damping_ratio : float
        Of its elastic modes [-], where the model has no damping.
    model_axes : tuple of str
        Axes of the model along x, y, z of the train, such as ("y", "z", "x") or ("x", "z", "-y").

    Raises
    ------
    ParameterError
        A number is out of range, axes are none, or no node has a name.

    Notes
    -----
    Rotations are small, and forces act where the nodes stand at first.

    Examples
    --------
    >>> from gearlube_core.housings.reduced_model import InterfaceNode
    >>> held = ReducedModel(
    ...     stiffness=np.diag([4e8, 1e8, 1e8]),
    ...     mass=np.eye(3),
    ...     nodes=[InterfaceNode("bore", 0.0, 0.0, 0.0)],
    ...     owner=np.zeros(3, int),
    ...     direction=np.arange(3),
    ... )
    >>> case = Housing(name="case", model=held, free=False)
    >>> [one.name for one in case.members()[0]]
    ['case.bore', 'case.modes_1']
    """

    name: str
    model: ReducedModel
    free: bool = True
    highest_frequency: Annotated[float, _LIMIT] = 5e3
    damping_ratio: Annotated[
        float,
        DAMPING_RATIO._replace(
            text="Damping ratio of its elastic modes, where the model has no damping"
        ),
    ] = 0.01
    model_axes: tuple[str, ...] = ("x", "y", "z")

    def __post_init__(self) -> None:
        check_fields(self)
        if not self.nodes:
            raise ParameterError(f"nodes of {self.name} must have at least one name, got none.")
        self._turned()

    @property
    def nodes(self) -> tuple[str, ...]:
        """Names of the nodes on which elements can act."""
        return tuple(one.name for one in self.model.nodes if one.name)

    def motion(self) -> HousingMotion:
        """Return its modes at the nodes, in the train's axes."""
        found = housing_motion(
            self.model, self.free, self.highest_frequency, self.damping_ratio, self.name
        )
        turned = np.kron(np.eye(2), self._turned())
        return found._replace(shapes=found.shapes @ turned.T)

    def _turned(self) -> Array:
        """Return the matrix that takes vectors of the model into the train's axes."""
        turned = np.zeros((3, 3))
        for row, axis in zip(turned, self.model_axes, strict=False):
            for column, letter in enumerate("xyz"):
                row[column] = (axis == letter) - (axis == f"-{letter}")
        if len(self.model_axes) != 3 or round(np.linalg.det(turned)) != 1:
            raise ParameterError(
                f"model_axes of {self.name} must be three right-handed ones among x, y, z, -x, "
                f"-y, -z, got {', '.join(self.model_axes)}."
            )
        return turned

    def _places(self) -> Iterator[AxisPlace]:
        """Yield where the axis through each node stands from that of the model's origin."""
        turned, metres = self._turned(), LENGTHS[self.model.length_unit]
        for one in self.model.nodes:
            x, y, z = metres * (turned @ one[1:])
            if one.name:
                yield AxisPlace(self.name, f"{self.name}.{one.name}", complex(x, y), float(z))

    def members(self) -> tuple[list[Body], list[Element]]:
        """Return its nodes and modes, and the element that carries them."""
        own = self.motion()
        nodes = [Node.of(self.name, one) for one in self.nodes]
        modes = [
            Hidden.modes(f"{self.name}.modes_{i + 1}", own.mass, held)
            for i, held in enumerate(free_modes(own))
        ]
        carrier = CarriedInterface(
            name=f"{self.name}.nodes",
            nodes=nodes[0].name,
            modes=modes[0].name if modes else GROUND,
            places=tuple(self._places()),
            motion=own,
            highest_frequency=self.highest_frequency,
        )
        return [*nodes, *modes], [carrier]
