"""A sweep told in one self-contained HTML page."""

from drivetrain.report.html import report_html, write_report

__all__ = ["report_html", "write_report"]
