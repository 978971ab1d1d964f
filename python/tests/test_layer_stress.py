"""Stresses and displacements in layers: a layer that is none, both sides of an interface, what cracks coatings."""

import unittest

import numpy as np

import fuge

SAME = fuge.Layers([0.2, 0.5], 2.0, 0.3)
FILM = fuge.Layers(0.3, [4.0, 1.0], [0.2, 0.3])


def ball(n=9):
    """A round pressure in the middle of n x n cells."""
    i = np.arange(n) - n // 2
    return np.sqrt(np.maximum(9.0 - i**2 - i[:, None] ** 2, 0.0))


class LayerStress(unittest.TestCase):
    def test_no_layers(self):
        force, depth = ball()[:, :7], [0.0, 0.4]
        np.testing.assert_array_equal(
            fuge.layered_halfspace_stress_grid(SAME, 0.2, 0.3, force, depth),
            fuge.halfspace_stress_grid(0.2, 0.3, force, 0.3, depth),
        )
        np.testing.assert_allclose(
            fuge.layered_halfspace_displacement_grid(SAME, 0.2, 0.3, force, depth, "periodic_x"),
            fuge.halfspace_displacement_grid(0.2, 0.3, force, 2.0, 0.3, depth, "periodic_x"),
            atol=1e-14,
        )
        np.testing.assert_array_equal(
            fuge.layered_halfplane_stress_grid(SAME, 0.2, force[0], depth, "periodic"),
            fuge.halfplane_stress_grid(0.2, force[0], "mean", depth, "periodic"),
        )
        np.testing.assert_allclose(
            fuge.layered_halfplane_displacement_grid(SAME, 0.2, force[0], 0.4),
            fuge.halfplane_displacement_grid(0.2, force[0], "mean", 2.0, 0.3, 0.4),
            atol=1e-14,
        )

    def test_interface(self):
        above, under = fuge.layered_halfspace_stress_grid(FILM, 0.2, 0.2, ball(), [0.3, 0.3], below=[False, True])
        np.testing.assert_allclose(above[..., 2:5], under[..., 2:5], atol=1e-10)
        self.assertGreater(above[4, 4, 0], under[4, 4, 0])
        surface, interface = fuge.layered_halfspace_interfaces(FILM, 0.2, 0.2, ball())
        self.assertEqual(surface.depth, 0.0)
        self.assertEqual(surface.shear, 0.0)
        self.assertEqual(interface.depth, 0.3)
        self.assertEqual(interface.cell_above, (4, 4))
        self.assertAlmostEqual(interface.tension_above, above[4, 4, 0], delta=1e-9)
        shear = np.hypot(above[..., 3], above[..., 4])
        self.assertAlmostEqual(interface.shear, shear.max(), delta=1e-9)
        self.assertAlmostEqual(shear[interface.cell_of_shear], shear.max(), delta=1e-9)
        (only,) = fuge.layered_halfspace_interfaces(SAME, 0.2, 0.2, ball())
        self.assertEqual(only.tension_above, only.tension_below)
        self.assertEqual(len(fuge.layered_halfplane_interfaces(FILM, 0.2, ball()[4])), 2)

    def test_points(self):
        i = 0.2 * np.arange(9)
        x, y = np.broadcast_arrays(i, i[:, None])
        cells = (x.ravel(), y.ravel(), 0.2, 0.2, ball().ravel())
        grid = fuge.layered_halfspace_stress_grid(FILM, 0.2, 0.2, ball(), 0.3, below=True)[0]
        found = fuge.layered_halfspace_stress(FILM, *cells, x, y, 0.3, below=True)
        np.testing.assert_allclose(found, grid, atol=1e-10)
        grid = fuge.layered_halfspace_displacement_grid(FILM, 0.2, 0.2, ball(), 0.5)[0]
        np.testing.assert_allclose(fuge.layered_halfspace_displacement(FILM, *cells, x, y, 0.5), grid, atol=1e-10)
        row = ball()[4]
        grid = fuge.layered_halfplane_stress_grid(FILM, 0.2, row, [0.0, 0.3])
        points = fuge.layered_halfplane_stress(FILM, i, 0.2, row, i, [[0.0], [0.3]])
        np.testing.assert_allclose(points, grid, atol=1e-10)
        grid = fuge.layered_halfplane_displacement_grid(FILM, 0.2, row, 0.3)[0]
        np.testing.assert_allclose(fuge.layered_halfplane_displacement(FILM, i, 0.2, row, i, 0.3), grid, atol=1e-10)

    def test_peak(self):
        peak = fuge.layered_halfspace_peak(FILM, 0.2, 0.2, ball())
        depth = [0.0, 0.1, 0.3, 0.3, 0.6, 1.0]
        stress = fuge.layered_halfspace_stress_grid(FILM, 0.2, 0.2, ball(), depth, below=np.arange(6) == 3)
        self.assertGreaterEqual(peak.value, fuge.von_mises(stress).max() * (1 - 1e-9))
        self.assertAlmostEqual(peak.value, float(fuge.von_mises(peak.tensor)), delta=1e-12 * peak.value)
        self.assertEqual(len(peak.cell), 2)
        self.assertIn(peak.layer, (0, 1))
        line = fuge.layered_halfplane_peak(FILM, 0.2, ball()[4], "periodic", "tresca")
        self.assertGreater(line.value, 0.0)
        self.assertEqual(len(line.cell), 1)

    def test_sides(self):
        with self.assertRaisesRegex(TypeError, "below must hold booleans"):
            fuge.layered_halfspace_stress_grid(FILM, 0.2, 0.2, ball(), 0.3, below=1)
        with self.assertRaisesRegex(fuge.InputError, "below has the shape"):
            fuge.layered_halfspace_stress_grid(FILM, 0.2, 0.2, ball(), [0.0, 0.3], below=[True] * 3)

    def test_errors(self):
        rigid = fuge.Layers(0.3, [1.0, np.inf], 0.3)
        with self.assertRaisesRegex(fuge.InputError, "rigid base"):
            fuge.layered_halfspace_stress_grid(rigid, 0.2, 0.2, ball(), 0.5)
        with self.assertRaises(fuge.InputError):
            fuge.layered_halfplane_stress_grid(FILM, 0.2, ball()[4], 0.5, element="hat")
        with self.assertRaises(ValueError):
            fuge.layered_halfplane_stress_grid(FILM, 0.2, ball()[4], [0.5, 0.6], below=[True, False, True])


if __name__ == "__main__":
    unittest.main()
