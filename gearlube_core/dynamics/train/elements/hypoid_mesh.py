"""Mesh of a hypoid pinion and its gear."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_mesh.flank_outputs import FLANK_RECORDS
from gearlube_core.dynamics.hypoid_mesh.flanks import N_FRICTION
from gearlube_core.dynamics.hypoid_mesh.node_films import N_FILMS
from gearlube_core.dynamics.hypoid_mesh.parameters import HypoidAxleParameters
from gearlube_core.dynamics.hypoid_mesh.tooth_pair import EXACT
from gearlube_core.dynamics.packed_mesh import N_CHANNELS
from gearlube_core.dynamics.ranges import Range
from gearlube_core.dynamics.train.element import Listed
from gearlube_core.dynamics.train.elements.hypoid_mesh_kernels import HypoidMeshKernels
from gearlube_core.dynamics.train.elements.hypoid_mesh_places import OWN_FILMS
from gearlube_core.dynamics.train.elements.mesh_outputs import FILM_SHARE, MESH_OUTPUTS
from gearlube_core.dynamics.train.part import Element
from gearlube_core.friction.flank_laws import MixedFlankFriction
from gearlube_core.number import Output


@dataclass(frozen=True, slots=True, kw_only=True)
class HypoidMesh(Element):
    """Mesh of a hypoid pair: that of the axle of [mohammadpour_2015], between any two bodies.

    I_p w_p' = T_p - R_p F + T_fr,p ; I_g w_g' = -T_g + R_g F + T_fr,g
    m_p u_p'' = -n F - f xi + F_b,p ; m_g u_g'' = +n F + f xi + F_b,g

    Displacements of both bodies are those of the axle's frame; rz of a body is its rotation about
    its own axis in the drive direction.

    Parameters
    ----------
    name, pinion, gear : str
        Of the mesh, and of the bodies that carry its gears.
    parameters : HypoidAxleParameters
        Mesh table, damping, friction and films; masses for the limit of the step alone.
    torque_of : str, optional
        Port whose torque selects the level of the mesh table; default: that of the mesh.

    Notes
    -----
    The printed [mohammadpour_2015 (1)] c-h has the opposite sign of n F to the one that
    [mohammadpour_2015 (2)] implies, and no flank friction in the lateral equations: with equations
    as printed it is so. Torques are those of [mohammadpour_2015 (6)].

    Examples
    --------
    >>> from gearlube_core.dynamics.hypoid_axle import mohammadpour_2015_axle
    >>> axle = mohammadpour_2015_axle()
    >>> mesh = HypoidMesh(name="mesh", pinion="pinion", gear="gear", parameters=axle)
    >>> mesh.losses[:2]
    ('friction_viscous', 'friction_boundary')
    """

    name: str
    pinion: str
    gear: str
    parameters: HypoidAxleParameters
    torque_of: str | None = None
    kind: ClassVar = "hypoid_mesh"
    interpreted: ClassVar = (Listed(HypoidMeshKernels, (MixedFlankFriction,), 15),)
    on: ClassVar = ("pinion", "gear")
    beside: ClassVar = ("torque_of",)
    states: ClassVar = (
        Output("transmission_error", "m", "dynamic transmission error", 1e-5, "um"),
    )
    losses: ClassVar = ("friction_viscous", "friction_boundary", "friction_rolling", "mesh_damping")
    bounds: ClassVar = ("friction_bound",)
    outputs: ClassVar = (
        *MESH_OUTPUTS,
        Output("force", "N", "normal mesh force", 1e3),
        *FLANK_RECORDS,
    )
    levels: ClassVar = ("load_torque",)
    events: ClassVar = (
        Output("event.drive_flank", "1", "deflection of the drive flanks over 1 um"),
        Output("event.coast_flank", "1", "distance of the coast flanks from contact over 1 um"),
        Output("event.side", "1", "place of the pinion from the middle of the gap over 1 um"),
    )

    def variants(self) -> tuple[type, ...]:
        """Return the class of the friction law."""
        return (type(self.parameters.kernel_parameters().flank_law),)

    def sizes(self) -> tuple[int, ...]:
        """Return the sizes of the mesh table and of the film model."""
        packed = self.parameters.packed_mesh()
        film = self.parameters.film_model().size
        return packed.levels.size, packed.orders, packed.nodes, packed.series_size, film

    def numbers(self) -> HypoidMeshKernels:
        """Return the constants of the kernels."""
        given, p = self.parameters, self.parameters.kernel_parameters()
        R_p = given.mean_pinion_radius
        R_g = R_p * p.ratio
        return HypoidMeshKernels(
            p.mesh,
            p.lateral_sign,
            p.friction,
            p.rolling,
            p.ratio,
            p.reduced_modulus,
            float(given.steps_per_mesh_period),
            R_p * R_p / p.I_p + R_g * R_g / p.I_g + 1.0 / p.m_p + 1.0 / p.m_g,
            R_p,
            p.ranges,
            p.flank_law,
        )

    def memory(self) -> Array:
        """Return the mesh table, its data at the present load, friction and the film model."""
        packed = self.parameters.packed_mesh()
        table = packed.levels, packed.series.ravel(), packed.windows.ravel()
        now = packed.series_size + packed.window_size + N_FRICTION + N_CHANNELS
        head = np.array([np.nan, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, EXACT, 0.0])
        return np.concatenate([head, *table, np.zeros(now), self.parameters.film_model()])

    def ranges(self) -> tuple[Range, ...]:
        """Return the ranges of mesh table, oil and formulas, and that of solved films."""
        return (*self.parameters.ranges, FILM_SHARE)

    def kept_size(self) -> int:
        """Return the places of load level, side, stiffness at the start and films."""
        return OWN_FILMS + (N_FILMS if self.parameters.film == "solved" else 0)
