"""FMI layer: variable table, model description, slaves, builder and the command line."""
