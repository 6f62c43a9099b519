"""Drive cycles: speed over time, what they ask of a drive, and what that loses."""
