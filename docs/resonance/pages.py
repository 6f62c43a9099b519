"""Tables of docs/resonance.md."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from docs.resonance.cases import SEPARATED_FROM, Curve
from docs.resonance.double_count import DoubleCount
from docs.resonance.evidence import Evidence
from docs.resonance.numerics import Agreement, Drift, LinearLimit
from docs.resonance.starts import Start
from docs.resonance.verdicts import Claim, Verdict
from docs.validation.tally import tally
from gearlube_core.periodic.branch import Kind

UM = 1e6


def table(heads: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Return a table of the page."""
    lines = [heads, ["---"] * len(heads), *rows]
    return "\n" + "".join("| " + " | ".join(line) + " |\n" for line in lines)


def claims_table(claims: Sequence[Claim], verdicts: Sequence[Verdict]) -> str:
    """Return the verdicts on the paper's statements."""
    rows = [
        [
            str(claim.number),
            claim.statement,
            claim.source,
            claim.tolerance,
            found.shipped,
            _bold(found.shipped_verdict),
            found.reconstructed,
            _bold(found.reconstructed_verdict),
            found.reason,
        ]
        for claim, found in zip(claims, verdicts, strict=True)
    ]
    heads = ["#", "What the paper says", "Printed in", "Tolerance", "Shipped mesh", "Verdict"]
    return table([*heads, "0 / 0.2 / 0.3 / 0.4 % mismatch", "Verdict", "Reason"], rows)


def flank_table(claims: Sequence[Claim], verdicts: Sequence[Verdict]) -> str:
    """Return the verdicts on what is asked of the shipped mesh alone."""
    rows = []
    for claim, found in zip(claims, verdicts, strict=True):
        value, verdict = found.shipped, _bold(found.shipped_verdict)
        if found.reconstructed != "-":
            value += f"; with mismatch {found.reconstructed}"
            verdict += f"; with mismatch {_bold(found.reconstructed_verdict)}"
        rows.append(
            [
                str(claim.number),
                claim.statement,
                claim.source,
                claim.tolerance,
                value,
                verdict,
                found.reason,
            ]
        )
    return table(
        ["#", "What the paper says", "Printed in", "Tolerance", "Found", "Verdict", "Reason"], rows
    )


def verdict_counts(verdicts: Sequence[Verdict]) -> str:
    """Return one line with how many verdicts of each kind there are."""
    parts = []
    for name, words in (
        ("Shipped mesh", [v.shipped_verdict for v in verdicts]),
        ("reconstructed mesh with mismatch", [v.reconstructed_verdict for v in verdicts]),
    ):
        parts.append(f"{name}: {tally(word for word in words if word != '-')}")
    return "\n" + "; ".join(parts) + ".\n"


def branch_table(evidence: Evidence) -> str:
    """Return folds, bistable range and separation of every response."""
    named = [
        ("Shipped, 2-DOF", evidence.two),
        ("Shipped, 2-DOF, both radii from the table", evidence.paper),
        ("Shipped, 2-DOF, constant radii", evidence.mean),
        ("Shipped, 1-DOF", evidence.one),
        ("Reconstructed, 1-DOF", evidence.reconstructed_one),
        *(
            (f"Reconstructed, 2-DOF, {100.0 * d:g} % mismatch", curve)
            for d, curve in evidence.mismatched.items()
        ),
    ]
    rows = []
    for name, curve in named:
        natural = curve.response.natural_frequency
        rows.append(
            [
                name,
                f"{natural:.0f}",
                _span(curve.bistable),
                _span(curve.separated("up")),
                _span(curve.separated("down")),
                _special(curve, "fold"),
                _special(curve, "period doubling"),
                _sizes(curve, 0.65),
                _sizes(curve, 0.9),
                _sizes(curve, 1.0),
            ]
        )
    heads = ["Pair", "f_n, Hz", "two stable motions", "apart, sweep up", "apart, sweep down"]
    heads += ["folds", "period doubling"]
    return table([*heads, "p-p at 0.65, um", "at 0.9", "at 1.0"], rows)


def double_count_table(found: Sequence[DoubleCount]) -> str:
    """Return claim 14 with numbers."""
    rows = []
    for count in found:
        rows.append(
            [
                f"{100.0 * count.mismatch:g}",
                f"{UM * count.error:.2f}",
                f"{count.relative:g}",
                f"{UM * count.radii:.3f}",
                f"{UM * count.error_in_two_dof:.3f}",
                f"{UM * count.error_in_one_dof:.3f}",
                f"{100.0 * (count.error_in_one_dof / count.radii - 1.0):+.2f}",
            ]
        )
    heads = ["d, %", "R_p0 d/z, um", "w/w_n", "2-DOF, radii vary", "2-DOF, error instead"]
    return table([*heads, "1-DOF, error instead", "1-DOF off, %"], rows)


