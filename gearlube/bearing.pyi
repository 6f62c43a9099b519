# The public names of this module, and the only list of them: the package reads this file, type
# checkers and docs/api.py do too. "# -- " begins a group.

# -- Hypoid axle
from gearlube_core.bearings.tapered_roller_bearing import (
    TaperedRollerBearing as TaperedRollerBearing,
)

from gearlube_core.bearings.standalone import RotorOnBearing as RotorOnBearing

# -- Trains of bodies and elements
from gearlube_core.bearings.bearing_under_load import bearing_under_load as bearing_under_load
from gearlube_core.bearings.element_loads import element_loads as element_loads
from gearlube_core.bearings.element_loads import tapered_loads as tapered_loads

# -- Friction of a bearing
from gearlube_core.bearings.bearing_file import BearingFile as BearingFile
from gearlube_core.bearings.losses.geometry import BearingGeometry as BearingGeometry
from gearlube_core.bearings.losses.loss import LossModel as LossModel
from gearlube_core.bearings.losses.loss import bearing_loss as bearing_loss
