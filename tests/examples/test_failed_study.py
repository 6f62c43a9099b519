"""Studies that fail or are stopped end with the reason and its exit code, whatever the command."""

import logging

from typer.testing import CliRunner

from gearlube import command as cli
from gearlube.cli.exit_codes import FAILED, INTERRUPTED
from gearlube.studies.contact import run as contact
from gearlube.studies.films import run_steady
from gearlube.studies.helical import run as helical
from gearlube.studies.resonance import run as resonance
from gearlube_core.errors import ConvergenceError
from tests.helpers.each import each

STUDIES = [
    ("contact", contact, "run_contact"),
    ("helical", helical, "run_helical"),
    ("resonance", resonance, "run_resonance"),
    ("ehl point", run_steady, "run_point"),
]
ENDS = [
    (ConvergenceError("no motion"), FAILED),
    (OSError("disk full"), FAILED),
    (KeyboardInterrupt(), INTERRUPTED),
]


@each(("command", "module", "name"), STUDIES)
@each(("reason", "code"), ENDS)
def test_it_says_why(command, module, name, reason, code, tmp_path, monkeypatch, caplog):
    def fail(*_, **__):
        raise reason

    monkeypatch.setattr(module, name, fail)
    monkeypatch.chdir(tmp_path)
    caplog.clear()
    with caplog.at_level(logging.WARNING, "gearlube"):
        assert CliRunner().invoke(cli.app, command.split()).exit_code == code
    assert caplog.text
    assert str(reason) in caplog.text
