"""Messages have Python's indices and words."""

import re
import tempfile
import unittest
from pathlib import Path

import numpy as np

import fuge
from fuge._messages import in_python


class Words(unittest.TestCase):
    def test_indices(self):
        shapes = {"gap": (3, 5), "point": (3, 5), "height": (3, 5)}
        for message, wanted in [
            ("gap(13) = NaN", "gap[2, 3] = NaN"),
            ("x(13) = NaN", "x[13] = NaN"),
            ("height(3, 2) = NaN", "height[2, 3] = NaN"),
            ("alpha(1,0) and alpha(0,1) differ", "alpha[1, 0] and alpha[0, 1] differ"),
            ("f(4) = Inf", "force[4] = Inf"),
            ("the largest at point 13, cannot", "the largest at point [2, 3], cannot"),
            ("mode 1 at point (13) = NaN", "modes[2, 3, 1] = NaN"),
            ("at 2 point(s), the first is 13: if", "at 2 point(s), the first is [2, 3]: if"),
            ('result "p(1)": value(1) = NaN', 'result "p(1)": value[1] = NaN'),
            ("2 x 3 (rows)", "2 x 3 (rows)"),
        ]:
            self.assertEqual(in_python(message, shapes), wanted)
        self.assertEqual(in_python("at point 13, mode 0 at point (13)", {}), "at point 13, modes[13, 0]")
        # An index that is not one of the array is left alone.
        self.assertEqual(in_python("gap(15)", shapes), "gap[15]")

    def test_names(self):
        for message, wanted in [
            ("use FUGE_CENTRE or FUGE_MEAN", "use 'centre' or 'mean'"),
            ("use FUGE_PLANE_STRAIN", "use 'strain'"),
            ("use FUGE_PERIODIC_Y", "use 'periodic_y'"),
            ("(FUGE_WITH_FFTW=OFF)", "(FUGE_WITH_FFTW=OFF)"),
            ("call fuge_set_gap before fuge_solve", "call set_gap before solve"),
            ("call fuge_bodies_join first", "call join first"),
            ("call fuge_operator_set_grid before", "call set_grid before"),
            ("operators of fuge_operator_halfplane", "operators of HalfplaneOperator"),
            ("or call fuge_load_path", "or call fuge.load_path"),
            ("no body has been condensed: call fuge_condense first", "no body has been condensed: call condense first"),
        ]:
            self.assertEqual(in_python(message, {}), wanted)


class Places(unittest.TestCase):
    """An element at [2, 3] of an array of the shape (4, 5) has these indices in the message."""

    def setUp(self):
        self.bad = np.zeros((4, 5))
        self.bad[2, 3] = np.nan
        self.operator = fuge.HalfspaceOperator(5, 4, 1.0, 1.0, 1.0)

    def says(self, array, call, place="[2, 3]"):
        with self.assertRaises(fuge.InputError) as caught:
            call()
        self.assertRegex(caught.exception.message, re.escape(array + place) + " (=|is) NaN")

    def test_surfaces(self):
        self.says("height", lambda: fuge.level_surface(self.bad, "mean"))
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "surface.txt"
            self.says("height", lambda: fuge.write_surface(path, self.bad))
            self.says("value", lambda: fuge.write_results(path, (1.0, 1.0), {"p": self.bad}))
            deep = {"p": np.stack([np.zeros((4, 5)), self.bad])}
            self.says("value", lambda: fuge.write_volume(path, (1.0, 1.0), [0.0, 1.0], deep), "[1, 2, 3]")

    def test_problems(self):
        self.says("gap", lambda: fuge.solve(self.operator, self.bad, 1.0))
        self.says("gap_upper", lambda: fuge.solve(self.operator, 0.0, 1.0, gap_upper=self.bad))
        modes = np.dstack([np.ones((4, 5)), self.bad])
        self.says("modes", lambda: fuge.solve(self.operator, 0.0, modes=modes, resultant=[1.0, 0.0]), "[2, 3, 1]")
        # Indices are those of the shape that the caller's array has.
        self.says("gap", lambda: fuge.solve(self.operator, self.bad.ravel(), 1.0), "[13]")
        self.says("force", lambda: self.operator @ self.bad)

    def test_matrices_in_either_order(self):
        matrix = np.eye(5)
        matrix[2, 3] = np.nan
        self.says("alpha", lambda: fuge.DenseOperator(matrix))
        self.says("alpha", lambda: fuge.DenseOperator(np.asfortranarray(matrix)))

    def test_stresses(self):
        self.says("force", lambda: fuge.Field.halfspace_grid(1.0, 1.0, self.bad, poisson=0.3))
        deep = np.ones((2, 4, 3))
        deep[1, 2, 2] = np.nan
        self.says("points", lambda: fuge.Field.halfplane([0.0], 1.0, [1.0], poisson=0.3).stress(deep), "[1, 2, 2]")
        self.says("position", lambda: fuge.rigid_modes([[0.0, 0.0], [np.nan, 1.0], [2.0, 2.0]]), "[1, 0]")

    def test_shapes(self):
        with self.assertRaisesRegex(fuge.InputError, r"shape \(5, 4\), but must have \(ny, nx\) = \(4, 5\) or \(20,\)"):
            fuge.solve(self.operator, self.bad.T, 1.0)
        with self.assertRaisesRegex(fuge.InputError, r"height has the shape \(20,\), but must have \(ny, nx\)"):
            fuge.level_surface(self.bad.ravel(), "mean")
        with self.assertRaisesRegex(fuge.InputError, r"but must have \(4, 5, m\) or \(20, m\)"):
            fuge.solve(self.operator, 0.0, modes=np.ones((4, 5)), resultant=[1.0])

    def test_call_order(self):
        with self.assertRaisesRegex(fuge.CallOrderError, "call set_gap before solve"):
            fuge.Solver(np.eye(2)).solve()


if __name__ == "__main__":
    unittest.main()
