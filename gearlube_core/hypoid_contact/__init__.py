"""Tooth contact: everything that writes a mesh table."""
