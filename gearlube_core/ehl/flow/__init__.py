"""Flow of an oil film under pressure and shear."""
