"""Help texts of commands with many options have headings."""

from typer.testing import CliRunner

from gearlube.cli.option_groups import GROUPS, MANY
from gearlube.command import COMMANDS, app


def _commands(command):
    below = getattr(command, "commands", {})
    return [one for part in below.values() for one in _commands(part)] if below else [command]


def test_long_help_texts_end_with_where_results_go():
    names = set()
    for lazy in COMMANDS:
        for command in _commands(lazy.load()):
            options = [one for one in command.params if one.param_type_name == "option"]
            names |= {name for one in options for name in one.opts}
            if len(options) >= MANY:
                panels = [one.rich_help_panel for one in options]
                assert panels[-1] == "Results", command.name
                assert len(dict.fromkeys(panels)) == 1 + sum(
                    one != other for one, other in zip(panels[1:], panels, strict=False)
                ), command.name  # options of one heading stand together
    assert set(GROUPS) <= names  # no heading for an option that is gone


def test_headings_stand_in_the_help():
    text = CliRunner().invoke(app, ["map", "--help"]).output
    places = [text.index(f" {one} ─") for one in ("Oil and heat", "Model", "Computing", "Results")]
    assert places == sorted(places)
