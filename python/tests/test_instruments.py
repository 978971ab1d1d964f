"""Files of instruments, read by a stub in place of SurfaceTopography."""

import os
import sys
import tempfile
import types
import unittest
from unittest import mock

import numpy as np

import fuge

X3P = b"PK\x03\x04main.xml"


class StubTopography:
    """What SurfaceTopography returns: the first index counts along x, and a mask where nothing was measured."""

    dim = 2
    is_uniform = True

    def __init__(self, heights, unit="um", pixel_size=(2.0, 3.0)):
        self._heights = heights
        self.unit = unit
        self.pixel_size = pixel_size

    def heights(self):
        return self._heights


def stub(result):
    """A module SurfaceTopography whose files hold `result`, or cannot be read because of that exception."""

    def read_topography(path):
        if isinstance(result, Exception):
            raise result
        return result

    module = types.ModuleType("SurfaceTopography")
    module.read_topography = read_topography
    return mock.patch.dict(sys.modules, {"SurfaceTopography": module})


class InstrumentTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = os.path.join(folder.name, "t.x3p")
        with open(self.path, "wb") as file:
            file.write(X3P)

    def refuses(self, part, **options):
        with self.assertRaises(fuge.FileError) as caught:
            fuge.read_surface(self.path, **options)
        self.assertIn(part, caught.exception.message)
        self.assertIn("t.x3p", caught.exception.message)
        self.assertEqual(caught.exception.status, fuge.Status.ERR_FILE)

    def test_heights_are_transposed_and_in_metres(self):
        with stub(StubTopography(np.array([[1.0, 2.0], [3.0, 4.0], [5.0, 6.0]]))):
            surface = fuge.read_surface(self.path)
        np.testing.assert_allclose(surface.height, [[1e-6, 3e-6, 5e-6], [2e-6, 4e-6, 6e-6]], rtol=1e-15)
        np.testing.assert_allclose(surface.spacing, (2e-6, 3e-6), rtol=1e-15)
        self.assertTrue(surface.height.flags.c_contiguous)
        self.assertEqual((surface.unit, surface.filled, surface.origin), ("m", 0, (0.0, 0.0)))

    def test_units(self):
        for unit, scale in [("m", 1.0), ("mm", 1e-3), ("\N{MICRO SIGN}m", 1e-6), ("\u00c2\u00b5m", 1e-6), ("nm", 1e-9)]:
            with stub(StubTopography(np.ones((2, 2)), unit)):
                np.testing.assert_allclose(fuge.read_surface(self.path).height, scale, rtol=1e-15)
        with stub(StubTopography(np.ones((2, 2)), None)):
            surface = fuge.read_surface(self.path)
        self.assertEqual((surface.height[0, 0], surface.spacing, surface.unit), (1.0, (2.0, 3.0), None))
        with stub(StubTopography(np.ones((2, 2)), "V")):
            self.refuses("its unit is 'V', no length")

    def test_points_that_were_not_measured(self):
        heights = np.ma.masked_invalid(np.array([[1.0, 1.0], [1.0, 1.0], [1.0, np.nan]]))
        with stub(StubTopography(heights, "m")):
            self.refuses("1 points were not measured, the first one is height[1, 2]: let them be filled by fill=True")
            surface = fuge.read_surface(self.path, fill=True)
        np.testing.assert_array_equal(surface.height, np.ones((2, 3)))
        self.assertEqual(surface.filled, 1)
        with stub(StubTopography(np.ma.masked_all((2, 2)))):
            self.refuses("has no point that was measured", fill=True)

    def test_what_cannot_be_read(self):
        with stub(ValueError("it is cut off")):
            self.refuses("is an x3p file (ISO 25178-72), but SurfaceTopography does not read it: it is cut off")
        # What dozens of readers say of a file that none of them takes.
        complaints = type("CannotDetectFileFormat", (Exception,), {})("no reader\nx3p: bad\nsur: bad\n")
        with stub(complaints):
            self.refuses("but SurfaceTopography does not read it: is it broken or cut off?")
        line = StubTopography(np.ones(4))
        line.dim = 1
        with stub(line):
            self.refuses("no heights on a grid")
        with mock.patch.dict(sys.modules, {"SurfaceTopography": None}):
            self.refuses("is an x3p file (ISO 25178-72): fuge reads it where SurfaceTopography is installed (pip")

    def test_other_files_are_those_of_the_library(self):
        with stub(StubTopography(np.ones((2, 2)))):
            self.refuses("which fuge does not read", format="grid")
            with open(self.path, "w", encoding="ascii") as file:
                file.write("1 2\n3\n")
            self.refuses("line 2: 1 value(s)")
            with open(self.path, "w", encoding="ascii") as file:
                file.write("1 2\n3 4\n")
            surface = fuge.read_surface(self.path)
        np.testing.assert_array_equal(surface.height, [[1.0, 2.0], [3.0, 4.0]])
        self.assertIsNone(surface.unit)


if __name__ == "__main__":
    unittest.main()
