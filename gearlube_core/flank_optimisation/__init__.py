"""Better flanks: reliefs, crowns and settings that lower the mesh orders of loaded error."""
