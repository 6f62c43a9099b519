"""Where the teeth of a hypoid pair touch under load: what writes a mesh table."""
