"""Run-up and coast-down: the axle taken through a speed ramp, and what is heard on the way."""
