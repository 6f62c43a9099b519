"""Speed sweeps: many operating points of the axle FMU, on one machine or on a cluster."""
