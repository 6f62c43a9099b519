"""How fast panels of the e-axle's case move per micrometre of transmission error.

`python examples/e_axle_case_response.py response.png` draws it for both stages up to 5 kHz.
"""

from __future__ import annotations

import sys

import numpy as np

import gearlube as gl

PANELS = {"top": "y", "side": "x", "cover": "z"}  # and the direction normal to each
MESHES = ("stage_1", "stage_2")


def panel_velocities(frequencies: np.ndarray) -> dict[str, np.ndarray]:
    """Return for each mesh the speeds of the panels over its error [1/s], (frequencies, panels)."""
    train = gl.train.TrainFile.named("e_axle_case").case().start()
    moves = [f"case.{name}.displacement.{way}" for name, way in PANELS.items()]
    turns = 2.0 * np.pi * frequencies[:, None]
    return {
        mesh: turns * abs(gl.train.frequency_response(train, mesh, moves, frequencies, 0.01))
        for mesh in MESHES
    }


if __name__ == "__main__":
    import matplotlib.pyplot as plt

    frequencies = np.geomspace(50.0, 5e3, 1500)
    figure, panels = plt.subplots(2, 1, sharex=True, figsize=(7.2, 5.2), layout="constrained")
    for ax, (mesh, speeds) in zip(panels, panel_velocities(frequencies).items(), strict=True):
        for name, speed in zip(PANELS, speeds.T, strict=True):
            ax.loglog(frequencies, 1e-3 * speed, label=name)  # mm/s per um
        ax.set(title=f"error of {mesh.replace('_', ' ')}", ylabel="velocity [mm/s per µm]")
        ax.grid(alpha=0.3)
    panels[0].legend()
    panels[1].set_xlabel("frequency [Hz]")
    figure.savefig(sys.argv[1], dpi=120)
