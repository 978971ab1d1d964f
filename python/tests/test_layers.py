"""Coated, layered and graded bodies: operators against matrices, layers that are none, and known answers."""

import unittest

import numpy as np

import fuge

SAME = fuge.Layers([0.2, 0.5], 2.0, 0.3)
COATED = fuge.Layers(0.1, [10.0, 1.0], [0.3, 0.2])


class Bodies(unittest.TestCase):
    def test_modulus_of_short_waves(self):
        self.assertAlmostEqual(COATED.e_star, 10.0 / 0.91)
        other = fuge.Layers([0.1], [10.0, 1.0], [0.3, 0.2], e_star_other=5.0)
        self.assertAlmostEqual(other.e_star, 1.0 / (0.091 + 0.2))

    def test_waves(self):
        # One layer in closed form (Burmister, 1945), and both half-spaces.
        layers = fuge.Layers(0.5, [1.0, 5.0], [0.3, 0.25])
        self.assertAlmostEqual(float(layers.compliance(2.0)), 0.91 * 0.544228816954707, delta=1e-14)
        q = np.array([[1e-9, 2.0], [2.0, 1e9]])
        found = layers.compliance(q) * q
        self.assertEqual(found.shape, (2, 2))
        np.testing.assert_allclose(found[0, 0], 2.0 * 0.9375 / 5.0, rtol=1e-7)
        np.testing.assert_allclose(found[1, 1], 2.0 * 0.91, rtol=1e-14)
        sliding = fuge.Layers(0.5, [1.0, 5.0], [0.3, 0.25], bonded=False)
        self.assertGreater(float(sliding.compliance(2.0)), float(layers.compliance(2.0)))
        self.assertEqual(layers.compliance([]).shape, (0,))

    def test_no_layers(self):
        none = fuge.Layers([], [2.0], 0.3)
        np.testing.assert_allclose(none.compliance([1.0, 4.0]), 0.91 * np.array([1.0, 0.25]), rtol=1e-14)
        x, y = np.array([-0.5, 0.5, -0.5, 0.5]), np.array([-0.5, -0.5, 0.5, 0.5])
        for layers in (SAME, none):
            modulus = layers.e_star
            np.testing.assert_allclose(
                layers.halfplane_matrix(x[:2], 1.0, "hat"),
                fuge.halfplane_matrix(x[:2], 1.0, modulus, "hat"),
                rtol=1e-13,
            )
            np.testing.assert_allclose(
                layers.halfspace_matrix(x, y, 1.0, 1.0, "centre"),
                fuge.halfspace_matrix(x, y, 1.0, 1.0, modulus, "centre"),
                rtol=1e-13,
            )
            radius = [0.0, 0.5, 1.0]
            np.testing.assert_allclose(layers.ring_matrix(radius), fuge.ring_matrix(radius, modulus), rtol=1e-13)

    def test_symmetric(self):
        x = np.array([-1.5, -0.5, 0.5, 1.5])
        for whole, half in (
            (COATED.halfplane_matrix(x, 1.0, "mean"), COATED.halfplane_matrix(x[2:], 1.0, "mean", symmetric=True)),
            (
                COATED.halfspace_matrix(x, np.zeros(4), 1.0, 1.0, "mean"),
                COATED.halfspace_matrix(x[2:], np.zeros(2), 1.0, 1.0, "mean", symmetric_x=True),
            ),
        ):
            np.testing.assert_allclose(half, 0.5 * (whole[2:, 2:] + whole[2:, 1::-1]), rtol=1e-12)

    def test_refusals(self):
        for arguments, words in (
            (([0.1, 0.2], [1.0, 2.0], 0.3), r"young has the shape \(2,\), but must have \(3,\)"),
            ((0.0, [1.0, 2.0], 0.3), "thickness 1 = 0"),
            ((0.1, [np.inf, 2.0], 0.3), "rigid base"),
            ((0.1, [1.0, 2.0], 0.6), "poisson 1 = 0.6"),
            (([[0.1]], [1.0, 2.0], 0.3), r"thickness has the shape \(1, 1\)"),
        ):
            with self.assertRaisesRegex(fuge.InputError, words):
                fuge.Layers(*arguments)
        with self.assertRaisesRegex(fuge.InputError, "q 2 = -1"):
            COATED.compliance([1.0, -1.0])
        self.assertRaises(TypeError, fuge.Layers, "thin", [1.0, 2.0], 0.3)
        with self.assertRaisesRegex(TypeError, "bonded must be True or False, not 7"):
            fuge.Layers(0.1, [1.0, 2.0], 0.3, bonded=7)
        self.assertRaises(fuge.InputError, COATED.ring_matrix, [])
        self.assertRaises(fuge.InputError, COATED.halfplane_matrix, [0.0], 1.0, "round")

    def test_numbers_and_layers_in_the_place_of_each_other(self):
        radius, force = [0.0, 1.0], np.ones(2)
        for call in (
            lambda: fuge.LayeredHalfplaneOperator(2, 1.0, 2e5),
            lambda: fuge.LayeredHalfspaceOperator(2, 2, 1.0, 1.0, 2e5),
            lambda: fuge.Field.halfplane_grid(1.0, force, layers=2e5),
        ):
            with self.assertRaisesRegex(TypeError, r"layers must be Layers, not float: .* Layers\(\[\], young"):
                call()
        for call in (
            lambda: fuge.ring_matrix(radius, COATED),
            lambda: fuge.halfplane_matrix([0.0], 1.0, COATED),
            lambda: fuge.halfspace_matrix([0.0], [0.0], 1.0, 1.0, COATED),
            lambda: fuge.HalfplaneOperator(2, 1.0, COATED),
            lambda: fuge.HalfspaceOperator(2, 2, 1.0, 1.0, COATED),
        ):
            with self.assertRaisesRegex(TypeError, "e_star must be a real number, not Layers: .*ring_matrix"):
                call()


