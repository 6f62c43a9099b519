"""Contacts of a hypoid flank that several tests share."""

import numpy as np

from gearlube_core.ehl.gears.hypoid_film import FlankCycle, HypoidFilm, pair_contact
from gearlube_core.mesh_table.netcdf import shipped_mesh_table
from gearlube_core.oil.film_oil_data import film_oil

SPEED, TORQUE = 144.2, 40.0  # rad/s, N.m
BETA = 0.024  # 1/K


def flank_cycle(phase=None, speed=SPEED):
    """The drive flank of the shipped table at rest's loads."""
    table = shipped_mesh_table("mohammadpour_2015")
    phase = np.linspace(-0.3, 1.2, 31) if phase is None else phase
    contact = pair_contact(table, TORQUE, phase)
    angle = (phase + 1.5) * 2.0 * np.pi / table.pinion_teeth
    return FlankCycle(
        time=angle / speed,
        angle=angle,
        phase=phase,
        load=TORQUE / table.mean("R_p", TORQUE) * contact.share,
        R_x=contact.R_x,
        R_y=contact.R_y,
        entrainment=contact.entrainment * speed,
        sliding=contact.sliding * speed,
    )


def lasting(cycle, at, times):
    """A cycle whose contact is that of one time throughout."""
    now = cycle.at(at)
    count = times.size
    return FlankCycle(
        time=times,
        angle=times * SPEED,
        phase=times * SPEED,
        load=np.full(count, now.load),
        R_x=np.full(count, now.R_x),
        R_y=np.full(count, now.R_y),
        entrainment=np.tile(now.entrainment, (count, 1)),
        sliding=np.tile(now.sliding, (count, 1)),
    )


def hypoid_film(cycle, nodes=(49, 33)):
    """Its film in the axle's oil at 95 degC."""
    return HypoidFilm(
        cycle=cycle,
        lubricant=film_oil(eta0=0.0171, alpha=2.383e-8, eyring_stress=2e6),
        contact_modulus=115.4e9,
        nodes=nodes,
    )
