"""Helical or spur pair with twelve degrees of freedom and sliding friction, He et al. 2007.

- here: parameters of a pair, from its gear file too, and the accelerations of all coordinates
- `mesh`: contact lines as springs with friction and damping, and the forces they exert
- `supports`: bearings and shafts
- `linear`: flanks that stay in contact; periodic response, harmonics, maps of instability
- `separation`: flanks that part; periodic motions, with derivatives for continuation
- `march`: lines, films and forces in any motion, of which trains make meshes

All three motions have the same lines, strains, forces and mesh damping from `mesh`.
"""
