"""Names the scripts among the tests that pytest must not collect."""

# started by tests in processes of their own, in an environment made for them
collect_ignore = ["fmu/importer_ecos.py", "fmu/importer_libcosim.py"]