class Operators(unittest.TestCase):
    def test_line(self):
        n, width = 48, 1.0 / 48
        x = width * (np.arange(n) - 0.5 * (n - 1))
        operator = fuge.LayeredHalfplaneOperator(n, width, COATED)
        self.assertIsInstance(operator, fuge.HalfplaneOperator)
        self.assertEqual((operator.n, operator.spacing, operator.boundary), (n, width, "free"))
        self.assertFalse(operator.cells.homogeneous)
        self.assertIn("LayeredHalfplaneOperator(n=48, spacing=0.0208", repr(operator))
        self.assertIn("layers=Layers(thickness=0.1", repr(operator))
        found = fuge.solve(operator, x**2, 0.05, tolerance=1e-12)
        wanted = fuge.solve(COATED.halfplane_matrix(x, width, "mean"), x**2, 0.05)
        np.testing.assert_allclose(found.force, wanted.force, rtol=0, atol=1e-9)
        np.testing.assert_allclose(found.pressure.sum() * width, 0.05)
        self.assertAlmostEqual(found.approach, wanted.approach, delta=1e-9)

    def test_area(self):
        nx, ny, width = 12, 9, 0.1
        x, y = np.meshgrid(width * (np.arange(nx) - 5.5), width * (np.arange(ny) - 4.0))
        operator = fuge.LayeredHalfspaceOperator(nx, ny, width, width, COATED)
        self.assertEqual((operator.nx, operator.ny, operator.grid), (nx, ny, (ny, nx)))
        self.assertIn("layers=Layers(", repr(operator))
        found = fuge.solve(operator, x**2 + y**2, 0.3, tolerance=1e-12)
        alpha = COATED.halfspace_matrix(x.ravel(), y.ravel(), width, width, "mean")
        wanted = fuge.solve(alpha, (x**2 + y**2).ravel(), 0.3)
        np.testing.assert_allclose(found.force.ravel(), wanted.force, rtol=0, atol=1e-8)

    def test_no_layers(self):
        force = np.cos(np.arange(30.0)).reshape(5, 6)
        for boundary in ("free", "periodic", "periodic_x", "periodic_y"):
            found = fuge.LayeredHalfspaceOperator(6, 5, 0.5, 0.25, SAME, boundary=boundary) @ force
            wanted = fuge.HalfspaceOperator(6, 5, 0.5, 0.25, SAME.e_star, boundary=boundary) @ force
            np.testing.assert_allclose(found, wanted, rtol=0, atol=1e-14)
        for boundary in ("free", "periodic"):
            found = fuge.LayeredHalfplaneOperator(30, 0.5, SAME, "centre", boundary) @ force.ravel()
            wanted = fuge.HalfplaneOperator(30, 0.5, SAME.e_star, "centre", boundary) @ force.ravel()
            np.testing.assert_allclose(found, wanted, rtol=0, atol=1e-14)

    def test_layer_on_a_rigid_base(self):
        # A periodic surface under equal forces: pressure times thickness over the modulus in constrained compression.
        layers = fuge.Layers(0.1, [2.0, np.inf], [0.25, 0.0])
        operator = fuge.LayeredHalfspaceOperator(4, 4, 0.5, 0.5, layers, boundary="periodic")
        np.testing.assert_allclose(operator @ np.full((4, 4), 0.25), 0.1 / 2.4, rtol=1e-10)

    def test_refusals(self):
        with self.assertRaises(fuge.InputError) as caught:
            fuge.LayeredHalfplaneOperator(0, 1.0, COATED)
        self.assertEqual(caught.exception.status, fuge.Status.ERR_SIZE)
        with self.assertRaises(fuge.InputError):
            fuge.LayeredHalfspaceOperator(2, 2, 1.0, -1.0, COATED)
        with self.assertRaisesRegex(fuge.InputError, "rigid base"):
            fuge.LayeredHalfspaceOperator(2, 2, 1.0, 1.0, fuge.Layers(0.1, np.inf, 0.3))


