"""FMUs as native libraries: the same kernels, compiled ahead, with FMI functions in C around them."""
