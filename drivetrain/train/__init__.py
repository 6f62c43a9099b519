"""Trains from files: bodies and elements as a user writes them."""
