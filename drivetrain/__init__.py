"""Vehicle, tyre, engine, drivers and driveline around the axle."""
