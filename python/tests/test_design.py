"""Gradients of an objective against derivatives and differences, kinks, and the gaps for a wanted pressure."""

import pickle
import unittest
import warnings

import numpy as np

import fuge

ALPHA = np.array([[0.2, 0.1], [0.1, 0.2]])
WEIGHTS = ("force", "gap", "motion")


def with_laws():
    """A beam of 24 points between two stops: three motions, one prescribed, one on a spring, and all laws."""
    x = np.linspace(-1.0, 1.0, 24)
    return {
        "matrix": np.exp(-3.0 * np.abs(x[:, np.newaxis] - x)) + 0.02 * np.eye(24),
        "gap": 0.4 * x**2 + 0.1 * np.sin(9.0 * x),
        "gap_upper": np.where(np.arange(24) % 3 == 1, 0.05, 0.6),
        "compliance": 0.1 + 0.05 * np.cos(5.0 * x),
        "limit": np.where(np.arange(24) % 4 == 2, 0.06, 0.27),
        "limit_upper": np.where(np.arange(24) % 6 == 1, 0.03, 0.3),
        "modes": np.column_stack([np.ones(24), x, x**2 - 0.3]),
        "load": np.array([1.0, 0.4, 0.625]),
        "motion_stiffness": np.array([2.0, 0.0, 0.0]),
    }


PRESCRIBED = 2


def solver_of(data):
    solver = fuge.Solver(data["matrix"], tolerance=1e-13)
    solver.set_gap(data["gap"], data["gap_upper"])
    solver.set_compliance(data["compliance"])
    solver.set_limits(data["limit"], data["limit_upper"])
    solver.set_modes(data["modes"], data["load"])
    for mode, stiffness in enumerate(data["motion_stiffness"]):
        solver.set_motion_stiffness(mode, stiffness)
    solver.set_motion(PRESCRIBED, data["load"][PRESCRIBED])
    return solver


def ball(n=16, load=0.3, e_star=1.0):
    """A ball on a half-space of cells of 0.1; its solver and its gaps."""
    operator = fuge.HalfspaceOperator(n, n, 0.1, 0.1, e_star)
    x, y = np.meshgrid(operator.cells.centres(0), operator.cells.centres(1))
    gap = (x**2 + 1.3 * y**2) / 2 + 0.01 * np.cos(11 * x + 5 * y)
    solver = fuge.Solver(operator, tolerance=1e-13)
    solver.set_gap(gap)
    solver.set_load(load)
    return solver, gap


def weights_of(contact, seed=7):
    """Weights of a linear objective, any."""
    random = np.random.default_rng(seed)
    return {name: random.standard_normal(getattr(contact, name).shape) for name in WEIGHTS}


def objective(contact, weights):
    return sum(np.sum(weight * getattr(contact, name)) for name, weight in weights.items())


class Products(unittest.TestCase):
    """The vector-Jacobian product and the derivative are adjoint to each other."""

    def adjoint(self, solver, seed=3):
        contact = solver.solve()
        weights = weights_of(contact)
        random = np.random.default_rng(seed)
        by_gap, by_load = random.standard_normal(contact.gap.shape), random.standard_normal(contact.motion.shape)
        change = solver.derivative(by_gap, by_load)
        gradients = solver.vjp(**weights)
        forward = [np.sum(weight * getattr(change, name)) for name, weight in weights.items()]
        backward = [np.sum(gradients.gap * by_gap), np.sum(gradients.load * by_load)]
        self.assertAlmostEqual(sum(forward) / sum(backward), 1.0, delta=1e-10)
        self.assertEqual(gradients.gap.shape, contact.gap.shape)
        self.assertFalse(gradients.at_kink.any())
        return contact

    def test_all_laws(self):
        contact = self.adjoint(solver_of(with_laws()))
        self.assertEqual(set(contact.state), set(fuge.PointState))

    def test_half_space(self):
        solver, _ = ball()
        self.assertEqual(self.adjoint(solver).gap.shape, (16, 16))

    def test_half_space_with_laws(self):
        solver, gap = ball()
        solver.set_compliance(0.5)
        solver.set_limits(np.where(gap < 0.1, 0.002, np.inf))
        contact = self.adjoint(solver)
        self.assertIn(fuge.PointState.LIMITED_LOWER, contact.state)
        solver.set_modes(np.dstack([np.ones_like(gap), gap]), [0.3, 1.01 * np.sum(contact.force * gap)])
        self.adjoint(solver)
        solver.set_approach(0.15)
        self.adjoint(solver)

    def test_iteration_and_tableau(self):
        for method in ("tableau", "iterative"):
            solver = fuge.Solver(with_laws()["matrix"], method=method, tolerance=1e-13)
            solver.set_gap(with_laws()["gap"])
            solver.set_load(2.0)
            self.adjoint(solver)


