"""The 8-DOF lubricated hypoid axle of Mohammadpour et al. 2015."""

from gearlube_core.dynamics.hypoid_axle.linearise import linearise
from gearlube_core.dynamics.hypoid_axle.model import HypoidAxle
from gearlube_core.dynamics.hypoid_axle.mohammadpour_2015 import mohammadpour_2015_axle
from gearlube_core.dynamics.hypoid_axle.output_names import OUTPUT_INDEX, OUTPUT_NAMES
from gearlube_core.dynamics.hypoid_mesh.parameters import HypoidAxleParameters

__all__ = [
    "OUTPUT_INDEX",
    "OUTPUT_NAMES",
    "HypoidAxle",
    "HypoidAxleParameters",
    "linearise",
    "mohammadpour_2015_axle",
]
