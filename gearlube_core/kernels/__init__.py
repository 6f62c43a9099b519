"""What compiled kernels are made with."""
