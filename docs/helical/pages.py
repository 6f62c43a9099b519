"""Tables of docs/helical.md."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
import xarray as xr

from docs.helical.cases import HE
from docs.helical.closed_forms import ZoneDifference
from docs.helical.loaded import C_M, Finer, Sharing, iso
from docs.helical.separation import Curve, overhang
from docs.helical.stiffness_density import Choice, Effect
from docs.helical.structure import SAMPLE, SAMPLE_TEETH, sample_stiffness
from docs.helical.verdicts import Claim, Verdict
from docs.validation.tally import tally

UM = 1e6
_LOWER, _UPPER = 0.08, 0.05  # scatter of the fit of ISO 6336-1


def table(heads: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Return a table of the page."""
    lines = [heads, ["---"] * len(heads), *rows]
    return "\n" + "".join("| " + " | ".join(line) + " |\n" for line in lines)


def claims_table(claims: Sequence[Claim], verdicts: Sequence[Verdict]) -> str:
    """Return the verdicts on a source's statements."""
    rows = [
        [
            claim.name,
            claim.statement,
            claim.source,
            claim.tolerance,
            found.value,
            f"**{found.verdict}**",
            found.reason,
        ]
        for claim, found in zip(claims, verdicts, strict=True)
    ]
    return table(
        ["#", "What the source says", "Printed in", "Tolerance", "Found", "Verdict", "Reason"], rows
    )


def verdict_counts(verdicts: Sequence[Verdict]) -> str:
    """Return one line with how many verdicts of each kind there are."""
    return f"\n{tally(found.verdict for found in verdicts)}.\n"


def zone_table(found: Sequence[ZoneDifference]) -> str:
    """Return closed forms against quadrature."""
    rows = [
        [
            str(d.zone),
            f"{d.deflection:.0e}",
            f"{d.x_moment:.0e}",
            f"{d.z_moment:.0e}",
            f"{100.0 * d.printed:.0f} %",
        ]
        for d in found
    ]
    heads = ["Zone of eq. (24)", "(10b)", "(18a)", "(18b)", "(10b) with the printed x_e"]
    return table(heads, rows)


def limit_table(found: Sequence[tuple[float, float]]) -> str:
    """Return the way to the spur pair."""
    return table(
        ["Helix angle, deg", "delta_z off the spur pair's, rms over peak to peak"],
        [[f"{angle:g}", f"{off:.1e}"] for angle, off in found],
    )


def form_table(found: dict[float, dict[str, float]]) -> str:
    """Return six against twelve degrees of freedom."""
    names = list(next(iter(found.values())))
    rows = [
        [f"{mu:g}", *(f"{100.0 * off[name]:.1f} %" for name in names)] for mu, off in found.items()
    ]
    return table(["mu", *names], rows)


def sample_table() -> str:
    """Return ISO 6336-1 stiffness beside the published example."""
    teeth, values = sample_stiffness()
    rows = [
        [f"z_n{i + 1}", f"{printed:.3f}", f"{ours:.3f}", f"{ours / printed - 1.0:+.0e}"]
        for i, (printed, ours) in enumerate(zip(SAMPLE_TEETH, teeth, strict=True))
    ]
    rows += [
        [f"{name}, N/(mm um)", f"{printed:.5f}", f"{values[name]:.5f}",
         f"{values[name] / printed - 1.0:+.0e}"]
        for name, printed in SAMPLE.items()
    ]  # fmt: skip
    return table(["ISO/TR 6336-30:2017, example 1", "printed", "here", "off"], rows)


def choice_table(choices: Sequence[Choice], effects: Sequence[Effect]) -> str:
    """Return the densities and what they do."""
    rows = [
        [
            c.words,
            " / ".join(f"{z:.2f}" for z in c.teeth),
            f"{c.rack_factor:.3f}",
            f"{c.single:.2f}",
            f"{c.mesh:.2f}",
            f"{1e-9 * c.density:.2f}",
            f"{e.mesh_order:.2f}",
            f"{UM * e.swing:.3f}",
            f"{e.growth[0]:.1f} / {e.growth[1]:.1f}",
            f"{e.growth[2]:.2f}",
            f"{e.off_line:.2f}",
        ]
        for c, e in zip(choices, effects, strict=True)
    ]
    heads = ["Choice", "z_n", "C_B", "c'", "c_gamma_alpha", "k, N/(mm um)", "mesh mode at n"]
    heads += ["delta_z, p-p, um", "u_x grows, n = 1 / 2", "delta_z, n = 2", "u_y off ten times"]
    return table(heads, rows)


def torque_table(contact: xr.Dataset) -> str:
    """Return what load does to the plain pair, and ISO 6336-1 beside it."""
    standard = iso().mesh * HE.face_width
    rows = []
    for torque in contact["torque"].values:
        at = contact.sel(torque=torque)
        mean = float(at["K"].mean())
        off = at["share"] - at["length_share"]
        rows.append(
            [
                f"{torque:.0f}",
                f"{1e-6 * mean:.0f}",
                f"{1e-6 * float(at['K_tangent'].mean()):.0f}",
                f"{mean / standard:.3f}",
                f"{C_M * mean / standard:.3f}",
                f"{100.0 * float(np.ptp(at['K'].values) / mean):.1f}",
                f"{UM * float(at['transmission_error_ptp']):.2f}",
                f"{100.0 * float(at['corner_share'].max()):.1f}",
                f"{100.0 * float(np.abs(off.values).max()):.1f}",
            ]
        )
    heads = ["Pinion torque, N.m", "secant K, N/um", "tangent K", "secant over ISO", "times C_M"]
    heads += ["range of K, %", "error, p-p, um", "corners, most, %"]
    return table([*heads, "share less length share, most, points"], rows)


