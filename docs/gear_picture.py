"""Draw the picture of the shipped hypoid pair in docs/gear_file.md: python -m docs.gear_picture."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure
from scipy.spatial.transform import Rotation

from docs.page import IMAGES
from gearlube_core.arrays import Array
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_contact.placement import Placement
from gearlube_core.hypoid_geometry.flank.tooth import Tooth
from gearlube_core.hypoid_geometry.flank.tooth_solid import Solid, gear_solid
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile

STEEL, BRASS = np.array([0.62, 0.68, 0.75]), np.array([0.86, 0.62, 0.33])


def picture(name: str = "mohammadpour_2015") -> Figure:
    """Return a picture of a shipped pair: the whole, and the teeth in mesh seen from the toe."""
    file = HypoidGearFile.named(name)
    pair = FlankPair.from_file(file, "drive")
    members = [
        (gear_solid(Tooth.from_file(file, "gear"), 12, 24, rim=9e-3), pair.gear_placed(0.0), STEEL),
        (
            gear_solid(Tooth.from_file(file, "pinion"), 16, 40, rim=9e-3),
            pair.pinion_placed(0.0),
            BRASS,
        ),
    ]
    figure = Figure(figsize=(11.0, 5.0), dpi=120)
    whole = _view(figure.add_axes((0.0, 0.0, 0.56, 1.0)), members, np.array([0.1, 0.85, -0.5]))
    near = _view(figure.add_axes((0.58, 0.02, 0.41, 0.96)), members, np.array([-0.75, -0.2, -0.42]))
    for axes, (low, high) in ((whole.axes, whole.frame), (near.axes, near.around(pair.mean_point))):
        axes.set_xlim(low[0], high[0])
        axes.set_ylim(low[1], high[1])
        axes.set_aspect("equal")
        axes.axis("off")
    return figure


class View(NamedTuple):
    """A drawn view: its axes, the directions of its sheet, its corners low and high [m]."""

    axes: Axes
    sheet: Array  # (3, 2)
    frame: tuple[Array, Array]

    def around(self, point: Array) -> tuple[Array, Array]:
        """Return the corners of a window around a point of the pair."""
        middle = point @ self.sheet
        return middle - 25e-3, middle + 25e-3


def _view(axes: Axes, members: list[tuple[Solid, Placement, Array]], eye: Array) -> View:
    """Draw the members as seen from the direction `eye`, the gear's teeth up."""
    eye = eye / np.linalg.norm(eye)
    parts = [_lit(solid, placement, eye, base) for solid, placement, base in members]
    corners = np.concatenate([one[0] for one in parts])
    shade = np.concatenate([one[1] for one in parts])
    order = np.argsort((corners @ eye).mean(axis=1))
    up = np.array([0.0, 0.0, -1.0]) + eye[2] * eye
    up /= np.linalg.norm(up)
    sheet = np.stack([np.cross(up, eye), up], axis=1)
    flat, shade = corners[order] @ sheet, shade[order]
    # each triangle is edged in its own colour, else the background shines through the joints
    axes.add_collection(PolyCollection(flat, facecolors=shade, edgecolors=shade, linewidths=0.25))
    ends = flat.reshape(-1, 2)
    return View(axes, sheet, (ends.min(axis=0) - 2e-3, ends.max(axis=0) + 2e-3))


def _lit(solid: Solid, placement: Placement, eye: Array, base: Array) -> tuple[Array, Array]:
    """Return the triangles that face the eye, (f, 3, 3), and their colours, (f, 3)."""
    angle = np.arctan2(placement.sine, placement.cosine)
    turn = Rotation.from_rotvec(angle * np.array(placement.axis))
    point = np.array(placement.point)
    corners = (turn.apply(solid.vertices - point) + point)[solid.faces]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    seen = normal @ eye > 0.0
    corners, normal = corners[seen], normal[seen]
    lamp = eye + np.array([-0.5, 0.5, -0.6])
    lamp /= np.linalg.norm(lamp)
    half = (lamp + eye) / np.linalg.norm(lamp + eye)
    diffuse = np.clip(normal @ lamp, 0.0, 1.0)[:, None]
    gloss = np.clip(normal @ half, 0.0, 1.0)[:, None] ** 30
    return corners, np.clip(base * (0.25 + 0.75 * diffuse) + 0.35 * gloss, 0.0, 1.0)


if __name__ == "__main__":
    picture().savefig(IMAGES / "gear_pair.png")