class Graded(unittest.TestCase):
    def test_constant(self):
        layers = fuge.graded_layers([0.0, 0.5, 0.5], [3.0, 3.0, np.inf], 0.3)
        np.testing.assert_array_equal(layers.thickness, [0.5])
        np.testing.assert_array_equal(layers.young, [3.0, np.inf])
        self.assertEqual(layers.error, 0.0)
        self.assertEqual(fuge.graded_layers([0.0], [3.0], 0.3).thickness.size, 0)

    def test_error(self):
        q = np.geomspace(1e-3, 1e5, 30)
        coarse = fuge.graded_layers([0.0, 2.0], [1.0, 8.0], [0.3, 0.2], 1e-2, e_star_other=4.0)
        fine = fuge.graded_layers([0.0, 2.0], [1.0, 8.0], [0.3, 0.2], e_star_other=4.0)
        self.assertIsInstance(fine, fuge.Layers)
        self.assertEqual(fine.e_star_other, 4.0)
        self.assertLessEqual(fine.error, 1e-4)
        self.assertGreater(coarse.error, fine.error)
        self.assertGreater(fine.thickness.size, coarse.thickness.size)
        difference = np.abs(coarse.compliance(q) / fine.compliance(q) - 1.0)
        self.assertLess(difference.max(), 1.2 * coarse.error + fine.error)
        self.assertAlmostEqual(fine.thickness.sum(), 2.0)

    def test_springs(self):
        # Incompressible, with a modulus that grows from nearly nothing: the surface is one of springs (Gibson, 1967).
        layers = fuge.graded_layers([0.0, 1e3], [3e-3, 3e3], 0.5)
        np.testing.assert_allclose(layers.compliance([0.03, 0.1, 0.3]), 0.5, rtol=2e-3)

    def test_refusals(self):
        with self.assertRaisesRegex(fuge.InputError, r"depth\[1\] = -1"):
            fuge.graded_layers([0.0, -1.0], [1.0, 2.0], 0.3)
        with self.assertRaisesRegex(fuge.InputError, r"young has the shape \(3,\)"):
            fuge.graded_layers([0.0, 1.0], [1.0, 2.0, 3.0], 0.3)
        with self.assertRaisesRegex(fuge.InputError, "tolerance = 0"):
            fuge.graded_layers([0.0, 1.0], [1.0, 2.0], 0.3, 0.0)
        with self.assertRaisesRegex(fuge.LimitError, "max_layers = 10 are too few"):
            fuge.graded_layers([0.0, 1.0], [1.0, 2.0], 0.3, 1e-6, max_layers=10)
        with self.assertRaisesRegex(fuge.InputError, "max_layers = -3"):
            fuge.graded_layers([0.0, 1.0], [1.0, 2.0], 0.3, max_layers=-3)


class EffectiveModulus(unittest.TestCase):
    def test_limits(self):
        modulus = COATED.effective_modulus([[1e-12, 1.0, 1e11]])
        self.assertEqual(modulus.shape, (1, 3))
        np.testing.assert_allclose(modulus[0, ::2], [10.0 / 0.91, 1.0 / 0.96], rtol=1e-9)
        self.assertTrue(modulus[0, 0] > modulus[0, 1] > modulus[0, 2])
        self.assertAlmostEqual(float(SAME.effective_modulus(3.0)), SAME.e_star)

    def test_flat_punch(self):
        # The stiffness by rings.
        layers = fuge.Layers(0.3, [10.0, 1.0], 0.3)
        radius = np.sin(np.linspace(0.0, np.pi / 2, 61))
        stiffness = np.linalg.solve(layers.ring_matrix(radius), np.ones(60)).sum()
        self.assertAlmostEqual(float(layers.effective_modulus(1.0)) / stiffness, 0.5, delta=5e-5)

    def test_coating(self):
        young, poisson, radius, share = [10.0, 1.0], [0.3, 0.2], 2.0, 0.01
        found = fuge.coating_limits(young, poisson, radius, share)
        self.assertLess(found.thin, found.thick)
        for thickness, wanted in ((found.thin, 1.01 / 0.96), (found.thick, 0.99 * 10.0 / 0.91)):
            modulus = float(fuge.Layers(thickness, young, poisson).effective_modulus(radius))
            self.assertAlmostEqual(modulus, wanted, delta=1e-6)
        self.assertEqual(fuge.coating_limits([1.0, 1.0], 0.3, 1.0, share), (np.inf, 0.0))
        self.assertEqual(fuge.coating_limits([1.0, np.inf], 0.3, 1.0, share).thin, 0.0)

    def test_refusals(self):
        with self.assertRaisesRegex(fuge.InputError, r"radius\[0, 1\] = 0"):
            COATED.effective_modulus([[1.0, 0.0]])
        with self.assertRaisesRegex(fuge.InputError, "share = 0"):
            fuge.coating_limits([1.0, 2.0], 0.3, 1.0, 0.0)
        with self.assertRaisesRegex(fuge.InputError, r"young has the shape \(3,\)"):
            fuge.coating_limits([1.0, 2.0, 3.0], 0.3, 1.0, 0.1)


if __name__ == "__main__":
    unittest.main()
