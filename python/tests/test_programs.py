"""Linear complementarity problems and quadratic programs against exact answers and the conditions of optimality."""

import itertools
import unittest
import warnings

import numpy as np
from numpy.testing import assert_allclose
from scipy.sparse import coo_matrix, csc_matrix

import fuge


def murty(n):
    """Ones on the diagonal, twos above it."""
    return np.eye(n) + 2.0 * np.triu(np.ones((n, n)), 1)


def hilbert(n):
    return 1.0 / (np.arange(n)[:, None] + np.arange(n) + 1.0)


class Lcp(unittest.TestCase):
    def test_all_supports(self):
        # The one support of 2^4 whose equations give numbers of the right signs.
        random = np.random.default_rng(3)
        for _ in range(50):
            factor = random.standard_normal((4, 4))
            matrix, q = factor @ factor.T + 0.1 * np.eye(4), random.standard_normal(4)
            found = fuge.solve_lcp(matrix, q)
            answers = []
            for support in itertools.product([False, True], repeat=4):
                inside = np.array(support)
                z = np.zeros(4)
                if inside.any():
                    z[inside] = np.linalg.solve(matrix[np.ix_(inside, inside)], -q[inside])
                if np.all(z >= 0.0) and np.all((matrix @ z + q)[~inside] >= 0.0):
                    answers.append(z)
            self.assertEqual(len(answers), 1)
            assert_allclose(found.z, answers[0], atol=1e-12)
            assert_allclose(found.w, matrix @ found.z + q, atol=1e-12)
            self.assertEqual(found.undecided.size, 0)
            self.assertLess(found.z_bound.max(), 1e-10)

    def test_exponential_for_pivoting(self):
        # Fathi's matrix, the square of Murty's: z = (.., 0, 1), found without 2^n pivots.
        n = 40
        found = fuge.solve_lcp(murty(n).T @ murty(n), -np.ones(n))
        self.assertEqual(np.flatnonzero(found.z).tolist(), [0])
        self.assertEqual(found.z[0], 1.0)
        self.assertLess(found.info.iterations, 4 * n)

    def test_nearly_singular(self):
        found = fuge.solve_lcp(hilbert(6), -hilbert(6) @ [1.0, 0.0, 2.0, 0.0, 1.0, 0.0])
        self.assertLess(np.abs(np.minimum(found.z, found.w)).max(), 1e-10)
        assert_allclose(found.w, 0.0, atol=1e-12)

    def test_degenerate(self):
        found = fuge.solve_lcp([[2.0, 1.0], [1.0, 2.0]], [-2.0, -1.0])
        assert_allclose(found.z, [1.0, 0.0], atol=1e-15)
        self.assertEqual(found.undecided.tolist(), [1])

    def test_refusals(self):
        with self.assertRaisesRegex(fuge.MatrixError, r"M\[0, 1\] = 2 and M\[1, 0\] = 0 differ: M has to be symmetric"):
            fuge.solve_lcp(murty(3), -np.ones(3))
        for matrix in ([[-1.0]], [[1.0, 2.0], [2.0, 1.0]]):
            with self.assertRaisesRegex(fuge.MatrixError, "M is not positive semidefinite, to rounding"):
                fuge.solve_lcp(matrix, -np.ones(len(matrix)))
        with self.assertRaisesRegex(fuge.InputError, r"M\[0, 1\] = nan is not a finite number"):
            fuge.solve_lcp([[1.0, np.nan], [0.0, 1.0]], [1.0, 1.0])
        with self.assertRaisesRegex(fuge.InputError, r"q\[0\] = inf is not a finite number"):
            fuge.solve_lcp([[1.0]], [np.inf])
        for matrix, q in (([[0.0]], [-1.0]), ([[1.0, -1.0], [-1.0, 1.0]], [-1.0, 0.0])):
            with self.assertRaisesRegex(fuge.EquilibriumError, "there is no z >= 0"):
                fuge.solve_lcp(matrix, q)

    def test_not_semidefinite(self):
        # A solution that needs no more of M than its first element, and is not proved.
        found = fuge.solve_lcp([[1.0, 2.0], [2.0, 1.0]], [-1.0, 0.0])
        assert_allclose(found.z, [1.0, 0.0])
        self.assertTrue(np.all(np.isinf(found.z_bound)))


