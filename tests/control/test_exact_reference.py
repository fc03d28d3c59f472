"""The exact method on 4 000 random problems, degenerate ones among them: none may be wrong."""

import numpy as np
import pytest

from dualarm_repro.control.few_constraints import few_constraints, make_work, minimise
from dualarm_repro.control.least_distance import SOLVED
from dualarm_repro.control.problem import NoSolution, QuadraticProgram, Solution
from dualarm_repro.control.solvers import solve

KINDS = ("plain", "duplicates", "near-dependent", "all rows tight", "near-dependent and tight")
PER_KIND = 800


def binary(values, digits):
    """Rounded to so many binary digits after the point, so that products and sums are exact."""
    return np.round(np.asarray(values) * 2.0**digits) / 2.0**digits


def degenerate(kind, seed):
    """A problem with 14 unknowns and a known point that is feasible exactly, not but for rounding.

    With rounded right-hand sides nearly dependent equalities would contradict tight bounds.
    """
    rng = np.random.default_rng([KINDS.index(kind), seed])
    n, m, k = 14, int(rng.choice([0, 3, 6, 12])), int(rng.choice([0, 3, 9, 20]))
    x = binary(rng.normal(size=n), 8)
    A, G = binary(rng.normal(size=(m, n)), 10), binary(rng.normal(size=(k, n)), 10)
    if kind == "duplicates":
        if m:
            A[m // 2 :] = A[: m - m // 2] * rng.choice([1.0, -2.0])
        if k:
            G[k // 2 :] = G[: k - k // 2]
    if kind.startswith("near-dependent"):
        for i in range(1, m):
            if rng.random() < 0.5:
                A[i] = A[i - 1] + binary(10.0 ** rng.uniform(-4.5, -2) * rng.normal(size=n), 30)
        for i in range(1, k):
            if rng.random() < 0.5:
                G[i] = G[i - 1] + binary(10.0 ** rng.uniform(-4.5, -2) * rng.normal(size=n), 30)
    loose = rng.random(k) * (rng.random(k) < 0.5)
    lower, upper = (x + side * rng.random(n) * (rng.random(n) > 0.2) for side in (-1, 1))
    if kind.endswith("tight"):
        loose[:] = 0.0
    target = rng.normal(size=n) * rng.choice([0.1, 3.0])
    return QuadraticProgram(target, A, A @ x, G, G @ x + loose, lower, upper)


def objective(p, x):
    return 0.5 * float(((x - p.target) ** 2).sum())


@pytest.mark.parametrize("kind", KINDS)
def test_none_is_wrong(kind):
    """Every answer satisfies the optimality conditions, and no exact solver finds a better one."""
    for seed in range(PER_KIND):
        p = degenerate(kind, seed)
        own = solve(p)
        assert own.residual <= 1e-8, seed
        try:
            other = solve(p, "daqp")
        except NoSolution:  # the peer gave up; the certificate stands alone
            continue
        assert objective(p, own.x) <= objective(p, other.x) + 1e-6, seed
        if not kind.startswith("near-dependent"):
            np.testing.assert_allclose(own.x, other.x, rtol=0, atol=1e-6)


@pytest.mark.parametrize("kind", KINDS[:4])
def test_the_compiled_step_minimises_alike(kind):
    """From the Gram matrix or by the dual method, in reused arrays: the same certified answer."""
    work, few = {}, 0
    for seed in range(200):
        p = degenerate(kind, seed)
        sizes = p.size, len(p.b), 20
        used = work.setdefault(sizes, make_work(*sizes))
        few += few_constraints(p.parts, used.gram) >= 0
        if minimise(p.parts, used) != SOLVED:
            continue
        found = Solution(p, used.x, used.y, used.z[: len(p.h)], used.w)
        if found.certified():
            np.testing.assert_allclose(used.x, solve(p).x, rtol=0, atol=1e-6)
    assert 0 < few < 200


@pytest.mark.parametrize("scale", [1e6, 1e12])
def test_numbers_so_large_that_no_refinement_settles_them_end(scale):
    """Constraints of large right-hand sides are off by more than what counts as settled."""
    for seed in range(50):
        p = degenerate("plain", seed)
        far = QuadraticProgram(
            *(scale * p.target, p.A, scale * p.b, p.G, scale * p.h),
            *(scale * p.lower, scale * p.upper),
        )
        sizes = far.size, len(far.b), len(far.h)
        work = make_work(*sizes)
        if few_constraints(far.parts, work.gram) >= 0:
            np.testing.assert_allclose(work.gram.x[: far.size], scale * solve(p).x, rtol=1e-6)
