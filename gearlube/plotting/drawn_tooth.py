"""A gear tooth as it is drawn: its outline in the axial section, with toe, heel, tip and root."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import xarray as xr

from gearlube_core.arrays import Array
from gearlube_core.hypoid_geometry.flank.flank import tooth_region
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile

_LINE = "#404040"
_AROUND = np.linspace(0.0, 2.0 * np.pi, 73)


@dataclass(frozen=True, slots=True)
class DrawnTooth:
    """The gear flank turned into the axial section; depth is uniform, so it is a rectangle.

    Parameters
    ----------
    width, height : float
        Face width, and height from root line to tip [mm].
    """

    width: float
    height: float

    @classmethod
    def of_dataset(cls, dataset: xr.Dataset) -> DrawnTooth:
        """Return the tooth of the gear whose file is in the attribute `gear_file`."""
        file = HypoidGearFile.model_validate_json(dataset.attrs["gear_file"])
        region = tooth_region(file.blank(), "gear")
        return cls(1e3 * region.face_width, 1e3 * region.whole_height)

    def along(self, t: Any) -> Array:
        """Return the place along the face [mm] of toe 0 to heel 1."""
        return np.asarray(self.width * np.asarray(t, dtype=float))

    def up(self, s: Any) -> Array:
        """Return the height over the root line [mm] of root 0 to tip 1."""
        return np.asarray(self.height * np.asarray(s, dtype=float))

    def draw(self, ax: Any, title: str = "") -> None:
        """Draw the outline and its names into axes in mm, with the same scale both ways."""
        x, y = [0.0, self.width, self.width, 0.0, 0.0], [0.0, 0.0, self.height, self.height, 0.0]
        ax.plot(x, y, color=_LINE, lw=1.6, zorder=6, clip_on=False)
        ax.set(xlim=(0.0, self.width), ylim=(0.0, self.height), aspect="equal")
        ax.set(xlabel="along the face [mm]", ylabel="height [mm]")
        ax.grid(visible=False)
        for spine in ax.spines.values():
            spine.set_visible(False)
        look = {"transform": ax.transAxes, "fontsize": 9, "color": _LINE, "fontweight": "bold"}
        ax.text(0.0, 1.02, "toe", ha="left", va="bottom", **look)
        ax.text(1.0, 1.02, "heel", ha="right", va="bottom", **look)
        ax.text(1.01, 0.97, "tip", ha="left", va="top", **look)
        ax.text(1.01, 0.03, "root", ha="left", va="bottom", **look)
        if title:
            ax.set_title(title, fontsize=9.5)


def ellipse(centre: Array, minor: Array, major: Array, size: float = 1.0) -> tuple[Array, Array]:
    """Return the outline of an ellipse with these semi-axes, each of shape (2,); `size` times."""
    x, y = (
        centre[:, None]
        + size * minor[:, None] * np.cos(_AROUND)
        + size * major[:, None] * np.sin(_AROUND)
    )
    return x, y