class Differences(unittest.TestCase):
    """Each gradient is what central differences show."""

    def setUp(self):
        self.data = with_laws()
        self.solver = solver_of(self.data)
        self.contact = self.solver.solve()
        self.weights = weights_of(self.contact)
        self.gradients = self.solver.vjp(**self.weights)

    def difference(self, name, place, step):
        sides = []
        for side in (step, -step):
            changed = {**self.data, name: self.data[name].copy()}
            changed[name][place] += side
            contact = solver_of(changed).solve()
            np.testing.assert_array_equal(contact.state, self.contact.state)
            sides.append(objective(contact, self.weights))
        return (sides[0] - sides[1]) / (2 * step)

    def check(self, name, places, step=1e-6):
        found = getattr(self.gradients, name)
        wanted = np.zeros(found.shape)
        for place in places:
            wanted[place] = self.difference(name, place, step)
        np.testing.assert_allclose(found, wanted, rtol=1e-6, atol=1e-6)
        return wanted

    def test_each_datum(self):
        for name in ("gap", "gap_upper", "compliance", "limit", "limit_upper"):
            self.assertTrue(self.check(name, range(24)).any(), name)

    def test_loads_and_the_prescribed_motion(self):
        self.assertTrue(self.check("load", range(3)).all())

    def test_springs_on_motions(self):
        self.data["motion_stiffness"][1] = 0.5
        self.solver = solver_of(self.data)
        self.contact = self.solver.solve()
        self.gradients = self.contact.vjp(**self.weights)
        self.assertTrue(self.check("motion_stiffness", range(2))[:2].all())

    def test_the_first_bit_of_a_spring(self):
        # A spring of none can only get softer, or stiffer: differences to one side, of second order.
        solver, _ = ball()
        weights = weights_of(solver.solve())
        gradients = solver.vjp(**weights)
        points, step = np.cos(np.arange(256.0)).reshape(16, 16) ** 2, 1e-4
        for change, found in [
            (lambda value: solver.set_compliance(value * points), np.sum(gradients.compliance * points)),
            (lambda value: solver.set_motion_stiffness(0, value), gradients.motion_stiffness[0]),
        ]:
            values = []
            for k in range(3):
                change(k * step)
                values.append(objective(solver.solve(), weights))
            change(0.0)
            wanted = np.dot([-3.0, 4.0, -1.0], values) / (2 * step)
            self.assertAlmostEqual(found / wanted, 1.0, delta=1e-6)

    def test_coefficients_of_the_matrix(self):
        i, j, step = 9, 17, 1e-6
        sides = []
        for side in (step, -step):
            matrix = self.data["matrix"].copy()
            matrix[[i, j], [j, i]] += side
            sides.append(objective(solver_of({**self.data, "matrix": matrix}).solve(), self.weights))
        wanted = (sides[0] - sides[1]) / (2 * step)
        force, by_gap = self.contact.force, self.gradients.gap
        self.assertAlmostEqual((by_gap[i] * force[j] + by_gap[j] * force[i]) / wanted, 1.0, delta=1e-6)

    def test_modulus(self):
        solver, gap = ball()
        weights = weights_of(solver.solve())
        step = 1e-5
        sides = [objective(ball(e_star=1.0 + side)[0].solve(), weights) for side in (step, -step)]
        found = solver.vjp(**weights).log_modulus
        self.assertAlmostEqual(found / ((sides[0] - sides[1]) / (2 * step)), 1.0, delta=1e-6)

    def test_a_norm_of_the_pressure(self):
        solver, gap = ball()

        def norm(contact):
            return np.sum(contact.pressure**8) ** (1 / 8)

        contact = solver.solve()
        by_pressure = (contact.pressure / norm(contact)) ** 7
        gradients = contact.vjp(pressure=by_pressure)
        shape, step = np.sin(np.arange(256.0)).reshape(16, 16), 1e-6
        sides = []
        for side in (step, -step):
            solver.set_gap(gap + side * shape)
            sides.append(norm(solver.solve()))
        wanted = (sides[0] - sides[1]) / (2 * step)
        self.assertAlmostEqual(np.sum(gradients.gap * shape) / wanted, 1.0, delta=1e-6)


