"""The shipped axle under a rising torque: efficiency and mesh force every 10 ms."""

import gearlube as gl

STEP = 1e-4  # s
OIL = gl.celsius_to_kelvin(80.0)
RATIO = gl.gears.shipped_mesh_table("mohammadpour_2015").ratio


def ramp(first: float = 30.0, last: float = 120.0, steps: int = 1000) -> list[tuple[float, ...]]:
    """Return pinion torque [N.m], mesh efficiency [-] and mesh force [N] along the ramp."""
    axle = gl.HypoidAxle(gl.mohammadpour_2015_axle(bearing_preload=2500.0))
    axle.initialise(
        pinion_speed=gl.rpm_to_rads(1500.0), pinion_torque=first, wheel_torque=first * RATIO,
        oil_temperature=OIL,
    )  # fmt: skip
    rows = []
    for n in range(1, steps + 1):
        torque = first + (last - first) * n / steps
        axle.step(STEP, torque, torque * RATIO, OIL)
        if n % 100 == 0:
            rows.append((torque, axle.output("efficiency"), axle.output("mesh.force")))
    return rows


if __name__ == "__main__":
    for torque, efficiency, force in ramp():
        print(f"{torque:6.1f} N.m   {100.0 * efficiency:6.2f} %   {force:7.0f} N")
