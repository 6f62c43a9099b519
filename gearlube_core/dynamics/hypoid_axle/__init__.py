"""The 8-DOF lubricated hypoid axle of Mohammadpour et al. 2015."""
