"""Load cases of a solver, envelopes, and the load path with a law."""

import unittest
import warnings

import numpy as np

import fuge

ALPHA = [[0.2, 0.1], [0.1, 0.2]]
GAP = [0.0, 1.0]


class Cases(unittest.TestCase):
    def setUp(self):
        self.solver = fuge.Solver(ALPHA)
        self.solver.set_gap(GAP)
        self.solver.set_load(1.0)

    def test_loads(self):
        cases = self.solver.solve_cases(load=[2.0, 20.0, 0.0])
        np.testing.assert_allclose(cases.force, [[2.0, 0.0], [15.0, 5.0], [0.0, 0.0]], atol=1e-13)
        np.testing.assert_allclose(cases.gap, [[0.0, 0.8], [0.0, 0.0], [0.0, 1.0]], atol=1e-13)
        np.testing.assert_allclose(cases.motion, [[0.4], [3.5], [0.0]], atol=1e-13)
        np.testing.assert_array_equal(cases.state[:2], [[fuge.PointState.AT_LOWER_STOP, 0], [1, 1]])
        self.assertEqual(len(cases), 3)
        self.assertEqual([info.contacts for info in cases.info[:2]], [1, 2])
        self.assertEqual(cases.message, ("", "", ""))
        self.assertIsNone(cases.displacement)
        self.assertTrue(cases.force.flags.c_contiguous)
        self.assertIn("3 load cases of 2 points, 0 failed", repr(cases))

    def test_gaps(self):
        cases = self.solver.solve_cases([[0.0, 1.0], [1.0, 0.0]], load=[[2.0], [2.0]])
        np.testing.assert_allclose(cases.force, [[2.0, 0.0], [0.0, 2.0]], atol=1e-13)

    def test_failed_case(self):
        with self.assertWarnsRegex(fuge.CasesWarning, "1 of 3 load cases failed.*load case 1") as caught:
            cases = self.solver.solve_cases(load=[2.0, -1.0, 20.0])
        self.assertEqual(caught.warning.status, fuge.Status.WARN_CASES)
        self.assertEqual(cases.status.tolist(), [0, fuge.Status.ERR_NO_EQUILIBRIUM, 0])
        self.assertTrue(np.isnan(cases.force[1]).all() and np.isnan(cases.motion[1]).all())
        np.testing.assert_allclose(cases.force[2], [15.0, 5.0], atol=1e-13)
        self.assertEqual(cases.info[1].status, fuge.Status.ERR_NO_EQUILIBRIUM)
        self.assertIn("load", cases.message[1])

    def test_grid(self):
        operator = fuge.HalfspaceOperator(3, 2, 1.0, 1.0, 1.0)
        solver = fuge.Solver(operator)
        solver.set_gap(np.zeros((2, 3)))
        solver.set_load(1.0)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", fuge.GridWarning)
            cases = solver.solve_cases(np.zeros((2, 2, 3)), [1.0, 2.0])
            self.assertEqual(cases.force.shape, (2, 2, 3))
            np.testing.assert_allclose(cases.force.sum(axis=(1, 2)), [1.0, 2.0], rtol=1e-9)

    def test_refusals(self):
        self.assertRaises(fuge.InputError, self.solver.solve_cases)
        self.assertRaises(fuge.InputError, self.solver.solve_cases, [[0.0, 1.0]], [1.0, 2.0])
        self.assertRaises(fuge.InputError, self.solver.solve_cases, [[0.0, 1.0, 2.0]])
        self.assertRaises(fuge.InputError, self.solver.solve_cases, None, [])
        self.assertRaises(fuge.CallOrderError, fuge.Solver(ALPHA).solve_cases, [GAP])

    def test_envelope(self):
        found = fuge.envelope([[1.0, np.nan, 5.0], [3.0, np.nan, -5.0], [2.0, np.nan, 5.0]])
        np.testing.assert_array_equal(found.smallest, [1.0, np.nan, -5.0])
        np.testing.assert_array_equal(found.largest, [3.0, np.nan, 5.0])
        self.assertEqual(found.smallest_case.tolist(), [0, -1, 1])
        self.assertEqual(found.largest_case.tolist(), [1, -1, 0])
        self.assertRaises(fuge.InputError, fuge.envelope, np.empty((0, 3)))


class PathWithLaws(unittest.TestCase):
    """A rigid plate on two springs, one of which yields."""

    def test_limit(self):
        solver = fuge.Solver(np.diag([1.0, 1.0]))
        solver.set_gap([0.0, 0.0])
        solver.set_limits([2.0, np.inf])
        solver.set_load(0.0)
        path = solver.follow_path(10.0)
        # Both carry half, until the first one yields at a load of 4.
        yielding = np.flatnonzero(path.state == fuge.PointState.LIMITED_LOWER)
        self.assertEqual(path.point[yielding].tolist(), [0])
        np.testing.assert_allclose(path.parameter[yielding], 0.4, rtol=1e-13)
        np.testing.assert_allclose(path.motion[yielding], [[2.0]], rtol=1e-13)
        np.testing.assert_allclose(path.rate[yielding], [[10.0]], rtol=1e-13)

    def test_compliance(self):
        solver = fuge.Solver(np.diag([1.0, 1.0]))
        solver.set_gap([0.0, 1.0])
        solver.set_compliance([1.0, 0.0])
        solver.set_load(0.0)
        path = solver.follow_path(2.0)
        # The first one has a stiffness of 1/2, and the gap of the second one closes at a load of 1/2.
        second = np.flatnonzero(path.point == 1)
        np.testing.assert_allclose(path.parameter[second], [0.25], rtol=1e-13)
        np.testing.assert_allclose(path.rate[second], [[2.0 / 1.5]], rtol=1e-13)


if __name__ == "__main__":
    unittest.main()
