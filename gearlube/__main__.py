"""Run the command `gearlube` with `python -m gearlube`."""

from gearlube.command import main

main()
