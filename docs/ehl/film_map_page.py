"""Section of docs/ehl.md on the formulas of smooth contacts: tables, picture, failures."""

from __future__ import annotations

import math
import statistics
from collections.abc import Callable, Sequence
from pathlib import Path

from docs.ehl.film_map import (
    ANGLES,
    CHITTENDEN,
    COARSE,
    ELLIPTICITIES,
    FINE,
    FINEST,
    HAMROCK_DOWSON,
    LOADS,
    MATERIALS,
    NIJENBANNING,
    TURNED,
    Contact,
    Film,
    Films,
    all_films,
    grid_error,
    map_contacts,
    refined_contacts,
    spread,
    turned_contacts,
)
from docs.ehl.film_map_picture import draw
from docs.ehl.store import Store
from docs.helical.pages import table

IMAGES = Path(__file__).resolve().parents[1] / "images"
CENTRAL, MINIMUM = "central film", "minimum film"
PAIRS = (
    (CENTRAL, HAMROCK_DOWSON),
    (CENTRAL, CHITTENDEN),
    (CENTRAL, NIJENBANNING),
    (MINIMUM, HAMROCK_DOWSON),
    (MINIMUM, CHITTENDEN),
)
LIMITS = (0.1, 0.2, 0.3)
Group = tuple[str, list[Film]]
_GROUPS: tuple[tuple[str, Callable[[Contact], bool]], ...] = (
    ("all", lambda _: True),
    ("not rigid", lambda contact: not contact.rigid),
    ("fitted", lambda contact: contact.fitted),
    ("fitted, not rigid", lambda contact: contact.fitted and not contact.rigid),
)


def film_map_section(store: Store) -> str:
    """Return the section and draw its picture; what is not computed is said to be missing."""
    films = all_films(store)
    along = [films[c, FINE] for c in map_contacts() if (c, FINE) in films]
    text = (Path(__file__).parent / "text" / "film_map.md").read_text(encoding="utf-8")
    if not along:
        return text + "\nNot computed yet.\n"
    draw(films).savefig(IMAGES / "ehl_film_map.png", dpi=100)
    return "".join(
        (
            text.format(coarse=COARSE, fine=FINE, points=len(map_contacts())),
            _state(films),
            "\n![Solved films over formulas](images/ehl_film_map.png)\n",
            "\nEach marker is a contact; rigid contacts are explained below.\n",
            "\nSolved film divided by the formula. *Rigid*: in Nijenbanning's chart the film of "
            "rigid solids and constant viscosity is the thickest; the formulas of Hamrock and "
            "Dowson and of Chittenden et al. do not cover this case. *Fitted*: W from 1e-7 to "
            "1e-6 and U from 5e-13 to 1e-10, about the range of their fits. Failed contacts count "
            "as outside every limit.\n",
            _spread_table(along),
            "\nBy ellipticity, load and material where not rigid, film divided by Hamrock and "
            "Dowson's, mean and standard deviation:\n",
            _trend_table(along),
            "\nEvery contact, film over Hamrock and Dowson's: central / smallest.\n",
            _map_table(films),
            "\nEntrainment at an angle to the short axis, film over Chittenden's: central / "
            "smallest.\n",
            _angle_table(films),
            "\nEffect of the grid: films in nm on three grids, the order of convergence between "
            "them, and their limit.\n",
            _grid_table(films),
        )
    )


def _state(films: Films) -> str:
    wanted = [*map_contacts(), *(c for c in turned_contacts() if c.angle)]
    found = [films[c, FINE] for c in wanted if (c, FINE) in films]
    failed = [film for film in found if not film.converged]
    first = [film for film in found if film.converged and film.wedge != "upwind-2"]
    limited = [f for f in found if f.converged and f.wedge == "upwind-2" and not f.sound]
    lacking = len(wanted) - len(found)
    both = [c for c in map_contacts() if {(c, COARSE), (c, FINE)} <= films.keys()]
    errors = {q: [100.0 * grid_error(films, c, q) for c in both] for q in (CENTRAL, MINIMUM)}
    told = " and ".join(
        f"{statistics.median(some):.1f} % (at most {max(some):.1f} %) of the {quantity}"
        for quantity, some in errors.items()
    )
    missing = f" {lacking} are not computed yet." if lacking else ""
    return (
        f"\nOf {len(found)} contacts on {FINE} by {FINE} nodes {len(failed)} did not converge"
        f"{_named(failed)}; {len(first)} have a film with the first-order stencil alone"
        f"{_named(first)}; {len(limited)} have more than 1 % of first-order faces"
        f"{_named(limited)}.{missing} They took {sum(film.seconds for film in found):.0f} s of "
        f"one processor, a median of {statistics.median(f.seconds for f in found):.1f} s each. "
        f"By both grids the error of the finer one is {told}.\n"
    )


