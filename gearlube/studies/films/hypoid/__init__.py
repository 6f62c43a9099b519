"""The film of a hypoid tooth pair: its load and motion, and film formulas for comparison.

These modules join the axle model (`dynamics`), the contact of the flanks (`hypoid_contact`) and
the film (`ehl`). In the core none of the three may import another: a film must not need an axle
and the axle's FMU must not need a film solver. They are combined here. The physics stays in
the core; here it is sampled over one engagement and transformed to the axes of the film.
"""
