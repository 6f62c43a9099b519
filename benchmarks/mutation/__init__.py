"""A mutation run: do the default tests notice faults that are put into the code?

A mutant is the code with one small change (`sites`). It is killed when a default test fails. The
tests nearest to the changed file run first (`reach`), each mutant in a process of its own over a
copy of the tree (`trial`). Results are appended to a file, so a run can be stopped and go on
(`run`); `score` counts them. Mutants that change no result are listed, with the reason, in
`equivalent.toml`; mutants made by hand are in `by_hand.toml`.

mutmut and cosmic-ray were looked at. mutmut keeps all mutants of a function beside each other and
picks one when it is called, which compiled kernels do not see. cosmic-ray starts one command for
each mutant, the same for all: no choice of tests, and a start of four seconds for tests that take
one. What they would leave to do here (choice of tests, caches of compiled code, runs without
compilation) is more than the rest.

    python -m benchmarks.mutation.run /tmp/mutation --count 500
    python -m benchmarks.mutation.score /tmp/mutation
"""
