"""Vehicle and driveline around the axle, co-simulation, speed sweeps and their figures."""
