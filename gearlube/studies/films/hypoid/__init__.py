"""A tooth pair of a hypoid axle: what loads and moves its film, and formulas beside it.

These modules join the axle model (`dynamics`), the contact of the flanks (`hypoid_contact`) and
the film (`ehl`). In the core none of the three may import another, so they meet here.
"""
