"""The helical pair as a train: `HelicalPairModel`, which HelicalPair.fmu steps.

- `pair`: its list of bodies and elements, and their numbers from packed parameters
- `outputs`: names of the outputs, which are the FMU's contract, and kernels that write them
- `model`: start, steps, saved states

Physics of the mesh is in `helical_pair.march`; state, steps and equilibrium are those of any train.
"""
