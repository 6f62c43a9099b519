"""Study of a drivetrain from a train file: modes, and a run in time."""
