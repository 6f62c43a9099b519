"""The study of lubricated films: solve a case, get a dataset, write files and figures if wanted.

One call for each kind of film; all report their progress and return an `xarray.Dataset`, whose
attribute `converged` is 1 or 0 and whose attribute `outcome` says in a sentence how it ended:

- `run_steady.run_line`, `run_point`, `run_helical_line`: a film at rest;
- `run_march.run_helical_march`: a helical pair's film in time;
- `run_hypoid.run_hypoid`: the films of a hypoid tooth pair, steady and in time;
- `compare.compare_marches`: several marches of helical pairs in one figure.

>>> from gearlube.studies.films.run_steady import run_line
>>> from gearlube_core.ehl.case.contact_case import LineCase
>>> case = LineCase.named("jamali_2015").varied({"solver.nodes": 201})
>>> film = run_line(case)
>>> film.attrs["converged"]
1

With `folder` given a run also writes NetCDF, summary and figures; `results.write_film_results`
does the same with any of these datasets. A film needs no case: see `gearlube_core.ehl` for the
solvers, and `datasets` for the datasets of their solutions.
"""
