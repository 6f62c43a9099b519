"""Case files of lubricated contacts."""
