"""Eigenvalues of a general real matrix as a kernel: balancing, Hessenberg form, shifted QR.

References
----------
J. H. Wilkinson and C. Reinsch, Handbook for Automatic Computation II: Linear Algebra, Springer
1971, contributions II/11 (balancing), II/13 (Hessenberg form) and II/14 (hqr).
"""

from __future__ import annotations

import math

from gearlube_core.arrays import Array
from gearlube_core.kernels.jit import kernel

OK = 0
NOT_CONVERGED = 1
NOT_FINITE = 2

_GAIN = 0.95  # of the norms: less is not worth another scaling
_EXCEPTIONAL = 10  # every so many steps a shift of another kind ends cycles
_MAX_STEPS = 60  # for one eigenvalue; usually 2 or 3


@kernel
def _balance(a: Array, n: int) -> None:
    """Scale rows and columns by powers of 2, which round nothing, until their norms compare."""
    changed = True
    while changed:
        changed = False
        for i in range(n):
            row = 0.0
            column = 0.0
            for j in range(n):
                if j != i:
                    row += abs(a[i * n + j])
                    column += abs(a[j * n + i])
            if row == 0.0 or column == 0.0:
                continue
            factor = 1.0
            while column * factor < 0.5 * row / factor:
                factor *= 2.0
            while column * factor >= 2.0 * row / factor:
                factor *= 0.5
            if column * factor + row / factor < _GAIN * (column + row):
                changed = True
                for j in range(n):
                    a[i * n + j] /= factor
                    a[j * n + i] *= factor


@kernel
def _to_hessenberg(a: Array, n: int, v: Array) -> None:
    """Reflect a matrix to zeros below its first lower diagonal; `v` of shape (n,) is scratch."""
    for k in range(n - 2):
        largest = 0.0
        for i in range(k + 2, n):
            largest = max(largest, abs(a[i * n + k]))
        if largest == 0.0:
            continue
        largest = max(largest, abs(a[(k + 1) * n + k]))
        total = 0.0
        for i in range(k + 1, n):
            v[i] = a[i * n + k] / largest
            total += v[i] * v[i]
        length = math.copysign(math.sqrt(total), v[k + 1])
        half = total + abs(v[k + 1] * length)  # half the square of the reflector
        v[k + 1] += length
        for j in range(k, n):
            dot = 0.0
            for i in range(k + 1, n):
                dot += v[i] * a[i * n + j]
            for i in range(k + 1, n):
                a[i * n + j] -= v[i] * dot / half
        for i in range(n):
            dot = 0.0
            for j in range(k + 1, n):
                dot += a[i * n + j] * v[j]
            for j in range(k + 1, n):
                a[i * n + j] -= dot / half * v[j]
        for i in range(k + 2, n):
            a[i * n + k] = 0.0


@kernel
def _first_row(h: Array, n: int, last: int, norm: float) -> int:
    """Return the first row of the block that ends in row `last` and does not split further."""
    for row in range(last, 0, -1):
        here = row * n + row
        around = abs(h[here - n - 1]) + abs(h[here])
        if around == 0.0:
            around = norm
        if abs(h[here - 1]) + around == around:
            h[here - 1] = 0.0
            return row
    return 0


@kernel
def _pair(h: Array, n: int, last: int, shift: float, real: Array, imaginary: Array) -> None:
    """Write both eigenvalues of the 2 x 2 block that ends in row `last`."""
    at = last * n + last
    x = h[at]
    w = h[at - 1] * h[at - n]
    p = 0.5 * (h[at - n - 1] - x)
    q = p * p + w
    root = math.sqrt(abs(q))
    x += shift
    if q >= 0.0:
        z = p + math.copysign(root, p)
        real[last - 1] = x + z
        real[last] = x - w / z if z != 0.0 else x
        imaginary[last - 1] = 0.0
        imaginary[last] = 0.0
    else:
        real[last - 1] = x + p
        real[last] = x + p
        imaginary[last - 1] = root
        imaginary[last] = -root


