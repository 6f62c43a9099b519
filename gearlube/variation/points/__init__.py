"""What each study computes at one point of a variation."""
