"""Roughness given or made: profiles and maps, filters, statistics, generator, extrusion."""
