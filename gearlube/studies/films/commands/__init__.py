"""The commands `gearlube ehl line`, `point`, `helical`, `hypoid` and `compare`."""
