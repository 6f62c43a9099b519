"""Where the teeth of a helical pair touch under load, and how stiff they are."""
