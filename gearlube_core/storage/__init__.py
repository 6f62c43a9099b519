"""Files written whole or not at all, stored results, worker processes."""
