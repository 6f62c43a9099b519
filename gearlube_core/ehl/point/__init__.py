"""Point contacts: films at rest, isothermal and thermal."""
