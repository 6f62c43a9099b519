"""FMUs as native libraries: the same kernels compiled ahead, FMI functions in C around them."""
