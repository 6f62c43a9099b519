"""Films of elliptical and line contacts by a surrogate of solved thermal Eyring films."""