def twice_counted(evidence: Evidence) -> str:
    """Return what the shipped radii do when they act besides the error that holds them."""
    more = [
        evidence.paper.up(r).peak_to_peak / evidence.two.up(r).peak_to_peak - 1.0
        for r in (0.3, 0.5, 0.65, 0.8, 1.0, 1.2, 1.4)
    ]
    return (
        f"With the shipped mesh that adds {100.0 * min(more):.0f} to {100.0 * max(more):.0f} % "
        "(0.3 to 1.4 w_n) and moves the fold of the upper branch, see the table of branches.\n"
    )


def start_table(starts: Sequence[Start]) -> str:
    """Return where starts lead."""
    names = list(dict.fromkeys(start.name for start in starts))
    rows = []
    for case in dict.fromkeys((start.relative, start.mismatch) for start in starts):
        found = [start for start in starts if (start.relative, start.mismatch) == case]
        sizes = [f"{UM * start.peak_to_peak:.2f} ({start.periods or 'none'})" for start in found]
        rows.append([f"{case[0]:g}", f"{100.0 * case[1]:g}", *sizes])
    return table(["w/w_n", "d, %", *names], rows)


def agreement_table(found: Sequence[Agreement]) -> str:
    """Return continuation beside time integration."""
    rows = [
        [
            f"{a.pair}, {a.form}",
            a.branch,
            f"{a.relative:g}",
            f"{UM * a.continued.peak_to_peak:.3f}",
            f"{UM * a.peak_to_peak:.3f}",
            f"{100.0 * a.off:+.4f}",
            f"{100.0 * a.continued.separation_share:.1f} / {100.0 * a.separation_share:.1f}",
        ]
        for a in found
    ]
    heads = ["Pair", "branch", "w/w_n", "continuation, um", "integration, um", "off, %"]
    return table([*heads, "apart, %"], rows)


def agreement_summary(found: Sequence[Agreement]) -> str:
    """Return one line about the largest distance."""
    worst = max(abs(a.off) for a in found)
    return (
        f"\n{len(found)} motions; largest distance {100.0 * worst:.3f} % (asked: 0.5 %). The "
        "shares apart are counted in steps of 1/512 and 1/256 of the period.\n"
    )


def linear_table(found: Sequence[LinearLimit]) -> str:
    """Return the distance from the exact linear response."""
    rows = [[f.form.replace("_", " "), f"{f.worst:.1e}", f"{f.at:.2f}"] for f in found]
    return table(["Form", "largest relative distance", "at w/w_n"], rows)


def drift_table(found: Sequence[Drift]) -> str:
    """Return what tolerances and states do to the motion."""
    exact = min(found, key=lambda d: (d.rtol, d.states != "x in um")).peak_to_peak
    tolerances = sorted({(d.rtol, d.atol) for d in found}, reverse=True)
    rows = []
    for rtol, atol in tolerances:
        row = [f"{rtol:.0e} / {atol:.0e}"]
        for states in ("two angles", "x in um"):
            d = next(d for d in found if (d.states, d.rtol) == (states, rtol))
            row += [f"{UM * d.peak_to_peak:.3f}", f"{d.peak_to_peak / exact:.3f}"]
            row.append(str(d.evaluations))
        rows.append(row)
    heads = ["rtol / atol", "two angles: p-p, um", "of exact", "evaluations"]
    return table([*heads, "x in um: p-p, um", "of exact", "evaluations"], rows)


def _bold(word: str) -> str:
    return word if word == "-" else f"**{word}**"


def _special(curve: Curve, kind: Kind) -> str:
    places = [
        float(curve.response.relative(point.parameter))
        for segment in curve.response.segments
        for point in segment.branch.of_kind(kind)
    ]
    shown = sorted({f"{place:.3f}" for place in places if place > SEPARATED_FROM})
    return ", ".join(shown) or "none"


def _span(span: tuple[float, float] | None) -> str:
    return "none" if span is None else f"{span[0]:.3f} to {span[1]:.3f}"


def _sizes(curve: Curve, relative: float) -> str:
    points = curve.points.get(relative, [])
    return " / ".join(f"{UM * p.peak_to_peak:.2f}" for p in points) or "none stable"
