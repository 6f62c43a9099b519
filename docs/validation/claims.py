"""The statements of Mohammadpour et al. 2015 that a sweep can confirm or refute."""

from __future__ import annotations

import numpy as np
import xarray as xr

from docs.page import FAILS, HOLDS, PARTLY, Claims, Verdict, judge
from docs.validation.measures import (
    amplitude_at,
    log_slope,
    range_text,
    split_rms,
    strongest_other_line,
    unloading_preload,
)
from drivetrain.road_load import RoadLoad, Tyre, mohammadpour_2015_vehicle
from gearlube.studies.sweep.scalars import DOUBLE_SIDED, NONE, SINGLE_SIDED, separation_class
from gearlube_core.bearings.tapered_roller_bearing import TaperedRollerBearing
from gearlube_core.film.point_film import central_film_thickness
from tests.helpers.bearing_statics import natural_frequencies, stiffness

CLAIMS = Claims()


@CLAIMS("32")
def _mesh_frequency(sweep: xr.Dataset) -> Verdict:
    per_kmh = (sweep["mesh_frequency"] / (3.6 * sweep["vehicle_speed"])).values
    error = np.max(np.abs(per_kmh / 5.0 - 1.0))
    return Verdict(
        f"{range_text(sweep['mesh_frequency'].values)} Hz; {np.mean(per_kmh):.3f} Hz per km/h",
        judge(bool(error < 0.03)),
    )


@CLAIMS("33")
def _road_torque(_: xr.Dataset) -> Verdict:
    load = RoadLoad(
        vehicle=mohammadpour_2015_vehicle(),
        tyre=Tyre.from_size("195/65R16", rolling_radius="fraction"),
    )
    speeds = (20.0, 40.0, 60.0, 80.0, 100.0)
    torques = np.array([load.ring_gear_torque(v / 3.6) for v in speeds])
    # m g f + rho/2 C A V^2 with Table A3, by hand, times 0.965 of the unladen radius
    hand = (
        0.965
        * 0.32995
        * np.array(
            [1300 * 9.80665 * 0.0166 + 0.5 * 1.22 * 0.33 * 2.2 * (v / 3.6) ** 2 for v in speeds]
        )
    )
    error = float(np.max(np.abs(torques / hand - 1.0)))
    return Verdict(
        " / ".join(f"{t:.1f}" for t in torques) + " N.m at 20/40/60/80/100 km/h",
        judge(error < 0.01),
    )


@CLAIMS("34")
def _preload_exponent(_: xr.Dataset) -> Verdict:
    def frequency(preload: float) -> float:
        bearing = TaperedRollerBearing.mohammadpour_2015(film="off").with_preload(preload)
        matrix = stiffness(bearing.parameters())
        return float(np.max(natural_frequencies(matrix, 12.0)))

    slope = log_slope(frequency, 4000.0)
    return Verdict(f"exponent {slope:.5f}", judge(abs(slope - 0.05) < 1e-3))


@CLAIMS("35")
def _resonances_shift(sweep: xr.Dataset) -> Verdict:
    modes = sweep["mode_frequency"]
    bearing = [m for m in modes["mode"].values if "axial" in str(m) or "radial" in str(m)]
    low, high = (modes.sel(mode=bearing).isel(preload=i).values for i in (0, -1))
    return Verdict(
        f"{range_text(high / low - 1.0, '{:+.1f}', 100.0)} % from 2500 to 6000 N",
        judge(bool(np.all(high > low))),
    )


@CLAIMS("36")
def _crossing(sweep: xr.Dataset) -> Verdict:
    modes = sweep["mode_frequency"].isel(preload=0)
    low, high = float(sweep["mesh_frequency"].min()), float(sweep["mesh_frequency"].max())
    crossed = [
        f"{m} ({float(modes.sel(mode=m)):.0f} Hz)"
        for m in modes["mode"].values
        if low < float(modes.sel(mode=m)) < high and ("axial" in str(m) or "radial" in str(m))
    ]
    return Verdict(", ".join(crossed) or "none", judge(bool(crossed)))


@CLAIMS("37")
def _bearing_lines(sweep: xr.Dataset) -> Verdict:
    mesh, other = split_rms(sweep, "dte")
    ratio = other / mesh
    speeds = sweep["speed_kmh"].values
    seen = ratio[0] > 0.1
    where = f"at {speeds[seen].min():.0f} km/h and above" if seen.any() else "nowhere"
    line = strongest_other_line(sweep, "dte")[0][seen]
    found = f", strongest at {range_text(line, '{:.0f}')} Hz" if seen.any() else ""
    return Verdict(
        f"lines off the mesh orders above a tenth of their rms: {where}{found}",
        PARTLY if seen.any() and not seen.all() else judge(bool(seen.all())),
    )


@CLAIMS("38")
def _dominance(sweep: xr.Dataset) -> Verdict:
    mesh, other = split_rms(sweep, "dte")
    ratio = other / mesh
    dominated = ratio[0] > 1.0
    # a share that is nowhere noticeable cannot grow in any sense worth reporting
    grows = ratio[-1][dominated] < ratio[0][dominated]
    return Verdict(
        f"others/mesh rms {range_text(ratio[0])} at 2500 N, {range_text(ratio[-1])} at 6000 N",
        HOLDS if dominated.all() and grows.all() else (PARTLY if dominated.any() else FAILS),
    )


