"""Everything that the verdicts of docs/resonance.md rest on, computed once."""

from __future__ import annotations

import logging
import pickle
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import NamedTuple, TypeVar

from docs.resonance.cases import MISMATCHES, Curve, double_counts, reconstructed, respond
from docs.resonance.contacts import COLD, HOT, Contacts, contacts
from gearlube_core.dynamics.hypoid_torsional.model import HypoidTorsional
from gearlube_core.dynamics.hypoid_torsional.parameters import karagiannis_2012_pair

logger = logging.getLogger("docs.resonance")
T = TypeVar("T")

HIGH_EYRING_STRESS = 5e6  # Pa, where fig. 19a bends


class Both(NamedTuple):
    """What was found with the shipped and with the reconstructed mesh; "-" where it is not asked.

    Mismatches in the second are 0 / 0.2 / 0.3 / 0.4 % in this order. Without a reason that of the
    page stays.
    """

    shipped: str
    shipped_verdict: str
    reconstructed: str = "-"
    reconstructed_verdict: str = "-"
    reason: str | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Evidence:
    """Curves, contacts and identities.

    Parameters
    ----------
    two, one, mean, paper : Curve
        Shipped mesh: 2-DOF with consistent radii, 1-DOF, 2-DOF with constant radii and with both
        radii as in the table.
    reconstructed_one : Curve
        1-DOF with the reconstructed numbers.
    mismatched : dict of float to Curve
        2-DOF with the reconstructed numbers, by ratio mismatch [-].
    contacts : dict of (float, float) to Contacts
        Shipped mesh, by mesh over natural frequency [-] and oil temperature [K].
    high_stress : dict of float to Contacts
        The same at 0.3 with a higher Eyring stress, by oil temperature [K].
    consistent : dict of float to Contacts
        The same at 0.3 with the film's consistent convention and inlet temperature.
    double_counts : list of tuple
        Of `docs.resonance.cases.double_counts`.
    """

    two: Curve
    one: Curve
    mean: Curve
    paper: Curve
    reconstructed_one: Curve
    mismatched: dict[float, Curve]
    contacts: dict[tuple[float, float], Contacts]
    high_stress: dict[float, Contacts]
    consistent: dict[float, Contacts]
    double_counts: list[tuple[float, ...]]

    @property
    def shipped(self) -> HypoidTorsional:
        """The pair with the shipped mesh."""
        return self.two.response.segments[0].problem.model

    @property
    def reconstructed(self) -> HypoidTorsional:
        """The pair with the reconstructed numbers."""
        return self.mismatched[0.0].response.segments[0].problem.model


def kept(work: Path, name: str, compute: Callable[[], T]) -> T:
    """Return what an earlier run left under a name, or compute and leave it."""
    file = work / f"{name}.pkl"
    if file.exists():
        return pickle.loads(file.read_bytes())  # type: ignore[no-any-return]
    logger.info("computing %s", name.replace("_", " "))
    found = compute()
    work.mkdir(parents=True, exist_ok=True)
    file.write_bytes(pickle.dumps(found))
    return found


def gather(work: Path) -> Evidence:
    """Return the evidence, from the folder `work` where an earlier run left it."""
    pair = karagiannis_2012_pair()

    def curve(name: str, **options: str) -> Curve:
        return kept(work, name, lambda: Curve(respond(name, replace(pair, **options))))  # type: ignore[arg-type]

    def mismatched(d: float) -> Curve:
        name = f"mismatch_{1e4 * d:g}"
        return kept(work, name, lambda: Curve(respond(name, reconstructed(d))))

    temperatures = (COLD, HOT)
    return Evidence(
        two=curve("two_dof"),
        one=curve("one_dof", form="one_dof"),
        mean=curve("mean_radii", radii="mean"),
        paper=curve("paper_radii", radii="paper"),
        reconstructed_one=kept(
            work,
            "reconstructed_one",
            lambda: Curve(respond("reconstructed_one", reconstructed(form="one_dof"))),
        ),
        mismatched={d: mismatched(d) for d in MISMATCHES},
        contacts=kept(
            work,
            "contacts",
            lambda: {(r, T): contacts(r, T) for r in (0.3, 1.0) for T in temperatures},
        ),
        high_stress=kept(
            work,
            "contacts_high_stress",
            lambda: {T: contacts(0.3, T, HIGH_EYRING_STRESS) for T in temperatures},
        ),
        consistent=kept(
            work,
            "contacts_consistent",
            lambda: {
                T: contacts(0.3, T, film="consistent", film_temperature="inlet")
                for T in temperatures
            },
        ),
        double_counts=kept(work, "double_count", double_counts),
    )
