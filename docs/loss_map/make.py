"""Draw the figures of docs/loss_map.md and docs/pair_losses.md: python -m docs.loss_map.make.

About a minute.
"""

from __future__ import annotations

from docs.page import IMAGES
from drivetrain.axle_file.read_axle import read_axle
from gearlube.studies.helical.figures.catalogue import pair_losses
from gearlube.studies.helical.pair_losses import losses_dataset
from gearlube.studies.helical.settings import HelicalSettings
from gearlube.studies.loss_map.figures import loss_contours, loss_split, sensitivity
from gearlube.studies.loss_map.run import run_loss_map
from gearlube.studies.loss_map.settings import LossMapSettings
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.units import celsius_to_kelvin, rpm_to_rads


def main() -> None:
    """Compute the map of the shipped axle and draw it."""
    found = run_loss_map(LossMapSettings(axle=read_axle("mohammadpour_2015").axle))
    drawn = {"contours": loss_contours, "split": loss_split, "sensitivity": sensitivity}
    for name, draw in drawn.items():
        draw(found).savefig(IMAGES / f"loss_map_{name}.png", dpi=110)
    pair = HelicalSettings(
        file=HelicalGearFile.named("he_2007"),
        pinion_torque=226.0,
        pinion_speed=rpm_to_rads(1000.0),
        torques=(50.0, 150.0, 300.0),
        oil="fva_3",
        oil_temperatures=(celsius_to_kelvin(40.0), celsius_to_kelvin(90.0)),
        parts="losses",
    )
    losses = losses_dataset(pair, pair.constant_mesh())
    pair_losses(losses).savefig(IMAGES / "pair_losses.png", dpi=110)


if __name__ == "__main__":
    main()
