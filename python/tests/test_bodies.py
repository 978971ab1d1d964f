"""Elastic bodies with meshes that do not match: the patch test, joined bodies, and meshes with their matrices."""

import tempfile
import unittest
from pathlib import Path

import numpy as np
from scipy.sparse import csc_matrix

import fuge
from fuge._library import has_sparse

YOUNG, POISSON, PRESSURE = 2.0, 0.25, 0.01


def element_stiffness(width):
    """A bilinear rectangle, `width` wide and 1 high, in plane strain, by four Gauss points."""
    shear = YOUNG / 2 / (1 + POISSON)
    material = np.diag([2 * shear, 2 * shear, shear])
    material[:2, :2] += YOUNG * POISSON / (1 + POISSON) / (1 - 2 * POISSON)
    corner = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]])
    stiffness = np.zeros((8, 8))
    for r, s in corner / np.sqrt(3):
        slope = corner * (1 + corner[:, ::-1] * [s, r]) / 4 * [2 / width, 2]
        strain = np.zeros((3, 8))
        strain[0, 0::2] = strain[2, 1::2] = slope[:, 0]
        strain[1, 1::2] = strain[2, 0::2] = slope[:, 1]
        stiffness += strain.T @ material @ strain * width / 4
    return stiffness


class Block:
    """A block one wide and one high, of rectangles side by side."""

    def __init__(self, elements, bottom):
        n = elements + 1
        self.node = np.array([[k % n / elements, bottom + k // n] for k in range(2 * n)])
        self.stiffness = np.zeros((4 * n, 4 * n))
        for e in range(elements):
            dof = np.array([[2 * k, 2 * k + 1] for k in (e, e + 1, e + 1 + n, e + n)]).ravel()
            self.stiffness[np.ix_(dof, dof)] += element_stiffness(1 / elements)
        dof = np.arange(4 * n).reshape(-1, 2)
        self.bottom = fuge.Surface(self.node, [[e, e + 1] for e in range(elements)], dof)
        self.top = fuge.Surface(self.node, [[e + 1 + n, e + n] for e in range(elements)], dof)
        self.load = np.zeros(4 * n)
        self.load[2 * n + 1 :: 2] = -PRESSURE / elements
        self.load[[2 * n + 1, -1]] /= 2


class Patch(unittest.TestCase):
    def setUp(self):
        self.lower, self.upper = Block(2, 0.0), Block(3, 1.0)

    def bodies(self, lower, upper):
        bodies = fuge.ElasticBodies()
        below, above = bodies.add(lower), fuge.Body(upper)
        self.assertIs(bodies.add(above), above)
        below.fix([1, 3, 5, 0])
        above.set_load(self.upper.load)
        bodies.add_pair(above, self.upper.bottom, below, self.lower.top)
        return bodies, below, above

    def check(self, contact):
        np.testing.assert_allclose(contact.pressure, np.full(4, PRESSURE), rtol=1e-10)
        np.testing.assert_allclose(contact.area, np.array([1, 2, 2, 1]) / 6, rtol=1e-13)
        np.testing.assert_allclose(contact.force, contact.pressure * contact.area, rtol=1e-12)
        np.testing.assert_array_equal(contact.node, np.arange(4))
        np.testing.assert_allclose(contact.direction, [[0, -1]] * 4, atol=1e-14)
        strain = -PRESSURE * (1 - POISSON**2) / YOUNG
        for displacement, block in zip(contact.displacement, (self.lower, self.upper)):
            np.testing.assert_allclose(displacement[1::2], strain * block.node[:, 1], atol=1e-12)
        self.assertEqual(contact.info.contacts, 4)
        self.assertEqual(contact.unpaired.shape, (0, 2))

    def test_solve(self):
        for sparse in (False, True) if has_sparse() else (False,):
            bodies, _, _ = self.bodies(self.lower.stiffness, self.upper.stiffness)
            self.check(bodies.solve(sparse=sparse))
            self.assertEqual(bodies.info.status, fuge.Status.DONE)

    def test_join(self):
        joined = self.bodies(self.lower.stiffness, self.upper.stiffness)[0].join()
        np.testing.assert_array_equal(joined.first, [0, 12, 28])
        whole = np.zeros(joined.stiffness.shape)
        column = np.repeat(np.arange(28), np.diff(joined.stiffness.column))
        np.add.at(whole, (joined.stiffness.row, column), joined.stiffness.value)
        np.testing.assert_allclose(np.triu(whole)[:12, :12], np.triu(self.lower.stiffness), atol=1e-14)
        np.testing.assert_allclose(np.triu(whole)[12:, 12:], np.triu(self.upper.stiffness), atol=1e-14)
        np.testing.assert_allclose(joined.gap, np.zeros(4), atol=1e-15)
        body = fuge.Body(whole + whole.T - np.diag(np.diag(whole)))
        body.fix([1, 3, 5, 0])
        body.set_load(np.concatenate([np.zeros(12), self.upper.load]))
        body.find_rigid_modes()
        body.set_contact(joined.dof, joined.normal)
        condensed = body.condense()
        gap = joined.gap + condensed.displacement
        contact = fuge.solve(condensed.influence, gap, modes=condensed.modes, resultant=condensed.resultant)
        np.testing.assert_allclose(contact.force / joined.area, np.full(4, PRESSURE), rtol=1e-10)

    def test_rigid_opposite(self):
        bodies = fuge.ElasticBodies()
        block = bodies.add(self.upper.stiffness)
        block.set_load(self.upper.load)
        ground = fuge.Surface([[-1.0, 1.0], [2.0, 1.0]], [[1, 0]])
        bodies.add_pair(block, self.upper.bottom, None, ground)
        np.testing.assert_allclose(bodies.solve(sparse=False).pressure, np.full(4, PRESSURE), rtol=1e-10)

    def test_rigid_modes(self):
        bodies, _, above = self.bodies(self.lower.stiffness, self.upper.stiffness)
        above.set_rigid_modes(fuge.rigid_modes(self.upper.node))
        self.check(bodies.solve(sparse=False))

    def test_reactions(self):
        bodies, _, above = self.bodies(self.lower.stiffness, self.upper.stiffness)
        contact = bodies.solve(sparse=False)
        np.testing.assert_allclose(contact.reaction[0], PRESSURE * np.array([0.25, 0.5, 0.25, 0]), atol=1e-12)
        self.assertEqual(contact.reaction[1].size, 0)
        # Nodes of the contact are held too: the supports have part of the contact forces.
        above.fix([0, 1, 3])
        contact = bodies.solve(sparse=False)
        pressed = contact.force.sum()
        np.testing.assert_allclose(contact.reaction[0][:3].sum(), pressed, rtol=1e-11)
        np.testing.assert_allclose(contact.reaction[1][1:].sum(), PRESSURE - pressed, rtol=1e-11)
        self.assertLess(pressed, 0.9 * PRESSURE)
        self.assertRegex(repr(contact), "^<BodiesContact: 2 bodies, .* points in contact, residual")

    def test_errors(self):
        bodies, below, above = self.bodies(self.lower.stiffness, self.upper.stiffness)
        with self.assertRaisesRegex(fuge.InputError, "is not one of the 2 bodies") as caught:
            bodies.add_pair(fuge.Body(np.eye(28)), self.upper.bottom, below, self.lower.top)
        self.assertEqual(caught.exception.status, fuge.Status.ERR_SIZE)
        self.assertRaises(fuge.InputError, below.set_load, self.upper.load)
        self.assertRaises(fuge.InputError, bodies.add, self.lower.stiffness[:3])
        self.assertRaises(fuge.InputError, fuge.ElasticBodies().solve, sparse=False)
        bodies.add_pair(above, self.upper.top, below, self.lower.top)
        with self.assertRaises(fuge.InputError) as caught:
            bodies.solve(sparse=False)
        self.assertEqual(caught.exception.status, fuge.Status.ERR_MESH)
        self.assertIn("pair 1", caught.exception.message)

    def test_kinds_of_matrices(self):
        # A band and one triangle of a sparse matrix; loads count as they are at the time of the solve.
        k = self.lower.stiffness
        band = np.array([np.r_[np.diag(k, -i), np.zeros(i)] for i in range(len(k))])
        bodies, _, above = self.bodies(k, csc_matrix(np.tril(self.upper.stiffness)))
        self.check(bodies.solve(sparse=False))
        bodies, _, above = self.bodies(fuge.Body.from_band(band), self.upper.stiffness)
        self.check(bodies.solve(sparse=False))
        above.set_load(2 * self.upper.load)
        np.testing.assert_allclose(bodies.solve(sparse=False).pressure, np.full(4, 2 * PRESSURE), rtol=1e-10)

    def test_closed_bodies_stay(self):
        bodies, below, above = self.bodies(self.lower.stiffness, self.upper.stiffness)
        below.close(), above.close()
        self.check(bodies.solve(sparse=False))
        self.assertRaises(fuge.CallOrderError, above.set_load, self.upper.load)

    def test_surfaces_that_look_inwards(self):
        def inwards(surface):
            return fuge.Surface(surface.node, np.asarray(surface.face)[:, ::-1], surface.dof)

        bodies = fuge.ElasticBodies()
        below, above = bodies.add(self.lower.stiffness), bodies.add(self.upper.stiffness)
        below.fix([1, 3, 5, 0])
        above.set_load(self.upper.load)
        bodies.add_pair(above, inwards(self.upper.bottom), below, inwards(self.lower.top))
        with self.assertRaises(fuge.InputError) as caught:
            bodies.solve(sparse=False)
        self.assertEqual(caught.exception.status, fuge.Status.ERR_MESH)
        self.assertIn("pair 0: contact surface of body 1: face 0 looks into the body", caught.exception.message)


class MeshWithMatrix(unittest.TestCase):
    def test_surface_and_set(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "m.inp"
            path.write_text(
                "*NODE\n10, 0., 0.\n20, 1., 0.\n30, 1., 1.\n40, 0., 1.\n"
                "*ELEMENT, TYPE=CPE4, ELSET=ALL\n1, 10, 20, 30, 40\n"
                "*NSET, NSET=BASE\n10, 20\n*SURFACE, NAME=TOP\nALL, S3\n"
            )
            mesh = fuge.read_mesh(path)
        node, direction = np.repeat(np.array([10, 20, 30, 40], dtype=np.intc), 2), np.tile([1, 2], 4).astype(np.intc)
        # The matrix has no row for one degree of freedom, which is fixed.
        node, direction = node[1:], direction[1:]
        identity = np.arange(8, dtype=np.intc)
        stiffness = fuge.StiffnessFile((7, 7), identity, identity[:7], np.ones(7), node, direction)
        surface = mesh.surface("top", stiffness, 2)
        np.testing.assert_array_equal(surface.node, mesh.position[:, :2])
        np.testing.assert_array_equal(np.sort(surface.face[0, :2]), [2, 3])
        np.testing.assert_array_equal(surface.dof[2:], [[3, 4], [5, 6]])
        np.testing.assert_array_equal(mesh.set_dof("base", 1, stiffness), [1])
        np.testing.assert_array_equal(mesh.set_dof("base", 2, stiffness), [0, 2])
        self.assertRaises(fuge.InputError, mesh.surface, "bottom", stiffness, 2)
        self.assertRaises(fuge.InputError, mesh.surface, "top", stiffness, 4)

    def test_blocks_in_files(self):
        # Two blocks 6 wide whose meshes do not match, under 12: the job of the command fuge in this folder.
        folder = Path(__file__).resolve().parents[2] / "examples" / "data" / "blocks"
        bodies, both, surfaces = fuge.ElasticBodies(), [], []
        for name in ("lower", "upper"):
            mesh, stiffness = fuge.read_mesh(folder / f"{name}.inp"), fuge.read_stiffness(folder / f"{name}.sti")
            body = bodies.add(stiffness)
            held = [mesh.set_dof("left", 1, stiffness)]
            if name == "lower":
                held.append(mesh.set_dof("bottom", 2, stiffness))
            body.fix(np.concatenate(held))
            both.append(body)
            surfaces.append(mesh.surface("face", stiffness, 2))
        load = np.zeros(stiffness.shape[0])
        for node, force in ((13, 1.5), (50, 3.0), (87, 3.0), (23, 3.0), (60, 1.5)):
            load[(stiffness.node == node) & (stiffness.direction == 2)] = -force
        body.set_load(load)
        bodies.add_pair(both[1], surfaces[1], both[0], surfaces[0])
        contact = bodies.solve(sparse=False)
        self.assertAlmostEqual(contact.force.sum(), 12.0, delta=1e-9)
        np.testing.assert_allclose(contact.pressure, contact.pressure.mean(), rtol=1e-8)


if __name__ == "__main__":
    unittest.main()
