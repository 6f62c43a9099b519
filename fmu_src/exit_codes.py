"""What the command `gearlube` returns to the shell."""

BAD_ARGUMENT, FAILED, INTERRUPTED = 2, 1, 130
