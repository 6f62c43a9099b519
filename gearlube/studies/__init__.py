"""Studies: one folder each, with its settings, run function, datasets, figures and command."""
