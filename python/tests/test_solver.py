"""Problems and solvers: known answers, warm starts, derivatives, paths, and what refuses bad data."""

import copy
import gc
import pickle
import signal
import threading
import unittest
import warnings
from unittest import mock

import numpy as np

import fuge

ALPHA = np.array([[0.2, 0.1], [0.1, 0.2]])
GAP = np.array([0.0, 1.0])
TOLERANCE = 1e-13


def barrel(n=80, width=0.02, radius=50.0, e_star=115384.61538461538):
    x = width * (np.arange(n) - 0.5 * (n - 1))
    return x, width, x**2 / (2 * radius), e_star


class OneCall(unittest.TestCase):
    def test_two_nodes(self):
        contact = fuge.solve(ALPHA, GAP, 2.0)
        np.testing.assert_allclose(contact.force, [2, 0], atol=TOLERANCE)
        np.testing.assert_allclose(contact.gap, [0, 0.8], atol=TOLERANCE)
        self.assertAlmostEqual(contact.approach, 0.4, delta=TOLERANCE)
        self.assertAlmostEqual(contact.load, 2.0, delta=TOLERANCE)
        self.assertEqual(contact.info.status, fuge.Status.DONE)
        self.assertEqual(contact.info.contacts, 1)
        self.assertLess(contact.info.residual, 1e-14)

    def test_approach(self):
        contact = fuge.solve(ALPHA, GAP, approach=0.4)
        self.assertAlmostEqual(contact.load, 2.0, delta=TOLERANCE)

    def test_lists_integers_and_single_precision_are_taken(self):
        for gap in ([0, 1], np.array([0, 1], dtype=np.float32), np.array([[0.0, 9.0], [1.0, 9.0]])[:, 0]):
            np.testing.assert_allclose(fuge.solve(ALPHA.tolist(), gap, 2).force, [2, 0], atol=TOLERANCE)

    def test_both_memory_orders(self):
        wide = np.zeros((2, 5))
        wide[:, :2] = ALPHA
        for alpha in (np.asfortranarray(ALPHA), ALPHA.copy(), wide[:, :2], ALPHA[::-1, ::-1]):
            contact = fuge.solve(alpha, GAP, 20.0)
            np.testing.assert_allclose(contact.force, [15, 5], rtol=1e-13)

    def test_excluded(self):
        contact = fuge.solve(ALPHA, GAP, 2.0, excluded=[True, False])
        np.testing.assert_allclose(contact.force, [0, 2], atol=TOLERANCE)
        self.assertAlmostEqual(contact.gap[0], -1.2, delta=TOLERANCE)

    def test_tied(self):
        # The gap 0.1 of a tied point is closed by a force that pulls.
        contact = fuge.solve([[0.5]], [0.1], modes=np.empty((1, 0)), resultant=[], gap_upper=0.0)
        np.testing.assert_allclose(contact.force, [-0.2], rtol=1e-14)

    def test_play(self):
        contact = fuge.solve([[0.5]], [0.8], modes=np.empty((1, 0)), resultant=[], gap_upper=[0.3])
        np.testing.assert_allclose(contact.gap, [0.3], rtol=1e-14)
        np.testing.assert_allclose(contact.force, [-1.0], rtol=1e-14)

    def test_modes(self):
        n, half = 9, 1.0
        x = np.linspace(-half, half, n)
        modes = np.column_stack([np.ones(n), x])
        contact = fuge.solve(np.eye(n), 0.0, modes=modes, resultant=[9.0, 0.6])
        np.testing.assert_allclose(modes.T @ contact.force, [9.0, 0.6], rtol=1e-13)
        np.testing.assert_allclose(contact.motion, [1.0, 0.6 / (x @ x)], rtol=1e-13)
        self.assertRaises(fuge.InputError, lambda: contact.approach)
        held = fuge.solve(np.eye(n), 0.0, modes=modes, resultant=[9.0, 0.6], motion={1: 0.0})
        np.testing.assert_allclose(held.force, np.ones(n), rtol=1e-13)
        self.assertAlmostEqual(held.resultant[1], 0.0, delta=1e-12)

    def test_one_of_load_approach_and_modes(self):
        for motions in ({}, {"load": 1.0, "approach": 1.0}, {"load": 1.0, "resultant": [1.0]}):
            with self.assertRaises(fuge.InputError) as caught:
                fuge.solve(ALPHA, GAP, **motions)
            self.assertEqual(caught.exception.status, fuge.Status.ERR_OPTION)


