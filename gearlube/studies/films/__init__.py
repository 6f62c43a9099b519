"""The study of lubricated films: solve a case, return a dataset, optionally write files.

There is one function for each kind of film. Each returns an `xarray.Dataset` whose
attribute `converged` is 1 or 0; its attribute `outcome` states the result in a sentence:

- `run_steady.run_line`, `run_point`, `run_helical_line`: a steady film;
- `run_march.run_helical_march`: a helical pair's film in time;
- `run_hypoid.run_hypoid`: the films of a hypoid tooth pair, steady and in time;
- `compare.compare_marches`: several marches of helical pairs in one figure.

>>> from gearlube.studies.films.run_steady import run_line
>>> from gearlube_core.ehl.case.contact_case import LineCase
>>> case = LineCase.named("jamali_2015").varied({"solver.nodes": 201})
>>> film = run_line(case)
>>> film.attrs["converged"]
1

If `folder` is given, NetCDF, summary and figures are written too. `results.write_film_results`
does the same for a dataset. To solve a film without a case file, see `gearlube_core.ehl` for the
solvers and `datasets` for turning their solutions into datasets.
"""
