"""Study: whine orders of a hypoid pair against its settings, from flanks to vibration."""
