"""The strut loop in rows of all frequencies, as adjoints have the dynamic stiffness of struts.

A row (2, n) has the real and imaginary parts of a value. Products may be fused and sums taken in whatever order
suits the processor, the same for every design; numpy's error model leaves out a check for division by zero that
would keep a loop from being vectorised.
"""

from ..compiled import compilable, uncounted
from ..quantities import Bool, Real
from .many_struts import ManyStruts, element_at


@uncounted()
def fill_stiffness(added: Real, struts: ManyStruts, entry: int, present: Bool, stiffness: Real) -> None:
    """Fill in D (q q, 2, n), sum of gain (jw)^order, and which entries (q q,) are not zero."""
    for i in range(stiffness.shape[0]):
        k, c, b = element_at(struts, added, entry + i)
        present[i] = k != 0.0 or c != 0.0 or b != 0.0
        for t in range(struts.omega.size):
            w = struts.omega[t]
            stiffness[i, 0, t] = k - b * (w * w)
            stiffness[i, 1, t] = c * w


@uncounted()
def fill_loop(q: int, s: int, present: Bool, stiffness: Real, feedback: Real, sources: Real, loop: Real) -> None:
    """Put 1 - P D beside the sources into the loop (q (q + s), 2, n)."""
    for i in range(q):
        for j in range(q):
            row = loop[i * (q + s) + j]
            row[:] = 0.0
            for other in range(q):
                if present[other * q + j]:
                    add_product(-1.0, feedback[i * q + other], stiffness[other * q + j], row)
            for t in range(row.shape[1] if i == j else 0):
                row[0, t] += 1.0
        for source in range(s):
            copy(sources[i * s + source], loop[i * (q + s) + q + source])


@uncounted()
def eliminate(q: int, columns: int, loop: Real) -> None:
    """Solve the linear equations (q columns, 2, n) in place: solutions replace the right-hand sides.

    Elimination closes one strut after the other and needs no pivoting.
    """
    for c in range(q):
        invert(loop[c * columns + c])
        for j in range(c + 1, columns):
            multiply(loop[c * columns + c], loop[c * columns + j])
        for i in range(c + 1, q):
            for j in range(c + 1, columns):
                add_product(-1.0, loop[i * columns + c], loop[c * columns + j], loop[i * columns + j])
    for c in range(q - 1, 0, -1):
        for i in range(c):
            for j in range(q, columns):
                add_product(-1.0, loop[i * columns + c], loop[c * columns + j], loop[i * columns + j])


@compilable()
def copy(given: Real, row: Real) -> None:
    """Fill in a complex row (2, n) by another."""
    for part in range(2):
        for t in range(row.shape[1]):
            row[part, t] = given[part, t]


@compilable(fastmath={"contract", "nsz"}, error_model="numpy")
def invert(value: Real) -> None:
    """Replace a complex row (2, n) by its reciprocal."""
    a, b = value[0], value[1]
    for t in range(a.size):
        size = a[t] * a[t] + b[t] * b[t]
        a[t] /= size
        b[t] /= -size


@compilable(fastmath={"contract", "nsz"})
def multiply(factor: Real, value: Real) -> None:
    """Multiply a complex row (2, n) by another in place."""
    a, b, x, y = factor[0], factor[1], value[0], value[1]
    for t in range(a.size):
        real = a[t] * x[t] - b[t] * y[t]
        y[t] = a[t] * y[t] + b[t] * x[t]
        x[t] = real


@compilable(fastmath={"contract", "nsz"})
def add_product(sign: float, left: Real, right: Real, total: Real) -> None:
    """Add the product of two complex rows (2, n), times `sign`, to a third."""
    a, b, x, y, re, im = left[0], left[1], right[0], right[1], total[0], total[1]
    for t in range(a.size):
        re[t] += sign * (a[t] * x[t] - b[t] * y[t])
        im[t] += sign * (a[t] * y[t] + b[t] * x[t])


@compilable(fastmath={"reassoc", "contract", "nsz"})
def sum_of_squares(value: Real) -> float:
    """Return the sum of the squared magnitudes of a complex row (2, n)."""
    total = 0.0
    x, y = value[0], value[1]
    for t in range(x.size):
        total += x[t] * x[t] + y[t] * y[t]
    return total
