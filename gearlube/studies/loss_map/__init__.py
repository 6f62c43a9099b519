"""The loss map of an axle: loss torque over torque, speed and oil temperature."""
