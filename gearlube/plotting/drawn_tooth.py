"""A gear tooth as it is drawn: its outline in the axial section, with toe, heel, tip and root."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from gearlube.plotting.style import VERMILLION
from gearlube_core.arrays import Array
from gearlube_core.hypoid_contact.ease_off import MARKING_COMPOUND
from gearlube_core.hypoid_geometry.flank.flank import tooth_region
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile

_LINE = "#404040"
_AROUND = np.linspace(0.0, 2.0 * np.pi, 73)


class ToothWords(NamedTuple):
    """Names of the axes and edges of a drawn tooth, and a sentence on where places are drawn."""

    along: str
    up: str
    left: str
    right: str
    top: str
    bottom: str
    where: str


GEAR_TOOTH = ToothWords(
    "along the face", "height", "toe", "heel", "tip", "root",
    "Drawn on the gear tooth, values of the pinion where it touches the gear.",
)  # fmt: skip


@dataclass(frozen=True, slots=True)
class DrawnTooth:
    """The gear flank turned into the axial section; depth is uniform, so it is a rectangle.

    Parameters
    ----------
    width, height : float
        Face width, and height from root line to tip [mm].
    words : ToothWords
        Names of axes and edges.
    """

    width: float
    height: float
    words: ToothWords = GEAR_TOOTH

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
        ax.set(xlabel=f"{self.words.along} [mm]", ylabel=f"{self.words.up} [mm]")
        ax.grid(visible=False)
        for spine in ax.spines.values():
            spine.set_visible(False)
        look = {"transform": ax.transAxes, "fontsize": 9, "color": _LINE, "fontweight": "bold"}
        ax.text(0.0, 1.02, self.words.left, ha="left", va="bottom", **look)
        ax.text(1.0, 1.02, self.words.right, ha="right", va="bottom", **look)
        ax.text(1.01, 0.97, self.words.top, ha="left", va="top", **look)
        ax.text(1.01, 0.03, self.words.bottom, ha="left", va="bottom", **look)
        if title:
            ax.set_title(title, fontsize=9.5)

    def draw_ease_off(self, ax: Any, part: xr.Dataset, levels: Array, width: float) -> Any:
        """Draw one side's ease-off, pattern of the marking compound and path of contact.

        `levels` are those of the ease-off [um], `width` that of the pattern's line. Returned is
        what a colour bar is made for.
        """
        places = self.along(part["ease_t"]), self.up(part["ease_s"])
        filled = ax.contourf(
            *places, 1e6 * part["ease_off"], levels=levels, cmap="viridis_r", extend="max"
        )
        ax.contour(
            *places,
            part["closest"].fillna(1.0),
            levels=[MARKING_COMPOUND],
            colors=VERMILLION,
            linewidths=width,
        )
        ax.plot(self.along(part["path_t"]), self.up(part["path_s"]), color="black", lw=1.8)
        return filled


def ease_off_levels(dataset: xr.Dataset) -> Array:
    """Return the levels of the ease-off [um] that both sides are drawn with."""
    from matplotlib.ticker import MaxNLocator

    top = float(np.nanpercentile(1e6 * dataset["ease_off"].values, 97))
    return np.asarray(MaxNLocator(12).tick_values(0.0, top))


def ellipse(centre: Array, minor: Array, major: Array, size: float = 1.0) -> tuple[Array, Array]:
    """Return the outline of an ellipse with these semi-axes, each of shape (2,); `size` times."""
    x, y = (
        centre[:, None]
        + size * minor[:, None] * np.cos(_AROUND)
        + size * major[:, None] * np.sin(_AROUND)
    )
    return x, y
