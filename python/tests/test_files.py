"""Files that are read and written."""

import tempfile
import unittest
from pathlib import Path

import numpy as np

import fuge


class InFolder(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = Path(holder.name)

    def file(self, name, text):
        path = self.folder / name
        path.write_text(text, encoding="utf-8")
        return path


class Matrices(InFolder):
    def test_dense(self):
        path = self.folder / "a.mtx"
        matrix = np.random.default_rng(1).random((3, 2))
        for array in (matrix, np.asfortranarray(matrix)):
            fuge.write_matrix(path, array)
            np.testing.assert_array_equal(fuge.read_matrix(path), matrix)
        square = matrix @ matrix.T
        fuge.write_matrix(str(path), square, symmetric=True)
        np.testing.assert_array_equal(np.tril(fuge.read_matrix(path)), np.tril(square))

    def test_sparse(self):
        path = self.folder / "k.mtx"
        fuge.write_sparse(
            path, fuge.CompressedColumns((2, 3), np.array([0, 1, 1, 3]), np.array([1, 0, 1]), np.arange(1.0, 4))
        )
        back = fuge.read_sparse(path)
        self.assertEqual(back.shape, (2, 3))
        np.testing.assert_array_equal(back.column, [0, 1, 1, 3])
        np.testing.assert_array_equal(back.row, [1, 0, 1])
        np.testing.assert_array_equal(back.value, [1.0, 2.0, 3.0])
        np.testing.assert_array_equal(fuge.read_matrix(path), [[0, 0, 2], [1, 0, 3]])

    def test_stiffness(self):
        path = self.file("k.mtx", "*MATRIX,TYPE=STIFFNESS\n1,1, 1,1,  2.0\n1,1, 2,1, -1.0\n2,1, 2,1, 2.0\n")
        stiffness = fuge.read_stiffness(path, "abaqus")
        np.testing.assert_array_equal(stiffness.node, [1, 2])
        np.testing.assert_array_equal(stiffness.direction, [1, 1])
        np.testing.assert_array_equal(stiffness.value, [2.0, -1.0, -1.0, 2.0])

    def test_missing(self):
        with self.assertRaises(fuge.FileError) as caught:
            fuge.read_matrix(self.folder / "none.mtx")
        self.assertEqual(caught.exception.status, fuge.Status.ERR_FILE)
        self.assertIn("none.mtx", caught.exception.message)
        self.assertRaises(OSError, fuge.read_stiffness, self.file("k", "?\n"))


class Pictures(InFolder):
    def test_pictures(self):
        field = np.arange(6.0).reshape(2, 3)
        path = self.folder / "f.vti"
        fuge.write_results(path, (1.0, 2.0), {"pressure": field, "gap": -field}, origin=(5.0, 6.0))
        text = path.read_bytes()
        self.assertIn(b'"pressure"', text)
        self.assertIn(field.tobytes(), text)
        self.assertIn((-field).tobytes(), text)
        path = self.folder / "f.vtr"
        volume = np.arange(12.0).reshape(2, 2, 3)
        fuge.write_volume(path, (1.0, 2.0), [0.0, 1.0], {"zz": volume})
        self.assertIn(volume.tobytes(), path.read_bytes())
        with self.assertRaisesRegex(fuge.InputError, "gap"):
            fuge.write_results(path, (1.0, 2.0), {"pressure": field, "gap": field.T})
        self.assertRaises(fuge.InputError, fuge.write_results, path, (1.0, 2.0), {})


class Decks(InFolder):
    text = (
        "GRID,1\nGRID,2,,0.,0.,2.\nCGAP,12,5,1,2\nPGAP,5,.5,,4.\n"
        "FORCE,3,2,,2.,0.,0.,-1.\nSPC,4,1,13,.25\n"
    )

    def test_deck(self):
        deck = fuge.read_deck(self.file("m.bdf", self.text))
        self.assertEqual((deck.link_names, deck.case_names), (["CGAP 12"], ["SUBCASE 1"]))
        np.testing.assert_array_equal(deck.direction, [[0, 0, 1]])
        np.testing.assert_array_equal([deck.gap, deck.compliance], [[0.5], [0.25]])
        self.assertTrue(np.isinf(deck.play[0]) and np.isinf(deck.limit[0]))
        entries = "\n".join(f"{k} {k} 1.0" for k in range(1, 5))
        names = self.file("k.dof", "1.1\n1.3\n2.1\n2.3\n")
        market = f"%%MatrixMarket matrix coordinate real symmetric\n4 4 4\n{entries}\n"
        stiffness = fuge.read_stiffness(self.file("k.mtx", market), names_path=names)
        links = deck.links(stiffness)
        self.assertEqual(links.names, ("CGAP 12",))
        self.assertEqual((links.count, links.gap.tolist()), (1, [0.5]))
        np.testing.assert_array_equal(deck.loads(stiffness), [[0, 0, 0, -2]])
        held, displacement = deck.supports(0, stiffness)
        np.testing.assert_array_equal(np.sort(held), [0, 1])
        np.testing.assert_array_equal(displacement, [0.25, 0.25])
        self.assertRaises(fuge.InputError, deck.supports, 1, stiffness)
        # The force 2 minus that of the spring closes the gap, and more, by the displacement 0.25 of node 1.
        body = fuge.Body(np.eye(4))
        body.fix(held)
        body.set_links(links)
        body.condense()
        cases = body.solve_cases(deck.loads(stiffness), supports=[displacement])
        np.testing.assert_allclose(cases.force, [[1.4]], rtol=1e-14)
        np.testing.assert_allclose(cases.displacement, [[0.25, 0.25, 0.0, -0.6]], rtol=1e-14)

    def test_tables(self):
        deck = fuge.Deck()
        self.assertEqual(deck.link_names, [])
        deck.read_links(self.file("links.csv", "0,2,0,-3,0,1,2,0,5,rope\n"))
        deck.read_supports(self.file("supports.csv", "2,x\n"))
        deck.read_cases(self.file("cases.csv", "row,wind\n2.1,8\n"))
        self.assertEqual((deck.link_names, deck.case_names), (["rope"], ["wind"]))
        np.testing.assert_array_equal([deck.play, deck.limit], [[2], [5]])
        with self.assertRaisesRegex(fuge.FileError, "line 1: the stiffness is negative"):
            deck.read_links(self.file("wrong.csv", "0,2,0,-3,0,1,2,-1\n"))


class Meshes(InFolder):
    text = (
        "*NODE\n10, 0., 0., 0.\n20, 1., 0., 0.\n30, 0., 1., 0.\n40, 0., 0., 1.\n"
        "*ELEMENT, TYPE=c3d4, ELSET=Tet\n7, 10, 20, 30, 40\n*NSET, NSET=BASE\n10, 30, 20\n"
        "*SURFACE, NAME=FOOT\nTET, S1\nTET, S3\n"
    )

    def test_mesh(self):
        mesh = fuge.read_mesh(self.file("m.inp", self.text))
        np.testing.assert_array_equal(mesh.node, [10, 20, 30, 40])
        np.testing.assert_array_equal(mesh.position, [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
        np.testing.assert_array_equal(mesh.element, [7])
        np.testing.assert_array_equal(mesh.first, [0, 4])
        np.testing.assert_array_equal(mesh.connection, [0, 1, 2, 3])
        self.assertEqual(mesh.element_type(0), "C3D4")
        self.assertEqual((mesh.node_sets, mesh.element_sets, mesh.surfaces), (["BASE"], ["TET"], ["FOOT"]))
        np.testing.assert_array_equal(mesh.node_set("base"), [0, 2, 1])
        np.testing.assert_array_equal(mesh.element_set("TET"), [0])
        faces = mesh.faces("foot")
        self.assertEqual(faces.shape, (2, 8))
        np.testing.assert_array_equal(faces[0, :4], [0, 2, 1, -1])
        with self.assertRaisesRegex(fuge.InputError, '"TOP", it has FOOT'):
            mesh.faces("TOP")
        self.assertRaises(fuge.InputError, mesh.element_type, 1)

    def test_broken(self):
        with self.assertRaisesRegex(fuge.FileError, "m.inp"):
            fuge.read_mesh(self.file("m.inp", "*NODE\n10, x\n"))

    def test_arrays_and_pictures(self):
        mesh = fuge.Mesh.from_arrays([[0, 0], [1, 0], [1, 1], [0, 1]], [[0, 1, 2, 3]], "CPE4")
        self.assertEqual(mesh.position.shape, (4, 3))
        both = fuge.join_meshes([mesh, mesh])
        self.assertEqual(both.node.size, 8)
        np.testing.assert_array_equal(both.connection, np.arange(8))
        path = self.folder / "m.vtu"
        both.write(path)
        both.write(path, {"displacement": np.ones((8, 2)), "gap": np.arange(8)}, {"body": [0, 1]})
        text = path.read_bytes()
        for name in (b'"displacement"', b'"gap"', b'"body"'):
            self.assertIn(name, text)
        self.assertRaises(fuge.InputError, both.write, path, {"gap": np.arange(7)})
        self.assertRaises(fuge.InputError, fuge.Mesh.from_arrays, [[0, 0]], [[0]], "CPE4")


if __name__ == "__main__":
    unittest.main()
