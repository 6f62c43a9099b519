"""Lubricated gears for vehicle co-simulation.

Start here::

    import gearlube as gl

    axle = gl.read_axle("my_axle.toml").axle                    # or gl.mohammadpour_2015_axle()
    losses = gl.run_loss_map(gl.LossMapSettings(axle=axle))     # an xarray.Dataset
    losses.plot().savefig("map.png")                            # the study's first figure
    losses.report("map")                                        # map/report.html

Its FMU is built by `gearlube build-fmu --axle my_axle.toml`.

The most used names are attributes of `gl`. All others are in these modules:

====================  ============================================================
`gl.gears`            gear and blank files, mesh tables, models of pairs and axles
`gl.train`            drivetrains of bodies and elements
`gl.bearing`          rolling bearings
`gl.oil`              oils
`gl.film`, `gl.ehl`   film formulas; films solved in full
`gl.surface`          rough surfaces
`gl.rating`           rating of gears and bearings
`gl.studies`          studies: settings, runs, readers of results
====================  ============================================================

Settings and models are in SI units (N, m, rad/s, K, Pa); other units stand in names (`speed_kmh`).
A variable of a result has its unit in `attrs["units"]`: maps and cycles are in rpm, degC and km/h,
as their files and figures are. `losses.si()` has all of it in SI.
The stubs `*.pyi` list the names, each with the module that defines it. A module is imported when
one of its names is first used. docs/api.md describes each name and gives an example.

Examples
--------
>>> import gearlube as gl
>>> oil = gl.Lubricant.named("mohammadpour_2015")
>>> round(oil.dynamic_viscosity(gl.celsius_to_kelvin(95.0)), 4)  # Pa s
0.0171
"""

from __future__ import annotations

from typing import Any

from gearlube.lazy_names import lazy_names

_get, __dir__, __all__ = lazy_names(__name__, __file__)


def __getattr__(name: str) -> Any:
    if name == "__version__":
        from gearlube_core import __version__

        return __version__
    return _get(name)
