"""Will gears last: damage of flanks, roots and bearings over a duty cycle."""