class Weights(unittest.TestCase):
    def setUp(self):
        self.solver, _ = ball()
        self.contact = self.solver.solve()

    def test_pressures_are_forces_over_areas(self):
        weight = np.cos(np.arange(256.0)).reshape(16, 16)
        by_pressure = self.solver.vjp(pressure=weight)
        np.testing.assert_allclose(by_pressure.gap, self.solver.vjp(force=weight / 0.01).gap, rtol=1e-12)
        both = self.solver.vjp(pressure=weight, force=weight)
        np.testing.assert_allclose(both.gap, 1.01 * by_pressure.gap, rtol=1e-9, atol=1e-9)

    def test_flat_arrays_and_numbers(self):
        one = self.solver.vjp(gap=np.ones((16, 16)), motion=[2.0])
        for gap, motion in ((np.ones(256), 2), (1, np.array(2.0))):
            np.testing.assert_array_equal(self.solver.vjp(gap=gap, motion=motion).gap, one.gap)
        # The sum of the forces is the load.
        total = self.solver.vjp(force=1.0)
        np.testing.assert_allclose(total.load, [1.0], rtol=1e-12)
        np.testing.assert_allclose(total.gap, 0.0, atol=1e-11)

    def test_no_weights(self):
        none = self.solver.vjp()
        self.assertEqual((np.abs(none.gap).max(), none.load.tolist(), none.log_modulus), (0.0, [0.0], 0.0))

    def test_what_is_refused(self):
        for weights, words in [
            ({"force": np.ones((16, 4))}, r"force has the shape \(16, 4\)"),
            ({"gap": np.ones(4)}, r"gap has the shape \(4,\)"),
            ({"pressure": np.ones(4)}, r"pressure has the shape"),
            ({"motion": [1.0, 2.0]}, r"motion has the shape \(2,\)"),
            ({"force": np.full(256, np.nan)}, "finite"),
            ({"motion": np.inf}, "finite"),
        ]:
            with self.subTest(words), self.assertRaisesRegex(fuge.InputError, words):
                self.contact.vjp(**weights)
        with self.assertRaises(TypeError):
            self.solver.vjp(np.ones(256))
        with self.assertRaisesRegex(TypeError, "motion"):
            self.solver.vjp(motion="1")

    def test_pressures_need_cells(self):
        solver = fuge.Solver(ALPHA)
        solver.set_gap([0.0, 1.0])
        solver.set_load(2.0)
        contact = solver.solve()
        for call in (lambda: solver.vjp(pressure=1.0), lambda: contact.pressure):
            self.assertRaisesRegex(fuge.InputError, "areas of its points", call)

    def test_shapes_and_words(self):
        data = with_laws()
        solver = solver_of(data)
        gradients = solver.solve().vjp(motion=[1.0, 0.0, 0.0])
        shapes = {name: np.shape(value) for name, value in vars(gradients).items()}
        by_motions = {"load": (3,), "motion_stiffness": (3,), "log_modulus": ()}
        self.assertEqual(shapes, {name: by_motions.get(name, (24,)) for name in shapes})
        self.assertEqual(gradients.at_kink.dtype, bool)
        self.assertRegex(repr(gradients), r"^<Gradients: by 24 gaps up to \S+, load \[.*\], log_modulus \S+, 0 points")
        self.assertRegex(repr(self.solver.vjp(motion=1.0)), "^<Gradients: by 256 gaps up to .*, load 0.*, 0 points at")


