"""Input files in people's units: data models read from TOML, their notes and errors."""
