"""Files written whole, results kept by key, and processes that share work."""
