"""Draw the figures of docs/loss_map.md: python -m docs.loss_map.make. About a minute."""

from __future__ import annotations

from pathlib import Path

from drivetrain.axle_file.axle_file import read_axle
from gearlube.studies.loss_map.figures import loss_contours, loss_split, sensitivity
from gearlube.studies.loss_map.run import run_loss_map
from gearlube.studies.loss_map.settings import LossMapSettings

IMAGES = Path(__file__).resolve().parents[1] / "images"


def main() -> None:
    """Compute the map of the shipped axle and draw it."""
    found = run_loss_map(LossMapSettings(axle=read_axle("mohammadpour_2015").axle))
    drawn = {"contours": loss_contours, "split": loss_split, "sensitivity": sensitivity}
    for name, draw in drawn.items():
        draw(found).savefig(IMAGES / f"loss_map_{name}.png", dpi=110)


if __name__ == "__main__":
    main()
