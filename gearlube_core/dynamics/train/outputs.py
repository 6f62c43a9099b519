"""Outputs of a train: what they are, and the kernel that writes them all."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

from gearlube_core.arrays import Array, Offsets
from gearlube_core.dynamics.mean_power import mean_power
from gearlube_core.dynamics.train.drivers import AllElements
from gearlube_core.dynamics.train.element import BODY_STATES, N_COORDINATES, RATE, RZ, W
from gearlube_core.dynamics.train.part import Body, Element, Hidden, Node
from gearlube_core.dynamics.train.plan import Sizes
from gearlube_core.errors import ParameterError
from gearlube_core.kernels.array_part import part
from gearlube_core.kernels.inlining import inside
from gearlube_core.kernels.jit import kernel
from gearlube_core.number import Output
from gearlube_core.oil.lubricant_state import LubricantState

IDLE_WORK = 1e-12  # J; no efficiency is stated for less work
_MEAN = "mean over the last step"
# of a body: about its axis, and along and about the coordinates that it does not hold
TURNING = (
    Output("angle", "rad", "rotation about z"),
    Output("speed", "rad/s", "speed about z", 100.0),
    Output("acceleration", "rad/s2", "acceleration about z", 1e3),
)
MOVING = {
    **{c: Output(f"displacement.{c}", "m", f"displacement along {c}", 1e-6, "um") for c in "xyz"},
    **{f"r{c}": Output(f"tilt.{c}", "rad", f"tilt about {c}", 1e-5) for c in "xy"},
}

OF_NODE = (*TURNING[:2], *MOVING.values())


def train_outputs(
    bodies: Sequence[Body],
    elements: Sequence[Element],
    works: Iterable[str],
    losses: Iterable[str],
    bounds: Iterable[str],
) -> tuple[Output, ...]:
    """Return all outputs of a train, in the order of the kernel.

    Parameters
    ----------
    bodies, elements
    works, losses, bounds : iterable of str
        Labels of the energies put in and lost, and of bounds of those.

    Raises
    ------
    ParameterError
        Two outputs have one name.
    """
    made = []
    for body in bodies:
        if isinstance(body, Hidden):
            continue
        if isinstance(body, Node):
            made += [named_of(body.name, one) for one in OF_NODE]
            continue
        moving = (one for name, one in MOVING.items() if name not in body.held)
        made += [named_of(body.name, one) for one in (*TURNING, *moving)]
    made += [named_of(one.name, output) for one in elements for output in one.outputs]
    words = {label: label.replace("_", " ") for label in losses}
    made += [
        Output(f"{label}.power_loss", "W", f"power lost in {word}, {_MEAN}", 10.0)
        for label, word in words.items()
    ]
    words_of_bounds = {label: label.replace("_", " ") for label in bounds}
    made += [
        Output(f"{label}.power", "W", f"{word} by solved films, {_MEAN}", 1.0)
        for label, word in words_of_bounds.items()
    ]
    ports = {label: label.removesuffix(".work") for label in works}
    made += [
        Output(f"{port}.power", "W", f"power put in by {port}, {_MEAN}", 1e3)
        for port in ports.values()
    ]
    made.append(
        Output("efficiency", "1", f"1 - losses over the power put in, {_MEAN}; 0 without power")
    )
    made += [Output(f"energy.{one}", "J", f"work put in by {ports[one]}", 100.0) for one in ports]
    made += [Output(f"energy.{one}", "J", f"energy lost in {words[one]}", 100.0) for one in words]
    made += [
        Output(f"energy.{label}", "J", f"{word} by solved films", 1.0)
        for label, word in words_of_bounds.items()
    ]
    made.append(Output("energy.stored", "J", "kinetic and elastic energy", 100.0))
    names = [one.name for one in made]
    for name in names:
        if names.count(name) > 1:
            raise ParameterError(
                f"outputs of a train must have names of their own, got {name!r} twice. Rename the "
                "body or the element."
            )
    return tuple(made)


def named_of(name: str, one: Output) -> Output:
    """Return the record of an output of a body or element under its name in the train."""
    return one._replace(name=f"{name}.{one.name}", text=f"{one.text} of {name}")


@kernel
def outputs_at(sizes: Sizes) -> int:
    """Return where the outputs begin in the `work` of the kernel of `outputs_kernel`."""
    return sizes.integrated + sizes.exchanged


@kernel
def write_work_size(sizes: Sizes) -> int:
    """Return the length of `work` for the kernel of `outputs_kernel`."""
    return outputs_at(sizes) + max(sizes.written, sizes.states)


@kernel
def count_outputs(numbers: Array, sizes: Sizes) -> int:
    """Return how many outputs these numbers and sizes give."""
    count = len(TURNING) * sizes.shown + len(OF_NODE) * sizes.nodes
    for body in range(sizes.shown):
        for i in range(N_COORDINATES - 1):
            mobility = numbers[sizes.first_mobility + N_COORDINATES * body + i]
            count += 1 if mobility > 0.0 else 0
    return count + sizes.outputs + 2 * sizes.energies + 2


@kernel
def write_state(s: Array, slope: Array, numbers: Array, sizes: Sizes, work: Array) -> int:
    """Write all outputs but those of elements and the stored energy, see `outputs_kernel`.

    Returns the place of the first output of an element. `slope` has the rates, read for
    accelerations and, before the first step, for powers.
    """
    first_mobility, works, energies = sizes.first_mobility, sizes.works, sizes.energies
    n, n_state, n_kept = sizes.integrated, sizes.states, sizes.kept
    first, k = n - energies, outputs_at(sizes)
    for body in range(sizes.shown):
        u = BODY_STATES * body
        work[k], work[k + 1], work[k + 2] = s[u + RZ], s[u + W], slope[u + RATE + RZ]
        k += 3
        for i in range(N_COORDINATES - 1):
            if numbers[first_mobility + N_COORDINATES * body + i] > 0.0:
                work[k] = s[u + i]
                k += 1
    for node in range(sizes.shown, sizes.shown + sizes.nodes):
        u = BODY_STATES * node
        work[k], work[k + 1] = s[u + RZ], s[u + W]
        k += 2
        for i in range(N_COORDINATES - 1):
            work[k] = s[u + i]
            k += 1
    of_elements = k
    k += sizes.outputs
    duration = s[n_state - 1]
    lost = put_in = 0.0
    for i in range(works, energies):
        power = mean_power(s, slope, first + i, n_kept + i, duration)
        work[k] = power
        lost += power if i < works + sizes.losses else 0.0
        k += 1
    for i in range(works):
        power = mean_power(s, slope, first + i, n_kept + i, duration)
        work[k] = power
        put_in += max(power, 0.0)
        k += 1
    idle = IDLE_WORK * (1.0 / duration) if duration > 0.0 else IDLE_WORK
    work[k] = 1.0 - lost / put_in if put_in > idle else 0.0
    k += 1
    for i in range(energies):
        work[k] = s[first + i]
        k += 1
    return of_elements


@inside
def of_elements_at(sizes: Sizes) -> int:
    """Return the place of the first output of an element, as `write_state` does."""
    return outputs_at(sizes) + sizes.written - (sizes.outputs + 2 * sizes.energies + 2)


@inside
def energy_at(of_elements: int, sizes: Sizes) -> int:
    """Return the place of the stored energy, the last output."""
    return of_elements + sizes.outputs + 2 * sizes.energies + 1


def outputs_kernel(elements: AllElements, now: Callable[..., None]) -> Callable[..., None]:
    """Return the kernel that writes what `now` gives and then the outputs into `work`.

    Accelerations, and the powers before the first step, are those of `now`, see `now_kernel`.
    The state stays as it is.
    """
    sizes_of, write = elements.sizes_of, elements.write

    @kernel
    def write_all(
        s: Array,
        oil: LubricantState,
        numbers: Array,
        memory: Array,
        plan: Offsets,
        stored: float,
        work: Array,
    ) -> None:
        now(s, oil, numbers, memory, plan, work)
        sizes = sizes_of(plan)
        k = write_state(s, part(work, 0, sizes.integrated), numbers, sizes, work)
        write(s, oil, numbers, memory, plan, part(work, k, sizes.outputs))
        work[energy_at(k, sizes)] = stored

    return write_all
