"""Sound of a run: bearing forces through a transfer path to pressure, WAV and what one hears."""
