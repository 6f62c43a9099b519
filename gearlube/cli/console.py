"""The terminal to which messages and progress bars are written."""

from __future__ import annotations

from rich.console import Console

console = Console(stderr=True)