def _named(films: Sequence[Film]) -> str:
    names = [
        f"k {f.contact.ellipticity:g} M {f.contact.M:g} L {f.contact.L:g}"
        + (f" at {f.contact.angle:g} degrees" if f.contact.angle else "")
        for f in films
    ]
    return f" ({'; '.join(names)})" if names else ""


def _spread_table(films: Sequence[Film]) -> str:
    rows = []
    for quantity, source in PAIRS:
        for words, chosen in _GROUPS:
            some = [film for film in films if chosen(film.contact)]
            good = [film.ratio(quantity, source) for film in some if film.converged]
            found = spread(good, len(some) - len(good), LIMITS)
            rows.append(
                [source, quantity, words, str(found.count), str(found.failed),
                 f"{found.mean:.3f}", f"{found.deviation:.3f}",
                 f"{found.low:.2f} to {found.high:.2f}",
                 *(f"{100.0 * share:.0f} %" for share in found.within)]
            )  # fmt: skip
    heads = ["Formula", "Film", "Contacts", "number", "failed", "mean", "deviation", "range"]
    return table([*heads, *(f"within {100 * limit:.0f} %" for limit in LIMITS)], rows)


def _trend_table(films: Sequence[Film]) -> str:
    groups: list[Group] = []
    elastic = [film for film in films if film.converged and not film.contact.rigid]
    chosen: tuple[tuple[str, tuple[float, ...], Callable[[Contact], float]], ...] = (
        ("k", ELLIPTICITIES, lambda c: c.ellipticity),
        ("M", LOADS, lambda c: c.M),
        ("L", MATERIALS, lambda c: c.L),
    )
    for letter, values, which in chosen:
        for value in values:
            some = [f for f in elastic if which(f.contact) == value]
            groups.append((f"{letter} = {value:g}", some))
    rows = []
    for words, some in groups:
        if len(some) < 2:
            continue
        row = [words]
        for quantity in (CENTRAL, MINIMUM):
            ratios = [film.ratio(quantity, HAMROCK_DOWSON) for film in some]
            row.append(f"{statistics.mean(ratios):.2f} ± {statistics.stdev(ratios):.2f}")
        over = [film.central / film.minimum for film in some]
        rows.append([*row, f"{min(over):.2f} to {max(over):.2f}"])
    return table(["", CENTRAL, MINIMUM, "central over smallest film"], rows)


def _cell(films: Films, contact: Contact, source: str) -> str:
    film = films.get((contact, FINE))
    if film is None:
        return "missing"
    if not film.converged:
        return "**failed**"
    mark = "" if film.sound else " *"
    return f"{film.ratio(CENTRAL, source):.2f} / {film.ratio(MINIMUM, source):.2f}{mark}"


def _map_table(films: Films) -> str:
    rows = [
        [f"{k:g}", f"{L:g}", *(_cell(films, Contact(k, M, L), HAMROCK_DOWSON) for M in LOADS)]
        for k in ELLIPTICITIES
        for L in MATERIALS
    ]
    heads = ["a_y/a_x", "L", *(f"M = {M:g}" for M in LOADS)]
    return table(heads, rows) + "\n\\* first-order faces or stencil.\n"


def _angle_table(films: Films) -> str:
    rows = [
        [f"{k:g}", f"{M:g}", f"{L:g}"]
        + [_cell(films, Contact(k, M, L, angle), CHITTENDEN) for angle in ANGLES]
        for k, M, L in TURNED
    ]
    return table(["a_y/a_x", "M", "L", *(f"{angle:g} degrees" for angle in ANGLES)], rows)


def _grid_table(films: Films) -> str:
    rows = []
    for contact in refined_contacts():
        for quantity in (CENTRAL, MINIMUM):
            if any((contact, n) not in films for n in (COARSE, FINE, FINEST)):
                continue
            h = [1e9 * films[contact, n].height(quantity) for n in (COARSE, FINE, FINEST)]
            first, second = h[1] - h[0], h[2] - h[1]
            falling = first * second > 0.0 and abs(first) > abs(second)
            order = math.log2(first / second) if falling else math.nan
            limit = h[2] + second / 3.0
            rows.append(
                [f"{contact.ellipticity:g}, {contact.M:g}, {contact.L:g}", quantity,
                 *(f"{one:.2f}" for one in h), f"{order:.1f}" if falling else "none",
                 f"{limit:.2f}", f"{100.0 * (h[1] / limit - 1.0):+.1f} %"]
            )  # fmt: skip
    grids = [f"{n} x {n}" for n in (COARSE, FINE, FINEST)]
    heads = ["a_y/a_x, M, L", "Film", *grids, "order", "second-order limit"]
    return table([*heads, f"{FINE} off it"], rows)
