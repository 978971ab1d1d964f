"""Links of structures: cables, supports that lift off, load cases and mechanisms."""

import unittest
import warnings

import numpy as np

import fuge

NODE, ANCHOR = [0, 1], [-1, -1]


def cable():
    """A node on springs of stiffness 100 along x and y, and a cable to (3, 4) with E A/L = 100."""
    links = fuge.Links()
    links.add_member(NODE, ANCHOR, [0.0, 0.0], [3.0, 4.0], area=1.0, modulus=500.0, name="cable")
    body = fuge.Body(np.diag([100.0, 100.0]))
    body.set_links(links)
    body.condense()
    return body, links


def floating():
    """Two nodes with a spring between them that only a support holds, with a gap of 0.5."""
    links = fuge.Links()
    links.add_support(0, 2.0, gap=0.5, name="stop")
    body = fuge.Body([[1.0, -1.0], [-1.0, 1.0]])
    body.find_rigid_modes()
    body.set_links(links)
    body.condense()
    return body, links


class Structures(unittest.TestCase):
    def test_cable(self):
        body, links = cable()
        self.assertEqual(links.count, 1)
        self.assertEqual(links.gap.tolist(), [0.0])
        self.assertEqual(links.names, ("cable",))
        cases = body.solve_cases([[-6.0, -8.0], [6.0, 8.0]])
        np.testing.assert_allclose(cases.force, [[5.0], [0.0]], atol=1e-13)
        np.testing.assert_allclose(cases.displacement, [[-0.03, -0.04], [0.06, 0.08]], atol=1e-14)
        # Again with the same solver.
        cases = body.solve_cases([[-12.0, -16.0]])
        np.testing.assert_allclose(cases.force, [[10.0]], atol=1e-13)

    def test_links_that_can_never_act(self):
        links = fuge.Links()
        links.add_support(0, 1.0, name="pier")
        links.add_support(1, 1.0)
        body = fuge.Body(np.diag([100.0, 100.0]))
        body.fix([0])
        body.set_links(links)
        body.condense()
        with self.assertWarnsRegex(fuge.Warning, "pier can never act: supports of the body hold its ends"):
            body.solve_cases([[-6.0, -8.0]])
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            cases = body.solve_cases([[-6.0, -8.0]], supports=[[0.5]])
        np.testing.assert_allclose(cases.force, [[0.0, 8.0]], atol=1e-13)
        np.testing.assert_allclose(cases.gap, [[0.5, 0.0]], atol=1e-13)

    def test_rotations_are_lever_arms(self):
        links = fuge.Links()
        links.add_support([-1, 0, -1, -1, -1, 1], [0.0, 2.0, 0.0, 0.0, 0.0, 1.0])
        body = fuge.Body(np.diag([1.0, 1.0]))
        body.set_links(links)
        body.condense()
        cases = body.solve_cases([[-3.0, -1.0]])
        np.testing.assert_allclose(cases.force, [[2.0]], atol=1e-13)
        np.testing.assert_allclose(cases.displacement, [[-1.0, 1.0]], atol=1e-13)

    def test_slack_and_yield(self):
        links = fuge.Links()
        ends = NODE, ANCHOR, [0.0, 0.0], [3.0, 4.0]
        links.add_member(*ends, area=1.0, modulus=500.0, slack=0.02, yield_force=6.0)
        links.add_member(*ends, area=1.0, modulus=500.0, kind="compression_only")
        body = fuge.Body(np.diag([100.0, 100.0]))
        body.set_links(links)
        body.condense()
        self.assertEqual(links.gap.tolist(), [0.02, 0.0])
        self.assertEqual(links.names, ("link 1", "link 2"))
        cases = body.solve_cases([[-6.0, -8.0], [-60.0, -80.0], [6.0, 8.0]])
        # 100 u + 100 (u - 0.02) = 10; 100 u + 6 = 100; the strut takes one half.
        np.testing.assert_allclose(cases.force, [[4.0, 0.0], [6.0, 0.0], [0.0, 5.0]], atol=1e-12)
        np.testing.assert_allclose(cases.displacement[1], [-0.564, -0.752], atol=1e-13)

    def test_gap(self):
        links = fuge.Links()
        links.add_gap([0], [1], [1.0], gap=0.1, compliance=0.0)
        body = fuge.Body(np.diag([100.0, 100.0]))
        body.set_links(links)
        body.condense()
        cases = body.solve_cases([[30.0, 0.0], [5.0, 0.0]])
        np.testing.assert_allclose(cases.force, [[10.0], [0.0]], atol=1e-12)
        np.testing.assert_allclose(cases.gap, [[0.0], [0.05]], atol=1e-14)

    def test_failed_cases(self):
        body, _ = floating()
        with self.assertWarnsRegex(fuge.CasesWarning, "load case 1"):
            cases = body.solve_cases([[0.0, -4.0], [0.0, 4.0]])
        self.assertEqual(cases.status.tolist(), [0, fuge.Status.ERR_NO_EQUILIBRIUM])
        np.testing.assert_allclose(cases.displacement[0], [-0.5, -4.5], atol=1e-13)
        self.assertTrue(np.isnan(cases.displacement[1]).all())
        body, _ = cable()
        with self.assertWarnsRegex(fuge.CasesWarning, "1 of 2 load cases failed, 0 have a warning; load case 0"):
            cases = body.solve_cases([[np.nan, 0.0], [-6.0, -8.0]])
        self.assertEqual(cases.status.tolist(), [fuge.Status.ERR_NOT_FINITE, 0])
        self.assertEqual(cases.info[0].status, fuge.Status.ERR_NOT_FINITE)
        self.assertIn("nan", cases.message[0].lower())
        np.testing.assert_allclose(cases.force[1], [5.0], atol=1e-13)

    def test_displaced_supports(self):
        links = fuge.Links()
        links.add_gap([1], [0], [1.0])
        body = fuge.Body(np.diag([100.0, 1.0]))
        body.fix([1])
        body.set_links(links)
        body.condense()
        cases = body.solve_cases(np.zeros((2, 2)), supports=[[0.25], [-0.5]])
        np.testing.assert_allclose(cases.force, [[25.0], [0.0]], rtol=1e-13)
        np.testing.assert_allclose(cases.displacement, [[0.25, 0.25], [0.0, -0.5]], rtol=1e-13)
        self.assertRaises(fuge.InputError, body.solve_cases, np.zeros((2, 2)), supports=[[0.25]])

    def test_mechanism(self):
        body, links = floating()
        body.set_load([0.0, -4.0])
        self.assertEqual(body.mechanism().tolist(), [0.0, 0.0])
        body.set_load([0.0, 4.0])
        u = body.mechanism()
        np.testing.assert_allclose(u, [1.0, 1.0], rtol=1e-13)
        words = links.describe(u, [[0.0, 0.0], [1.0, 0.0]], [[0, -1], [1, -1]])
        self.assertEqual(words, "stop opens; the structure moves along x")

    def test_remove_member(self):
        # E A/L = 100 along (3, 4), beside springs of 10 along each axis.
        ends = [0, 1], [2, 3], [0.0, 0.0], [3.0, 4.0]
        h = np.array([-0.6, -0.8, 0.6, 0.8])
        springs = np.diag([10.0] * 4)
        whole = springs + 100.0 * np.outer(h, h)
        found = fuge.remove_member(whole, *ends, area=1.0, modulus=500.0)
        np.testing.assert_allclose(found, springs, atol=1e-13)
        np.testing.assert_array_equal(whole, springs + 100.0 * np.outer(h, h))
        # In one triangle of a sparse matrix, whose arrays remain as they are.
        columns, rows = np.triu_indices(4)  # of column j the rows from j on
        count = np.arange(4, 0, -1)
        first = np.r_[0, np.cumsum(count)]
        lower = fuge.CompressedColumns((4, 4), first, rows, whole[rows, columns])
        found = fuge.remove_member(lower, *ends, area=1.0, modulus=500.0)
        np.testing.assert_allclose(found.value, springs[rows, columns], atol=1e-13)
        np.testing.assert_array_equal(lower.value, whole[rows, columns])
        # An end that does not move.
        found = fuge.remove_member(whole[:2, :2], [0, 1], [-1, -1], *ends[2:], area=1.0, modulus=500.0)
        np.testing.assert_allclose(found, springs[:2, :2], atol=1e-13)
        with self.assertRaises(fuge.MatrixError):
            fuge.remove_member(springs, *ends, area=1.0, modulus=500.0)
        for wrong in ({"area": 0.0, "modulus": 500.0}, {"area": 1.0, "modulus": np.nan}):
            self.assertRaises(fuge.InputError, fuge.remove_member, whole, *ends, **wrong)
        same = [0, 1], [2, 3], [0.0, 0.0], [0.0, 0.0]
        self.assertRaises(fuge.InputError, fuge.remove_member, whole, *same, area=1.0, modulus=500.0)
        self.assertRaises(fuge.InputError, fuge.remove_member, whole[:3], *ends, area=1.0, modulus=500.0)

    def test_refusals(self):
        body, links = cable()
        with self.assertRaisesRegex(fuge.InputError, "link 2 is zero"):
            links.add_support(NODE, [0.0, 0.0])
        with self.assertRaisesRegex(fuge.InputError, "'tension_only', 'compression_only'"):
            links.add_member(NODE, ANCHOR, [0.0, 0.0], [3.0, 4.0], area=1.0, modulus=1.0, kind="both")
        self.assertRaises(fuge.InputError, links.add_gap, [0], [1], [1.0], play=-1.0)
        self.assertRaises(fuge.InputError, links.add_gap, [0, 1], [1], [1.0])
        self.assertRaises(fuge.InputError, links.describe, [1.0, 1.0], [[0.0, 0.0]], [[5, -1]])
        self.assertEqual(links.count, 1)
        self.assertEqual(links.names, ("cable",))
        self.assertRaises(fuge.InputError, body.solve_cases, [[1.0, 2.0, 3.0]])
        body = fuge.Body(np.eye(2))
        self.assertRaises(fuge.CallOrderError, body.set_links, fuge.Links())
        self.assertRaises(fuge.CallOrderError, body.solve_cases, [[1.0, 2.0]])
        self.assertRaises(fuge.CallOrderError, body.mechanism)
        body.set_links(links)
        self.assertRaises(fuge.CallOrderError, body.solve_cases, [[1.0, 2.0]])


if __name__ == "__main__":
    unittest.main()
