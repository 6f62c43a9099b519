"""The picture of a report in docs/reports.md."""
