"""Contact lines as springs: points, loads, friction, damping, forces on both members."""