class Kinks(unittest.TestCase):
    """Points on the border between two states are named."""

    def test_a_point_that_just_touches(self):
        solver = fuge.Solver(ALPHA)
        solver.set_gap([0.0, 0.2])
        solver.set_load(2.0)
        contact = solver.solve()
        with self.assertWarnsRegex(fuge.KinkWarning, r"1 point\(s\), first point 1, lie on the border") as caught:
            gradients = contact.vjp(motion=1.0)
        self.assertEqual(caught.filename, __file__)
        self.assertEqual(caught.warning.status, fuge.Status.WARN_KINK)
        np.testing.assert_array_equal(gradients.at_kink, [False, True])
        self.assertIn("1 points at a kink", repr(gradients))
        # It is the derivative of one of the two sides.
        self.assertTrue(np.isclose(gradients.load[0], [0.2, 0.15]).any())

    def test_a_point_of_a_grid(self):
        solver, gap = ball(8, 0.03)
        wanted = solver.gap_for_pressure(np.where(gap < 0.05, 1.0, 0.0), clearance=0.1)
        gap = wanted.gap.copy()
        gap[1, 6] -= 0.1
        solver.set_gap(gap)
        solver.set_load(wanted.resultant[0])
        contact = solver.solve()
        with self.assertWarnsRegex(fuge.KinkWarning, r"first point \[1, 6\]"):
            self.assertEqual(np.argwhere(contact.vjp(force=1.0).at_kink).tolist(), [[1, 6]])

    def test_a_warning_of_the_solve(self):
        # It has come already, as for a derivative.
        solver = fuge.Solver(np.ones((2, 2)))
        solver.set_gap([0.0, 0.0])
        solver.set_load(2.0)
        with self.assertWarns(fuge.NotUniqueWarning):
            solver.solve()
        for call in (lambda: solver.derivative(load_change=1.0), lambda: solver.vjp(motion=1.0)):
            with warnings.catch_warnings(record=True) as caught:
                warnings.simplefilter("always")
                call()
            self.assertEqual(caught, [])


class Solutions(unittest.TestCase):
    """A solution has gradients as long as it is the last one of a solver that is still there."""

    def setUp(self):
        self.solver, _ = ball(8, 0.03)
        self.contact = self.solver.solve()

    def test_that_of_the_solver(self):
        np.testing.assert_array_equal(self.contact.vjp(motion=1.0).gap, self.solver.vjp(motion=1.0).gap)

    def test_the_solver_has_gone(self):
        del self.solver
        self.assertRaisesRegex(fuge.CallOrderError, "solver of this solution has gone", self.contact.vjp, motion=1.0)
        contact = fuge.solve(ALPHA, [0.0, 1.0], 2.0)
        self.assertRaises(fuge.CallOrderError, contact.vjp, motion=1.0)

    def test_the_solver_is_closed(self):
        self.solver.close()
        self.assertRaises(fuge.CallOrderError, self.contact.vjp, motion=1.0)

    def test_another_solution(self):
        self.solver.solve()
        self.assertRaisesRegex(fuge.CallOrderError, "solved another problem", self.contact.vjp, motion=1.0)

    def test_another_problem(self):
        self.solver.set_load(0.2)
        self.assertRaisesRegex(fuge.CallOrderError, "call solve", self.contact.vjp, motion=1.0)
        self.assertRaises(fuge.CallOrderError, fuge.Solver(ALPHA).vjp)

    def test_a_copy(self):
        other = pickle.loads(pickle.dumps(self.contact))
        self.assertRaises(fuge.CallOrderError, other.vjp, motion=1.0)
        self.assertTrue(self.contact.vjp(motion=1.0).load[0] > 0.0)


