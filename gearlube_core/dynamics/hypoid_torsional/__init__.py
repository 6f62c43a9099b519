"""Torsional hypoid gear pair of Karagiannis et al. 2012: two degrees of freedom, or one."""
