"""A command with commands of its own that does without naming the usual one."""

from __future__ import annotations

from typing import Any

from typer.core import TyperGroup


class ShowByDefault(TyperGroup):
    """`gearlube oil my_oil.toml` is `gearlube oil show my_oil.toml`."""

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:
        """Put "show" in front of arguments that name no command."""
        if args and args[0] not in (*self.commands, "--help"):
            args = ["show", *args]
        return super().parse_args(ctx, args)