class WantedPressures(unittest.TestCase):
    """The gaps for a wanted pressure, solved with, give it back."""

    def test_round_trip(self):
        solver, gap = ball()
        pressure = np.maximum(0.2 - gap, 0.0)
        wanted = solver.gap_for_pressure(pressure, clearance=0.01)
        self.assertEqual(wanted.gap.min(), 0.0)
        self.assertAlmostEqual(wanted.resultant[0] / (0.01 * pressure.sum()), 1.0, delta=1e-14)
        solver.set_gap(wanted.gap)
        solver.set_load(wanted.resultant[0])
        contact = solver.solve()
        for found in (contact.pressure, wanted.pressure):
            np.testing.assert_allclose(found, pressure, atol=1e-10)
        np.testing.assert_allclose(contact.gap[pressure == 0.0], 0.01, rtol=1e-9)
        self.assertRegex(repr(wanted), "^<WantedContact: gaps 0 to .*, load ")

    def test_all_laws(self):
        data = with_laws()
        solver = solver_of(data)
        contact = solver.solve()
        wanted = solver.gap_for_pressure(force=contact.force, clearance=0.1)
        self.assertEqual(wanted.resultant.shape, (3,))
        solver.set_gap(wanted.gap, data["gap_upper"])
        for mode in range(2):
            solver.set_resultant(mode, wanted.resultant[mode])
        found = solver.solve()
        np.testing.assert_allclose(found.force, contact.force, atol=1e-10)
        np.testing.assert_allclose(found.motion[:2], 0.0, atol=1e-10)
        self.assertRegex(repr(wanted), r"resultant \[")

    def test_before_any_gap(self):
        solver = fuge.Solver(fuge.HalfplaneOperator(50, 0.1, 1.0))
        wanted = solver.gap_for_pressure(2.0)
        self.assertEqual((wanted.gap.shape, wanted.force.shape, wanted.resultant.shape), ((50,), (50,), (1,)))
        np.testing.assert_allclose(wanted.resultant, [10.0], rtol=1e-14)

    def test_shapes(self):
        solver, _ = ball(8, 0.03)
        self.assertEqual(solver.gap_for_pressure(np.ones(64)).gap.shape, (64,))
        self.assertEqual(solver.gap_for_pressure(1.0).gap.shape, (8, 8))

    def test_the_solution_stays(self):
        solver, _ = ball(8, 0.03)
        contact = solver.solve()
        solver.gap_for_pressure(1.0)
        self.assertGreater(contact.vjp(motion=1.0).load[0], 0.0)

    def test_unreachable(self):
        solver, _ = ball(8, 0.03)
        pressure = np.ones((8, 8))
        pressure[2, 3] = -1.0
        with self.assertWarnsRegex(fuge.UnreachableWarning, r"1 point\(s\).*as point \[2, 3\] with -0.01") as caught:
            wanted = solver.gap_for_pressure(pressure)
        self.assertEqual(caught.filename, __file__)
        self.assertEqual(wanted.force[2, 3], 0.0)

    def test_what_is_refused(self):
        solver, _ = ball(8, 0.03)
        for arguments, words in [
            ({}, "give one of pressure and force"),
            ({"pressure": 1.0, "force": 1.0}, "give one of pressure and force"),
            ({"pressure": np.ones((8, 4))}, "pressure has the shape"),
            ({"force": np.ones(4)}, "force has the shape"),
            ({"force": np.where(np.arange(64) == 19, np.nan, 1.0).reshape(8, 8)}, r"force\[2, 3\]"),
            ({"force": 1.0, "clearance": -1.0}, "clearance"),
            ({"force": 1.0, "clearance": np.inf}, "clearance"),
        ]:
            with self.subTest(words), self.assertRaisesRegex(fuge.InputError, words):
                solver.gap_for_pressure(**arguments)
        with self.assertRaisesRegex(fuge.InputError, "areas of its points"):
            fuge.Solver(ALPHA).gap_for_pressure([1.0, 1.0])
        wanted = fuge.Solver(ALPHA).gap_for_pressure(force=[1.0, 1.0])
        with self.assertRaisesRegex(fuge.InputError, "areas of its points"):
            wanted.pressure

    def test_exception_in_a_product(self):
        def product(force):
            raise KeyError("mine")

        with self.assertRaisesRegex(KeyError, "mine"):
            fuge.Solver(fuge.CallbackOperator(2, product)).gap_for_pressure(force=[1.0, 1.0])


if __name__ == "__main__":
    unittest.main()
