"""Operators and influence matrices: products by FFT against matrices, callbacks, and Hertz."""

import pickle
import threading
import unittest
import warnings

import numpy as np

import fuge


class Halfplane(unittest.TestCase):
    n, width, e_star = 64, 0.1, 2.0

    def setUp(self):
        self.x = self.width * (np.arange(self.n) - 0.5 * (self.n - 1))
        self.gap = self.x**2 / 2

    def test_fft_against_the_matrix(self):
        for element in ("centre", "mean", "hat"):
            alpha = fuge.halfplane_matrix(self.x, self.width, self.e_star, element)
            self.assertTrue(alpha.flags.f_contiguous)
            wanted = fuge.solve(alpha, self.gap, 3.0)
            operator = fuge.HalfplaneOperator(self.n, self.width, self.e_star, element)
            found = fuge.solve(operator, self.gap, 3.0, tolerance=1e-12, threads=2)
            np.testing.assert_allclose(found.force, wanted.force, rtol=0, atol=1e-9)
            self.assertAlmostEqual(found.approach, wanted.approach, delta=1e-9)

    def test_periodic(self):
        operator = fuge.HalfplaneOperator(self.n, self.width, self.e_star, "mean", "periodic")
        contact = fuge.solve(operator, 0.0, 6.4)
        np.testing.assert_allclose(contact.force, np.full(self.n, 0.1), rtol=1e-12)
        self.assertRaises(fuge.UnsupportedError, fuge.load_path, operator, self.gap, 1.0)

    def test_graded_cells(self):
        # A flat punch: the approach is F/(pi E*) times 2 ln(2 D/a), with the datum D of the matrix.
        x, width = fuge.graded_cells(-0.5, 0.5, 40, ends=("corner", "corner"))
        self.assertEqual((x.size, width.size), (40, 40))
        contact = fuge.solve(fuge.halfplane_matrix(x, width, 2.0, "mean"), 0.0, 3.0)
        self.assertAlmostEqual(contact.approach, 3.0 / np.pi * np.log(2.0 * 2.0 / 0.5), delta=1e-4)
        x, width = fuge.graded_cells(-1.0, 3.0, 10, beyond=(2, 1))
        self.assertAlmostEqual(x[2] - width[2] / 2, -1.0, delta=1e-15)
        self.assertAlmostEqual(x[-1] - width[-1] / 2, 3.0, delta=1e-15)
        self.assertRaises(fuge.InputError, fuge.graded_cells, 1.0, 1.0, 4)
        self.assertRaises(fuge.InputError, fuge.graded_cells, 0.0, 1.0, 0)
        self.assertRaises(fuge.InputError, fuge.graded_cells, 0.0, 1.0, 4, ends=("edge", "round"))

    def test_symmetric(self):
        half = self.x[self.n // 2 :]
        whole = fuge.solve(fuge.halfplane_matrix(self.x, self.width, self.e_star, "mean"), self.gap, 3.0)
        alpha = fuge.halfplane_matrix(half, self.width, self.e_star, "mean", symmetric=True)
        part = fuge.solve(alpha, half**2 / 2, 3.0)
        np.testing.assert_allclose(part.force, 2 * whole.force[self.n // 2 :], rtol=0, atol=1e-12)

    def test_edges(self):
        contact = fuge.solve(fuge.halfplane_matrix(self.x, self.width, self.e_star, "hat"), self.gap, 3.0)
        edges = fuge.contact_edges(self.x, self.width, contact.force, "hat")
        half_width = np.sqrt(4 * 3.0 * 1.0 / (np.pi * self.e_star))
        np.testing.assert_allclose([edges.left[0], edges.right[0]], [-half_width, half_width], rtol=1e-4)
        self.assertEqual(edges.left.shape, (1,))
        self.assertEqual(edges.left_kind[0], fuge.EdgeKind.REFINED)

    def test_edges_with_a_law(self):
        x = np.arange(9.0)
        force = np.array([0, 0.2, 0.8, 1, 1, 1, 1, 0.5, 0])
        state = np.where(force == 1, 2, np.where(force > 0, 1, 0))
        edges = fuge.contact_edges(x, 1.0, force, "mean", state=state, compliance=3.0)
        self.assertEqual(edges.left_kind[0], fuge.EdgeKind.LIMITED)
        self.assertAlmostEqual(edges.right[0], 7.0 + np.sqrt(1 / 6), delta=1e-12)
        bed = fuge.contact_edges(x, 1.0, 4.25 - np.minimum(4.25, abs(x - 4)), "mean", compliance=np.ones(9))
        self.assertEqual(bed.left_kind[0], fuge.EdgeKind.GRID_END)
        self.assertRaises(TypeError, fuge.contact_edges, x, 1.0, force, "mean", state=force)
        self.assertRaises(fuge.InputError, fuge.contact_edges, x, 1.0, force, "mean", compliance=-1.0)

    def test_moduli(self):
        self.assertAlmostEqual(fuge.plane_modulus(210e3, 0.3), 210e3 / 0.91, delta=1e-9)
        self.assertEqual(fuge.plane_modulus(210e3, 0.3, "stress"), 210e3)
        self.assertEqual(fuge.combined_modulus(2.0, np.inf), 2.0)
        self.assertEqual(fuge.displacement_shares(1.0, 3.0), (0.75, 0.25))
        with self.assertRaises(fuge.InputError) as caught:
            fuge.plane_modulus(210e3, 0.6)
        self.assertEqual(caught.exception.status, fuge.Status.ERR_MODULUS)


class QuietRims(unittest.TestCase):
    """Contacts that reach the rim of their grid, where the bodies end."""

    def setUp(self):
        caught = warnings.catch_warnings()
        caught.__enter__()
        self.addCleanup(caught.__exit__, None, None, None)
        warnings.simplefilter("ignore", fuge.GridWarning)


class Halfspace(QuietRims):
    def test_ball(self):
        n, spacing, e_star, radius, load = 40, 0.05, 1.0, 2.0, 0.3
        x = spacing * (np.arange(n) - 0.5 * (n - 1))
        gap = (x[None, :] ** 2 + x[:, None] ** 2) / (2 * radius)
        hertz = fuge.hertz_ellipse(radius, radius, e_star, load)
        operator = fuge.HalfspaceOperator(n, n, spacing, spacing, e_star, "mean")
        contact = fuge.solve(operator, gap, load)
        self.assertEqual(contact.force.shape, (n, n))
        self.assertAlmostEqual(contact.approach / hertz.approach, 1.0, delta=5e-3)
        self.assertAlmostEqual(contact.force.max() / spacing**2 / hertz.peak_pressure, 1.0, delta=2e-2)
        self.assertEqual(hertz.semi_axis_x, hertz.semi_axis_y)
        flat = fuge.solve(operator, gap.ravel(), load)
        self.assertEqual(flat.force.shape, (n * n,))

    def test_rows_and_columns(self):
        # A grid that is not square: element [j, i] is at x[i], y[j].
        nx, ny, spacing_x, spacing_y = 6, 4, 0.1, 0.3
        x, y = np.meshgrid(spacing_x * np.arange(nx), spacing_y * np.arange(ny))
        gap = 0.01 * (x - 0.2) ** 2 + 0.3 * y
        alpha = fuge.halfspace_matrix(x.ravel(), y.ravel(), spacing_x, spacing_y, 1.0, "mean")
        wanted = fuge.solve(alpha, gap.ravel(), 0.2)
        operator = fuge.HalfspaceOperator(nx, ny, spacing_x, spacing_y, 1.0, "mean")
        found = fuge.solve(operator, gap, 0.2, excluded=np.zeros((ny, nx), dtype=bool), tolerance=1e-12)
        np.testing.assert_allclose(found.force, wanted.force.reshape(ny, nx), rtol=0, atol=1e-9)
        solver = fuge.Solver(operator)
        solver.set_gap(gap)
        solver.set_modes(np.dstack([np.ones((ny, nx)), x - 0.25]), [0.2, 0.0])
        self.assertEqual(solver.solve().gap.shape, (ny, nx))
        with self.assertRaisesRegex(fuge.InputError, r"shape \(6, 4\), but must have \(ny, nx\) = \(4, 6\)"):
            solver.set_gap(gap.T)

    def test_a_grid_that_is_too_small(self):
        operator = fuge.HalfspaceOperator(8, 6, 1.0, 1.0, 1.0)
        gap = np.ones((6, 8))
        gap[2:5, 5:] = 0.0
        with self.assertWarnsRegex(fuge.GridWarning, r"first is \[2, 7\].*too small.*ignore fuge.GridWarning") as seen:
            contact = fuge.solve(operator, gap, 0.1)
        self.assertEqual(seen.filename, __file__)
        self.assertEqual(seen.warning.status, fuge.Status.DONE)
        self.assertEqual(contact.info.status, fuge.Status.DONE)
        self.assertIn("rim", contact.message)
        # Where the bodies end at the rim, the warning can be turned off.
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            warnings.simplefilter("ignore", fuge.GridWarning)
            fuge.solve(operator, gap, 0.1)
        # A warning that is raised as an error leaves the solution in the solver.
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            solver = fuge.Solver(operator)
            solver.set_gap(gap)
            solver.set_load(0.1)
            self.assertRaises(fuge.GridWarning, solver.solve)
            self.assertGreater(solver.info.contacts, 0)
            # A contact inside of the grid says nothing.
            gap[:, :2] = gap[:, 6:] = 1.0
            fuge.solve(operator, gap, 0.1)

    def test_boundaries(self):
        for boundary in ("periodic", "periodic_x", "periodic_y"):
            operator = fuge.HalfspaceOperator(8, 8, 1.0, 1.0, 1.0, "mean", boundary)
            contact = fuge.solve(operator, 0.0, 64.0)
            self.assertAlmostEqual(contact.load, 64.0, delta=1e-10)
        np.testing.assert_allclose(
            fuge.solve(fuge.HalfspaceOperator(8, 8, 1.0, 1.0, 1.0, "mean", "periodic"), 0.0, 64.0).force,
            np.ones((8, 8)),
        )

    def test_symmetric(self):
        x = np.array([-0.5, 0.5])
        alpha = fuge.halfspace_matrix(x, [0.0, 0.0], 1.0, 1.0, 1.0, "mean")
        half = fuge.halfspace_matrix([0.5], [0.0], 1.0, 1.0, 1.0, "mean", symmetric_x=True)
        self.assertAlmostEqual(half[0, 0], alpha[0].mean(), delta=1e-15)

    def test_rings(self):
        # A flat round punch on a fine set of rings: approach load/(2 E* a).
        radius = np.sin(np.linspace(0.0, np.pi / 2, 61))
        contact = fuge.solve(fuge.ring_matrix(radius, 1.0), 0.0, 2.0)
        self.assertAlmostEqual(contact.approach, 1.0, delta=1e-3)
        places = np.array([[0.0, 0.5], [2.0, 100.0]])
        surface = fuge.ring_displacement(radius, contact.force, 1.0, places)
        self.assertEqual(surface.shape, (2, 2))
        self.assertAlmostEqual(surface[0, 1], 1.0, delta=2e-3)
        self.assertAlmostEqual(surface[1, 1] * np.pi * 100.0 / 2.0, 1.0, delta=1e-3)


class Callback(unittest.TestCase):
    def setUp(self):
        self.n = 128
        x = (np.arange(self.n) - 0.5 * (self.n - 1)) / 16
        self.gap = x**2 / 2
        self.alpha = fuge.halfplane_matrix(x, 1 / 16, 1.0, "mean")
        self.wanted = fuge.solve(self.alpha, self.gap, 2.0)

    def same(self, operator):
        found = fuge.solve(operator, self.gap, 2.0)
        np.testing.assert_allclose(found.force, self.wanted.force, rtol=0, atol=1e-8)
        return found.info.products

    def test_product(self):
        self.same(fuge.CallbackOperator(self.n, lambda f: self.alpha @ f))

    def test_fewer_products(self):
        def apply(f):
            return self.alpha @ f

        plain = self.same(fuge.CallbackOperator(self.n, apply))
        with self.subTest("diagonal"):
            self.same(fuge.CallbackOperator(self.n, apply, diagonal=np.diag(self.alpha)))
        with self.subTest("preconditioner"):
            inverse = np.linalg.inv(self.alpha)
            self.assertLess(
                self.same(fuge.CallbackOperator(self.n, apply, preconditioner=lambda f: inverse @ f)), plain
            )
        with self.subTest("auxiliary"):
            operator = fuge.CallbackOperator(self.n, apply)
            operator.set_auxiliary(fuge.HalfplaneOperator(self.n, 1 / 16, 1.0, "mean"))
            self.assertLess(self.same(operator), plain)
        with self.subTest("coarser"):
            operator = fuge.CallbackOperator(self.n, apply, diagonal=np.diag(self.alpha))
            operator.set_grid(self.n)
            operator.set_coarser(fuge.HalfplaneOperator(self.n // 2, 1 / 8, 1.0, "mean"))
            self.same(operator)
        with self.subTest("datum"):
            operator = fuge.CallbackOperator(self.n, lambda f: self.alpha @ f - 3.0 * f.sum())
            operator.set_coefficients(3.0, 1.0)
            self.same(operator)

    def test_exception(self):
        def apply(f):
            raise ZeroDivisionError("in the product")

        with self.assertRaisesRegex(ZeroDivisionError, "in the product"):
            fuge.solve(fuge.CallbackOperator(self.n, apply), self.gap, 2.0)

    def test_wrong_results(self):
        with self.assertRaisesRegex(fuge.InputError, "must have \\(128,\\)"):
            fuge.solve(fuge.CallbackOperator(self.n, lambda f: f[:3]), self.gap, 2.0)
        with self.assertRaises(fuge.CallbackError):
            fuge.solve(fuge.CallbackOperator(self.n, lambda f: np.nan * f), self.gap, 2.0)
        with self.assertRaises(TypeError):
            fuge.solve(fuge.CallbackOperator(self.n, lambda f: None), self.gap, 2.0)

    def test_arguments(self):
        self.assertRaises(TypeError, fuge.CallbackOperator, 3, 4)
        with self.assertRaises(fuge.InputError):
            fuge.CallbackOperator(2, lambda f: f, diagonal=[1.0, 1.0], preconditioner=lambda f: f)
        with self.assertRaises(fuge.InputError) as caught:
            fuge.CallbackOperator(2, lambda f: f, diagonal=[1.0, 0.0])
        self.assertEqual(caught.exception.status, fuge.Status.ERR_NOT_DEFINITE)
        with self.assertRaises(fuge.CallOrderError):
            fuge.CallbackOperator(2, lambda f: f).set_coarser(fuge.CallbackOperator(1, lambda f: f))

    def test_itself(self):
        operator = fuge.CallbackOperator(2, lambda f: f)
        for name in ("set_coarser", "set_auxiliary"):
            with self.assertRaisesRegex(fuge.InputError, "is this operator itself"):
                getattr(operator, name)(operator)

    def test_forces_can_be_kept(self):
        kept = []

        def apply(f):
            kept.append(f)
            return self.alpha @ f

        fuge.solve(fuge.CallbackOperator(self.n, apply), self.gap, 2.0)
        self.assertTrue(all(np.isfinite(f).all() for f in kept))

    def test_forces_are_read_only(self):
        def scale(f):
            f *= 2.0
            return self.alpha @ f

        with self.assertRaisesRegex(ValueError, "read-only"):
            fuge.solve(fuge.CallbackOperator(self.n, scale), self.gap, 2.0)
        operator = fuge.CallbackOperator(self.n, lambda f: self.alpha @ f, preconditioner=scale)
        with self.assertRaisesRegex(ValueError, "read-only"):
            fuge.solve(operator, self.gap, 2.0)
        self.same(fuge.CallbackOperator(self.n, lambda f: self.alpha @ f))


class Threads(QuietRims):
    """The same bits by any number of threads."""

    def compare(self, operator, gap):
        found = []
        for threads in (1, 2, 3, 5, 0):
            solver = fuge.Solver(operator, threads=threads)
            solver.set_gap(gap)
            solver.set_load(0.05)
            contact = solver.solve()
            change = solver.derivative(load_change=1.0)
            found.append((contact.force, contact.gap, contact.motion, change.force, change.gap))
        for others in found[1:]:
            for one, other in zip(found[0], others):
                np.testing.assert_array_equal(one, other)
        np.testing.assert_array_equal(fuge.solve(operator, gap, 0.05).force, found[0][0])

    def test_area(self):
        n = 128
        x = (np.arange(n) + 0.5) / n - 0.5
        sphere = x[None, :] ** 2 + x[:, None] ** 2
        self.compare(fuge.HalfspaceOperator(n, n, 1 / n, 1 / n, 1.0), sphere)
        rough = 0.1 * np.ones((n, n))
        for wave in range(1, 40, 2):
            phase = 2 * np.pi * (wave * x[None, :] + 3 * wave % 29 * x[:, None]) + wave**2
            rough += 0.02 / wave * np.cos(phase)
        self.compare(fuge.HalfspaceOperator(n, n, 1 / n, 1 / n, 1.0, boundary="periodic"), rough)

    def test_line(self):
        n = 100000
        x = np.arange(n) / n - 0.4
        self.compare(fuge.HalfplaneOperator(n, 1 / n, 1.0), x**2 + 1e-4 * np.cos(700 * x))


class Grids(QuietRims):
    """Attributes and representations of operators of grids and of their contacts."""

    def test_line(self):
        operator = fuge.HalfplaneOperator(64, 0.5, 2.0)
        self.assertIsInstance(operator, fuge.GridOperator)
        self.assertEqual((operator.n, operator.spacing, operator.e_star), (64, 0.5, 2.0))
        self.assertEqual((operator.element, operator.boundary), ("mean", "free"))
        self.assertEqual(operator.cells, fuge.Cells((64,), (0.5,), "free", "mean"))
        self.assertEqual(operator.cells.periodic, (False,))
        np.testing.assert_allclose(operator.cells.centres(0), 0.5 * (np.arange(64) - 31.5))
        self.assertEqual(
            repr(operator), "HalfplaneOperator(n=64, spacing=0.5, e_star=2.0, element='mean', boundary='free')"
        )
        contact = fuge.solve(operator, 0.1 * np.arange(64), 3.0)
        np.testing.assert_allclose(contact.pressure.sum() * 0.5, 3.0)
        np.testing.assert_allclose(contact.pressure * 0.5, contact.force, rtol=1e-15)

    def test_area(self):
        operator = fuge.HalfspaceOperator(6, 4, 0.5, 0.25, 2.0, boundary="periodic_y")
        self.assertEqual((operator.nx, operator.ny, operator.spacing_x, operator.spacing_y), (6, 4, 0.5, 0.25))
        self.assertEqual(operator.cells.periodic, (False, True))
        self.assertEqual(operator.cells.centres(1).shape, (4,))
        again = eval("fuge." + repr(operator))
        self.assertEqual(again.cells, operator.cells)
        contact = fuge.solve(operator, 0.0, 3.0)
        self.assertEqual(contact.pressure.shape, (4, 6))
        np.testing.assert_allclose(contact.pressure.sum() * 0.125, 3.0)
        copy = pickle.loads(pickle.dumps(contact))
        np.testing.assert_array_equal(copy.pressure, contact.pressure)

    def test_default_element(self):
        operator = fuge.HalfspaceOperator(2, 1, 1.0, 1.0, 1.0)
        wanted = fuge.halfspace_matrix([0.0, 1.0], [0.0, 0.0], 1.0, 1.0, 1.0, "mean") @ [1.0, 0.0]
        np.testing.assert_allclose(operator @ [1.0, 0.0], wanted, rtol=1e-14)
        x = np.arange(3.0)
        wanted = fuge.halfplane_matrix(x, 1.0, 1.0, "mean") @ [1.0, 0.0, 0.0]
        np.testing.assert_allclose(fuge.HalfplaneOperator(3, 1.0, 1.0) @ [1.0, 0.0, 0.0], wanted, rtol=1e-13)

    def test_path_without_a_matrix(self):
        # The operator is refused, whatever the shapes of gaps and motions are.
        operator = fuge.HalfspaceOperator(2, 2, 1.0, 1.0, 1.0)
        words = r"influence matrix, which HalfspaceOperator\(nx=2"
        with self.assertRaisesRegex(fuge.UnsupportedError, words):
            fuge.load_path(operator, np.zeros((2, 2)), 1.0)
        with self.assertRaisesRegex(fuge.UnsupportedError, words):
            fuge.Solver(operator).follow_path([1.0, 2.0, 3.0])

    def test_matrices_and_operators_have_one_default(self):
        x = np.arange(2.0)
        line, area = fuge.halfplane_matrix(x, 1.0, 2.0), fuge.halfspace_matrix(x, 0.0 * x, 1.0, 1.0, 2.0)
        force = [1.0, 0.0]
        np.testing.assert_allclose(fuge.HalfplaneOperator(2, 1.0, 2.0) @ force, line @ force, rtol=1e-13)
        np.testing.assert_allclose(
            np.ravel(fuge.HalfspaceOperator(2, 1, 1.0, 1.0, 2.0) @ [force]), area @ force, rtol=1e-13
        )
        same = fuge.Layers([], [2.0], 0.0)
        np.testing.assert_allclose(same.halfplane_matrix(x, 1.0), line, rtol=1e-13)
        np.testing.assert_allclose(same.halfspace_matrix(x, 0.0 * x, 1.0, 1.0), area, rtol=1e-13)

    def test_elements_that_fit(self):
        for call in (
            lambda: fuge.HalfspaceOperator(2, 1, 1.0, 1.0, 1.0, "hat"),
            lambda: fuge.halfspace_matrix([0.0], [0.0], 1.0, 1.0, 1.0, "hat"),
        ):
            with self.assertRaises(fuge.InputError) as caught:
                call()
            self.assertEqual(caught.exception.status, fuge.Status.ERR_ELEMENT)
            self.assertEqual(caught.exception.message, "element is 'hat', but must be one of 'centre', 'mean'")

    def test_no_cells(self):
        contact = fuge.solve(np.eye(2), [0.0, 1.0], 0.5)
        self.assertIsNone(contact.cells)
        with self.assertRaisesRegex(ValueError, "forces, which are pressures times the area, or the width"):
            contact.pressure
        self.assertEqual(repr(fuge.DenseOperator(np.eye(2))), "DenseOperator(n=2)")

    def test_cells_of_an_auxiliary_operator(self):
        operator = fuge.CallbackOperator(12, lambda f: 2.0 * f)
        self.assertEqual(repr(operator), "CallbackOperator(n=12)")
        operator.set_auxiliary(fuge.HalfspaceOperator(4, 3, 0.5, 0.5, 1.0))
        self.assertEqual(operator.cells.shape, (3, 4))
        self.assertEqual(repr(operator), "CallbackOperator(n=12, grid=(3, 4))")
        np.testing.assert_allclose(fuge.solve(operator, 0.0, 3.0).pressure, 1.0)
        # The spacing of another grid is unknown.
        operator.set_grid(2, 6)
        self.assertIsNone(operator.cells)

    def test_contact_in_a_line(self):
        contact = fuge.solve(np.eye(2), [0.0, 1.0], 0.5)
        known = "1 of 2 points in contact, approach 0.5, load 0.5, residual [0-9.e+-]+"
        self.assertRegex(repr(contact), f"^<Contact: {known}>$")
        contact = fuge.solve(np.eye(2), 0.0, modes=np.eye(2), resultant=[1.0, 2.0])
        self.assertIn("motion [1. 2.], resultant [1. 2.]", repr(contact))


class Products(unittest.TestCase):
    def test_matrix(self):
        alpha = np.array([[0.2, 0.1, 0.0], [0.1, 0.2, 0.1], [0.0, 0.1, 0.2]])
        force = np.array([1.0, -2.0, 4.0])
        np.testing.assert_allclose(fuge.DenseOperator(alpha) @ force, alpha @ force, rtol=1e-15)
        np.testing.assert_allclose(fuge.DenseOperator(alpha) @ [1, -2, 4], alpha @ force, rtol=1e-15)

    def test_halfplane(self):
        x = 0.1 * np.arange(20)
        force = np.sin(3.0 * x)
        for element in ("centre", "mean", "hat"):
            wanted = fuge.halfplane_matrix(x, 0.1, 2.0, element) @ force
            np.testing.assert_allclose(fuge.HalfplaneOperator(20, 0.1, 2.0, element) @ force, wanted, atol=1e-14)

    def test_area(self):
        # A grid that is not square, with forces in either shape and memory order.
        ny, nx = 3, 5
        x, y = np.meshgrid(0.1 * np.arange(nx), 0.3 * np.arange(ny))
        force = np.cos(20.0 * x) * (1.0 + y)
        operator = fuge.HalfspaceOperator(nx, ny, 0.1, 0.3, 2.0, "mean")
        wanted = fuge.halfspace_matrix(x.ravel(), y.ravel(), 0.1, 0.3, 2.0, "mean") @ force.ravel()
        np.testing.assert_allclose(operator @ force.ravel(), wanted, atol=1e-14)
        np.testing.assert_allclose(operator @ force, wanted.reshape(ny, nx), atol=1e-14)
        np.testing.assert_allclose(operator @ np.asfortranarray(force), wanted.reshape(ny, nx), atol=1e-14)

    def test_gaps_of_a_contact(self):
        # The gaps of a solution are c = g + A f - v.
        operator = fuge.HalfspaceOperator(8, 8, 1.0, 1.0, 1.0, "mean")
        gap = np.add.outer((np.arange(8) - 3.5) ** 2, (np.arange(8) - 3.5) ** 2)
        contact = fuge.solve(operator, gap, 10.0)
        np.testing.assert_allclose(gap + operator @ contact.force - contact.approach, contact.gap, atol=1e-8)

    def test_inside_a_callback(self):
        # A layer on a half-plane, whose product is that of another operator.
        half_plane = fuge.HalfplaneOperator(32, 0.1, 1.0, "mean")
        operator = fuge.CallbackOperator(32, lambda f: half_plane @ f + 0.5 * f)
        alpha = fuge.halfplane_matrix(0.1 * np.arange(32), 0.1, 1.0, "mean") + 0.5 * np.eye(32)
        force = np.arange(32.0)
        np.testing.assert_allclose(operator @ force, alpha @ force, rtol=1e-13)
        gap = 0.1 * (np.arange(32) - 15.5) ** 2
        found, wanted = fuge.solve(operator, gap, 3.0), fuge.solve(alpha, gap, 3.0)
        np.testing.assert_allclose(found.force, wanted.force, atol=1e-8)

    def test_closed_in_a_product(self):
        def close_elsewhere():
            thread = threading.Thread(target=operator.close)
            thread.start()
            thread.join(10)
            self.assertFalse(thread.is_alive())

        for close in (lambda: operator.close(), close_elsewhere):
            freed = []

            def apply(f):
                close()
                freed.append(operator._handle._freed)
                return 2.0 * f

            operator = fuge.CallbackOperator(2, apply)
            np.testing.assert_array_equal(operator @ [1.0, 4.0], [2.0, 8.0])
            self.assertEqual(freed, [False])
            self.assertTrue(operator._handle._freed)
            self.assertRaisesRegex(fuge.CallOrderError, "closed", lambda: operator @ [1.0, 4.0])

    def test_changed_in_a_product(self):
        other = fuge.HalfplaneOperator(2, 1.0, 1.0)

        def apply(f):
            for change in (
                lambda: operator.set_diagonal([1.0, 1.0]),
                lambda: operator.set_preconditioner(lambda f: f),
                lambda: operator.set_auxiliary(other),
                lambda: operator.set_coefficients(1.0),
            ):
                self.assertRaisesRegex(fuge.CallOrderError, "during a product or a solve", change)
            return 2.0 * f

        operator = fuge.CallbackOperator(2, apply)
        np.testing.assert_array_equal(operator @ [1.0, 4.0], [2.0, 8.0])
        np.testing.assert_allclose(fuge.solve(operator, 0.0, 2.0).force, [1.0, 1.0])
        operator.set_diagonal([2.0, 2.0])

    def test_solver_of_a_closed_operator(self):
        operator = fuge.CallbackOperator(2, lambda f: 2.0 * f)
        solver = fuge.Solver(operator)
        operator.close()
        solver.set_gap(0.0)
        solver.set_load(2.0)
        np.testing.assert_allclose(solver.solve().force, [1.0, 1.0])

    def test_datum(self):
        operator = fuge.CallbackOperator(2, lambda f: 2.0 * f)
        operator.set_coefficients(3.0)
        np.testing.assert_array_equal(operator @ [1.0, 4.0], [17.0, 23.0])

    def test_refusals(self):
        operator = fuge.DenseOperator(np.eye(6))
        area = fuge.HalfspaceOperator(3, 2, 1.0, 1.0, 1.0, "mean")
        self.assertRaisesRegex(fuge.InputError, r"shape \(5,\)", lambda: operator @ np.ones(5))
        self.assertRaisesRegex(fuge.InputError, r"shape \(3, 2\)", lambda: area @ np.ones((3, 2)))
        self.assertRaises(fuge.InputError, lambda: operator @ np.ones((2, 3)))
        self.assertRaises(fuge.InputError, lambda: operator @ 1.0)
        self.assertRaises(TypeError, lambda: operator @ "force")
        self.assertRaisesRegex(fuge.LimitError, "too large", lambda: fuge.DenseOperator([[1e200]]) @ [1e200])
        with self.assertRaises(fuge.InputError) as caught:
            area @ [[0.0, 0.0, 0.0], [0.0, np.nan, 0.0]]
        self.assertEqual(caught.exception.status, fuge.Status.ERR_NOT_FINITE)

        def fail(f):
            raise ZeroDivisionError("in the product")

        self.assertRaises(ZeroDivisionError, lambda: fuge.CallbackOperator(6, fail) @ np.ones(6))
        operator.close()
        self.assertRaises(fuge.CallOrderError, lambda: operator @ np.ones(6))


if __name__ == "__main__":
    unittest.main()
