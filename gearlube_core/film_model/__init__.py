"""Films of elliptical contacts by a surrogate of solved thermal Eyring films."""
