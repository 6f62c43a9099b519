"""Frequencies of the geared rotors by a train of gearlube."""

import itertools
import time
from collections.abc import Sequence
from importlib.metadata import version

from cases import COUNT, PAIR, found_frequencies, serve

import gearlube as gl


def shaft(side: int, longest: float, file: str = "") -> gl.train.Shaft:
    """Return a shaft of sections, or from the matrices of a file."""
    ends = [0.0, *itertools.accumulate(PAIR["lengths"][side])]
    sections = [
        gl.train.ShaftSection(start=a, end=b, outer_diameter=d)
        for (a, b), d in zip(itertools.pairwise(ends), PAIR["diameters"][side], strict=True)
    ]
    discs = [
        gl.train.ShaftDisc(position=ends[node], mass=mass, inertia=inertia, polar_inertia=polar)
        for node, mass, inertia, polar in (*PAIR["discs"][side], PAIR["gears"][side])
    ]
    low, high = PAIR["bearings"][side][0]
    made = {"rotor": gl.train.read_rotor(file)} if file else {
        "sections": sections,
        "discs": discs,
        "material": gl.train.ShaftMaterial(E=PAIR["E"], G=PAIR["G"], density=PAIR["density"]),
    }  # fmt: skip
    return gl.train.Shaft(
        name=("driving", "driven")[side],
        nodes={"low": ends[low], "high": ends[high], "gear": ends[PAIR["gears"][side][0]]},
        longest_element=longest,
        highest_frequency=5e3,
        **made,
    )


def train(longest: float, files: Sequence[str] = ("", "")) -> gl.Train:
    shafts = [shaft(side, longest, file) for side, file in enumerate(files)]
    bearings = [
        gl.train.SpringSupport(
            name=f"{one.name} {end}", body=f"{one.name}.{end}", K_xx=k_x, K_yy=k_y, K_zz=1.0
        )
        for one, (_, k_x, k_y) in zip(shafts, PAIR["bearings"], strict=True)
        for end in ("low", "high")
    ]  # fmt: skip
    mesh = gl.train.GearMesh(
        name="mesh", first="driving.gear", second="driven.gear", face_width=0.1, backlash=1e-3,
        teeth_1=PAIR["teeth"][0], teeth_2=PAIR["teeth"][1], normal_module=PAIR["module"],
        normal_pressure_angle=PAIR["pressure_angle"], stiffness=PAIR["mesh_stiffness"],
    )  # fmt: skip
    ports = [gl.train.Port(name=one.name, body=f"{one.name}.low") for one in shafts]
    return gl.Train(shafts, [*ports, *bearings, mesh], gl.Lubricant.named("mohammadpour_2015"))


def run(mesh: float, first: int = COUNT, files: Sequence[str] = ("", "")) -> dict:
    began = time.perf_counter()
    pair = train(mesh, files)
    built = time.perf_counter()
    torque = 1000.0  # N.m, so that flanks touch
    loads = {"driving": torque, "driven": torque * PAIR["teeth"][1] / PAIR["teeth"][0]}
    pair.initialise({"driving": 0.0}, loads, oil_temperature=333.15)
    found, _ = pair.modes()
    return found_frequencies(found, first, began, built)


if __name__ == "__main__":
    serve(run, version("gearlube"))
