"""From a helical gear file to its dynamic transmission error over speed."""

import gearlube as gl


def transmission_error(torque: float, speeds_rpm: list[float]) -> list[float]:
    """Return the peak-to-peak dynamic transmission error [m] at each pinion speed."""
    gear = gl.HelicalGearFile.named("he_2007")  # or HelicalGearFile.from_toml("my_pair.toml")
    pair = gl.gears.helical_pair_parameters(gear, pinion_torque=torque, mu=0.05)
    found = []
    for speed in speeds_rpm:
        response = gl.gears.periodic_response(pair, gl.rpm_to_rads(speed))
        error = response.signal("psi")  # along the line of action
        found.append(float(error.max() - error.min()))
    return found


if __name__ == "__main__":
    speeds = [1000.0, 2000.0, 4000.0, 6000.0, 8000.0]
    for speed, error in zip(speeds, transmission_error(226.0, speeds), strict=True):
        print(f"{speed:6.0f} rpm   {1e6 * error:.3f} um")
