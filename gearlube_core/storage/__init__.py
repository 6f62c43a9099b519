"""Files written whole, records of finished work, and the processes that do it."""
