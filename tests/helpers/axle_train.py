"""The state of an axle as that of its train."""

from __future__ import annotations

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.bearings.followed_shaft import N_FOLLOWED
from gearlube_core.bearings.roller_nodes import N_ROLLER_NODES
from gearlube_core.dynamics.hypoid_axle import HypoidAxle
from gearlube_core.dynamics.hypoid_axle import state as of
from gearlube_core.dynamics.train.model import Train

_MEMBERS = (("PHI_P", "W_P", "U_P", "V_P"), ("PHI_G", "W_G", "U_G", "V_G"))
_ENERGIES = {
    "input.work": of.PINION_WORK,
    "output.work": of.WHEEL_WORK,  # a load, which takes work out
    "friction_viscous": of.VISCOUS,
    "friction_boundary": of.BOUNDARY,
    "friction_rolling": of.ROLLING,
    "mesh_damping": of.MESH_DAMPING,
    "bearing_damping": of.BEARING_DAMPING,
    "bearing_torque": of.BEARING_TORQUE,
    "churning": of.CHURNING,
    "seals": of.SEALS,
}
_BOUNDS = {"friction_bound": of.FRICTION_BOUND, "bearing_bound": of.DRAG_BOUND}
_AT_TORQUES = of.N_STATE  # in `HypoidAxle.get_state`: two torques, then the oil's temperature


def train_state(train: Train, axle: HypoidAxle) -> Array:
    """Return what `Train.set_state` takes for a train to go on as an axle does."""
    s, made, found = axle.get_state(), train.assembly, train.get_state()
    n, sizes, kept = len(train.state_names), made.sizes, made.kept
    for i, (phi, w, u, v) in enumerate(_MEMBERS):
        first = 12 * i
        found[first : first + 3] = 1e-6 * s[getattr(of, u) :][:3]
        found[first + 6 : first + 9] = s[getattr(of, v) :][:3]
        found[first + 5], found[first + 11] = s[getattr(of, phi)], s[getattr(of, w)]
    found[24:27] = 1e-6 * s[of.X], s[of.CAGE_P], s[of.CAGE_G]
    for name, place in (made.works | made.losses | made.bounds).items():
        mark = sizes.kept + place - (n - sizes.energies)
        if name in _BOUNDS:  # since the step began
            found[place], found[mark] = s[_BOUNDS[name]], 0.0
            continue
        sign, at = -1.0 if name == "output.work" else 1.0, _ENERGIES[name]
        found[place] = sign * s[at]
        found[mark] = sign * s[of.WORK_MARK + at - of.PINION_WORK]
    found[kept["input"]], found[kept["output"]] = s[_AT_TORQUES : _AT_TORQUES + 2]
    mesh = kept["mesh"]
    found[mesh : mesh + 2] = s[of.LOAD_TORQUE], s[of.SIDE]
    found[mesh + 2] = axle.step_control.reference_stiffness
    if axle.parameters.film == "solved":
        found[mesh + 3 :][: of.N_FILMS] = s[of.FILM_NODES :][: of.N_FILMS]
    for i, body in enumerate(("pinion", "gear")):
        at = kept[f"{body} bearings"]
        found[at : at + N_FOLLOWED] = s[of.KEPT_DRAG + i * N_FOLLOWED :][:N_FOLLOWED]
        if axle.parameters.bearing_torque_loss == "solved_films":
            nodes = s[of.ROLLER_NODES + i * N_ROLLER_NODES :][:N_ROLLER_NODES]
            found[at + N_FOLLOWED :][:N_ROLLER_NODES] = nodes
    found[sizes.states - 1] = s[of.TIME_IN_STEP]
    control = axle.step_control
    rate = control.steps_per_highest_period * control.highest_frequency
    found[-2:] = s[_AT_TORQUES + 2], rate
    return np.array(found)
