"""Helical or spur pair with twelve degrees of freedom and sliding friction, He et al. 2007."""
