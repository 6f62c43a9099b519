"""What `gearlube helical` finds of the pair of He et al. 2007, as far as the page shows it."""

from __future__ import annotations

import logging
from pathlib import Path

from docs.helical.cases import density
from gearlube.studies.helical.results import HelicalResults
from gearlube.studies.helical.run import run_helical
from gearlube.studies.helical.settings import HelicalSettings
from gearlube_core.dynamics.helical_pair.he_2007 import PINION_SPEED, PINION_TORQUE
from gearlube_core.helical_geometry.gear_file import HelicalGearFile

logger = logging.getLogger("docs.helical")

TORQUES = (25.0, 50.0, 100.0, 160.0, PINION_TORQUE, 300.0, 450.0)  # N.m


def study(store: Path) -> HelicalResults:
    """Run the command's study with the density of `he_2007_pair`.

    Its speed sweep is left at one speed, and its branches with separation are followed here.
    """
    asked = HelicalSettings(
        file=HelicalGearFile.named("he_2007"),
        pinion_torque=PINION_TORQUE,
        pinion_speed=PINION_SPEED,
        speeds=(PINION_SPEED,),
        mesh="density",
        density=density(),
        torques=TORQUES,
        separation_speeds=0,
    )
    logged: list[str] = []

    def log(_: float, sentence: str) -> None:
        stage = sentence.partition(",")[0]
        if stage not in logged:
            logged.append(stage)
            logger.info(stage)

    return run_helical(asked, store=store, progress=log)
