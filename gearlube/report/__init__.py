"""Reports of studies: findings, figures, tables and inputs in one HTML file."""
