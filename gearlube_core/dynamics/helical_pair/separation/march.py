"""March of the pair with tooth separation over mesh periods, with variational equations: kernel."""

from __future__ import annotations

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.dynamics.helical_pair.linear.linear_system import add_product
from gearlube_core.dynamics.helical_pair.mesh.mesh_damping import damping_constant, flank_damping
from gearlube_core.dynamics.helical_pair.separation.system import (
    BY_TORQUE,
    BY_Y0,
    BY_Y1,
    FLANK_DAMPING,
    FLANK_LOAD,
    N_ROWS,
    VALUE,
    SeparationPoints,
    SeparationSystem,
    StagePoints,
    separating_sums,
)
from gearlube_core.kernels.jit import kernel

# columns of a record after the 2n states
FORCE, DRAG_FORCE, CONTACT_SHARE, DAMPING_FORCE = range(4)
N_EXTRA = 4
_SUMS = 5  # that exert forces


def march_work(n: int, columns: int) -> Array:
    """Return work space for `march_separating` with n coordinates."""
    return np.zeros((6 * n + 2 + N_ROWS, columns))


@kernel
def separating_rates(
    q: Array,
    v: Array,
    torque: float,
    speed: float,
    stage: StagePoints,
    system: SeparationSystem,
    strains: Array,
    products: Array,
    sums: Array,
    a: Array,
    v_rate: Array,
) -> tuple[float, float]:
    """Fill the slopes of states and derivatives; return damping force over m_e, k dl in contact.

    Parameters
    ----------
    q, v : ndarray of shape (n, columns)
        Last column: the state. Others, if any: its derivatives by 2n states, torque and speed.
    strains, products, sums : ndarray
        Work space of shapes (2, columns), (N_ROWS, columns), (N_ROWS, N_BY).
    a, v_rate : ndarray of shape (n, columns)
        Written: slopes of v and of q over time; those of the speed's column are for slopes over the
        phase, which the speed divides.
    """
    n, columns = q.shape
    last = columns - 1
    total = stage.total
    strains[:, :] = 0.0
    add_product(1.0, system.E, q, strains)
    touching = separating_sums(
        strains[0, last],
        strains[1, last],
        stage.points,
        stage.used,
        system.backlash,
        system.build_up,
        sums,
    )
    for i in range(N_ROWS):
        by_0, by_1 = sums[i, BY_Y0], sums[i, BY_Y1]
        for j in range(columns):
            products[i, j] = by_0 * strains[0, j] + by_1 * strains[1, j]
        if last > 0:
            products[i, last - 2] += sums[i, BY_TORQUE]
        products[i, last] = sums[i, VALUE]
    for i in range(n):
        c = system.C[i]
        for j in range(columns):
            a[i, j] = -c * v[i, j]
            v_rate[i, j] = v[i, j]
        a[i, last] += torque * system.f[i]
        if last > 0:
            a[i, last - 2] += system.f[i]
    add_product(-1.0, system.K, q, a)
    add_product(1.0, system.W, products[:_SUMS], a)
    psi, psi_rate = n - 1, v[n - 1, last]
    constant = damping_constant(system.damping, total[0])
    drag = 0.0
    for flank in range(2):
        row, closing = FLANK_DAMPING[flank], -1.0 if flank == 0 else 1.0
        elastic = -closing * system.per_force * sums[FLANK_LOAD[flank], VALUE]
        share = sums[row, VALUE] / total[0]
        force = closing * flank_damping(constant, share, closing * psi_rate, elastic)
        if force == -closing * elastic:  # the flank's load limits the damper
            for j in range(last):
                a[psi, j] -= system.per_force * products[FLANK_LOAD[flank], j]
        else:
            by_sum, by_rate = constant / total[0] * psi_rate, constant * share
            for j in range(last):
                a[psi, j] -= by_sum * products[row, j] + by_rate * v[psi, j]
            if last > 0:
                a[psi, last - 2] += 0.5 * force * total[1] / total[0]
        drag += force
    a[psi, last] -= drag
    if last > 0:
        for i in range(n):
            a[i, last - 1] -= a[i, last] / speed
            v_rate[i, last - 1] -= v[i, last] / speed
    return drag, touching


