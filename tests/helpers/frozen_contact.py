"""Loaded cells of a hypoid pair, frozen, and cut again out of changed flanks."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from gearlube_core.contact.half_space import love_coefficients
from gearlube_core.hypoid_contact.loaded_contact import LoadedSettings, MeshPosition
from gearlube_core.hypoid_contact.placement import tooth_position
from gearlube_core.hypoid_contact.strips import StripSettings, cut_strip
from gearlube_core.tooth_compliance.flank_compliance import interpolation_weights
from tests.helpers.loaded_cases import stiffness

SOFT_TEETH = stiffness()
SETTINGS = LoadedSettings(strips=StripSettings(cells_across=10, cells_along=14), tolerance=1e-9)
TORQUE, PHASE = 80.0, 0.3


class Frozen:
    """The same strips and loaded cells cut out of other flanks, solved by elimination."""

    def __init__(self, pair, phase=PHASE, torque=TORQUE):
        self.pair, self.torque = pair, torque
        self.state = MeshPosition.at(pair, phase, pairs=1).load(torque, SOFT_TEETH, SETTINGS)
        self.carrying = [one for one in self.state.pairs if (one.forces > 0.0).any()]

    def system(self, pair):
        """Return compliance, gap, arm, and strips with their loaded cells."""
        blocks, gaps, arms, strips = [], [], [], []
        for loaded in self.carrying:
            old = loaded.strip
            angles = loaded.phase * pair.gear_pitch, loaded.phase * pair.pinion_pitch
            half = 0.5 * old.cell[0] * old.gap.shape[0]
            strip = cut_strip(pair, *angles, old.frame, half, SETTINGS.strips)
            there = loaded.forces > 0.0
            i, j = np.nonzero(there)
            table = love_coefficients(*old.cell, *old.gap.shape, SOFT_TEETH.contact_modulus)
            block = table[abs(i[:, None] - i), abs(j[:, None] - j)]
            for flank, parameters, tooth in (
                (pair.pinion, strip.pinion_parameters, SOFT_TEETH.pinion),
                (pair.gear, strip.gear_parameters, SOFT_TEETH.gear),
            ):
                place = tooth_position(flank, flank.sample_parameters(parameters[there]).r)
                spread = interpolation_weights(*place, tooth).toarray()
                block = block + spread @ tooth.image @ spread.T
            blocks.append(block)
            gaps.append(strip.gap[there])
            arms.append(strip.arm[there])
            strips.append((strip, there))
        size = sum(gap.size for gap in gaps)
        whole, at = np.zeros((size, size)), 0
        for block in blocks:
            whole[at : at + len(block), at : at + len(block)] = block
            at += len(block)
        return whole, np.concatenate(gaps), np.concatenate(arms), strips

    def quantities(self, pair):
        """Return the quantities of `loaded_rates` and the shares, flat."""
        whole, gap, arm, strips = self.system(pair)
        n = gap.size
        bordered = np.block([[whole, -arm[:, None]], [arm[None], np.zeros((1, 1))]])
        solved = np.linalg.solve(bordered, np.append(-gap, self.torque))
        forces, rotation = solved[:n], solved[n]

        def cells(name):
            return np.concatenate([getattr(strip, name)[there] for strip, there in strips])

        normal, point = cells("normal"), cells("point")
        force = np.linalg.norm(forces @ normal)
        first, highest = self.marked
        touching = gap[first] / arm[first]
        axis, origin = pair.pinion_axis_placed
        slip = np.cross(-axis, point - origin) - np.cross(pair.gear.axis, point) / pair.ratio
        slip -= np.einsum("ni,ni->n", slip, normal)[:, None] * normal
        gear = pair.gear
        own = [gear.sample_parameters(strip.gear_parameters[there]).r for strip, there in strips]
        s, t = tooth_position(gear, np.concatenate(own))
        ends = np.cumsum([0, *(there.sum() for _, there in strips)])
        shares = [arm[a:b] @ forces[a:b] / self.torque for a, b in pairwise(ends)]
        return np.array(
            [
                rotation,
                touching,
                forces @ cells("gear_arm"),
                force,
                force**2 / self.torque / (rotation - touching),
                forces[highest] / cells("area")[highest],
                forces @ np.linalg.norm(slip, axis=1) / self.torque,
                forces @ s / forces.sum(),
                forces @ t / forces.sum(),
                *shares,
            ]
        )

    @property
    def marked(self):
        there = [one.forces > 0.0 for one in self.carrying]
        pressure = np.concatenate(
            [p.pressure[m] for p, m in zip(self.carrying, there, strict=True)]
        )
        touching = np.concatenate(
            [(p.strip.gap / p.strip.arm)[m] for p, m in zip(self.carrying, there, strict=True)]
        )
        return int(np.argmin(touching)), int(np.argmax(pressure))
