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


class Profiles(InFolder):
    def test_profile(self):
        x, z = fuge.read_profile(self.file("p.txt", "x z\n0 1\n1, 3\n2; 1\n"))
        np.testing.assert_array_equal(x, [0, 1, 2])
        np.testing.assert_array_equal(z, [1, 3, 1])
        np.testing.assert_allclose(fuge.sample_profile(x, z, [[0.5], [1.25]]), [[2.0], [2.5]], rtol=1e-14)
        level = fuge.level_profile(x, z, "mean")
        np.testing.assert_allclose(level, [-1, 1, -1], rtol=1e-14)
        np.testing.assert_array_equal(z, [1, 3, 1])
        np.testing.assert_allclose(fuge.level_profile(x, 3 * x, "line"), 0.0, atol=1e-14)
        self.assertRaises(fuge.InputError, fuge.sample_profile, x, z, 3.0)
        self.assertRaises(fuge.InputError, fuge.level_profile, x, z, "plane")


class Surfaces(InFolder):
    def test_rows_and_columns(self):
        height = np.arange(12.0).reshape(3, 4) / 7
        path = self.folder / "s.txt"
        fuge.write_surface(path, height, (0.5, 0.25))
        surface = fuge.read_surface(path)
        np.testing.assert_array_equal(surface.height, height)
        self.assertEqual(surface.spacing, (0.5, 0.25))
        self.assertEqual(surface.filled, 0)
        fuge.write_surface(path, height)
        self.assertIsNone(fuge.read_surface(path, "grid").spacing)
        np.testing.assert_allclose(fuge.level_surface(height, "plane"), 0.0, atol=1e-14)
        np.testing.assert_allclose(fuge.level_surface(height, "mean"), height - height.mean(), atol=1e-14)

    def test_filling(self):
        path = self.file("s.txt", "1 2 3 4\n4 nan 6 7\n7 8 9 9\n")
        self.assertRaises(fuge.FileError, fuge.read_surface, path)
        surface = fuge.read_surface(path, fill=True)
        self.assertEqual(surface.filled, 1)
        self.assertAlmostEqual(surface.height[1, 1], 5.0, delta=1e-14)

    def test_filling_of_arrays(self):
        height = np.array([[1.0, 2.0, 3.0], [np.nan, np.nan, 8.0]])
        filled = fuge.fill_surface(height)
        np.testing.assert_array_equal(filled, [[1.0, 2.0, 3.0], [1.0, 5.0, 8.0]])
        self.assertTrue(np.isnan(height[1, 0]))
        masked = np.ma.masked_greater(np.array([[1.0, 9.0, 3.0]]), 5.0)
        np.testing.assert_array_equal(fuge.fill_surface(np.ma.filled(masked, np.nan)), [[1.0, 2.0, 3.0]])
        self.assertRaisesRegex(fuge.InputError, "all heights are NaN", fuge.fill_surface, [[np.nan]])
        height[1, 0] = np.inf
        self.assertRaisesRegex(fuge.InputError, r"height\[1, 0\] = Inf", fuge.fill_surface, height)
        self.assertRaises(fuge.InputError, fuge.fill_surface, height[0])

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


if __name__ == "__main__":
    unittest.main()
