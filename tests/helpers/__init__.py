"""Operating points, gears and hosts that several tests share."""
