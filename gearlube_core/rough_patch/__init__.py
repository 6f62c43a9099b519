"""Rough patches: mean flow between them and the load that they carry dry, from given heights."""
