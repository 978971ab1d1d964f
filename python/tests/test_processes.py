"""Processes that are forked after solves in several threads."""

import multiprocessing
import unittest
import warnings

import numpy as np

import fuge


class Forks(unittest.TestCase):
    @unittest.skipUnless("fork" in multiprocessing.get_all_start_methods(), "no fork")
    def test_fork_after_solves_in_two_threads(self):
        n = 16384
        gap = np.linspace(-1.0, 1.0, n) ** 2
        operator = fuge.HalfplaneOperator(n, 1.0, 1.0, "mean")
        wanted = fuge.solve(operator, gap, 1e-2, threads=2).force

        def work(results):
            own = fuge.HalfplaneOperator(n, 1.0, 1.0, "mean")
            forces = [fuge.solve(op, gap, 1e-2, threads=2).force for op in (operator, own)]
            results.put([np.array_equal(force, wanted) for force in forces])

        with warnings.catch_warnings():
            # Python 3.12 warns of threads beside a fork.
            warnings.simplefilter("ignore", DeprecationWarning)
            context = multiprocessing.get_context("fork")
            results = context.SimpleQueue()
            child = context.Process(target=work, args=(results,))
            child.start()
        child.join(30)
        hangs = child.is_alive()
        if hangs:
            child.kill()
            child.join()
        self.assertFalse(hangs)
        self.assertEqual(child.exitcode, 0)
        self.assertEqual(results.get(), [True, True])


if __name__ == "__main__":
    unittest.main()
