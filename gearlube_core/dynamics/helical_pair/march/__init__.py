"""The pair marched in time, at any speed and load: what HelicalPair.fmu steps."""
