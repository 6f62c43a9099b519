"""The architecture page: its picture and its tables come from the import contracts."""
