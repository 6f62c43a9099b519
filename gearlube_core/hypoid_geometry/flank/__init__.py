"""Flank surfaces of hypoid gears as their machine settings cut them."""
