"""Draw docs/images/flank_films.gif: python -m docs.tooth_contact.flank_films [workdir].

The shipped pair at 20, 50 and 150 N.m, 2000 rpm; finished positions are kept in the folder given
as argument, by default build/tooth_contact/flank_films.
"""

from __future__ import annotations

from docs.page import IMAGES, begin
from gearlube.studies.contact.film_option import film_request, write_films
from gearlube.studies.contact.run import ContactResults
from gearlube.studies.contact.settings import QUICK
from gearlube_core.hypoid_contact.contact_dataset import analyse_contact
from gearlube_core.hypoid_contact.contact_table import contact_table
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile


def main() -> None:
    """Analyse the pair and write the animation."""
    work = begin("tooth_contact/flank_films")
    file = HypoidGearFile.named("mohammadpour_2015")
    contact = analyse_contact(file, QUICK, store=work)
    results = ContactResults(contact=contact, mesh_table=contact_table(file, contact))
    request = film_request(2000.0, "mohammadpour_2015", 90.0)
    assert request is not None
    write_films(results, request, IMAGES)


if __name__ == "__main__":
    main()
