"""Contact to a wanted error, against closed forms."""

import copy
import pickle
import signal
import threading
import unittest
import warnings
from concurrent.futures import ThreadPoolExecutor
from unittest import mock

import numpy as np

import fuge

LOAD = np.pi / 4
"""The load under which a cylinder of radius 1 has the half width 1 and the largest pressure 1/2, for e_star = 1."""


def parabola(x):
    return x**2 / 2


def bowl(x, y):
    return (x**2 + y**2) / 2


def share_in_the_wrong_place(force, wanted):
    return np.abs(force - wanted).sum() / (2 * wanted.sum())


def hertz_forces(contact):
    """Forces of the cylinder on the cells."""
    ends = np.append(contact.x - contact.width_x / 2, contact.x[-1] + contact.width_x[-1] / 2).clip(-1.0, 1.0)
    return np.diff((np.arcsin(ends) + ends * np.sqrt(1 - ends**2)) / 4)


class Lines(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.contact = fuge.solve_line(parabola, (-3.0, 3.0), e_star=1.0, load=LOAD)

    def near(self, estimate, exact, most):
        """An estimate holds, and is of use."""
        self.assertLessEqual(abs(float(estimate) - exact), estimate.error + 1e-12 * abs(exact))
        self.assertLessEqual(estimate.error, most * abs(exact))

    def test_cylinder(self):
        contact = self.contact
        self.assertLessEqual(contact.pressure_error, 1e-3)
        self.assertEqual(contact.accuracy, 1e-3)
        self.assertLess(share_in_the_wrong_place(contact.force, hertz_forces(contact)), 1e-3)
        np.testing.assert_allclose(contact.pressure, contact.force / contact.width_x)
        self.near(contact.largest, 0.5, 0.02)
        self.near(contact.size, 2.0, 0.02)
        # The datum is twice the length of the interval.
        self.near(contact.approach, (np.log(24.0) + 0.5) / 2, 0.01)
        self.assertEqual(contact.edges.shape, (1, 2))
        np.testing.assert_allclose(contact.edges[0], [-1, 1], atol=contact.edge_error + 1e-12)
        self.assertLess(contact.edge_error, 0.02)
        self.assertAlmostEqual(contact.load, LOAD, delta=1e-9)
        self.assertEqual(contact.tilt, 0.0)
        self.assertEqual(contact.at_rim, (False,) * 4)
        self.assertEqual((contact.y.tolist(), contact.width_y.tolist()), ([0.0], [1.0]))
        for values in (contact.gap, contact.force, contact.pressure, contact.width_x):
            self.assertEqual(values.shape, contact.x.shape)
        self.assertGreater(len(contact.choice), 10)

    def test_levels(self):
        levels = self.contact.levels
        self.assertIsInstance(levels, list)
        self.assertTrue(levels)
        for level in levels:
            self.assertIn(level.method, ("series", "graded_cells", "equal_cells"))
            self.assertGreater(level.cells, 0)
            self.assertTrue(0 <= level.pressure_error <= 1 and level.approach_error >= 0)
        self.assertEqual(levels[-1].method, self.contact.method)
        self.assertEqual(levels[-1].pressure_error, self.contact.pressure_error)
        seconds = [level.seconds for level in levels]
        self.assertEqual(seconds, sorted(seconds))
        self.assertGreater(seconds[-1], 0.0)

    def test_flat_face(self):
        contact = fuge.solve_line(lambda x: 0.0, (1.0, 3.0), e_star=2.0, load=1.0, accuracy=5e-3)
        self.assertEqual(contact.at_rim, (True, True, False, False))
        ends = np.append(contact.x - contact.width_x / 2, contact.x[-1] + contact.width_x[-1] / 2) - 2.0
        wanted = np.diff(np.arcsin(ends.clip(-1, 1))) / np.pi
        self.assertLess(share_in_the_wrong_place(contact.force, wanted), 5e-3)
        self.near(contact.size, 2.0, 0.02)
        self.near(contact.approach, np.log(8.0) / np.pi, 0.02)

    def test_approach(self):
        contact = fuge.solve_line(parabola, (-3.0, 3.0), e_star=1.0, approach=(np.log(24.0) + 0.5) / 2)
        self.assertAlmostEqual(contact.load, LOAD, delta=3e-3 * LOAD)

    def test_moment(self):
        contact = fuge.solve_line(parabola, (-3.0, 3.0), e_star=1.0, load=LOAD, moment=0.2 * LOAD)
        self.assertAlmostEqual(contact.edges.mean(), 0.2, delta=contact.edge_error + 1e-12)
        self.assertAlmostEqual(contact.tilt, 0.2, delta=2e-3)

    def test_periodic(self):
        # Westergaard: half of the surface touches under half of the pressure that closes the gap.
        contact = fuge.solve_line(
            lambda x: 1 - np.cos(2 * np.pi * x), (0.0, 1.0), e_star=1.0, load=np.pi / 2, boundary="periodic"
        )
        self.near(contact.size, 0.5, 0.02)
        self.assertEqual(contact.at_rim, (False,) * 4)

    def test_layers(self):
        layers = fuge.Layers([], [0.91], [0.3])
        contact = fuge.solve_line(parabola, (-3.0, 3.0), layers=layers, load=LOAD)
        self.near(contact.size, 2.0, 0.02)
        # A hard film: between the contacts of half-spaces of both materials.
        coated = fuge.Layers([0.1], [91.0, 0.91], 0.3)
        contact = fuge.solve_line(parabola, (-3.0, 3.0), layers=coated, load=LOAD, accuracy=1e-2)
        self.assertTrue(0.2 < contact.size < 1.9)

    def test_points(self):
        x = np.linspace(-3.0, 3.0, 2001)
        contact = fuge.solve_line((x, parabola(x)), (-3.0, 3.0), e_star=1.0, load=LOAD, accuracy=5e-3)
        self.assertAlmostEqual(contact.size, 2.0, delta=0.02)
        # A wedge is linear between three points.
        wedge = fuge.solve_line(([-2, 0, 2], [2.0, 0.0, 2.0]), (-1.0, 1.0), e_star=1.0, load=0.5, accuracy=5e-3)
        self.near(wedge.size, 1.0, 0.05)

    def test_points_that_are_refused(self):
        def refused(gap, words, error=fuge.InputError):
            with self.assertRaisesRegex(error, words):
                fuge.solve_line(gap, (-1.0, 1.0), e_star=1.0, load=1.0)

        refused(([0, 1], [0, 1]), r"from 0 to 1 along x, but needed from -1 to 1")
        refused(([-1, 1, 1], [0, 1, 2]), "places that grow")
        refused(([0], [0]), "two or more places")
        refused(([-1, 1], [0, np.nan]), "not finite")
        refused(([-1, 1], [0, 1, 2]), r"gap has the shape \(3,\)")
        refused(([[-1, 1]], [[0, 1]]), r"x has the shape \(1, 2\)")
        refused(np.zeros(5), "gap must be a function, or the arrays", TypeError)
        refused((1, 2, 3), "gap must be a function, or the arrays", TypeError)

    def test_threads(self):
        again = fuge.solve_line(parabola, (-3.0, 3.0), e_star=1.0, load=LOAD, threads=0)
        np.testing.assert_array_equal(again.force, self.contact.force)

    def test_limits(self):
        def rough(x):
            return np.abs(np.sin(7 * x)) + np.abs(np.sin(40.1 * x)) / 3

        with self.assertWarnsRegex(fuge.AccuracyWarning, "most_cells") as caught:
            contact = fuge.solve_line(rough, (-3.0, 3.0), e_star=1.0, load=1.0, accuracy=1e-8, most_cells=512)
        self.assertEqual(caught.warning.status, fuge.Status.WARN_ACCURACY)
        self.assertEqual(caught.filename, __file__)
        self.assertGreater(contact.pressure_error, 1e-8)
        self.assertLessEqual(contact.x.size, 512)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            with self.assertRaises(fuge.AccuracyWarning):
                fuge.solve_line(rough, (-3.0, 3.0), e_star=1.0, load=1.0, accuracy=1e-8, most_cells=512)
        with self.assertWarns(fuge.AccuracyWarning):
            fuge.solve_line(rough, (-3.0, 3.0), e_star=1.0, load=1.0, accuracy=1e-8, most_seconds=1e-6)

    def test_refused(self):
        def refused(words="", error=fuge.InputError, interval=(-3.0, 3.0), **changed):
            given = {"e_star": 1.0, "load": 1.0, **changed}
            with self.assertRaisesRegex(error, words):
                fuge.solve_line(parabola, interval, **given)

        refused("load", load=None)
        refused("load", approach=0.1)
        refused("moment", fuge.UnsupportedError, load=None, approach=0.1, moment=0.1)
        refused("moment", fuge.UnsupportedError, boundary="periodic", moment=0.1)
        refused("accuracy", accuracy=0.0)
        refused("accuracy", accuracy=-1.0)
        refused("accuracy", accuracy=1.0)
        refused("accuracy", accuracy=np.nan)
        refused("most_seconds", most_seconds=0.0)
        refused("most_cells", most_cells=-1)
        refused("threads", threads=-1)
        refused("boundary is 'open'", boundary="open")
        refused("e_star", e_star=None)
        refused("e_star", layers=fuge.Layers([], [1.0], [0.3]))
        refused(error=fuge.InputError, e_star=0.0)
        refused(error=fuge.InputError, interval=(1.0, -1.0))
        refused(error=fuge.EquilibriumError, load=-1.0)
        refused("interval", TypeError, 3.0)
        refused("interval", TypeError, (1.0, 2.0, 3.0))
        refused("load must be a real number", TypeError, load="1")
        refused("layers must be Layers", TypeError, e_star=None, layers=2.0)
        refused("most_cells must be an integer", TypeError, most_cells=1e3)

    def test_exceptions_of_the_gap(self):
        def gap(x):
            raise LookupError("mine")

        with self.assertRaisesRegex(LookupError, "mine"):
            fuge.solve_line(gap, (-1.0, 1.0), e_star=1.0, load=1.0)
        self.assertRaises(ValueError, fuge.solve_line, lambda x: x[:-1], (-1.0, 1.0), e_star=1.0, load=1.0)
        self.assertRaises(TypeError, fuge.solve_line, lambda x: "gap", (-1.0, 1.0), e_star=1.0, load=1.0)
        self.assertRaises(TypeError, fuge.solve_line, bowl, (-1.0, 1.0), e_star=1.0, load=1.0)
        self.assertRaises(fuge.CallbackError, fuge.solve_line, lambda x: x * np.nan, (-1.0, 1.0), e_star=1.0, load=1.0)

        def change(x):
            x[:] = 0.0

        self.assertRaises(ValueError, fuge.solve_line, change, (-1.0, 1.0), e_star=1.0, load=1.0)

    @unittest.skipUnless(hasattr(signal, "pthread_kill"), "no signals for threads")
    def test_interrupt(self):
        # Ctrl-C while the gap is computed ends the solve.
        self.addCleanup(signal.signal, signal.SIGINT, signal.signal(signal.SIGINT, signal.default_int_handler))
        main = threading.get_ident()
        calls = []

        def gap(x):
            if not calls:
                sender = threading.Thread(target=signal.pthread_kill, args=(main, signal.SIGINT))
                sender.start()
                sender.join()
            calls.append(x.size)
            return np.abs(x)

        self.assertRaises(KeyboardInterrupt, fuge.solve_line, gap, (-1.0, 1.0), e_star=1.0, load=0.1)
        self.assertEqual(len(calls), 1)
        self.assertIs(signal.getsignal(signal.SIGINT), signal.default_int_handler)

    def test_several_threads(self):
        def size(load):
            return fuge.solve_line(parabola, (-3.0, 3.0), e_star=1.0, load=load).size

        def fails(load):
            with self.assertRaisesRegex(LookupError, str(load)):
                fuge.solve_line(mock.Mock(side_effect=LookupError(load)), (-3.0, 3.0), e_star=1.0, load=load)
            return size(load)

        with ThreadPoolExecutor(4) as pool:
            sizes = list(pool.map(fails, LOAD * np.linspace(0.5, 1.5, 21)))
        np.testing.assert_allclose(sizes, 2 * np.sqrt(np.linspace(0.5, 1.5, 21)), rtol=1e-3)

    def test_the_gap_may_solve(self):
        # Of a contact inside the gap of another one.
        def gap(x):
            inner = fuge.solve_line(parabola, (-3.0, 3.0), e_star=1.0, load=LOAD, accuracy=0.05)
            return parabola(x) + 0 * inner.load

        contact = fuge.solve_line(gap, (-3.0, 3.0), e_star=1.0, load=LOAD, accuracy=0.05)
        self.assertAlmostEqual(contact.size, 2.0, delta=0.2)

    def test_nothing_is_left_in_the_library(self):
        freed = []
        free = fuge._calls.Handle.close

        def close(handle):
            freed.append(handle.name)
            free(handle)

        with mock.patch.object(fuge._calls.Handle, "close", close):
            fuge.solve_line(parabola, (-3.0, 3.0), e_star=1.0, load=LOAD)
        self.assertEqual(freed, ["contact"])


class Areas(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.hertz = fuge.hertz_ellipse(1.0, 1.0, 1.0, 0.05)
        cls.contact = fuge.solve_area(bowl, (-1.0, 1.0), (-0.6, 0.8), e_star=1.0, load=0.05, accuracy=0.03)

    def test_ball(self):
        contact, hertz = self.contact, self.hertz
        shape = (contact.y.size, contact.x.size)
        for values in (contact.force, contact.gap, contact.pressure):
            self.assertEqual(values.shape, shape)
        areas = contact.width_y[:, np.newaxis] * contact.width_x
        np.testing.assert_allclose(contact.pressure, contact.force / areas)
        self.assertLessEqual(contact.pressure_error, 0.03)
        self.assertAlmostEqual(contact.load, 0.05, delta=1e-9)
        exact = {"approach": hertz.approach, "largest": hertz.peak_pressure, "size": np.pi * hertz.semi_axis_x**2}
        for name, value in exact.items():
            estimate = getattr(contact, name)
            self.assertLessEqual(abs(float(estimate) - value), estimate.error + 1e-12, name)
        self.assertLess(contact.approach.error, 0.1 * hertz.approach)
        self.assertEqual(contact.edges.shape, (0, 2))
        self.assertEqual(contact.at_rim, (False,) * 4)

    def test_where_it_is(self):
        contact = fuge.solve_area(
            lambda x, y: bowl(x - 0.3, 2 * y), (-1.0, 1.0), (-0.6, 0.8), e_star=1.0, load=0.02, accuracy=0.1
        )
        row, column = np.unravel_index(contact.force.argmax(), contact.force.shape)
        self.assertAlmostEqual(contact.x[column], 0.3, delta=0.1)
        self.assertAlmostEqual(contact.y[row], 0.0, delta=0.1)
        self.assertGreater((contact.force > 0).any(axis=0).sum() * contact.width_x[0], 0.3)

    def test_approach(self):
        contact = fuge.solve_area(
            bowl, (-1.0, 1.0), (-0.6, 0.8), e_star=1.0, approach=self.hertz.approach, accuracy=0.03
        )
        self.assertAlmostEqual(contact.load, 0.05, delta=0.05 * 0.05)

    def test_roller(self):
        contact = fuge.solve_area(
            lambda x, y: parabola(x), (-1.0, 1.0), (0.0, 1.0), e_star=1.0, load=0.05, accuracy=0.1
        )
        self.assertEqual(contact.at_rim, (False, False, True, True))

    def test_points(self):
        x, y = np.linspace(-1.0, 1.0, 201), np.linspace(-0.6, 0.8, 141)
        gap = bowl(*np.meshgrid(x, y))
        contact = fuge.solve_area((x, y, gap), (-1.0, 1.0), (-0.6, 0.8), e_star=1.0, load=0.05, accuracy=0.05)
        self.assertAlmostEqual(contact.approach, self.hertz.approach, delta=0.05 * self.hertz.approach)
        # A plane is bilinear, also on unequal sides.
        x, y = np.array([-1.0, 0.3, 1.0]), np.array([0.0, 0.9, 1.0])
        plane = fuge.accuracy._surface((x, y, 2 + np.add.outer(3 * y, x)), [-1.0, 1.0], [0.0, 1.0])
        px, py = np.random.default_rng(1).uniform([[-1.0], [0.0]], 1.0, (2, 50))
        np.testing.assert_allclose(plane(px, py), 2 + px + 3 * py, rtol=1e-14)
        np.testing.assert_allclose(plane(np.array([-1.0, 1.0]), np.array([0.0, 1.0])), [1.0, 6.0])

    def test_points_that_are_refused(self):
        def refused(gap, words, error=fuge.InputError):
            with self.assertRaisesRegex(error, words):
                fuge.solve_area(gap, (0.0, 1.0), (0.0, 2.0), e_star=1.0, load=1.0)

        flat = np.zeros((3, 2))
        refused(([0, 1], [0, 1, 1.9], flat), "along y, but needed from 0 to 2")
        refused(([0, 1], [0, 1, 2], flat.T), r"gap has the shape \(2, 3\), but must have \(3, 2\)")
        refused(([0, 1], [0, 1, 2], flat + np.inf), "not finite")
        refused((flat, flat), "gap must be a function, or the arrays", TypeError)

    def test_refused(self):
        with self.assertRaisesRegex(TypeError, "y_range must be a pair"):
            fuge.solve_area(bowl, (0.0, 1.0), 1.0, e_star=1.0, load=1.0)
        with self.assertRaises(fuge.InputError):
            fuge.solve_area(bowl, (0.0, 1.0), (1.0, 0.0), e_star=1.0, load=1.0)
        with self.assertRaisesRegex(LookupError, "mine"):
            fuge.solve_area(mock.Mock(side_effect=LookupError("mine")), (0, 1), (0, 1), e_star=1.0, load=1.0)

    def test_layers(self):
        layers = fuge.Layers([0.1, 0.2], [0.91] * 3, 0.3)
        contact = fuge.solve_area(bowl, (-1.0, 1.0), (-0.6, 0.8), layers=layers, load=0.05, accuracy=0.1)
        self.assertAlmostEqual(contact.approach, self.hertz.approach, delta=contact.approach.error + 1e-6)

    def test_periodic(self):
        contact = fuge.solve_area(
            lambda x, y: 2 - np.cos(2 * np.pi * x) - np.cos(2 * np.pi * y),
            (0.0, 1.0),
            (0.0, 1.0),
            e_star=1.0,
            load=20.0,
            boundary="periodic",
            accuracy=0.1,
        )
        # All is closed, and the pressure a wave.
        self.assertAlmostEqual(contact.size, 1.0, delta=1e-9)
        self.assertEqual(contact.at_rim, (False,) * 4)


class Results(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.line = fuge.solve_line(parabola, (-3.0, 3.0), e_star=1.0, load=LOAD)
        cls.area = fuge.solve_area(bowl, (-1.0, 1.0), (-1.0, 1.0), e_star=1.0, load=0.05, accuracy=0.1)

    def test_repr(self):
        for contact in (self.line, self.area):
            text = repr(contact)
            self.assertEqual(len(text.splitlines()), 1)
            self.assertLess(len(text), 200)
            self.assertRegex(text, r"^<ResolvedContact: \d.* cells.*, load .*, error \d\.\de[-+]\d\d, .* s>$")
        self.assertRegex(repr(self.area), rf"{self.area.x.size} x {self.area.y.size} cells, by a series")
        self.assertIn(f"load {LOAD:.6g}", repr(self.line))
        self.assertNotIn("rim", repr(self.line))
        narrow = fuge.solve_line(parabola, (-0.1, 0.1), e_star=1.0, load=LOAD)
        self.assertIn("reaches the rim", repr(narrow))

    def test_pickles(self):
        for contact in (self.line, self.area):
            for again in (pickle.loads(pickle.dumps(contact)), copy.deepcopy(contact)):
                np.testing.assert_array_equal(again.force, contact.force)
                np.testing.assert_array_equal(again.pressure, contact.pressure)
                self.assertEqual(again.levels, contact.levels)
                self.assertEqual((again.approach, again.approach.error), (contact.approach, contact.approach.error))
                self.assertEqual(repr(again), repr(contact))

    def test_is_frozen(self):
        with self.assertRaises(AttributeError):
            self.line.load = 1.0
        with self.assertRaises(AttributeError):
            self.line.levels[0].cells = 1

    def test_estimates(self):
        number = fuge.Estimate(0.25, 0.001)
        self.assertEqual((number, number.error), (0.25, 0.001))
        self.assertEqual((repr(number), str(number)), ("Estimate(0.25, error=0.001)", "0.25"))
        self.assertEqual((f"{number:.1f}", f"{number}", "%g" % number), ("0.2", "0.25", "0.25"))
        self.assertIs(type(2 * number), float)
        for protocol in range(pickle.HIGHEST_PROTOCOL + 1):
            self.assertEqual(pickle.loads(pickle.dumps(number, protocol)).error, 0.001)
        self.assertEqual(repr(fuge.Estimate(0.25, np.inf)), "Estimate(0.25, error=inf)")

    def test_words(self):
        self.assertEqual(fuge.accuracy._method(fuge._library.HEADERS.constants["BY_SERIES"]), "series")
        self.assertEqual(fuge.accuracy._known(np.finfo(float).max), np.inf)
        self.assertEqual(fuge.accuracy._known(1.0), 1.0)


if __name__ == "__main__":
    unittest.main()
