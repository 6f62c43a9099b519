"""A tooth pair of a hypoid axle: what loads and moves its film, and formulas beside it.

These modules join the axle model (`dynamics`), the contact of the flanks (`hypoid_contact`) and
the film (`ehl`). In the core none of the three may import another: a film must not need an axle,
and the axle's FMU must not need a film solver. So they meet here. The physics stays in the core;
here it is called, sampled over one engagement and put in the axes of the film.
"""
