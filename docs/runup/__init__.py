"""The page of run-ups and its figures."""
