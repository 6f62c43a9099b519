"""Study: design of a hypoid or bevel pair from its blank."""
