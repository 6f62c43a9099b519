"""The axle file: an axle and the car around it in one TOML file."""
