# The public names of this module, and the only list of them: the package reads this file, type
# checkers and docs/api.py do too. "# -- " begins a group.

# -- Trains of bodies and elements
from gearlube_core.dynamics.train.part import Body as Body
from gearlube_core.dynamics.train.shaft import Shaft as Shaft
from gearlube_core.dynamics.train.contact_stations import contact_fields as contact_fields
from gearlube_core.dynamics.train.response import frequency_response as frequency_response
from gearlube_core.dynamics.train.response import order_response as order_response
from gearlube_core.shafts.rotor_matrices import read_rotor as read_rotor
from gearlube_core.shafts.rotor_matrices import rotor_beam as rotor_beam
from gearlube_core.shafts.section import ShaftDisc as ShaftDisc
from gearlube_core.shafts.section import ShaftMaterial as ShaftMaterial
from gearlube_core.shafts.section import ShaftSection as ShaftSection
from gearlube_core.dynamics.train.housing import Housing as Housing
from gearlube_core.housings.model_files import read_reduced_model as read_reduced_model
from gearlube_core.housings.reduced_model import InterfaceNode as InterfaceNode
from gearlube_core.housings.reduced_model import ReducedModel as ReducedModel
from gearlube_core.dynamics.train.part import Element as Element
from gearlube_core.kernels.jit import kernel as kernel
from gearlube_core.number import Number as Number
from gearlube_core.dynamics.train.elements.port import Port as Port
from gearlube_core.dynamics.train.elements.held_port import HeldPort as HeldPort
from gearlube_core.dynamics.train.elements.held_port import SpeedHolder as SpeedHolder
from gearlube_core.dynamics.train.elements.motor import Motor as Motor
from gearlube_core.dynamics.train.ripple_table import RippleTable as RippleTable
from gearlube_core.dynamics.train.ripple_table import skew_factor as skew_factor
from gearlube_core.dynamics.train.elements.helical_mesh import HelicalMesh as HelicalMesh
from gearlube_core.dynamics.train.elements.hypoid_mesh import HypoidMesh as HypoidMesh
from gearlube_core.dynamics.train.elements.spring_support import SpringSupport as SpringSupport
from gearlube_core.dynamics.train.elements.opposed_bearings import (
    OpposedBearings as OpposedBearings,
)
from gearlube_core.dynamics.train.elements.roller_bearing import RollerBearing as RollerBearing
from gearlube_core.dynamics.train.elements.ball_bearing import BallBearing as BallBearing
from gearlube_core.dynamics.train.elements.cylindrical_bearing import (
    CylindricalBearing as CylindricalBearing,
)
from gearlube_core.dynamics.train.elements.gear_mesh import GearMesh as GearMesh
from gearlube_core.dynamics.train.elements.joint import Joint as Joint
from gearlube_core.dynamics.train.elements.orbit import Orbit as Orbit
from gearlube_core.dynamics.train.elements.half_shaft import HalfShaft as HalfShaft
from gearlube_core.dynamics.train.elements.differential import Differential as Differential
from gearlube_core.dynamics.train.elements.drag import Seal as Seal
from gearlube_core.dynamics.train.elements.drag import Churning as Churning
from gearlube_core.dynamics.helical_model.pair import helical_pair as helical_pair
from gearlube_core.dynamics.hypoid_axle.as_train import axle_train as axle_train
from gearlube_core.dynamics.hypoid_axle.as_train import axle_values as axle_values
from gearlube_core.dynamics.hypoid_axle.as_train import hypoid_axle as hypoid_axle
from drivetrain.train.train_file import TrainFile as TrainFile
