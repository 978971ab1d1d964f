"""Stresses and displacements against closed forms and against each other."""

import unittest

import numpy as np

import fuge

NU, E = 0.3, 2.0


class Halfplane(unittest.TestCase):
    def test_strip(self):
        # Uniform pressure p on (-a, a), straight below its middle: zz = -(2 p/pi)(atan(a/z) + a z/(a^2 + z^2)).
        p, a, z = 3.0, 0.5, np.array([[0.1, 1.0, 4.0]])
        stress = fuge.halfplane_stress([0.0], 2 * a, [2 * a * p], "mean", 0.0, z)
        self.assertEqual(stress.shape, (1, 3, 3))
        np.testing.assert_allclose(
            stress[..., 1], -2 * p / np.pi * (np.arctan(a / z) + a * z / (a**2 + z**2)), rtol=1e-13
        )
        np.testing.assert_allclose(stress[..., 2], 0.0, atol=1e-15)
        tensor = fuge.halfplane_tensor(stress, NU)
        np.testing.assert_allclose(tensor[..., 1], NU * (stress[..., 0] + stress[..., 1]), rtol=1e-14)
        self.assertEqual(fuge.halfplane_tensor(stress, NU, "stress")[0, 0, 1], 0.0)

    def test_grid_and_points(self):
        n, width = 16, 0.25
        x = width * np.arange(n)
        force = np.exp(-((x - 2.0) ** 2))
        depth = [0.0, 0.3, 2.0]
        grid = fuge.halfplane_stress_grid(width, force, "mean", depth)
        points = fuge.halfplane_stress(x, width, force, "mean", x[None, :], np.array(depth)[:, None])
        self.assertEqual(grid.shape, (3, n, 3))
        np.testing.assert_allclose(grid, points, rtol=0, atol=1e-13)
        moved = fuge.halfplane_displacement_grid(width, force, "mean", E, NU, depth)
        wanted = fuge.halfplane_displacement(x, width, force, "mean", E, NU, x[None, :], np.array(depth)[:, None])
        np.testing.assert_allclose(moved, wanted, rtol=0, atol=1e-12)
        periodic = fuge.halfplane_stress_grid(width, force, "mean", 1e3, "periodic")
        np.testing.assert_allclose(periodic[0, :, 1], -force.mean() / width, rtol=1e-12)

    def test_symmetric(self):
        x, force = np.array([-0.5, 0.5]), np.array([1.0, 1.0])
        whole = fuge.halfplane_stress(x, 1.0, force, "mean", 0.3, 0.7)
        half = fuge.halfplane_stress(x[1:], 1.0, [2.0], "mean", 0.3, 0.7, symmetric=True)
        np.testing.assert_allclose(half, whole, rtol=1e-13)
        np.testing.assert_allclose(
            fuge.halfplane_displacement(
                x[1:], 1.0, [2.0], "mean", E, NU, 0.3, 0.7, plane_state="stress", symmetric=True
            ),
            fuge.halfplane_displacement(x, 1.0, force, "mean", E, NU, 0.3, 0.7, plane_state="stress"),
            rtol=1e-12,
        )

    def test_errors(self):
        with self.assertRaises(fuge.InputError) as caught:
            fuge.halfplane_stress([0.0], 1.0, [1.0], "mean", 0.0, -1.0)
        self.assertEqual(caught.exception.status, fuge.Status.ERR_GRID)
        with self.assertRaisesRegex(fuge.InputError, r"px \(2,\), pz \(3,\)"):
            fuge.halfplane_stress([0.0], 1.0, [1.0], "mean", [0.0, 1.0], [0.0, 1.0, 2.0])
        with self.assertRaisesRegex(fuge.InputError, "force"):
            fuge.halfplane_stress([0.0], 1.0, [1.0, 2.0], "mean", 0.0, 1.0)


class Halfspace(unittest.TestCase):
    def test_points_and_grid(self):
        nx, ny, spacing = 6, 4, 0.5
        x, y = np.meshgrid(spacing * np.arange(nx), spacing * np.arange(ny))
        force = 1.0 + x * y
        depth = np.array([0.2, 1.5])
        grid = fuge.halfspace_stress_grid(spacing, spacing, force, NU, depth)
        self.assertEqual(grid.shape, (2, ny, nx, 6))
        cells = (x.ravel(), y.ravel(), spacing, spacing, force.ravel())
        points = fuge.halfspace_stress(*cells, NU, x, y, depth[:, None, None])
        np.testing.assert_allclose(grid, points, rtol=0, atol=1e-12 * np.abs(points).max())
        moved = fuge.halfspace_displacement_grid(spacing, spacing, force, E, NU, depth)
        wanted = fuge.halfspace_displacement(*cells, E, NU, x, y, depth[:, None, None])
        np.testing.assert_allclose(moved, wanted, rtol=0, atol=1e-12 * np.abs(wanted).max())

    def test_far_below(self):
        # Boussinesq: zz = -3 F/(2 pi z^2) straight below.
        stress = fuge.halfspace_stress([0.0], [0.0], 0.1, 0.1, [2.0], NU, 0.0, 0.0, 100.0)
        self.assertAlmostEqual(stress[2] * 2 * np.pi * 100.0**2 / (3 * 2.0), -1.0, delta=1e-5)

    def test_symmetric(self):
        whole = fuge.halfspace_stress([-0.5, 0.5], [0.0, 0.0], 1.0, 1.0, [1.0, 1.0], NU, 0.2, 0.3, 0.4)
        half = fuge.halfspace_stress([0.5], [0.0], 1.0, 1.0, [2.0], NU, 0.2, 0.3, 0.4, symmetric_x=True)
        np.testing.assert_allclose(half, whole, rtol=1e-12, atol=1e-15)
        np.testing.assert_allclose(
            fuge.halfspace_displacement([0.5], [0.0], 1.0, 1.0, [2.0], E, NU, 0.2, 0.3, 0.4, symmetric_x=True),
            fuge.halfspace_displacement([-0.5, 0.5], [0.0, 0.0], 1.0, 1.0, [1.0, 1.0], E, NU, 0.2, 0.3, 0.4),
            rtol=1e-12,
        )

    def test_rings(self):
        # One disc: zz straight below is -p (1 - z^3/(a^2 + z^2)^(3/2)).
        z = np.array([0.5, 2.0])
        stress = fuge.ring_stress([0.0, 1.0], [np.pi], NU, 0.0, z)
        np.testing.assert_allclose(stress[:, 2], -(1 - z**3 / (1 + z**2) ** 1.5), rtol=1e-12)
        surface = fuge.ring_interior_displacement([0.0, 1.0], [np.pi], E, NU, 0.5, 0.0)
        wanted = fuge.ring_displacement([0.0, 1.0], [np.pi], fuge.plane_modulus(E, NU), 0.5)
        self.assertAlmostEqual(surface[1], float(wanted), delta=1e-12)


