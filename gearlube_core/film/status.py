"""What a loss law says of its own number."""

from __future__ import annotations

IN_RANGE = 0  # within the range that the law was fitted for, as far as it is known
OUT_OF_RANGE = 1  # computed, but outside that range
