"""Design of hypoid pairs: from blank data to machine settings."""
