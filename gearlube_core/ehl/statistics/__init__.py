"""Statistics of rough films in time, from solved films alone."""
