"""The decorator of all compiled kernels, and tuples as flat arrays."""