@kernel
def _double_step(h: Array, n: int, first: int, last: int, x: float, y: float, w: float) -> None:
    """Do one double QR step in the rows `first` to `last`, whose shifts have x + y, x y - w."""
    p = 0.0
    q = 0.0
    r = 0.0
    start = last - 2
    while True:  # two small numbers below the diagonal let the step start there
        at = start * n + start
        z = h[at]
        r = x - z
        s = y - z
        p = (r * s - w) / h[at + n] + h[at + 1]
        q = h[at + n + 1] - z - r - s
        r = h[at + 2 * n + 1]
        s = abs(p) + abs(q) + abs(r)
        p /= s
        q /= s
        r /= s
        if start == first:
            break
        above = abs(h[at - 1]) * (abs(q) + abs(r))
        around = abs(p) * (abs(h[at - n - 1]) + abs(z) + abs(h[at + n + 1]))
        if above + around == around:
            break
        start -= 1
    for i in range(start + 2, last + 1):
        h[i * n + i - 2] = 0.0
        if i != start + 2:
            h[i * n + i - 3] = 0.0
    for k in range(start, last):
        three = k != last - 1
        size = 1.0
        if k != start:
            p = h[k * n + k - 1]
            q = h[(k + 1) * n + k - 1]
            r = h[(k + 2) * n + k - 1] if three else 0.0
            size = abs(p) + abs(q) + abs(r)
            if size == 0.0:
                continue
            p /= size
            q /= size
            r /= size
        s = math.copysign(math.sqrt(p * p + q * q + r * r), p)
        if s == 0.0:
            continue
        if k != start:
            h[k * n + k - 1] = -s * size
        elif first != start:
            h[k * n + k - 1] = -h[k * n + k - 1]
        p += s
        x = p / s
        y = q / s
        z = r / s
        q /= p
        r /= p
        for j in range(k, last + 1):
            dot = h[k * n + j] + q * h[(k + 1) * n + j]
            if three:
                dot += r * h[(k + 2) * n + j]
                h[(k + 2) * n + j] -= dot * z
            h[(k + 1) * n + j] -= dot * y
            h[k * n + j] -= dot * x
        for i in range(first, min(last, k + 3) + 1):
            dot = x * h[i * n + k] + y * h[i * n + k + 1]
            if three:
                dot += z * h[i * n + k + 2]
                h[i * n + k + 2] -= dot * r
            h[i * n + k + 1] -= dot * q
            h[i * n + k] -= dot


@kernel
def eigenvalues(matrix: Array, n: int, real: Array, imaginary: Array) -> int:
    """Write the eigenvalues of a real matrix; return OK, NOT_CONVERGED or NOT_FINITE.

    Parameters
    ----------
    matrix : ndarray of shape (n * n,)
        Row by row; overwritten.
    n : int
        Rows.
    real, imaginary : ndarray of shape (n,)
        On return the parts of the eigenvalues, in no order; of a complex pair the positive
        imaginary part stands first.

    Notes
    -----
    Each is an eigenvalue of a matrix within some roundings of the balanced one.
    """
    for i in range(n * n):
        if not abs(matrix[i]) < math.inf:
            return NOT_FINITE
    _balance(matrix, n)
    _to_hessenberg(matrix, n, real)
    norm = 0.0
    for i in range(n * n):
        norm += abs(matrix[i])
    last = n - 1
    shift = 0.0
    steps = 0
    while last >= 0:
        first = _first_row(matrix, n, last, norm)
        at = last * n + last
        if first == last:
            real[last] = matrix[at] + shift
            imaginary[last] = 0.0
            last -= 1
            steps = 0
            continue
        if first == last - 1:
            _pair(matrix, n, last, shift, real, imaginary)
            last -= 2
            steps = 0
            continue
        if steps == _MAX_STEPS:
            return NOT_CONVERGED
        steps += 1
        if steps % _EXCEPTIONAL == 0:
            corner = matrix[at]
            shift += corner
            for i in range(last + 1):
                matrix[i * n + i] -= corner
            s = abs(matrix[at - 1]) + abs(matrix[at - n - 2])
            x = 0.75 * s
            y = x
            w = -0.4375 * s * s
        else:
            x = matrix[at]
            y = matrix[at - n - 1]
            w = matrix[at - 1] * matrix[at - n]
            p = 0.5 * (y - x)
            q = p * p + w
            if q >= 0.0:
                # of two real shifts the nearer one twice: two blocks with the same pair of
                # eigenvalues hardly part under both
                z = p + math.copysign(math.sqrt(q), p)
                x -= w / z if z != 0.0 else 0.0
                y = x
                w = 0.0
        _double_step(matrix, n, first, last, x, y, w)
    return OK
