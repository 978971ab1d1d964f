"""Smooth and round punches against Hertz and closed forms."""

import unittest
import warnings

import numpy as np

import fuge


class Smooth(unittest.TestCase):
    def solve(self, **motion):
        return fuge.solve_smooth_punch(lambda x: (x**2 / 2, x), -3.0, 3.0, 1.0, np.pi / 4, **motion)

    def test_hertz(self):
        contact = self.solve()
        np.testing.assert_allclose([contact.left, contact.right, contact.half_width], [-1, 1, 1], rtol=1e-13)
        x = np.array([[-2.0, 0.0], [0.6, 1.5]])
        np.testing.assert_allclose(contact.pressure(x), np.array([[0.0, 0.5], [0.4, 0.0]]), atol=1e-13)
        self.assertLess(contact.residual, 1e-12)
        self.assertAlmostEqual(contact.coefficients[0], 0.5, delta=1e-13)
        gap = contact.gap(x, x**2 / 2)
        self.assertEqual(gap.shape, (2, 2))
        np.testing.assert_allclose(gap[0, 1], 0.0, atol=1e-13)
        self.assertGreater(gap[1, 1], 0.0)
        stress = contact.field(poisson=0.3).stress([0.6, 0.0, 0.0])
        np.testing.assert_allclose(stress, [-0.4, -0.24, -0.4, 0.0, 0.0, 0.0], atol=1e-12)

    def test_against_the_grid(self):
        n = 400
        x = (np.arange(n) - (n - 1) / 2) * 0.01
        grid = fuge.solve(fuge.halfplane_matrix(x, 0.01, 1.0, "hat"), x**4, 0.3)
        contact = fuge.solve_smooth_punch(lambda x: (x**4, 4 * x**3), -2.0, 2.0, 1.0, 0.3)
        self.assertLess(np.abs(grid.force - 0.01 * contact.pressure(x)).sum(), 2e-3 * 0.3)

    def test_moment(self):
        contact = self.solve(moment=0.1)
        self.assertAlmostEqual(contact.moment, 0.1, delta=1e-12)
        # A parabola that tilts moves its contact to the line of action.
        self.assertAlmostEqual((contact.left + contact.right) / 2, 0.1 / (np.pi / 4), delta=1e-12)

    def test_refused(self):
        with self.assertRaises(fuge.UnsupportedError) as caught:
            fuge.solve_smooth_punch(lambda x: (x**2 / 2, x), -0.5, 0.5, 1.0, np.pi / 4)
        self.assertTrue(caught.exception.message)
        self.assertRaises(fuge.EquilibriumError, fuge.solve_smooth_punch, lambda x: (x**2, 2 * x), -1.0, 1.0, 1.0, -1.0)

    def test_exceptions_of_the_profile(self):
        def profile(x):
            raise LookupError("mine")

        with self.assertRaisesRegex(LookupError, "mine"):
            fuge.solve_smooth_punch(profile, -1.0, 1.0, 1.0, 1.0)
        self.assertRaises(TypeError, fuge.solve_smooth_punch, lambda x: x, -1.0, 1.0, 1.0, 1.0)
        self.assertRaises(ValueError, fuge.solve_smooth_punch, lambda x: (x[:-1], x), -1.0, 1.0, 1.0, 1.0)
        self.assertRaises(fuge.CallbackError, fuge.solve_smooth_punch, lambda x: (x * np.nan, x), -1.0, 1.0, 1.0, 1.0)

    def test_warnings_that_are_errors(self):
        # Without a force the tilt is arbitrary, a warning; raised as an error it leaves no handle behind.
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            with self.assertRaises(fuge.NotUniqueWarning) as caught:
                fuge.solve_smooth_punch(lambda x: (x**2 / 2, x), -3.0, 3.0, 1.0, 0.0, moment=0.0)
        self.assertEqual(caught.exception.status, fuge.Status.WARN_NOT_UNIQUE)

    def test_closed(self):
        contact = self.solve()
        contact.close()
        self.assertRaises(fuge.CallOrderError, contact.pressure, 0.0)


class Round(unittest.TestCase):
    def test_hertz(self):
        contact = fuge.solve_round_punch(lambda r: (r**2 / 2, r), 3.0, 1.0, load=4.0 / 3.0)
        hertz = fuge.hertz_ellipse(1.0, 1.0, 1.0, 4.0 / 3.0)
        self.assertAlmostEqual(contact.radius, hertz.semi_axis_x, delta=1e-12)
        self.assertAlmostEqual(contact.approach, hertz.approach, delta=1e-12)
        self.assertAlmostEqual(float(contact.pressure(0.0)), hertz.peak_pressure, delta=1e-12)
        again = fuge.solve_round_powers([0.5], [2.0], 3.0, 1.0, radius=contact.radius)
        self.assertAlmostEqual(again.load, 4.0 / 3.0, delta=1e-12)
        surface = contact.field(young=2.0, poisson=0.3).displacement([contact.radius, 0.0, 0.0])
        self.assertAlmostEqual(surface[2], contact.approach / 2 * (1 - 0.3**2) / 2.0, delta=1e-12)
        self.assertAlmostEqual(float(contact.gap(contact.radius / 2, contact.radius**2 / 8)), 0.0, delta=1e-12)

    def test_cone(self):
        # Approach (pi/2) a tan(beta), load pi a^2 E* tan(beta)/2.
        contact = fuge.solve_round_powers([1.0], [1.0], 10.0, 1.0, approach=np.pi / 2)
        self.assertAlmostEqual(contact.radius, 1.0, delta=1e-12)
        self.assertAlmostEqual(contact.load, np.pi / 2, delta=1e-12)

    def test_edge(self):
        flat = fuge.solve_round_powers([0.5], [2.0], 10.0, 1.0, starts=[1.0], load=1.0)
        self.assertGreater(flat.radius, 1.0)

    def test_one_of_three(self):
        with self.assertRaises(fuge.InputError) as caught:
            fuge.solve_round_powers([0.5], [2.0], 3.0, 1.0, load=1.0, radius=1.0)
        self.assertEqual(caught.exception.status, fuge.Status.ERR_OPTION)


if __name__ == "__main__":
    unittest.main()