class Qp(unittest.TestCase):
    def check(self, p, q, g, h, a, b, lower, upper):
        """The conditions of Karush, Kuhn and Tucker, from the data alone."""
        found = fuge.solve_qp(p, q, g, h, a, b, lower, upper)
        x, size = found.x, 1.0 + np.abs(found.x).max()
        balance = p @ x + q + g.T @ found.z + a.T @ found.y + found.z_box
        self.assertLess(np.abs(balance).max(), 1e-10 * (1.0 + np.abs(q).max() + np.abs(found.z).max(initial=0.0)))
        self.assertGreaterEqual(found.z.min(initial=0.0), 0.0)
        above, below = found.z_box.clip(0.0), (-found.z_box).clip(0.0)
        for slack, force in ((h - g @ x, found.z), (upper - x, above), (x - lower, below)):
            self.assertGreater(slack.min(initial=0.0), -1e-11 * size)
            self.assertLess(np.abs(slack[force > 0.0]).max(initial=0.0), 1e-11 * size)
        assert_allclose(a @ x, b, atol=1e-11 * size)
        self.assertLess(found.residual, 1e-12)
        return found

    def test_random(self):
        random = np.random.default_rng(0)
        for _ in range(150):
            n, m = random.integers(1, 15), random.integers(0, 20)
            k = random.integers(0, max(1, n // 2))
            inside, factor = random.standard_normal(n), random.standard_normal((n, n))
            g, a = random.standard_normal((m, n)), random.standard_normal((k, n))
            h = g @ inside + random.uniform(0.0, 1.0, m) * (random.random(m) < 0.7)
            lower = np.where(random.random(n) < 0.5, inside - random.random(n), -np.inf)
            upper = np.where(random.random(n) < 0.5, inside + random.random(n), np.inf)
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", fuge.NotUniqueWarning)
                q = 5.0 * random.standard_normal(n)
                self.check(factor @ factor.T + 0.1 * np.eye(n), q, g, h, a, a @ inside, lower, upper)

    def test_by_hand(self):
        found = fuge.solve_qp(2.0 * np.eye(2), [-2.0, -5.0], [[1.0, 2.0]], [3.0])
        assert_allclose(found.x, [0.4, 1.3], rtol=1e-15)
        assert_allclose(found.z, [1.2], rtol=1e-15)
        self.assertTrue(found.is_proved)
        self.assertEqual(found.undecided, ())
        touching = fuge.solve_qp(np.eye(2), [-1.0, 0.0], [[1.0, 0.0]], [1.0], lb=[-1.0, 0.0])
        self.assertEqual(touching.undecided, ("G[0]", "x[1]"))

    def test_without_constraints(self):
        assert_allclose(fuge.solve_qp([[2.0, 1.0], [1.0, 2.0]], [-3.0, 0.0]).x, [2.0, -1.0], rtol=1e-15)
        zero_row = fuge.solve_qp(np.eye(2), [1.0, 2.0], [[0.0, 0.0]], [1.0])
        assert_allclose(zero_row.x, [-1.0, -2.0])
        assert_allclose(zero_row.z, [0.0])

    def test_sparse(self):
        dense = np.array([[2.0, 0.5, 0.0], [0.5, 1.0, 0.25], [0.0, 0.25, 3.0]])
        rest = [-1.0, -1.0, 2.0], [[1.0, 1.0, 1.0]], [0.5], None, None, -1.0, 1.0
        wanted = fuge.solve_qp(dense, *rest)
        for part in (dense, np.triu(dense), np.tril(dense)):
            for form in (csc_matrix, coo_matrix):
                found = fuge.solve_qp(form(part), *rest)
                assert_allclose(found.x, wanted.x, rtol=1e-14)
                assert_allclose(found.z, wanted.z, rtol=1e-13)
                self.assertLess(found.residual, 1e-14)

    def test_any_unit(self):
        for unit in (1e-150, 1e-8, 1.0, 1e150):
            found = fuge.solve_qp(2.0 * np.eye(2), [-2.0, -5.0], [[unit, 2.0 * unit]], [3.0 * unit])
            assert_allclose(found.x, [0.4, 1.3], rtol=1e-14)
            assert_allclose(found.z, [1.2 / unit], rtol=1e-14)

    def test_refusals(self):
        cases = [
            (dict(P=-np.eye(2)), fuge.MatrixError, "P is not positive definite, to rounding"),
            (dict(P=[[1.0, 1.0], [1.0, 1.0]]), fuge.MatrixError, "P is not positive definite, to rounding"),
            (dict(P=[[1.0, 0.5], [0.0, 1.0]]), fuge.MatrixError, r"P\[0, 1\] = 0.5 and P\[1, 0\] = 0 differ"),
            (dict(P=csc_matrix([[1.0, 0.5], [0.2, 1.0]])), fuge.MatrixError, r"P\[0, 1\] = 0.5 and P\[1, 0\] = 0.2"),
            (dict(P=csc_matrix(np.ones((2, 3)))), fuge.InputError, "P has the shape"),
            (dict(P=csc_matrix([[np.inf]])), fuge.InputError, r"P.value\[0\] = inf"),
            (dict(G=np.eye(2), h=[0.0, np.inf]), fuge.InputError, r"h\[1\] = inf is not a finite number"),
            (dict(G=[[1.0, 0.0], [-1.0, 0.0]], h=[-1.0, -1.0]), fuge.EquilibriumError, "no x satisfies all"),
            (dict(A=[[0.0, 0.0]], b=[1.0]), fuge.EquilibriumError, r"no x satisfies A\[0\]"),
            (dict(lb=[0.0, 2.0], ub=[1.0, 1.0]), fuge.InputError, r"lb\[1\] = 2 and ub\[1\] = 1"),
            (dict(G=np.eye(2)), fuge.InputError, "G and h belong together"),
            (dict(G=np.eye(3), h=np.ones(3)), fuge.InputError, "G has the shape"),
            (dict(lb=np.nan), fuge.InputError, r"lb\[0\] = nan"),
            (dict(q=[np.nan, 0.0]), fuge.InputError, r"q\[0\] = nan"),
        ]
        for changed, kind, message in cases:
            with self.subTest(changed), self.assertRaisesRegex(kind, message):
                fuge.solve_qp(**{"P": np.eye(2), "q": [1.0, 1.0], **changed})


if __name__ == "__main__":
    unittest.main()