class Measures(unittest.TestCase):
    def test_tension_and_shear(self):
        tensor = np.zeros((2, 6))
        tensor[0, 0] = 3.0
        tensor[1, 5] = 2.0
        np.testing.assert_allclose(fuge.von_mises(tensor), [3.0, 2 * np.sqrt(3)], rtol=1e-14)
        np.testing.assert_allclose(fuge.tresca(tensor), [3.0, 4.0], rtol=1e-14)
        np.testing.assert_allclose(fuge.mean_stress(tensor), [1.0, 0.0], atol=1e-15)
        np.testing.assert_allclose(fuge.principal_stresses(tensor), [[3, 0, 0], [2, 0, -2]], atol=1e-14)
        self.assertEqual(fuge.von_mises(tensor[0]).shape, ())
        self.assertRaises(fuge.InputError, fuge.von_mises, np.zeros((6, 2)))

    def test_round(self):
        np.testing.assert_array_equal(fuge.round_tensor([1.0, 2.0, 3.0, 4.0]), [1.0, 2.0, 3.0, 0.0, 4.0, 0.0])


class Peaks(unittest.TestCase):
    def test_line_contact(self):
        # Under Hertz's line contact the largest Tresca stress is 0.6006 p0 at the depth 0.786 a.
        contact = fuge.solve_smooth_punch(lambda x: (x**2 / 2, x), -3.0, 3.0, 1.0, np.pi / 4)
        self.assertAlmostEqual(contact.half_width, 1.0, delta=1e-13)
        peak = contact.peak(NU, "tresca")
        self.assertEqual(peak.location, "inside")
        self.assertAlmostEqual(peak.value / 0.5, 0.6006, delta=1e-4)
        self.assertAlmostEqual(peak.place[2], 0.786, delta=1e-3)
        n = 100
        x = (np.arange(n) - (n - 1) / 2) * 0.03
        force = 0.03 * contact.pressure(x)
        found = fuge.halfplane_peak(x, 0.03, force, "hat", NU, "tresca")
        self.assertAlmostEqual(found.value, peak.value, delta=1e-3)
        half = fuge.halfplane_peak(x[n // 2 :], 0.03, 2 * force[n // 2 :], "hat", NU, "tresca", symmetric=True)
        self.assertAlmostEqual(half.value, found.value, delta=1e-12)

    def test_area(self):
        n, spacing = 17, 0.125
        x, y = np.meshgrid((np.arange(n) - 8) * spacing, (np.arange(n) - 8) * spacing)
        force = spacing**2 * np.sqrt(np.maximum(0.0, 1 - x**2 - y**2))
        cells = (x.ravel(), y.ravel(), spacing, spacing, force.ravel())
        peak = fuge.halfspace_peak(*cells, NU)
        self.assertAlmostEqual(peak.value, 0.62, delta=0.01)
        self.assertAlmostEqual(peak.tensor[2], fuge.halfspace_stress(*cells, NU, *peak.place)[2], delta=1e-9)
        quarter = (x >= 0) & (y >= 0)
        weight = np.where(x > 0, 2.0, 1.0) * np.where(y > 0, 2.0, 1.0)
        part = [values[quarter] for values in (x, y)]
        found = fuge.halfspace_peak(
            *part, spacing, spacing, (force * weight)[quarter], NU, symmetric_x=True, symmetric_y=True
        )
        self.assertAlmostEqual(found.value, peak.value, delta=1e-9)

    def test_rings(self):
        radius = np.linspace(0.0, 1.0, 41)
        resultant = -2 * np.pi / 3 * np.diff((1 - radius**2) ** 1.5)
        self.assertAlmostEqual(fuge.ring_peak(radius, resultant, NU).value, 0.62, delta=0.01)

    def test_singular(self):
        x = (np.arange(40) + 0.5) / 20 - 1
        contact = fuge.solve(fuge.halfplane_matrix(x, 0.05, 1.0, "mean"), 0.0, 1.0)
        peak = fuge.halfplane_peak(x, 0.05, contact.force, "mean", NU)
        self.assertEqual(peak.location, "singular")
        self.assertTrue(np.isinf(peak.value) and np.isnan(peak.tensor).all())


if __name__ == "__main__":
    unittest.main()
