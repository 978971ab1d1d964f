"""Condensation of dense and banded stiffness matrices, and contact pairs."""

import unittest
import warnings

import numpy as np

import fuge


def chain(n):
    """Springs of stiffness 1 in a row, from node 0 to n - 1, without a support."""
    stiffness = np.diag(np.r_[1.0, np.full(n - 2, 2.0), 1.0])
    return stiffness - np.eye(n, k=1) - np.eye(n, k=-1)


class Condensation(unittest.TestCase):
    def setUp(self):
        self.stiffness = chain(5)

    def check(self, body):
        body.fix([0])
        body.set_contact([2, 4], [1.0, 1.0])
        condensed = body.condense()
        # Springs in series: i of them up to node i.
        np.testing.assert_allclose(condensed.influence, [[2.0, 2.0], [2.0, 4.0]], rtol=1e-13)
        np.testing.assert_allclose(condensed.displacement, [0.0, 0.0], atol=1e-15)
        self.assertEqual(condensed.modes.shape, (2, 0))
        contact = fuge.solve(condensed.influence, [0.0, 3.0], approach=1.0)
        np.testing.assert_allclose(contact.force, [0.5, 0.0], atol=1e-14)
        np.testing.assert_allclose(body.recover(contact.force), [0, 0.5, 1, 1, 1], atol=1e-14)

    def test_dense(self):
        for stiffness in (self.stiffness, np.asfortranarray(self.stiffness), self.stiffness.astype(int)):
            self.check(fuge.Body(stiffness))

    def test_band(self):
        ab = np.zeros((2, 5))
        ab[0], ab[1, :-1] = np.diag(self.stiffness), np.diag(self.stiffness, -1)
        self.check(fuge.Body.from_band(ab))
        upper = np.zeros((2, 5))
        upper[1], upper[0, 1:] = np.diag(self.stiffness), np.diag(self.stiffness, 1)
        self.check(fuge.Body.from_band(upper, upper=True))

    def test_supports_and_loads(self):
        body = fuge.Body(self.stiffness)
        body.fix([0, 4], [0.0, 1.0])
        body.set_load([0.0, 0.0, 1.0, 0.0, 0.0])
        body.set_contact([2], [1.0])
        condensed = body.condense()
        np.testing.assert_allclose(condensed.displacement, [0.5 + 1.0], rtol=1e-13)
        body.set_load(np.zeros(5))
        np.testing.assert_allclose(body.condense().displacement, [0.5], rtol=1e-13)

    def test_floating(self):
        for find in (True, False):
            body = fuge.Body(self.stiffness)
            if find:
                body.find_rigid_modes()
            else:
                body.set_rigid_modes(np.ones((5, 1)))
            body.set_contact([[0], [4]], [[1.0], [1.0]])
            body.set_load([0, 0, -4.0, 0, 0])
            condensed = body.condense()
            self.assertEqual(condensed.modes.shape, (2, 1))
            contact = fuge.solve(
                condensed.influence, condensed.displacement, modes=condensed.modes, resultant=condensed.resultant
            )
            np.testing.assert_allclose(contact.force, [2.0, 2.0], rtol=1e-12)
            displacement = body.recover(contact.force, contact.motion)
            np.testing.assert_allclose(self.stiffness @ displacement, [2, 0, -4, 0, 2], atol=1e-12)
            np.testing.assert_allclose(displacement[[0, 4]], contact.gap, atol=1e-12)

    def test_errors(self):
        body = fuge.Body(self.stiffness)
        body.set_contact([2], [1.0])
        with self.assertRaises(fuge.MatrixError) as caught:
            body.condense()
        self.assertEqual(caught.exception.status, fuge.Status.ERR_NOT_DEFINITE)
        self.assertRaises(fuge.CallOrderError, body.recover, [1.0])
        self.assertRaises(fuge.InputError, body.set_contact, [2, 3], [1.0])
        self.assertRaises(fuge.InputError, body.set_load, [1.0])
        self.assertRaises(TypeError, body.set_contact, [2.5], [1.0])
        self.assertRaises(fuge.InputError, body.fix, [2**40])
        self.assertRaises(fuge.InputError, fuge.Body, np.ones((2, 3)))
        body.fix([7])
        with self.assertRaises(fuge.InputError) as caught:
            body.condense()
        self.assertEqual(caught.exception.status, fuge.Status.ERR_DOF)

    def test_rigid_modes(self):
        modes = fuge.rigid_modes([[0.0, 0.0], [2.0, 0.0]])
        self.assertEqual(modes.shape, (4, 3))
        # The rotation about the middle moves the nodes up and down.
        np.testing.assert_allclose(np.abs(modes[:, 2]) / np.abs(modes[1, 2]), [0, 1, 0, 1], atol=1e-14)
        self.assertEqual(fuge.rigid_modes(np.eye(3)).shape, (9, 6))
        self.assertRaises(fuge.InputError, fuge.rigid_modes, np.ones((2, 4)))