@kernel
def march_separating(
    q: Array,
    v: Array,
    periods: int,
    torque: float,
    speed: float,
    period: float,
    table: SeparationPoints,
    system: SeparationSystem,
    work: Array,
    small: Array,
    record: Array,
) -> None:
    """Advance the state over whole mesh periods by classical Runge-Kutta steps of fourth order.

    Parameters
    ----------
    q, v : ndarray of shape (n, 2n + 3) or (n, 1)
        In: the start in the last column. Out: the end, and in the others its derivatives by the
        2n start states (q, v), the pinion torque [N.m] and the pinion speed [rad/s].
    periods
        Number of mesh periods.
    torque, speed
        Of the pinion [N.m], [rad/s].
    period
        Of the mesh [s], proportional to 1/speed.
    table, system
        Points of the mesh, and matrices.
    work : ndarray of `march_work`
    small : ndarray of shape (N_ROWS, N_BY)
    record : ndarray of shape (periods * steps, 2n + N_EXTRA) or (0, 0)
        Written at the start of each step: q, v, sums of w and r [N], share of stiffness that
        touches [-], damping force over m_e [m/s2].

    Notes
    -----
    The derivatives go through the same stages as the state, so that they are those of the map as
    computed. They do not jump: all forces are continuous in the state.
    """
    n, columns = q.shape
    last = columns - 1
    if last > 0:
        for i in range(n):
            for j in range(last):
                q[i, j] = 1.0 if j == i else 0.0
                v[i, j] = 1.0 if j == n + i else 0.0
    q_s, v_s = work[0:n], work[n : 2 * n]
    q_sum, v_sum = work[2 * n : 3 * n], work[3 * n : 4 * n]
    a, v_rate = work[4 * n : 5 * n], work[5 * n : 6 * n]
    strains = work[6 * n : 6 * n + 2]
    products = work[6 * n + 2 : 6 * n + 2 + N_ROWS]
    steps = table.width.size
    for step in range(periods * steps):
        at = step % steps
        h = table.width[at] * period
        for i in range(n):
            for j in range(columns):
                q_s[i, j] = q[i, j]
                v_s[i, j] = v[i, j]
                q_sum[i, j] = q[i, j]
                v_sum[i, j] = v[i, j]
        for stage in range(4):
            row = (stage + 1) // 2
            drag, touching = separating_rates(
                q_s,
                v_s,
                torque,
                speed,
                StagePoints(table.points[at, row], table.used[at, row], table.total[at, row]),
                system,
                strains,
                products,
                small,
                a,
                v_rate,
            )
            if stage == 0 and record.shape[0] > 0:
                for i in range(n):
                    record[step, i] = q[i, last]
                    record[step, n + i] = v[i, last]
                record[step, 2 * n + FORCE] = small[0, VALUE]
                record[step, 2 * n + DRAG_FORCE] = small[2, VALUE]
                record[step, 2 * n + CONTACT_SHARE] = touching / table.total[at, row, 0]
                record[step, 2 * n + DAMPING_FORCE] = drag
            weight = h / 6.0 if stage == 0 or stage == 3 else h / 3.0
            ahead = h if stage == 2 else 0.5 * h
            for i in range(n):
                for j in range(columns):
                    q_sum[i, j] += weight * v_rate[i, j]
                    v_sum[i, j] += weight * a[i, j]
                    q_s[i, j] = q[i, j] + ahead * v_rate[i, j]
                    v_s[i, j] = v[i, j] + ahead * a[i, j]
        for i in range(n):
            for j in range(columns):
                q[i, j] = q_sum[i, j]
                v[i, j] = v_sum[i, j]