class Laws(unittest.TestCase):
    SPRINGS = {"operator": np.zeros((2, 2)), "gap": 0.0, "compliance": [1.0, 0.5]}

    def test_two_springs(self):
        contact = fuge.solve(**self.SPRINGS, load=6.0)
        np.testing.assert_allclose(contact.force, [2, 4], rtol=TOLERANCE)
        self.assertAlmostEqual(contact.approach, 2.0, delta=TOLERANCE)
        self.assertAlmostEqual(contact.info.energy, 6.0, delta=TOLERANCE)

    def test_limit(self):
        contact = fuge.solve(**self.SPRINGS, load=6.0, limit=[np.inf, 3.0])
        np.testing.assert_allclose(contact.force, [3, 3], rtol=TOLERANCE)
        np.testing.assert_allclose(contact.gap, [0, -1.5], atol=TOLERANCE)
        self.assertEqual(contact.state.tolist(), [fuge.PointState.AT_LOWER_STOP, fuge.PointState.LIMITED_LOWER])

    def test_pulling_limit(self):
        contact = fuge.solve(
            **self.SPRINGS, modes=np.ones((2, 1)), resultant=[-4.0], gap_upper=0.0, limit_upper=[np.inf, 1.0]
        )
        np.testing.assert_allclose(contact.force, [-3, -1], rtol=TOLERANCE)
        self.assertEqual(contact.state.tolist(), [fuge.PointState.AT_LOWER_STOP, fuge.PointState.LIMITED_UPPER])

    def test_spring_on_the_motion(self):
        for stiffness in (3.0, [3.0]):
            contact = fuge.solve(**self.SPRINGS, load=6.0, motion_stiffness=stiffness)
            np.testing.assert_allclose(contact.force, [1, 2], rtol=TOLERANCE)
            self.assertAlmostEqual(contact.info.energy, 3.0, delta=TOLERANCE)

    def test_one_solver(self):
        with fuge.Solver(np.zeros((2, 2))) as solver:
            solver.set_gap([0.0, 0.0])
            solver.set_load(6.0)
            solver.set_compliance([1.0, 0.5])
            solver.set_limits(limit=3.0)
            np.testing.assert_allclose(solver.solve().force, [3, 3], rtol=TOLERANCE)
            solver.set_limits()
            np.testing.assert_allclose(solver.solve().force, [2, 4], rtol=TOLERANCE)
            solver.set_compliance(1.0)
            np.testing.assert_allclose(solver.solve().force, [3, 3], rtol=TOLERANCE)
            solver.set_motion_stiffness(0, 1.0)
            np.testing.assert_allclose(solver.solve().force, [2, 2], rtol=TOLERANCE)

    def test_states_of_hard_contact_on_a_grid(self):
        x, y = np.meshgrid(np.linspace(-1, 1, 8), np.linspace(-1, 1, 6))
        contact = fuge.solve(fuge.HalfspaceOperator(8, 6, 0.25, 0.4, 1.0), x**2 + y**2, 0.1)
        self.assertEqual(contact.state.shape, (6, 8))
        np.testing.assert_array_equal(contact.state == fuge.PointState.AT_LOWER_STOP, contact.force > 0)

    def test_what_is_refused(self):
        for arguments, word in [
            ({"compliance": [1.0, -0.5]}, "compliance[1] = -0.5"),
            ({"limit": [1.0, -0.5]}, "limit[1] = -0.5"),
            ({"limit_upper": -1.0}, "limit_upper[0] = -1"),
            ({"motion_stiffness": -3.0}, "motion_stiffness[0] = -3"),
        ]:
            with self.assertRaises(fuge.InputError) as caught:
                fuge.solve(ALPHA, GAP, 2.0, **arguments)
            self.assertEqual(caught.exception.status, fuge.Status.ERR_LAW)
            self.assertIn(word, caught.exception.message)
        with self.assertRaises(fuge.InputError):
            fuge.solve(ALPHA, GAP, 2.0, motion_stiffness=[1.0, 2.0])
        with self.assertRaises(fuge.EquilibriumError):
            fuge.solve(ALPHA, GAP, 2.0, limit=0.5)

    def test_iteration(self):
        for law in ({"compliance": 0.5}, {"compliance": [0.5, 2.0], "motion_stiffness": 1.0}, {"limit": 1.5}):
            by_set = fuge.solve(ALPHA, GAP, 2.0, **law)
            by_products = fuge.solve(ALPHA, GAP, 2.0, method="iterative", **law)
            np.testing.assert_allclose(by_products.force, by_set.force, atol=1e-8)
            np.testing.assert_allclose(by_products.motion, by_set.motion, atol=1e-8)