def sharing_table(found: Sequence[Sharing]) -> str:
    """Return where shares of torque and of length differ."""
    rows = [
        [
            s.words,
            f"{100.0 * s.share:.1f}",
            f"{100.0 * s.length_share:.1f}",
            f"{100.0 * s.extreme:+.1f}",
            f"{s.at:.2f}",
        ]
        for s in found
    ]
    heads = ["One pair of teeth", "share of torque, %", "share of length, %"]
    return table([*heads, "largest difference, points", "mesh periods since its line enters"], rows)


def refinement_table(found: Sequence[Finer]) -> str:
    """Return stiffness with other cells and elements."""
    first = found[0]
    rows = [
        [
            f.words,
            f"{1e-6 * f.secant:.1f}{_change(f.secant, first.secant)}",
            f"{1e-6 * f.tangent:.1f}{_change(f.tangent, first.tangent)}",
            f"{f.share:.4f}{_change(f.share, first.share)}",
        ]
        for f in found
    ]
    return table(["Plain pair", "secant K, N/um", "tangent K, N/um", "largest share"], rows)


def _change(value: float, reference: float) -> str:
    return "" if value == reference else f" ({100.0 * (value / reference - 1.0):+.2f} %)"


def harris_table(rows: Sequence[tuple[str, xr.Dataset]]) -> str:
    """Return the range of the transmission error against torque."""
    torques = sorted({float(t) for _, d in rows for t in d["torque"].values})
    lines = []
    for words, dataset in rows:
        cells = [words, f"{UM * float(np.ptp(dataset['unloaded_error'].values)):.2f}"]
        for torque in torques:
            there = dataset["torque"].values
            at = int(np.argmin(np.abs(there - torque)))
            found = abs(there[at] - torque) < 1e-6 * torque
            value = UM * float(dataset["transmission_error_ptp"].values[at])
            cells.append(f"{value:.2f}" if found else "-")
        lines.append(cells)
    return table(["Error, p-p, um", "unloaded", *(f"{t:.0f} N.m" for t in torques)], lines)


def branch_table(curves: Sequence[Curve]) -> str:
    """Return folds, separation and swings of the branches."""
    rows = []
    for c in curves:
        top = int(c.swing.argmax())
        two = overhang(c)
        rows.append(
            [
                "crowned, " + c.label + f", ζ = {c.damping:g}"
                if c.crowned
                else "plain, " + c.label,
                f"{c.natural_frequency:.0f}",
                f"{UM * c.swing[top]:.1f} at {c.relative[top]:.3f}",
                f"{UM * float(c.linear[:, 1].max()):.1f}",
                _span(c.span(c.lifted)),
                _span(c.span(c.apart)),
                f"{100.0 * float(c.apart.max()):.0f}",
                _places(c.special("fold")),
                _places(c.special("period doubling")),
                f"{UM * two:.1f}" if two > 0.0 else "none",
            ]
        )
    heads = ["Flanks", "f_n, Hz", "largest delta_z, p-p, um", "springs that pull", "lines lift off"]
    heads += ["no contact", "of the time, %", "folds", "period doubling"]
    return table([*heads, "two stable motions apart, um"], rows)


def _span(span: tuple[float, float] | None) -> str:
    return "never" if span is None else f"{span[0]:.2f} to {span[1]:.2f}"


def _places(places: Sequence[float]) -> str:
    return ", ".join(f"{p:.3f}" for p in places) or "none"


def iso_sentence(contact: xr.Dataset, torque: float, bodies: Sequence[Finer]) -> str:
    """Return how far the mean stiffness at a torque is from the standard's, in words."""
    spread = max(abs(body.secant / bodies[0].secant - 1.0) for body in bodies)
    mean = float(contact["K"].sel(torque=torque, method="nearest").mean())
    ratio = C_M * mean / (iso().mesh * HE.face_width)
    within = 1.0 - _LOWER - spread <= ratio <= 1.0 + _UPPER + spread
    inside = "within" if within else "outside"
    return (
        f"At {torque:.0f} N.m it is {ratio / C_M:.3f} of it, times C_M {ratio:.3f}: {inside} "
        f"the scatter and the {100.0 * spread:.1f} % of the body."
    )


def parting_sentence(curves: Sequence[Curve]) -> str:
    """Return with which damping the plain pair parts and has two motions, in words."""
    keeps = [f"{c.damping:g}" for c in curves if c.lifted.max() == 0.0]
    parts = [f"{c.damping:g}" for c in curves if c.apart.max() > 0.0]
    folds = [f"{c.damping:g}" for c in curves if overhang(c) > 0.0]
    return (
        f"With damping ratios of {', '.join(keeps) or 'none of these'} no line of the plain pair "
        f"lifts off at any speed shown; with {', '.join(parts) or 'none'} it loses contact at its "
        f"resonance; with {', '.join(folds) or 'none'} two stable motions lie side by side."
    )
