"""Input files in TOML: data models, notes on their fields, errors."""