class Errors(unittest.TestCase):
    def refused(self, kind, status, call, *words):
        with self.assertRaises(kind) as caught:
            call()
        self.assertEqual(caught.exception.status, status)
        for word in words:
            self.assertIn(word, caught.exception.message)
        self.assertEqual(str(caught.exception), caught.exception.message)

    def test_negative_load(self):
        self.refused(
            fuge.EquilibriumError, fuge.Status.ERR_NO_EQUILIBRIUM, lambda: fuge.solve(ALPHA, GAP, -2.0), "-2.0"
        )

    def test_unsymmetric(self):
        matrix = [[0.2, 0.1], [0.3, 0.2]]
        self.refused(
            fuge.MatrixError, fuge.Status.ERR_NOT_SYMMETRIC, lambda: fuge.solve(matrix, GAP, 2.0), "alpha[1, 0]"
        )

    def test_sparse_matrix(self):
        class Sparse:
            def toarray(self):
                raise AssertionError

        with self.assertRaisesRegex(TypeError, r"alpha is a sparse matrix, .*: pass alpha\.toarray\(\)"):
            fuge.solve(Sparse(), GAP, 2.0)

    def test_path_of_several_loads(self):
        self.refused(
            fuge.InputError,
            fuge.Status.ERR_SIZE,
            lambda: fuge.load_path(ALPHA, GAP, [1.0, 2.0]),
            "load has the shape (2,)",
            "Solver.follow_path",
        )

    def test_not_definite(self):
        matrix = [[-1.0, 0.0], [0.0, -1.0]]
        self.refused(fuge.MatrixError, fuge.Status.ERR_NOT_DEFINITE, lambda: fuge.solve(matrix, GAP, 2.0))

    def test_not_finite(self):
        self.refused(fuge.InputError, fuge.Status.ERR_NOT_FINITE, lambda: fuge.solve(ALPHA, [0, np.nan], 2.0), "gap[1]")

    def test_shapes(self):
        size = fuge.Status.ERR_SIZE
        self.refused(fuge.InputError, size, lambda: fuge.solve(ALPHA, [0, 1, 2], 2.0), "gap", "(3,)", "(2,)")
        self.refused(fuge.InputError, size, lambda: fuge.solve(ALPHA[:1], GAP, 2.0), "alpha", "square")
        self.refused(fuge.InputError, size, lambda: fuge.solve([1.0], GAP, 2.0), "alpha", "(1,)")
        self.refused(fuge.InputError, size, lambda: fuge.solve(ALPHA, GAP, 2.0, excluded=[True]), "excluded")
        self.refused(fuge.InputError, size, lambda: fuge.solve(np.empty((0, 0)), [], 2.0))
        self.refused(
            fuge.InputError, size, lambda: fuge.solve(ALPHA, GAP, modes=np.eye(2), resultant=[1.0]), "resultant"
        )

    def test_modes_without_resultants(self):
        modes = np.array([[1.0, 0.0], [1.0, 1.0]])
        option = fuge.Status.ERR_OPTION
        self.refused(fuge.InputError, option, lambda: fuge.solve(ALPHA, GAP, modes=modes), "resultant", "mode 0 has")
        self.refused(
            fuge.InputError, option, lambda: fuge.solve(ALPHA, GAP, modes=modes, motion={0: 1.0}), "mode 1 has neither"
        )
        contact = fuge.solve(ALPHA, GAP, modes=modes, motion={0: 2.0, 1: 0.0})
        np.testing.assert_array_equal(contact.motion, [2.0, 0.0])

    def test_types(self):
        for call, word in [
            (lambda: fuge.solve(ALPHA * 1j, GAP, 2.0), "alpha"),
            (lambda: fuge.solve(ALPHA, ["a", "b"], 2.0), "gap"),
            (lambda: fuge.solve(ALPHA, GAP, "2"), "load"),
            (lambda: fuge.solve(ALPHA, GAP, 2.0, excluded=[0.0, 1.0]), "excluded"),
            (lambda: fuge.solve(ALPHA, GAP, 2.0, max_iterations=1.5), "max_iterations"),
            (lambda: fuge.solve(ALPHA, GAP, 2.0, threads=None), "threads"),
            (lambda: fuge.solve(ALPHA, GAP, 2.0, progress=1), "progress"),
        ]:
            with self.assertRaisesRegex(TypeError, word):
                call()

    def test_negative_threads(self):
        for call in (lambda: fuge.solve(ALPHA, GAP, 2.0, threads=-1), lambda: fuge.Solver(ALPHA, threads=-1)):
            self.refused(
                fuge.InputError, fuge.Status.ERR_OPTION, call, "threads = -1 is negative: use 0 for all cores"
            )

    def test_words(self):
        self.refused(
            fuge.InputError, fuge.Status.ERR_OPTION, lambda: fuge.solve(ALPHA, GAP, 2.0, method="fast"), "'active_set'"
        )
        self.refused(
            fuge.InputError, fuge.Status.ERR_ELEMENT, lambda: fuge.halfplane_matrix([0.0], 1.0, 1.0, "middle"), "'hat'"
        )

    def test_kinds(self):
        # The exceptions are also of Python's own classes.
        self.assertTrue(issubclass(fuge.InputError, ValueError))
        self.assertTrue(issubclass(fuge.OutOfMemoryError, MemoryError))
        self.assertTrue(issubclass(fuge.FileError, OSError))
        for status in fuge.Status:
            self.assertTrue(status.text)

    def test_warning(self):
        # The tilt of a body without load is arbitrary.
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            contact = fuge.solve(ALPHA, GAP, modes=np.array([[1.0, 0.0], [1.0, 1.0]]), resultant=[0.0, 0.0])
        self.assertEqual(len(caught), 1)
        self.assertIs(caught[0].category, fuge.NotUniqueWarning)
        self.assertEqual(caught[0].message.status, fuge.Status.WARN_NOT_UNIQUE)
        self.assertEqual(caught[0].filename, __file__)
        self.assertEqual(contact.info.status, fuge.Status.WARN_NOT_UNIQUE)
        self.assertEqual(contact.message, caught[0].message.message)


