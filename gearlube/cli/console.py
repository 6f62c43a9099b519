"""The terminal to which messages and progress bars are written."""

from __future__ import annotations

from rich.console import Console

# no markup: it would take "[mm]" in a heading for a style
console = Console(stderr=True, markup=False)
