"""The pictures: what their lines, maps and titles hold."""

import dataclasses
import io
import subprocess
import sys
import unittest
import warnings
from unittest import mock

import matplotlib

matplotlib.use("Agg")

import numpy as np
from matplotlib import pyplot

import fuge
import fuge._cuts


class Pictures(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        n, cls.spacing, radius = 48, 0.02, 10.0
        cls.x = cls.spacing * (np.arange(n) - 0.5 * (n - 1))
        ny = 40
        cls.y = cls.spacing * (np.arange(ny) - 0.5 * (ny - 1))
        cls.area_gap = np.add.outer((cls.y - 0.1) ** 2, (cls.x + 0.05) ** 2) / (2 * radius)
        operator = fuge.HalfspaceOperator(n, ny, cls.spacing, cls.spacing, 115e3)
        cls.ball = fuge.solve(operator, cls.area_gap, 50.0)
        cls.line_gap = cls.x**2 / 2
        cls.barrel = fuge.solve(fuge.HalfplaneOperator(n, cls.spacing, 2.0), cls.line_gap, 0.2)

    def setUp(self):
        self.addCleanup(pyplot.close, "all")

    def drawn(self, ax):
        """The axes, drawn as when their figure is saved."""
        with io.BytesIO() as picture:
            ax.figure.savefig(picture, format="png")
            self.assertGreater(picture.tell(), 5000)
        return ax

    def title(self, ax):
        return ax.get_title(loc="left")


class Lines(Pictures):
    def test_pressure(self):
        ax = self.drawn(fuge.plot.line(self.barrel))
        (curve,) = ax.lines
        np.testing.assert_allclose(curve.get_xdata(), self.x, atol=1e-15)
        np.testing.assert_array_equal(curve.get_ydata(), self.barrel.force / self.spacing)
        self.assertEqual(curve.get_drawstyle(), "steps-mid")
        self.assertEqual((ax.get_xlabel(), ax.get_ylabel()), ("x from the middle", "pressure"))
        self.assertEqual(self.title(ax), f"Pressure along x: largest {self.barrel.pressure.max():.4g}")

    def test_units_and_places(self):
        ax = fuge.plot.line(self.barrel, x=self.x + 3.0, unit="mm", pressure_unit="MPa")
        np.testing.assert_array_equal(ax.lines[0].get_xdata(), self.x + 3.0)
        self.assertEqual((ax.get_xlabel(), ax.get_ylabel()), ("x [mm]", "pressure [MPa]"))
        self.assertRegex(self.title(ax), " MPa$")
        with self.assertRaisesRegex(fuge.InputError, r"x has the shape \(3,\)"):
            fuge.plot.line(self.barrel, x=[1, 2, 3])

    def test_through_an_area(self):
        row, column = np.unravel_index(self.ball.force.argmax(), self.ball.force.shape)
        ax = fuge.plot.line(self.ball)
        np.testing.assert_array_equal(ax.lines[0].get_ydata(), self.ball.pressure[row])
        self.assertIn(f"at y = {self.y[row]:.4g}:", self.title(ax))
        ax = fuge.plot.line(self.ball, along="y", y=self.y)
        np.testing.assert_array_equal(ax.lines[0].get_xdata(), self.y)
        np.testing.assert_array_equal(ax.lines[0].get_ydata(), self.ball.pressure[:, column])
        self.assertEqual(ax.get_xlabel(), "y")
        self.assertRaises(fuge.InputError, fuge.plot.line, self.ball, along="z")

    def test_of_a_matrix(self):
        contact = fuge.solve(fuge.halfplane_matrix(self.x, self.spacing, 2.0, "hat"), self.line_gap, 0.2)
        ax = fuge.plot.line(contact)
        np.testing.assert_array_equal(ax.lines[0].get_ydata(), contact.force)
        self.assertEqual((ax.get_xlabel(), ax.get_ylabel()), ("point", "force"))
        ax = fuge.plot.line(contact, x=self.x, width=self.spacing)
        np.testing.assert_array_equal(ax.lines[0].get_ydata(), contact.force / self.spacing)
        self.assertEqual((ax.get_xlabel(), ax.get_ylabel()), ("x", "pressure"))

    def test_forces_that_pull(self):
        # Some of the tied points pull; stresses are the same by sums and by transforms, on areas and on lines.
        tied = {"gap_upper": 0.0}
        area = fuge.HalfspaceOperator(12, 10, 0.1, 0.1, 2.0)
        line = fuge.HalfplaneOperator(24, 0.1, 2.0)
        wave = np.cos(np.arange(120)).reshape(10, 12)
        for operator, gap in ((area, wave), (line, wave.ravel()[:24])):
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", fuge.GridWarning)
                contact = fuge.solve(operator, gap, 0.5, **tied)
            self.assertLess(contact.force.min(), -0.1 * contact.force.max())
            with mock.patch.object(fuge._cuts, "_TRANSFORMS", 1000):
                by_sums = fuge.plot.stress(contact).collections[0].get_array()
            a_sum = mock.Mock(side_effect=AssertionError("a sum"))
            with mock.patch.object(fuge._cuts, "_TRANSFORMS", 0), mock.patch.object(fuge.Field, "stress", a_sum):
                by_transforms = fuge.plot.stress(contact).collections[0].get_array()
            np.testing.assert_allclose(by_sums, by_transforms, rtol=0, atol=1e-9 * by_sums.max())
            ax = fuge.plot.line(contact)
            self.assertLess(ax.get_ylim()[0], contact.pressure.min() if operator is line else 0.0)

    def test_without_a_grid(self):
        contact = fuge.solve_smooth_punch(lambda x: (x**2 / 2, x), -1.0, 1.0, 2.0, 0.2)
        (curve,) = self.drawn(fuge.plot.line(contact)).lines
        np.testing.assert_array_equal(curve.get_ydata(), contact.pressure(curve.get_xdata()))
        self.assertLess(curve.get_xdata()[0], contact.left)
        cone = fuge.solve_round_powers([1.0], [1.0], reach=10.0, e_star=1.0, load=1.0)
        (curve,) = fuge.plot.line(cone).lines
        self.assertAlmostEqual(curve.get_xdata()[0], -1.4 * cone.radius)
        np.testing.assert_allclose(curve.get_ydata(), curve.get_ydata()[::-1])

    def test_gap(self):
        ax = self.drawn(fuge.plot.gap(self.barrel, unit="mm"))
        whole, closed = ax.lines
        np.testing.assert_array_equal(whole.get_ydata(), self.barrel.gap)
        np.testing.assert_array_equal(np.isfinite(closed.get_ydata()), self.barrel.force > 0)
        self.assertEqual(ax.get_ylabel(), "gap [mm]")
        self.assertRegex(self.title(ax), f"^Gap under load: {self.barrel.info.contacts} of 48 points touch, widest ")


class Maps(Pictures):
    def test_pressure(self):
        ax = self.drawn(fuge.plot.map(self.ball, unit="mm", pressure_unit="MPa"))
        (image,) = ax.images
        np.testing.assert_array_equal(image.get_array().filled(0.0), self.ball.pressure)
        np.testing.assert_array_equal(image.get_array().mask, self.ball.force == 0.0)
        # The first row is the lowest one, and the edges are those of the cells.
        self.assertEqual(image.origin, "lower")
        np.testing.assert_allclose(image.get_extent(), [-0.48, 0.48, -0.4, 0.4])
        self.assertEqual((ax.get_xlabel(), ax.get_ylabel()), ("x from the middle [mm]", "y from the middle [mm]"))
        words = f"Pressure: {self.ball.info.contacts} of 1920 points touch, largest {self.ball.pressure.max():.4g} MPa"
        self.assertEqual(self.title(ax), words)

    def test_places(self):
        image = fuge.plot.map(self.ball, x=self.x + 1.0, y=self.y + 2.0).images[0]
        np.testing.assert_allclose(image.get_extent(), [0.52, 1.48, 1.6, 2.4])

    def test_unequal_cells(self):
        # The widths of the cells grow from the middle of the grid.
        x = np.sign(self.x) * self.x**2
        ax = self.drawn(fuge.plot.map(self.ball, x=x, y=self.y))
        (mesh,) = ax.collections
        self.assertEqual(len(ax.images), 0)
        edges = mesh.get_coordinates()
        self.assertEqual(edges.shape, (41, 49, 2))
        np.testing.assert_allclose(edges[0, 1:-1, 0], (x[1:] + x[:-1]) / 2, atol=1e-15)
        np.testing.assert_allclose(edges[[0, -1], 0, 1], [-0.4, 0.4])
        found = mesh.get_array().filled(0.0).reshape(40, 48)
        np.testing.assert_array_equal(found, self.ball.pressure)
        self.assertEqual(len(fuge.plot.gap(self.ball, x=x).collections), 1)
        self.assertRaisesRegex(fuge.InputError, "sort the cells along x", fuge.plot.map, self.ball, x=np.abs(x))

    def test_one_column(self):
        operator = fuge.HalfspaceOperator(1, 40, self.spacing, self.spacing, 115e3)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", fuge.GridWarning)
            contact = fuge.solve(operator, self.area_gap[:, :1], 1.0)
        np.testing.assert_allclose(fuge.plot.map(contact).images[0].get_extent(), [-0.5, 0.5, -0.4, 0.4])

    def test_flat_arrays(self):
        operator = fuge.HalfspaceOperator(48, 40, self.spacing, self.spacing, 115e3)
        flat = fuge.solve(operator, self.area_gap.ravel(), 50.0)
        self.assertEqual(fuge.plot.map(flat).images[0].get_array().shape, (40, 48))

    def test_gap(self):
        ax = self.drawn(fuge.plot.gap(self.ball))
        (image,) = ax.images
        open_cells = self.ball.force == 0.0
        np.testing.assert_array_equal(image.get_array()[open_cells], self.ball.gap[open_cells])
        self.assertTrue(image.get_array().mask[~open_cells].all())

    def test_of_a_line(self):
        self.assertRaisesRegex(fuge.InputError, "use fuge.plot.line", fuge.plot.map, self.barrel)


class Paths(Pictures):
    def test_load_path(self):
        alpha = fuge.halfplane_matrix(self.x, self.spacing, 2.0, "hat")
        path = fuge.load_path(alpha, self.line_gap, 0.2)
        ax = self.drawn(fuge.plot.path(path, end=0.2, unit="mm", force_unit="N/mm"))
        curve, events = ax.lines
        np.testing.assert_array_equal(curve.get_xdata()[:-1], path.motion)
        np.testing.assert_array_equal(curve.get_ydata()[:-1], path.parameter)
        contact = fuge.solve(alpha, self.line_gap, 0.2)
        self.assertAlmostEqual(curve.get_xdata()[-1], contact.approach, delta=1e-12)
        self.assertEqual(curve.get_ydata()[-1], 0.2)
        self.assertEqual(events.get_xdata().size, path.parameter.size)
        self.assertEqual((ax.get_xlabel(), ax.get_ylabel()), ("approach [mm]", "load [N/mm]"))
        self.assertEqual(self.title(ax), f"Load over approach: {contact.info.contacts} points come into contact")

    def test_motions(self):
        solver = fuge.Solver(fuge.halfplane_matrix(self.x, self.spacing, 2.0, "hat"))
        solver.set_gap(self.line_gap)
        solver.set_modes(np.column_stack([np.ones(48), self.x]), [0.2, 0.0])
        path = solver.follow_path([0.2, 0.02])
        ax = self.drawn(fuge.plot.path(path))
        self.assertEqual([text.get_text() for text in ax.get_legend().get_texts()], ["motion 0", "motion 1"])
        np.testing.assert_array_equal(ax.lines[2].get_ydata(), path.motion[:, 1])
        self.assertRegex(self.title(ax), "points come into contact, [1-9][0-9]* leave it")


class Levels(Pictures):
    def test_over_time_and_cells(self):
        # Two methods, and a level of which nothing is known yet.
        errors = [("equal_cells", 1.0), ("equal_cells", 0.02), ("graded_cells", 0.01), ("graded_cells", 0.002)]
        contact = fuge.solve_line(lambda x: x**2, (-1.0, 1.0), e_star=2.0, load=0.2, accuracy=3e-3)
        levels = [fuge.Level(64 + k, *errors[k], approach_error=np.inf, seconds=0.1 * k) for k in range(4)]
        contact = dataclasses.replace(contact, levels=levels, pressure_error=0.002)
        ax = self.drawn(fuge.plot.levels(contact))
        wanted, *curves = ax.lines
        self.assertEqual(set(wanted.get_ydata()), {3e-3})
        self.assertEqual([list(curve.get_ydata()) for curve in curves], [[0.02], [0.01, 0.002]])
        self.assertEqual(list(curves[1].get_xdata()), [levels[2].seconds, levels[3].seconds])
        self.assertNotEqual(curves[0].get_marker(), curves[1].get_marker())
        self.assertEqual([text.get_text() for text in ax.texts], ["65", "66", "67"])
        self.assertEqual((ax.get_xscale(), ax.get_yscale()), ("log", "log"))
        self.assertEqual((ax.get_xlabel(), ax.get_ylabel()), ("time [s]", "share of the load in the wrong place"))
        words = [text.get_text() for text in ax.get_legend().get_texts()]
        self.assertEqual(words, ["wanted", "equal cells", "graded cells"])
        self.assertEqual(self.title(ax), "Estimated error: 2.0e-03 in 0.3 s, wanted 3.0e-03")
        ax = self.drawn(fuge.plot.levels(contact, over="cells"))
        self.assertEqual(list(ax.lines[2].get_xdata()), [66, 67])
        self.assertEqual((ax.get_xlabel(), len(ax.texts)), ("cells", 0))
        self.assertRaises(fuge.InputError, fuge.plot.levels, contact, over="load")

    def test_of_solves(self):
        for gap in (lambda x: x**2, np.abs, lambda x: np.abs(np.sin(9 * x))):
            contact = fuge.solve_line(gap, (-1.0, 1.0), e_star=2.0, load=0.2, accuracy=1e-2)
            ax = self.drawn(fuge.plot.levels(contact))
            self.assertGreater(len(ax.lines), 1)
            self.assertLessEqual(ax.lines[-1].get_ydata()[-1], 1e-2)


class Stresses(Pictures):
    def test_line(self):
        ax = self.drawn(fuge.plot.stress(self.barrel, unit="mm", pressure_unit="MPa"))
        cross, bar = ax.lines
        # Hertz: 0.300 of the largest pressure, 0.786 half widths below the middle.
        half = np.sqrt(4 * 0.2 / (np.pi * 2.0))
        peak = 2 * 0.2 / (np.pi * half)
        largest = ax.collections[0].get_array().max()
        self.assertAlmostEqual(largest / peak, 0.300, delta=0.002)
        self.assertAlmostEqual(cross.get_ydata()[0] / half, 0.786, delta=0.05)
        self.assertAlmostEqual(cross.get_xdata()[0], 0.0, delta=self.spacing)
        touching = self.x[self.barrel.force > 0]
        wanted = [touching[0] - 0.5 * self.spacing, touching[-1] + 0.5 * self.spacing]
        np.testing.assert_allclose(bar.get_xdata(), wanted)
        # Depths grow downwards.
        self.assertGreater(*ax.get_ylim())
        self.assertRegex(self.title(ax), f"^Largest shear stress: {largest:.4g} MPa, .* mm deep$")
        self.assertRaises(fuge.InputError, fuge.plot.stress, self.barrel, depth=-1.0)
        self.assertEqual(fuge.plot.stress(self.barrel, depth=0.1).get_ylim(), (0.1, 0.0))

    def test_area(self):
        hertz = fuge.hertz_ellipse(10.0, 10.0, 115e3, 50.0)
        for along, place in (("x", -0.05), ("y", 0.1)):
            ax = fuge.plot.stress(self.ball, along=along)
            cross = ax.lines[0]
            # 0.310 of the largest pressure, 0.48 radii below it.
            self.assertAlmostEqual(ax.collections[0].get_array().max() / hertz.peak_pressure, 0.310, delta=0.006)
            self.assertAlmostEqual(cross.get_ydata()[0] / hertz.semi_axis_x, 0.48, delta=0.05)
            self.assertAlmostEqual(cross.get_xdata()[0], place, delta=self.spacing)
            self.assertEqual(ax.get_xlabel(), f"{along} from the middle")

    def shear_of_grid(self, ax, field):
        """The largest shear stress of all cells at the depths of a picture."""
        return fuge.tresca(field.grid_stress(np.linspace(0.0, ax.get_ylim()[0], 81))).max() / 2

    def test_periodic(self):
        contact = fuge.solve(fuge.HalfplaneOperator(48, self.spacing, 2.0, boundary="periodic"), self.line_gap, 0.2)
        ax = fuge.plot.stress(contact, poisson=0.25)
        wanted = self.shear_of_grid(ax, contact.field(poisson=0.25))
        self.assertAlmostEqual(ax.collections[0].get_array().max() / wanted, 1.0, delta=1e-12)

    def test_periodic_area(self):
        operator = fuge.HalfspaceOperator(48, 40, self.spacing, self.spacing, 115e3, boundary="periodic_x")
        contact = fuge.solve(operator, self.area_gap, 50.0)
        for along in ("x", "y"):
            ax = fuge.plot.stress(contact, along=along)
            wanted = self.shear_of_grid(ax, contact.field(poisson=0.3))
            # The largest stress may be a cell beside the largest pressure, through which the cut goes.
            self.assertAlmostEqual(ax.collections[0].get_array().max() / wanted, 1.0, delta=5e-3)
            # A large grid has room for a few depths at a time only.
            with mock.patch.object(fuge._cuts, "_ROOM", 10 * contact.force.size):
                again = fuge.plot.stress(contact, along=along)
            np.testing.assert_allclose(again.collections[0].get_array(), ax.collections[0].get_array(), rtol=1e-12)

    def test_many_cells(self):
        # Transforms replace sums where many cells are pressed.
        for along in ("x", "y"):
            ax = fuge.plot.stress(self.ball, along=along)
            a_sum = mock.Mock(side_effect=AssertionError("a sum"))
            with mock.patch.object(fuge._cuts, "_TRANSFORMS", 0), mock.patch.object(fuge.Field, "stress", a_sum):
                again = fuge.plot.stress(self.ball, along=along)
            largest = ax.collections[0].get_array().max()
            np.testing.assert_allclose(
                again.collections[0].get_array(), ax.collections[0].get_array(), rtol=0, atol=1e-9 * largest
            )

    def test_without_a_grid(self):
        contact = fuge.solve_smooth_punch(lambda x: (x**2 / 2, x), -1.0, 1.0, 2.0, 0.2)
        ax = self.drawn(fuge.plot.stress(contact))
        peak = contact.field(poisson=0.3).largest("tresca")
        self.assertAlmostEqual(ax.collections[0].get_array().max() / (peak.value / 2), 1.0, delta=1e-3)
        self.assertAlmostEqual(ax.lines[0].get_ydata()[0], peak.place[2], delta=0.02)
        ball = fuge.solve_round_powers([0.05], [2.0], reach=1.0, e_star=115e3, load=50.0)
        ax = fuge.plot.stress(ball)
        peak = ball.field(poisson=0.3).largest("tresca")
        self.assertAlmostEqual(ax.collections[0].get_array().max() / (peak.value / 2), 1.0, delta=1e-3)

    def test_fields(self):
        # A field of cells and forces shows what the contact does, whose places count from the middle.
        gap = self.x**2 / 2
        contact = fuge.solve(fuge.halfplane_matrix(self.x, self.spacing, 2.0, "hat"), gap, 0.2)
        cells = fuge.Field.halfplane(self.x, self.spacing, contact.force, "hat", poisson=0.3)
        half = self.x > 0
        part = fuge.Field.halfplane(
            self.x[half], self.spacing, 2 * contact.force[half], "hat", poisson=0.3, symmetric=True
        )
        wanted = cells.largest("tresca").value / 2
        for field in (cells, part):
            ax = self.drawn(fuge.plot.stress(field))
            self.assertAlmostEqual(ax.collections[0].get_array().max() / wanted, 1.0, delta=2e-3)
            edge = self.x[contact.force > 0].max() + 0.5 * self.spacing
            np.testing.assert_allclose(ax.lines[1].get_xdata(), [-edge, edge])
            self.assertEqual(ax.get_xlabel(), "x")
        x, y = np.meshgrid(self.x, self.y)
        touching = self.ball.force > 0
        area = fuge.Field.halfspace(
            x[touching], y[touching], self.spacing, self.spacing, self.ball.force[touching], poisson=0.3
        )
        wanted = fuge.plot.stress(self.ball, along="y").collections[0].get_array().max()
        ax = fuge.plot.stress(area, along="y")
        self.assertAlmostEqual(ax.collections[0].get_array().max() / wanted, 1.0, delta=5e-3)
        radius = np.linspace(0.0, 0.1, 21)
        ax = fuge.plot.stress(fuge.Field.rings(radius, np.diff(radius**2), poisson=0.3))
        np.testing.assert_allclose(ax.lines[-1].get_xdata(), [-0.1, 0.1])
        self.assertRaisesRegex(fuge.InputError, "knows its body", fuge.plot.stress, area, poisson=0.3)

    def test_layers(self):
        # None of the depths lies in the rigid base; a thick layer is nearly a half-space.
        for thickness, deepest in ((0.2, 0.2), (1e3, None)):
            layers = fuge.Layers(thickness, [1.82, np.inf], 0.3)
            contact = fuge.solve(fuge.LayeredHalfplaneOperator(48, self.spacing, layers), self.line_gap, 0.2)
            ax = self.drawn(fuge.plot.stress(contact))
            self.assertEqual(ax.get_ylim()[0], deepest or ax.get_ylim()[0])
        wanted = fuge.plot.stress(self.barrel).collections[0].get_array().max()
        self.assertAlmostEqual(ax.collections[0].get_array().max() / wanted, 1.0, delta=2e-3)
        self.assertRaisesRegex(fuge.InputError, "moduli of their own", fuge.plot.stress, contact, poisson=0.3)

    def test_without_limit(self):
        cone = fuge.solve_round_powers([1.0], [1.0], reach=10.0, e_star=1.0, load=1.0)
        ax = self.drawn(fuge.plot.stress(cone))
        self.assertEqual(self.title(ax), "Largest shear stress: without limit, as the pressure is")
        self.assertEqual(len(ax.lines), 1)
        # The corners of a flat punch, on a grid.
        flat = np.where(np.abs(self.x) < 0.2, 0.0, 1.0)
        contact = fuge.solve(fuge.HalfplaneOperator(48, self.spacing, 2.0), flat, 0.2)
        self.assertRegex(self.title(fuge.plot.stress(contact)), "or more, at the surface$")

    def test_depths_at_once(self):
        depth = np.arange(81.0)
        for cells, parts in ((1, 1), (2**20, 41), (2**21 + 1, 81), (2**23, 81)):
            found = fuge._cuts._batches(depth, cells)
            self.assertEqual((len(found), min(part.size for part in found) > 0), (parts, True))
            np.testing.assert_array_equal(np.concatenate(found), depth)

    def test_refusals(self):
        with self.assertRaisesRegex(fuge.InputError, "along='y' is for areas"):
            fuge.plot.stress(self.barrel, along="y")
        contact = fuge.solve(np.eye(2), 0.0, 1.0)
        self.assertRaisesRegex(fuge.InputError, "use HalfplaneOperator", fuge.plot.stress, contact)
        # A layer on a half-plane has the pressures of the cells, but other stresses.
        half_plane = fuge.HalfplaneOperator(48, self.spacing, 2.0)
        layered = fuge.CallbackOperator(48, lambda f: half_plane @ f + 0.1 * f)
        layered.set_auxiliary(half_plane)
        contact = fuge.solve(layered, self.line_gap, 0.2)
        self.assertEqual(fuge.plot.line(contact).get_ylabel(), "pressure")
        self.assertRaisesRegex(fuge.UnsupportedError, "only close to", fuge.plot.stress, contact)
        contact = fuge.solve(fuge.HalfplaneOperator(4, 1.0, 1.0), 0.0, 0.0)
        self.assertRaisesRegex(fuge.InputError, "press harder", fuge.plot.stress, contact)


class Matplotlib(Pictures):
    def test_axes_of_ones_own(self):
        figure, (left, right) = pyplot.subplots(1, 2)
        self.assertIs(fuge.plot.map(self.ball, ax=left), left)
        self.assertIs(fuge.plot.line(self.ball, ax=right), right)
        self.assertEqual(pyplot.get_fignums(), [figure.number])

    def test_kinds(self):
        for picture in ("line", "map", "gap", "path", "stress", "levels"):
            with self.assertRaisesRegex(TypeError, rf"fuge.plot.{picture} draws a \w+.*, not ndarray"):
                getattr(fuge.plot, picture)(self.ball.force)
        resolved = fuge.solve_line(lambda x: x**2, (-1.0, 1.0), e_star=1.0, load=0.1)
        self.assertRaisesRegex(TypeError, "not ResolvedContact: draw its arrays x, y", fuge.plot.line, resolved)

    def test_is_imported_for_the_first_picture_only(self):
        script = (
            "import sys, fuge\n"
            "assert 'matplotlib' not in sys.modules\n"
            "sys.modules['matplotlib'] = sys.modules['matplotlib.pyplot'] = None\n"
            "contact = fuge.solve([[1.0]], 0.0, 1.0)\n"
            "try:\n    fuge.plot.line(contact)\n"
            "except ImportError as error:\n    print(error)\n"
        )
        found = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
        self.assertIn("pip install matplotlib", found.stdout)


if __name__ == "__main__":
    unittest.main()
