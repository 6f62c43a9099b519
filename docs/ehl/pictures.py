"""The pictures of docs/ehl.md, in the order of the page."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from docs.ehl import figures_cycle, figures_facets, figures_fields
from docs.ehl.lines import GivenUpError
from docs.ehl.store import MissingFilmError, Store


@dataclass(frozen=True, slots=True)
class Picture:
    """A picture, its title and what is said below it."""

    name: str
    title: str
    caption: str
    draw: Callable[[Store], Any]


CYCLE_PICTURES = (
    Picture(
        "cycle_designs",
        "Pressure and film over the cycle",
        "Lines: in motion. Dots: largest pressure of the dry contact of the same gap. Circles: "
        "films at rest; crosses: steps not converged.",
        figures_cycle.designs,
    ),
)
SMOOTH_PICTURES = (
    Picture(
        "transient_steady",
        "In motion and at rest",
        "Design A; oil flows upwards, towards larger x; dotted: relief begins on the line. "
        "Pressures are alike; the film that a relief moving along the line leaves behind is "
        "thinner than that of a line at rest (J14).",
        figures_fields.transient_steady,
    ),
    Picture(
        "sections",
        "Sections",
        "Line contact: of the same gap, speeds and load per length (J15).",
        figures_fields.sections,
    ),
    Picture(
        "crowning",
        "Crowning",
        "In motion. A crown that begins later lowers the pressure at both ends of the cycle; one "
        "that begins close to the end of the face raises it in the middle, and thins the film "
        "there (J5 to J7).",
        figures_cycle.crowns,
    ),
    Picture(
        "linear_relief",
        "Straight relief",
        "Dry contact every 25 steps, films at rest at steps 75 and 500. A corner of the gap "
        "has no largest pressure: these values belong to this grid (J10).",
        figures_cycle.linear_relief,
    ),
    Picture(
        "parabolas",
        "Parabolic share",
        "Below k = 0.3 the pressure rises steeply. The film in motion is thinner than the "
        "film at rest, and at k = 0.02 next to nothing is left of it (J10, J11).",
        figures_cycle.parabolas,
    ),
    Picture(
        "speeds",
        "Speed",
        "Where the film follows the speed to the power 0.68, the points of one step lie at "
        "the same height (J16).",
        figures_cycle.speeds,
    ),
    Picture(
        "powers",
        "Power laws over the cycle",
        "β (beta in the tables) is the power with which the relief grows: 2 is the parabola. "
        "Points: films at rest; lines above: dry contact of the same gap.",
        figures_cycle.powers,
    ),
    Picture(
        "power_contours",
        "Power laws at step 75",
        "β = 1 has a corner, which concentrates the pressure and thins the film; above "
        "β = 2 little changes (J12).",
        figures_fields.power_contours,
    ),
    Picture(
        "power_lines",
        "Power laws along the line",
        "Dry contact; films lie within about 1 % of it, but for the corner of β = 1.",
        figures_fields.power_lines,
    ),
)
FACET_PICTURES = (
    Picture(
        "facets",
        "Facets",
        "Above: largest pressure and smallest film; below: section in the middle of the face."
        " Each edge of a facet makes a spike of pressure, smaller with more facets (F1 to "
        "F6).",
        figures_facets.facets,
    ),
)


def shown(store: Store, pictures: Iterable[Picture], images: Path) -> str:
    """Draw pictures and return them as text; those whose films are missing are left out."""
    text = ""
    for picture in pictures:
        try:
            figure = picture.draw(store)
        except (MissingFilmError, GivenUpError):
            continue
        figure.savefig(images / f"ehl_{picture.name}.png", dpi=100)
        text += f"\n![{picture.title}](images/ehl_{picture.name}.png)\n"
        text += f"\n{picture.caption}\n" if picture.caption else ""
    return text
