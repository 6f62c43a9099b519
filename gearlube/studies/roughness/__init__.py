"""Study of roughness: surfaces read or made, their statistics, files and figure."""
