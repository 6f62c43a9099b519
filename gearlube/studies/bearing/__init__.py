"""Study of the friction of a tapered roller bearing."""
