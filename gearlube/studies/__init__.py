"""Studies: each folder holds the settings, run, datasets, figures and command of one."""
