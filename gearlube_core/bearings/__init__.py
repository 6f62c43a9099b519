"""Dynamic roller bearings: every roller's orbit, load and film."""
