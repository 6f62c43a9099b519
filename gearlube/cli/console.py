"""Where messages and progress bars go."""

from __future__ import annotations

from rich.console import Console

console = Console(stderr=True)
