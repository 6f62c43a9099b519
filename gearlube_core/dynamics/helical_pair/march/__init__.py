"""Contact lines of a pair in any motion, their films, friction and forces: kernels of a mesh."""
