"""The problem file that makes a designed pair quieter, as `gearlube optimise` takes it."""

from __future__ import annotations

from gearlube_core.hypoid_design.design import Design
from gearlube_core.storage.file_names import pair_stem

PROBLEM = "problem.toml"
SHARES = (0.15, 0.3)  # of the torque of the relief: steady driving, where whine is heard
_CROWNS = (("profile_crown_um", 20.0), ("lead_crown_um", 40.0), ("twist_um", 40.0))


def problem_text(design: Design) -> str:
    """Return the problem of a designed pair as TOML.

    The pinion's settings and cutter, and crowns, twist and tip relief of the drive flanks may
    change; the gear is kept. The coast flanks follow the settings, within limits.

    Parameters
    ----------
    design : Design

    Examples
    --------
    >>> print(problem_text(design))  # doctest: +SKIP
    """
    file, torque = design.file, design.relief.torque
    stem = pair_stem(file.name)
    torques = [float(f"{share * torque:.2g}") for share in SHARES]
    lines = [
        f"# How {stem} may become quieter, as `gearlube design` proposes it. Change what you",
        "# like and run `gearlube optimise` on it. docs/problem_file.md explains each field.",
        "",
        f'name = "{stem[:90]}_quiet"',
        f'gear = "{stem}.toml"',
        f"torques_n_m = {torques}  # of the pinion: 15 and 30 % of {torque:g} N.m, for which the",
        "                            # relief was chosen",
        'side = "drive"',
        "",
        "[parameters]",
        *_parameters(design),
        "",
        "[settings]  # the pinion's, about those of the design",
        'members = ["pinion"]',
        "blades = true",
        "within_mm = 0.3",
        "within_deg = 0.3",
        "",
        "[errors]  # both signs, one at a time",
        "pinion_offset_um = 20.0",
        "pinion_axial_um = 20.0",
        "",
        "[limits]  # times the value of the design",
        "pressure = 1.0",
        "loss = 1.0",
        "sensitivity = 1.0",
        "force_swing = 1.5",
        f"other_side_torques_n_m = {torques[-1:]}  # of coast",
        "other_side_pressure = 1.2",
    ]
    return "\n".join(lines) + "\n"


def _parameters(design: Design) -> list[str]:
    """Return the lines of crowns, twist and tip relief of the drive flanks."""
    lines = [
        f"pinion.drive_flank.{name} = {{ low = {-width}, high = {width}, start = 0.0 }}"
        for name, width in _CROWNS
    ]
    depth = 1e3 * design.designed.blank.whole_depth
    for role in ("pinion", "gear"):
        if f"{role}.drive_flank.tip_relief_um" not in design.file.completed:
            continue
        high = min(2.0 * design.relief.amounts["drive"][f"{role} tip"], 200.0)
        # gear files refuse a relief steeper than a tenth
        least = max(0.08 * depth, 0.011 * high)
        lines += [
            f"{role}.drive_flank.tip_relief_um = {{ low = 1.0, high = {high} }}",
            f"{role}.drive_flank.tip_relief_depth_mm = "
            f"{{ low = {least:.3g}, high = {0.45 * depth:.3g} }}",
        ]
    return lines