class Pairs(unittest.TestCase):
    # An edge from x = 0 to 1 at y = 0.25, its body above, and two edges below it, at y = 0.
    upper = fuge.Surface([[0.0, 0.25], [1.0, 0.25]], [[0, 1]], [[6, 7], [8, 9]])
    lower = fuge.Surface(
        np.array([[0.0, 0.0], [0.5, 0.0], [1.0, 0.0]]), [[1, 0, -1], [2, 1, -1]], [[-1, 1], [2, 3], [4, 5]]
    )

    def test_mortar(self):
        pairs = fuge.ContactPairs()
        self.assertEqual(pairs.gap.size, 0)
        pairs.find(self.upper, self.lower)
        np.testing.assert_allclose(pairs.gap, [0.25, 0.25], rtol=1e-14)
        np.testing.assert_allclose(pairs.area, [0.5, 0.5], rtol=1e-14)
        self.assertTrue(np.isinf(pairs.gap_upper).all())
        factors = {int(d): f for d, f in zip(pairs.dof[0], pairs.normal[0]) if d >= 0 and f != 0}
        self.assertEqual(set(factors), {1, 3, 5, 7})
        np.testing.assert_allclose([factors[d] for d in (1, 3, 5, 7)], [-0.75, -0.5, 0.25, 1.0], rtol=1e-13)
        np.testing.assert_allclose(pairs.direction, [[0, -1], [0, -1]], atol=1e-14)
        self.assertEqual(pairs.place.shape, (2, 1))
        self.assertEqual(pairs.unpaired.shape, (0, 2))
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            pairs.find(self.upper, self.lower, play=0.0)
        self.assertIs(caught[0].category, fuge.PairsWarning)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            self.assertRaises(fuge.PairsWarning, pairs.find, self.upper, self.lower)
        self.assertEqual(pairs.gap.size, 6)
        self.assertEqual(pairs.gap_upper[3], 0.0)

    def test_node_to_face(self):
        above = fuge.Surface([[0.25, 0.25], [1.5, 0.25]], [[0, 1]], [[6, 7], [8, 9]])
        pairs = fuge.ContactPairs()
        pairs.find(
            above,
            self.lower,
            method="node_to_face",
            normals="given",
            normal=[[0, -2], [0, -2]],
            reach=1.0,
            smooth=False,
        )
        np.testing.assert_allclose(pairs.gap, [0.25], rtol=1e-14)
        np.testing.assert_array_equal(pairs.unpaired, [[0, 1]])

    def test_errors(self):
        pairs = fuge.ContactPairs()
        with self.assertRaises(fuge.InputError) as caught:
            pairs.find(self.upper, fuge.Surface(self.lower.node, [[0, 1, -1], [1, 2, -1]], self.lower.dof))
        self.assertEqual(caught.exception.status, fuge.Status.ERR_MESH)
        self.assertEqual(pairs.gap.size, 0)
        with self.assertRaisesRegex(fuge.InputError, "contact.dof"):
            pairs.find(fuge.Surface(self.upper.node, self.upper.face, [[1, 2]]), self.lower)
        with self.assertRaisesRegex(fuge.InputError, "'mortar', 'node_to_face'"):
            pairs.find(self.upper, self.lower, method="nodes")


if __name__ == "__main__":
    unittest.main()
