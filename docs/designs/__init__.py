"""Survey of designs of many ratios and offsets."""