class Solvers(unittest.TestCase):
    def setUp(self):
        x, width, self.gap, e_star = barrel()
        self.alpha = fuge.halfplane_matrix(x, width, e_star, "hat")
        self.solver = fuge.Solver(self.alpha)
        self.solver.set_gap(self.gap)

    def test_hertz(self):
        self.solver.set_load(400.0)
        contact = self.solver.solve()
        peak = np.sqrt(400.0 * 115384.61538461538 / (np.pi * 50.0))
        self.assertAlmostEqual(contact.force.max() / 0.02 / peak, 1.0, delta=2e-3)
        self.assertAlmostEqual(contact.force.sum(), 400.0, delta=1e-10)

    def test_warm_start(self):
        self.solver.set_load(400.0)
        cold = self.solver.solve()
        self.solver.set_load(401.0)
        warm = self.solver.solve()
        self.solver.reset()
        again = self.solver.solve()
        self.assertLess(warm.info.products, again.info.products)
        np.testing.assert_allclose(warm.force, again.force, rtol=0, atol=1e-10)
        # Later solves do not change the results of earlier ones.
        self.assertAlmostEqual(cold.force.sum(), 400.0, delta=1e-10)

    def test_engines_agree(self):
        self.solver.set_load(400.0)
        wanted = self.solver.solve()
        for method in ("tableau", "active_set", "iterative"):
            found = fuge.solve(self.alpha, self.gap, 400.0, method=method)
            np.testing.assert_allclose(found.force, wanted.force, rtol=0, atol=1e-7 * wanted.force.max())

    def test_call_order(self):
        self.assertRaises(fuge.CallOrderError, lambda: self.solver.info)
        self.assertRaises(fuge.CallOrderError, self.solver.solve)
        self.assertRaises(fuge.CallOrderError, self.solver.derivative)
        self.assertEqual(self.solver.info.status, fuge.Status.ERR_CALL_ORDER)

    def test_derivative(self):
        self.solver.set_load(400.0)
        before = self.solver.solve()
        change = self.solver.derivative(load_change=1.0)
        step = 1e-3
        self.solver.set_load(400.0 + step)
        after = self.solver.solve()
        self.assertEqual(before.info.contacts, after.info.contacts)
        np.testing.assert_allclose((after.force - before.force) / step, change.force, rtol=0, atol=1e-8)
        self.assertAlmostEqual((after.approach - before.approach) / step / change.motion[0], 1.0, delta=1e-6)
        self.assertAlmostEqual(change.force.sum(), 1.0, delta=1e-12)
        self.assertRaises(fuge.InputError, lambda: self.solver.derivative(load_change=[1.0, 2.0]))

    def test_derivative_by_a_gap(self):
        self.solver.set_load(400.0)
        self.solver.solve()
        unit = np.zeros(80)
        unit[40] = 1.0
        change = self.solver.derivative(gap_change=unit)
        self.assertLess(change.force[40], 0.0)
        self.assertAlmostEqual(change.force.sum() / abs(change.force[40]), 0.0, delta=1e-10)

    def test_history_of_the_paper(self):
        solver = fuge.Solver(ALPHA, keep_history=True)
        solver.set_gap(GAP)
        solver.set_load(2.0)
        solver.solve()
        history = solver.history()
        self.assertEqual(history.basis.shape[1], 3)
        self.assertEqual(history.z.shape, (history.basis.shape[0],))
        self.assertGreater(history.z[0], 0.0)
        self.assertAlmostEqual(history.z[-1], 0.0, delta=1e-14)
        np.testing.assert_array_equal(np.sort(history.basis[-1]), [1, 4, 5])

    def test_load_path(self):
        path = fuge.load_path(ALPHA, GAP, 20.0)
        np.testing.assert_allclose(path.parameter, [0, 0, 10], atol=1e-13)
        np.testing.assert_array_equal(path.point, [-1, 0, 1])
        self.assertEqual(path.state[2], fuge.PointState.AT_LOWER_STOP)
        np.testing.assert_allclose(path.rate[1:], [0.2, 0.15], rtol=1e-13)

    def test_path_with_more_events_than_expected(self):
        # One point goes from stop to stop; the arrays are enlarged where needed.
        calls = []

        def follow(capacity, *arrays):
            calls.append(capacity)
            arrays[-1][0] = 40
            arrays[0][:] = 7.0

        path = fuge.path.collect_path(4, 1, follow)
        self.assertEqual(calls, [24, 40])
        self.assertEqual(path.parameter.shape, (40,))

    def test_follow_path(self):
        solver = fuge.Solver(ALPHA)
        solver.set_gap(GAP)
        solver.set_load(0.0)
        path = solver.follow_path(20.0)
        self.assertEqual(path.motion.shape, (path.parameter.size, 1))
        np.testing.assert_allclose(path.parameter[-1], 0.5, rtol=1e-13)
        np.testing.assert_allclose(path.motion[-1], [2.0], rtol=1e-13)

    def test_progress(self):
        seen = []
        self.solver.set_load(400.0)
        self.solver.set_progress(lambda *report: seen.append(report))
        self.solver.solve()
        self.assertEqual([report[0] for report in seen], list(range(1, len(seen) + 1)))
        self.solver.set_progress(lambda *report: True)
        self.solver.reset()
        self.assertRaises(fuge.CancelledError, self.solver.solve)
        self.solver.set_progress(None)
        self.solver.solve()

    def test_exception_in_progress(self):
        def progress(*report):
            raise KeyError("mine")

        self.solver.set_load(400.0)
        self.solver.set_progress(progress)
        with self.assertRaisesRegex(KeyError, "mine"):
            self.solver.solve()
        # The exception is gone in the next call.
        self.solver.set_progress(None)
        self.assertEqual(self.solver.solve().info.status, fuge.Status.DONE)

    @unittest.skipUnless(hasattr(signal, "pthread_kill"), "no signals for threads")
    def test_interrupt(self):
        # Ctrl-C comes while the library works; the next iteration sees it. A job in the background ignores it at first.
        self.addCleanup(signal.signal, signal.SIGINT, signal.signal(signal.SIGINT, signal.default_int_handler))
        main = threading.get_ident()

        def product(f):
            if not sent:
                sent.append(threading.Thread(target=signal.pthread_kill, args=(main, signal.SIGINT)))
                sent[0].start()
                sent[0].join()
            return self.alpha @ f

        for progress in (None, lambda *report: None):
            sent = []
            solver = fuge.Solver(fuge.CallbackOperator(80, product), progress=progress)
            solver.set_gap(self.gap)
            solver.set_load(400.0)
            self.assertRaises(KeyboardInterrupt, solver.solve)
            self.assertIs(signal.getsignal(signal.SIGINT), signal.default_int_handler)
            self.assertAlmostEqual(solver.solve().load, 400.0, delta=1e-7)

    def test_calls_from_inside_are_refused(self):
        for call in (self.solver.reset, self.solver.close, lambda: self.solver.set_load(1.0)):
            self.solver.set_load(400.0)
            self.solver.reset()
            self.solver.set_progress(lambda *report: call())
            self.assertRaises(fuge.CallOrderError, self.solver.solve)
            self.solver.set_progress(None)

    def test_close(self):
        operator = fuge.DenseOperator(self.alpha)
        solver = fuge.Solver(operator)
        solver.set_gap(self.gap)
        solver.set_load(400.0)
        # The memory stays until the solver is closed, too.
        operator.close()
        self.assertAlmostEqual(solver.solve().load, 400.0, delta=1e-10)
        self.assertRaises(fuge.CallOrderError, fuge.Solver, operator)
        solver.close()
        solver.close()
        operator.close()
        self.assertRaises(fuge.CallOrderError, solver.solve)

    def test_context(self):
        with fuge.DenseOperator(ALPHA) as operator, fuge.Solver(operator) as solver:
            solver.set_gap(GAP)
            solver.set_load(2.0)
            solver.solve()
        self.assertRaises(fuge.CallOrderError, solver.solve)

    def test_cycles_are_collected(self):
        freed = []
        for _ in range(20):
            solver = fuge.Solver(ALPHA.copy())
            solver.set_progress(lambda *report, solver=solver: None)
            handles = solver._handle, solver.operator._handle
            freed.append([handle._pointer for handle in handles])
            del solver, handles
        gc.collect()
        self.assertFalse(any(pointer for pair in freed for pointer in pair))

    def test_the_matrix_is_kept(self):
        operator = fuge.DenseOperator(ALPHA.copy())
        gc.collect()
        contact = fuge.solve(operator, GAP, 2.0)
        np.testing.assert_allclose(contact.force, [2, 0], atol=TOLERANCE)

    def test_no_copy(self):
        for alpha in (ALPHA.copy(), np.asfortranarray(ALPHA)):
            operator = fuge.DenseOperator(alpha)
            self.assertTrue(np.shares_memory(operator._handle._kept[0], alpha))

    def test_threads(self):
        # Solvers side by side share the operator, and a solver that two threads have waits.
        operator = fuge.DenseOperator(self.alpha)
        wanted = fuge.solve(operator, self.gap, 400.0).force
        shared = fuge.Solver(operator)
        shared.set_gap(self.gap)
        shared.set_load(400.0)
        bad = []

        def work():
            for _ in range(10):
                for contact in (fuge.solve(operator, self.gap, 400.0), shared.solve()):
                    if not np.allclose(contact.force, wanted, rtol=0, atol=1e-9):
                        bad.append(contact)

        threads = [threading.Thread(target=work) for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(bad, [])


class Proofs(unittest.TestCase):
    """Bounds of the error, of what the solution is and of what cannot be proved."""

    def solved(self, alpha=ALPHA, gap=GAP, load=2.0):
        solver = fuge.Solver(np.array(alpha))
        solver.set_gap(gap)
        solver.set_load(load)
        return solver, solver.solve()

    def test_two_nodes(self):
        solver, contact = self.solved()
        proof = solver.prove()
        for bound, exact, found in [
            (proof.force_bound, [2.0, 0.0], contact.force),
            (proof.motion_bound, [0.4], contact.motion),
            (proof.gap_bound, [0.0, 0.8], contact.gap),
        ]:
            self.assertEqual(bound.shape, found.shape)
            self.assertTrue((bound >= 0.0).all() and (bound < 1e-15).all())
            # The exact numbers of the decimal data are rounded once more.
            self.assertTrue((np.abs(found - exact) <= bound + 1e-16).all())
        self.assertEqual(proof.proved.dtype, bool)
        self.assertTrue(proof.proved.all() and proof.bounded)
        self.assertEqual(proof.message, "")
        low, high = proof.largest_force
        self.assertTrue(2.0 - 1e-14 < low < 2.0 < high < 2.0 + 1e-14)
        self.assertRegex(repr(proof), "<Proof: forces within .*, 2 of 2 states, largest force 2 to 2>")

    def test_shapes_are_those_of_the_gaps(self):
        alpha = 0.1 * np.eye(6) + 0.1
        solver = fuge.Solver(alpha)
        solver.set_gap(np.linspace(0.0, 0.5, 6))
        solver.set_modes(np.column_stack([np.ones(6), np.arange(6.0)]), [3.0, 5.0])
        solver.solve()
        proof = solver.prove()
        shapes = [bound.shape for bound in (proof.force_bound, proof.gap_bound, proof.motion_bound, proof.proved)]
        self.assertEqual(shapes, [(6,), (6,), (2,), (6,)])

    def test_one_call(self):
        self.assertIsNone(fuge.solve(ALPHA, GAP, 2.0).proof)
        contact = fuge.solve(ALPHA, GAP, approach=0.4, prove=True)
        np.testing.assert_array_equal(contact.force, fuge.solve(ALPHA, GAP, approach=0.4).force)
        np.testing.assert_array_equal(contact.proof.motion_bound, [0.0])
        self.assertTrue(contact.proof.bounded)
        other = pickle.loads(pickle.dumps(contact))
        np.testing.assert_array_equal(other.proof.gap_bound, contact.proof.gap_bound)

    def test_proof_of_a_contact(self):
        solver, contact = self.solved()
        self.assertLess(contact.prove().force_bound.max(), 1e-15)
        done = fuge.solve(ALPHA, GAP, 2.0, prove=True)
        self.assertIs(done.prove(), done.proof)
        self.assertTrue(copy.deepcopy(done).prove().bounded)
        # Another solution, no solution, a copy, and no solver any more.
        solver.solve()
        self.assertRaisesRegex(fuge.CallOrderError, "solved another problem", contact.prove)
        contact = solver.solve()
        self.assertRaises(fuge.CallOrderError, pickle.loads(pickle.dumps(contact)).prove)
        solver.set_load(1.0)
        self.assertRaises(fuge.CallOrderError, contact.prove)
        self.assertRaisesRegex(fuge.CallOrderError, "prove=True", fuge.solve(ALPHA, GAP, 2.0).prove)

    def test_a_border(self):
        # The second point just touches.
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            proof = fuge.solve(ALPHA, [0.0, 0.2], 2.0, prove=True).proof
        np.testing.assert_array_equal(proof.proved, [True, False])
        self.assertTrue(proof.bounded)
        self.assertRegex(proof.message, "the first is point 1$")

    def test_points_in_one_place(self):
        with self.assertWarns(fuge.NotUniqueWarning):
            solver, contact = self.solved(np.ones((2, 2)), [0.0, 0.0])
        with self.assertWarnsRegex(fuge.NotProvedWarning, "positive definite") as caught:
            proof = solver.prove()
        self.assertEqual(caught.warning.status, fuge.Status.WARN_NOT_PROVED)
        self.assertEqual(caught.filename, __file__)
        self.assertEqual(proof.message, caught.warning.message)
        self.assertFalse(proof.bounded or proof.proved.any())
        self.assertTrue(np.isinf(proof.force_bound).all() and np.isinf(proof.motion_bound).all())
        self.assertEqual(proof.largest_force, (-np.inf, np.inf))
        # The solution is still there.
        np.testing.assert_allclose(solver.derivative(load_change=1.0).motion, [1.0])
        self.assertAlmostEqual(contact.approach, 2.0)

    def test_a_function_proves_nothing(self):
        operator = fuge.CallbackOperator(2, lambda force: ALPHA @ force)
        with self.assertWarns(fuge.NotProvedWarning):
            contact = fuge.solve(operator, GAP, 2.0, prove=True)
        self.assertFalse(contact.proof.bounded)
        np.testing.assert_allclose(contact.force, [2, 0], atol=1e-9)

    def test_call_order(self):
        solver, _ = self.solved()
        solver.prove()
        solver.set_load(1.0)
        self.assertRaisesRegex(fuge.CallOrderError, "call solve", solver.prove)
        solver.solve()
        self.assertTrue(solver.prove().bounded)
        solver.reset()
        self.assertRaises(fuge.CallOrderError, solver.prove)
        self.assertRaises(fuge.CallOrderError, fuge.Solver(ALPHA).prove)


class Copies(unittest.TestCase):
    """Objects in the memory of the library are neither copied nor pickled."""

    def test_copies_and_pickles_are_refused(self):
        solver = fuge.Solver(ALPHA.copy())
        punch = fuge.solve_round_punch(lambda r: (r**2, 2 * r), 1.0, 1.0, load=0.1)
        with mock.patch("sys.unraisablehook") as ignored:
            for owner in (solver, solver.operator, punch, [solver]):
                for make in (copy.copy, copy.deepcopy, pickle.dumps):
                    if make is copy.copy and owner == [solver]:
                        continue
                    with self.assertRaisesRegex(TypeError, "copy or pickle '.*make another one"):
                        make(owner)
            with self.assertRaisesRegex(TypeError, "copy or pickle the solver"):
                copy.deepcopy(solver._handle)
            gc.collect()
        ignored.assert_not_called()
        solver.set_gap(GAP)
        solver.set_load(2.0)
        # A solution has arrays of its own, and can be copied.
        contact = solver.solve()
        for other in (copy.deepcopy(contact), pickle.loads(pickle.dumps(contact))):
            np.testing.assert_array_equal(other.force, contact.force)


class MaskedArrays(unittest.TestCase):
    """Masked elements have no value; numpy.asarray would take the one behind the mask."""

    def test_masked_elements_are_refused(self):
        x, width, gap, e_star = barrel(n=8)
        solver = fuge.Solver(fuge.halfplane_matrix(x, width, e_star, "mean"))
        masked = np.ma.masked_greater(gap, gap[5])
        calls = (
            lambda: solver.set_gap(masked),
            lambda: solver.set_gap(gap, masked),
            lambda: solver.set_gap(list(masked)),
            lambda: solver.set_load(np.ma.masked),
            lambda: solver.set_load(np.ma.array(1.0, mask=True)),
            lambda: solver.set_modes([[value] for value in masked], [1.0]),
            lambda: solver.set_modes(masked.reshape(8, 1), [1.0]),
            lambda: solver.set_excluded(np.ma.array(gap > 0.0, mask=x > 0.0)),
            lambda: fuge.DenseOperator(np.ma.array(np.eye(2), mask=[[True, False], [False, False]])),
            lambda: fuge.DenseOperator([masked[:2], masked[6:]]),
            lambda: fuge.CallbackOperator(8, lambda f: f, diagonal=masked),
            lambda: fuge.solve(fuge.CallbackOperator(8, lambda f: np.ma.array(f, mask=x > 0.0)), gap, 1.0),
            lambda: fuge.Body(np.eye(8)).fix(np.ma.array([1, 2], mask=[False, True])),
            lambda: fuge.solve_round_punch(lambda r: (np.ma.masked_less(r**2, 2.0), 2 * r), 1.0, 1.0, load=0.1),
        )
        for k, call in enumerate(calls):
            with self.subTest(k), self.assertRaisesRegex(fuge.InputError, "masked elements"):
                call()

    def test_no_element_is_masked(self):
        contact = fuge.solve(np.ma.array(ALPHA), np.ma.masked_less(GAP, -1.0), 2.0)
        np.testing.assert_allclose(contact.force, [2, 0], atol=TOLERANCE)


if __name__ == "__main__":
    unittest.main()