@CLAIMS("39")
def _minimum_moves_away(sweep: xr.Dataset) -> Verdict:
    up = (sweep["dte_min"].isel(preload=-1) - sweep["dte_min"].isel(preload=0)).values
    pp = (sweep["dte_pp"].isel(preload=-1) / sweep["dte_pp"].isel(preload=0)).values - 1.0
    share = float(np.mean((up > 0.0) & (pp < 0.0)))
    return Verdict(
        f"minimum {range_text(up, '{:+.2f}', 1e6)} um, p-p {range_text(pp, '{:+.0f}', 100.0)} %; "
        f"both at {100 * share:.0f} % of the speeds",
        HOLDS if share == 1.0 else (PARTLY if share > 0.5 else FAILS),
    )


@CLAIMS("40")
def _radial_amplitude(sweep: xr.Dataset) -> Verdict:
    change = (sweep["radial_pp"].isel(preload=-1) / sweep["radial_pp"].isel(preload=0)).values - 1
    share = float(np.mean(change < 0.0))
    return Verdict(
        f"p-p {range_text(change, '{:+.0f}', 100.0)} %, median {100 * np.median(change):+.0f} %; "
        f"at {100 * share:.0f} % of the speeds",
        HOLDS if share == 1.0 else (PARTLY if share > 0.5 else FAILS),
    )


@CLAIMS("41")
def _cage_lines(sweep: xr.Dataset) -> Verdict:
    at_cage = amplitude_at(sweep, "roller_load", "pinion_cage_frequency")
    relative = at_cage / sweep["roller_load_mean"].values
    present = bool(np.all(relative[0] > 0.01))
    smaller = bool(np.all(relative[-1] < relative[0]))
    absolute = at_cage[-1] / at_cage[0] - 1.0
    return Verdict(
        f"{range_text(relative[0], '{:.1f}', 100.0)} % of the mean load at 2500 N, "
        f"{range_text(relative[-1], '{:.1f}', 100.0)} % at 6000 N; "
        f"absolute {range_text(absolute, '{:+.0f}', 100.0)} %",
        HOLDS if present and smaller else FAILS,
    )


@CLAIMS("42")
def _unloaded_rollers(sweep: xr.Dataset) -> Verdict:
    loaded = float(sweep["bearing_roller_load_min"].min())
    thresholds = []
    for index in (0, -1):
        point = sweep.isel(preload=0, speed=index)
        thresholds.append(
            unloading_preload(
                float(point["pinion_speed"]),
                float(point["pinion_torque"]),
                float(point["wheel_torque"]),
            )
        )
    return Verdict(
        f"smallest roller load {loaded:.0f} N; rollers unload below "
        f"{thresholds[0]:.0f} N preload at the lowest, {thresholds[1]:.0f} N at the highest speed",
        judge(loaded > 0.0),
    )


@CLAIMS("43")
def _efficiency_level(sweep: xr.Dataset) -> Verdict:
    values = sweep["efficiency_mesh"].values
    return Verdict(
        f"{range_text(values, '{:.2f}', 100.0)} %",
        judge(bool(np.all((values >= 0.988) & (values <= 0.992)))),
    )


@CLAIMS("44")
def _efficiency_flat(sweep: xr.Dataset) -> Verdict:
    spread = sweep["efficiency_mesh"].max("speed") - sweep["efficiency_mesh"].min("speed")
    worst = float(spread.max())
    return Verdict(f"spread {100 * worst:.2f} %", judge(worst < 0.003))


@CLAIMS("45")
def _efficiency_and_preload(sweep: xr.Dataset) -> Verdict:
    mesh = sweep["efficiency_mesh"].isel(preload=-1) - sweep["efficiency_mesh"].isel(preload=0)
    axle = sweep["efficiency_axle"].isel(preload=-1) - sweep["efficiency_axle"].isel(preload=0)
    falls = bool(np.all(mesh.values < 0.0))
    return Verdict(
        f"mesh {range_text(mesh.values, '{:+.3f}', 100.0)} %, "
        f"whole axle {range_text(axle.values, '{:+.2f}', 100.0)} %",
        HOLDS if falls else (PARTLY if bool(np.all(axle.values < -1e-4)) else FAILS),
    )


@CLAIMS("46")
def _film_exponent(_: xr.Dataset) -> Verdict:
    slope = log_slope(
        lambda load: central_film_thickness(0.02, 0.99, 0.0171, 2.383e-8, 3.0, load, 230.8e9), 1e3
    )
    return Verdict(f"d ln h/d ln W = {slope:.4f}", judge(abs(slope + 0.073) < 1e-6))


@CLAIMS("47")
def _impact_classes(sweep: xr.Dataset) -> Verdict:
    b2 = 150e-6
    right = (
        separation_class(1e-6, 9e-6, b2) == NONE
        and separation_class(-2e-6, 9e-6, b2) == SINGLE_SIDED
        and separation_class(-160e-6, 9e-6, b2) == DOUBLE_SIDED
    )
    counts = [
        int((sweep["separation"] == kind).sum()) for kind in (NONE, SINGLE_SIDED, DOUBLE_SIDED)
    ]
    return Verdict(
        f"{counts[0]} points in contact, {counts[1]} single-sided, {counts[2]} double-sided",
        judge(right),
    )
