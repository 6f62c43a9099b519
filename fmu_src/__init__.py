"""FMI layer: the table of variables, model descriptions, slaves and builders."""
