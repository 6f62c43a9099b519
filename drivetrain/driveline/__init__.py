"""The driveline: casadi equations, steady state, modes, time steps."""
