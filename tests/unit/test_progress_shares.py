"""Shares of progress of long studies, whose parts are stood in for."""

from functools import partial
from types import SimpleNamespace

import xarray as xr

from gearlube.studies.contact import run as contact
from gearlube.studies.contact.settings import QUICK
from gearlube.studies.design import run as design
from gearlube_core.hypoid_contact import contact_dataset as analysis

_PAIR = SimpleNamespace(name="pair")


def test_shares_of_a_design_and_a_contact_rise_and_end_at_1_once_all_is_done(monkeypatch, tmp_path):
    said = []

    def progress(share, _):
        said.append(share)

    def work(*_, progress, **__):
        progress(0.0, "begun")
        progress(1.0, "done")
        return xr.Dataset()

    def part(*_, **__):
        said.append("a part")
        return xr.Dataset()

    monkeypatch.setattr(analysis, "run_cycle", work)
    monkeypatch.setattr(
        design, "design_pair", lambda _, progress, __: (work(progress=progress), _PAIR)[1]
    )
    _PAIR.file = _PAIR
    for module, names in (
        (analysis, "check_pair pair_stiffness contact_dataset"),
        (contact, "contact_table save_pictures contact_report write_report write_dataset "
                  "write_mesh_table"),
        (design, "tooth_form design_dataset write_design"),
    ):  # fmt: skip
        for name in names.split():
            monkeypatch.setattr(module, name, part)
    for run in (partial(contact.run_contact, settings=QUICK), design.run_design):
        for folder in (None, tmp_path):
            said.clear()
            run(_PAIR, folder=folder, progress=progress)
            shares = [one for one in said if one != "a part"]
            assert shares == sorted(shares), run
            assert (shares.count(1.0), said[-1]) == (1, 1.0), run
