"""Elastohydrodynamic lubrication: Reynolds' equation, deflection and load solved in full.

A film is solved in three steps: an oil, a problem in SI units, a solver. Case files are a short way
to the problem and not needed.

A line contact, here of steel rollers with a relative radius of 14 mm:

>>> from gearlube_core.ehl.line.problem import LineProblem, LineSettings
>>> from gearlube_core.ehl.line.solver import solve_line
>>> from gearlube_core.oil.lubricant import Lubricant
>>> from gearlube_core.oil.named_film_oils import lubricant_from_library
>>> oil = lubricant_from_library(Lubricant.named("karagiannis_2012"), 353.15)  # at 80 degC
>>> contact = LineProblem(lubricant=oil, radius=0.014, line_load=2e5, reduced_modulus=230e9,
...                       speed_1=6.0, speed_2=5.0)
>>> film = solve_line(contact, LineSettings(nodes=201))
>>> film.converged
True
>>> f"{1e6 * film.minimum_film:.2f} um"
'0.44 um'

A point contact; `elliptical_contact` chooses the domain, `PointContactProblem` takes any gap:

>>> from gearlube_core.ehl.point.problem import elliptical_contact
>>> from gearlube_core.ehl.point.solver import solve_point_contact
>>> contact = elliptical_contact(R_x=0.012, R_y=0.06, entrainment=(2.0, 0.0), load=80.0,
...                              contact_modulus=115e9, lubricant=oil, nodes=(33, 33))
>>> film = solve_point_contact(contact)
>>> f"{1e6 * film.central_film:.2f} um"
'0.22 um'

With heat: `line.thermal.solve_thermal_line` and `point.thermal.solver.solve_thermal_point` take the
same problems, both solids and an oil with law="houpert". In time: `line.transient` for lines,
`transient.march.FilmMarch` for points, `gears.helical_cycle` and `gears.hypoid_cycle` for gears.

Solvers raise `ConvergenceError` if a film does not converge; with throw=False they return what was
reached, marked as not converged. Case files of films are read by `case`. Datasets, files and
figures of these solutions: `gearlube.studies.films`.
"""
