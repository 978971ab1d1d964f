"""Surfaces and profiles: files of every format, holes, levelling, sampling, and what is refused."""

import struct
import sys
import types
import unittest
from dataclasses import replace
from pathlib import Path
from unittest import mock

import numpy as np
from numpy.testing import assert_allclose, assert_array_equal

import fuge
from files import InFolder
from fuge.heights import rms_slope

GROUND = Path(__file__).parents[2] / "examples" / "data"
NAN = np.nan
POINTS = ["1.0 5 1", "1.5 5 2", "2.0 5 3", "1.0 9 4", "1.5 9 5", "2.0 9 6"]
HEADER = (
    "aISO-1.0\nManufacID = a = b\nwords\nnumpoints=3\nNUMPROFILES  =  2 \nXscale = 1d-6\nYscale = 2E-6\nZscale = 0.5\n"
    "Compression = 0\nDataType = 5\nCheckType = 0\n*\n"
)
GWYDDION = "# Channel: Z\n# Width: 6.0 um\n# Height: 8.0 \N{MICRO SIGN}m\n# Value units: nm\n"


def binary(kind, form, heights, version=b"bISO-1.0", counts="HH"):
    """Binary SDF of 3 x 2 points, spacings 1 and 2, heights in halves."""
    header = struct.pack(f"<8s34s{counts}4d3B", version, b"formula", 3, 2, 1.0, 2.0, 0.5, 0.0, 0, kind, 0)
    return header + struct.pack(f"<6{form}", *heights)


class Files(InFolder):
    def setUp(self):
        super().setUp()
        self.path = self.folder / "t.dat"

    def read(self, content, *arguments, reader=fuge.read_surface, **options):
        return reader(self.file("t.dat", content), *arguments, **options)

    def refuses(self, content, part, *arguments, **options):
        with self.subTest(content):
            self.assertIn("t.dat", self.refused(part, self.read, content, *arguments, **options))


class Grids(Files):
    def test_what_is_read(self):
        for content, height in [
            ("1 2 3\n4 5 6\n", [[1, 2, 3], [4, 5, 6]]),
            ("1,2\r\n\r\n3, 4\r\n5e0,6", [[1, 2], [3, 4], [5, 6]]),
            ("\ufeff# a\n\t1;2;\n# b\n3;4;  # c\n", [[1, 2], [3, 4]]),
            ("7\n8\n\n", [[7], [8]]),
            ("x y\nx y\n7 -.8d1 ! c", [[7, -8]]),
            ('"Date","1"\n"Unit",\n\n"Height"\n1,2\n3,4', [[1, 2], [3, 4]]),
            ("Date;1;;\n1;2;3;4;5", [[1, 2, 3, 4, 5]]),
            ("0.1 1e-400 123456789012345678", [[0.1, 0, 123456789012345678]]),
        ]:
            surface = self.read(content, "grid")
            assert_array_equal(surface.height, height, err_msg=content)
            self.assertEqual((surface.spacing, surface.origin, surface.filled), (None, (0.0, 0.0), 0))

    def test_spacings(self):
        for content, spacing in [
            ("# spacing_x = 0.5\r\n# spacing_y =2\r\n1 2", (0.5, 2.0)),
            ("# words\n# spacing_y = 2\n1 2\n# spacing_x = 3", None),
            ("# spacing_x = 1 um\n# spacing_y = wide\n1 2", None),
        ]:
            self.assertEqual(self.read(content).spacing, spacing, content)
        (told,) = self.read("# spacing_x = 1\n# spacing_y = -1\nSize in mm\n1 2").notes
        self.assertEqual(told, 'what its header says about lengths is not used: "# spacing_y = -1", "Size in mm"')

    def test_header_of_gwyddion(self):
        surface = self.read(GWYDDION + "1 2 3\n4 5 6\n", "grid")
        assert_allclose(surface.height, 1e-9 * np.arange(1.0, 7).reshape(2, 3), rtol=1e-15)
        assert_allclose(surface.spacing, (2e-6, 4e-6), rtol=1e-15)
        self.assertEqual(surface.unit, "m")
        self.assertIn('all is brought to metres: "# Width: 6.0 um"', surface.notes[0])
        surface = self.read(GWYDDION.replace("nm", "V") + "1 2\n", "grid")
        self.assertEqual((surface.height[0, 0], surface.spacing, surface.unit), (1.0, None, None))
        self.assertIn("is not used", surface.notes[0])

    def test_what_is_refused(self):
        for content, part in [
            ("x y\n# 1", "line 2: the file has no row of numbers"),
            ("1 2\n\n3 4 5", "line 3: 3 value(s), but the first row has 2"),
            ("1 2\r\n3 x\r\n", 'line 2: "x" is not a number'),
            ("x y\nx 3\n1 2", 'line 2: "x" is not a number'),
            ("1 2\n3 1_0", '"1_0" is not a number'),
            ("1 2\n3 4-5", '"4-5" is not a number'),
            ("1 2\n3 1e305", "line 2: 1e+305 is out of range"),
            ("1 2\n3 1e400", "line 2: inf is out of range"),
            ("1 2\ninf 4", 'line 2: "inf" is not a finite number'),
            ("1 2\n3 nan", "line 2: column 2 has no height, the point was not measured: let such points be filled"),
            ("1,2\n,4", "line 2: column 1 has no height"),
            ("1,5 2,5\n3,5 4,5", "by commas and by blanks: numbers need a decimal point, not a comma"),
            ("1;2,5", "by semicolons and by commas"),
        ]:
            self.refuses(content, part, "grid")
        self.refuses("nan nan", "no point that was measured", fill=True)
        self.assertRaisesRegex(fuge.InputError, "format is 'xyz'", fuge.read_surface, "none", "xyz")
        self.assertRaisesRegex(fuge.FileError, '"none/a.txt" cannot be opened', fuge.read_surface, "none/a.txt")

    def test_few_columns_are_no_grid(self):
        rows = "".join(f"{k % 4} {k // 4} 0.5 1\n" for k in range(12))
        self.refuses(rows, "line 1: 12 rows of 4 columns may be points or profiles")
        self.assertEqual(self.read(rows, "grid").height.shape, (12, 4))
        self.assertEqual(self.read("# spacing_x = 1\n# spacing_y = 1\n" + rows).height.shape, (12, 4))
        self.assertEqual(self.read("1 2 3 4").height.shape, (1, 4))
        self.refuses("# spacing_x = 1\n1 2 3", "line 2: three columns may be points, but comments give spacings")

    def test_writing(self):
        height = np.sin(np.arange(10500.0)).reshape(7, 1500) * 10.0 ** (np.arange(1500) % 60 - 30)
        fuge.write_surface(self.path, height, (1e-6 / 3, 2e-6 / 7))
        surface = fuge.read_surface(self.path)
        assert_array_equal(surface.height, height)
        self.assertEqual(surface.spacing, (1e-6 / 3, 2e-6 / 7))
        fuge.write_surface(self.path, height[:, :1])
        written = self.path.read_bytes()
        self.assertTrue(written.startswith(b"0.0000000000000000e+00\n"))
        for heights, spacing, part in [
            (np.empty((0, 2)), None, "no heights"),
            ([[1.0, NAN]], None, r"height\[0, 1\] = NaN is not a finite number: .* fill_surface"),
            ([[-1e308]], None, r"height\[0, 0\] = -1e\+308 is out of range"),
            ([[1.0]], (1.0, -1.0), r"spacing\[1\] = -1 is negative"),
            ([[1.0]], (NAN, 1.0), r"spacing\[0\] = NaN"),
        ]:
            self.assertRaisesRegex(fuge.Error, part, fuge.write_surface, self.path, heights, spacing)
        self.assertEqual(self.path.read_bytes(), written)
        self.assertRaisesRegex(fuge.FileError, "cannot be opened", fuge.write_surface, self.path / "a", height)


class Points(Files):
    def test_any_order(self):
        for order in ([0, 1, 2, 3, 4, 5], [5, 4, 3, 2, 1, 0], [4, 0, 5, 2, 3, 1]):
            surface = self.read("x y z\n" + "\n".join(POINTS[k] for k in order))
            assert_array_equal(surface.height, [[1, 2, 3], [4, 5, 6]])
            self.assertEqual((surface.spacing, surface.origin), ((0.5, 4.0), (1.0, 5.0)))
        surface = self.read("3;1;8\n1;1;7\n")
        self.assertEqual((surface.height.tolist(), surface.spacing), ([[7.0, 8.0]], None))

    def test_jitter(self):
        rng = np.random.default_rng(3)
        i, j = np.meshgrid(np.arange(60), np.arange(50))
        for unit in (1e-250, 1.0, 1e250):
            for off, accepted in ((0.01, True), (0.045, True), (0.055, False)):
                places = [unit * (k + rng.uniform(-off, off, k.shape) + 7) for k in (i, 2 * j)]
                lines = np.char.mod("%.9e", np.transpose([*places, i + 100.0 * j]).reshape(-1, 3))
                content = "\n".join(map(" ".join, lines))
                if not accepted:
                    self.refuses(content, "is no multiple of the step")
                    continue
                surface = self.read(content)
                assert_array_equal(surface.height, i + 100.0 * j)
                # By least squares the error is that of a mean over all points.
                assert_allclose(np.divide(surface.spacing, unit), (1, 2), rtol=off / 200)
                assert_allclose(np.divide(surface.origin, unit), (7, 7), atol=off / 10)

    def test_what_is_refused(self):
        for content, part in [
            ("\n".join(POINTS[:4] + POINTS[5:]), "no point at x = 1.5, y = 9 of a regular grid of 3 x 2: add it"),
            ("\n".join([*POINTS, POINTS[1]]), "line 7: a second point at x = 1.5, y = 5"),
            ("\n".join([*POINTS, "9.0 5 1"]), "is no multiple of the step"),
            ("\n".join(f"{k} {k} 1" for k in range(5)), ": 5 points are no full grid of 5 positions x and 5"),
            ("1 2", "line 1: 2 column(s): x, y and the height are needed"),
            ("1 2 3\nnan 2 3", "line 2: a position is missing"),
            ("1 2 3\n1 3 nan", "line 2: column 3 has no height"),
        ]:
            self.refuses(content, part, "points")
        surface = self.read("\n".join([*POINTS[:1], *POINTS[2:5], "2.0 9 BAD"]), fill=True)
        assert_array_equal(surface.height, [[1, 3, 3], [4, 5, 4]])
        self.assertEqual(surface.notes[0], "2 of 6 points (33.3 %) were not measured and are filled")


class Instruments(Files):
    def test_sdf(self):
        text = [HEADER + "1 2 3\n-4 5 6\n*\n*", HEADER + "1 2\n\n3\r\n-4 5d0 6 *\n by hand\n*"]
        text += [text[0].replace("1.0", "2.0", 1), "\ufeff" + text[0]]
        numbers = [1, 2, 3, -4, 5, 6]
        files = [binary(kind, form, numbers) for kind, form in ((5, "h"), (6, "i"), (7, "d"))]
        files += [binary(kind, form, numbers, b"bISO-2.0", "II") for kind, form in ((3, "f"), (4, "b"), (5, "h"))]
        files += [files[0][:81] + struct.pack("<II", 5, 1) + files[0][81:], files[1] + b"a trailer"]
        for content in text + files:
            surface = self.read(content)
            assert_array_equal(surface.height, [[0.5, 1.0, 1.5], [-2.0, 2.5, 3.0]])
            self.assertEqual(surface.spacing, (1.0, 2.0) if content in files else (1e-6, 2e-6))
            self.assertEqual((surface.unit, surface.filled), ("m", 0))
        least = [(5, "h", -(2**15)), (6, "i", -(2**31)), (7, "d", NAN), (7, "d", -sys.float_info.max)]
        files = [binary(kind, form, [1, 2, 3, 1, hole, 3]) for kind, form, hole in least]
        files += [binary(4, "b", [1, 2, 3, 1, -128, 3], b"bISO-2.0", "II"), HEADER + "1 2 3 1 BAD 3 *"]
        for content in files:
            self.refuses(content, "1 points were not measured, the first one is height[1, 1]: let such points be fill")
            assert_array_equal(self.read(content, fill=True).height[1], [0.5, (0.5 + 1.5 + 1.0) / 3, 1.5])
        sdf, grid = (fuge.read_surface(GROUND / name, fill=True) for name in ("ground.sdf", "ground.txt"))
        assert_allclose(sdf.height, grid.height, atol=1e-20)
        self.assertEqual((sdf.spacing, sdf.filled, grid.spacing), ((2e-6, 2.5e-6), 9, (2e-6, 2.5e-6)))
        profile = self.read(HEADER.replace("=  2", "= 1").replace("2E-6", "0") + "1 2 3 *")
        self.assertEqual((profile.height.shape, profile.spacing), ((1, 3), None))

    def test_wrong_sdf(self):
        good = HEADER + "9e5 2 3\n4 5 6\n*"
        for old, new, part in [
            ("= 0\n*", "= 0\n", "line 15: the file ends after 0 of 6 heights, without the * that ends them"),
            ("*\n9e5 2 3\n4 5 6\n*", "", "line 11: the header must end with a line with *"),
            ("=3", "=0", "line 12: NumPoints and NumProfiles must be from 1"),
            ("numpoints", "points", "NumPoints and NumProfiles"),
            ("=3", "=3.5", 'line 4: "3.5" is not a whole number'),
            ("=3", "=99999999999", "NumPoints and NumProfiles"),
            ("=3", "=1000000", "1000000 x 2 heights are more than the file has"),
            ("1d-6", "0", "Xscale = 0 must be a length > 0"),
            ("2E-6", "-1", "Yscale = -1 must"),
            ("0.5", "inf", 'line 8: "inf" is not a finite number'),
            ("0.5", "1e298", "height[0, 0] is out of range"),
            ("Compression = 0", "Compression = 1", "compressed heights and check sums are not read"),
            ("CheckType = 0", "CheckType = ", 'line 11: "" is not a whole number'),
            ("ISO", "BCR", 'the version "aBCR-1.0" is not read'),
            ("5 6\n*", "5\n*", "line 15: the heights end after 5 of 6"),
            ("6\n*", "6 7", "line 14: more than 6 heights"),
            ("2 3\n", "2 3,5\n", 'line 13: "3,5" is not a number'),
        ]:
            self.refuses(good.replace(old, new, 1), part)
        good = binary(5, "h", range(6))
        for content, part in [
            (good[:80], "ends within its header"),
            (good[:-1], "ends before the last of 6 heights"),
            (binary(3, "f", range(6)), "DataType = 3 is unknown: 5, 6, 7 are read"),
            (binary(7, "d", [np.inf] * 6), "height[0, 0] is out of range"),
        ]:
            self.refuses(content, part)
        self.refuses("1 2", "an SDF file begins with its version", "sdf")

    def topography(self, heights, unit="um", dim=2, channels=("Z",), kind="x3p", pixel_size=(2.0, 3.0)):
        """The module SurfaceTopography, whose files hold these heights; its first index counts along x."""
        found = mock.MagicMock(dim=dim, is_uniform=True, unit=unit, pixel_size=pixel_size, heights=lambda: heights)
        named = [types.SimpleNamespace(name=name) for name in channels]
        reader = mock.MagicMock(channels=named, default_channel=named[0])
        reader.format.return_value = kind
        reader.topography.side_effect = [heights if isinstance(heights, Exception) else found]
        reader.__enter__.return_value, reader.__exit__.return_value = reader, False
        module = types.ModuleType("SurfaceTopography")
        module.open_topography = lambda path: reader
        return mock.patch.dict(sys.modules, {"SurfaceTopography": module})

    def test_instruments(self):
        content, heights = b"VK4_\0", np.array([[1.0, 2.0], [3.0, 4.0], [5.0, 6.0]])
        for unit, scale in [("m", 1.0), ("mm", 1e-3), ("\N{MICRO SIGN}m", 1e-6), ("\u00c2\u00b5m", 1e-6), (None, 1.0)]:
            with self.topography(heights, unit, channels=("Z", "Phase")):
                surface = self.read(content)
            assert_allclose(surface.height, scale * heights.T, rtol=1e-15)
            assert_allclose(surface.spacing, (2 * scale, 3 * scale), rtol=1e-15)
            self.assertEqual(surface.unit, unit and "m")
            self.assertEqual(surface.notes[0], "of its channels Z, Phase Z is read")
        masked = np.ma.masked_equal(heights, 6.0)
        for result, options, part in [
            (masked, {}, "1 points were not measured, the first one is height[1, 2]"),
            (heights, {"unit": "V"}, "its unit is 'V', no length"),
            (heights, {"dim": 1}, "no heights on a grid"),
            (heights, {"kind": "hgt"}, "of an unknown format"),
            (heights, {"pixel_size": (0.0, 1.0)}, "its spacings, 0 and 1e-06, are no lengths"),
            (ValueError("cut off"), {}, "(vk3, vk4, vk6, vk7), but SurfaceTopography does not read it: cut"),
        ]:
            with self.topography(result, **options):
                self.refuses(content, part)
        with self.topography(masked):
            self.assertEqual(self.read(content, fill=True).filled, 1)

    def test_formats_are_named(self):
        with mock.patch.dict(sys.modules, {"SurfaceTopography": None}):
            for content, part in [
                (b"DIGITAL SURF\0", "a Digital Surf file (sur): fuge reads it where SurfaceTopography is installed"),
                (b"\x88\x1b\x03o", "a Zygo file (dat)"),
                (b"\x89HDF\r\n\x1a\n\0", "an HDF5 file"),
                (b"fileformat = bcrf\n", "pip install 'fuge[surfaces]'"),
                ("\ufefffileformat = bcrstm_unicode\n".encode("utf-16-le"), "a BCR file"),
                (b"1 2\n" * 1000 + b"\1", "a binary file"),
                (b"PK\3\4", "is a ZIP archive: unpack it"),
                (b"\xff\xfe1\0", "is text in UTF-16: save it"),
            ]:
                self.refuses(content, part)
            self.refuses(b"GWYP\0", "which fuge does not read as 'grid'", "grid")
            x3p = self.path.with_suffix(".X3P")
            x3p.write_bytes(b"PK\3\4")
            self.assertRaisesRegex(fuge.FileError, "an x3p file", fuge.read_surface, x3p)
        for text in ("VK4 sample\n1 2", "1\t2\r\n", "# \N{MICRO SIGN}\n1 2", "1 2" + " " * 5000 + "# \0"):
            assert_array_equal(self.read(text).height, [[1, 2]])


class Tools(unittest.TestCase):
    def test_filling(self):
        for height, filled in [
            ([[1, NAN, 5]], [[1, 3, 5]]),
            ([[NAN], [NAN], [5]], [[5], [5], [5]]),
            ([[0, NAN, NAN, NAN, 2]], [[0, 0, 1, 2, 2]]),
            ([[9, 1, 9], [2, NAN, 3], [9, 6, 9]], [[9, 1, 9], [2, 3, 3], [9, 6, 9]]),
            ([[1, 2, 3], [NAN, NAN, 8]], [[1, 2, 3], [1, 5, 8]]),
        ]:
            assert_array_equal(fuge.fill_surface(height), filled)
        i, j = np.meshgrid(np.arange(60), np.arange(50))
        height = np.where((i - 20) ** 2 + (j - 20) ** 2 < 250, NAN, np.sin(0.3 * i) * np.cos(0.2 * j))
        self.assertLessEqual(np.abs(fuge.fill_surface(height)).max(), 1.0)
        self.assertTrue(np.isnan(height[20, 20]))
        self.assertRaisesRegex(fuge.InputError, "all heights are NaN", fuge.fill_surface, [[NAN]])
        self.assertRaisesRegex(fuge.InputError, r"height\[0, 1\] = Inf", fuge.fill_surface, [[NAN, np.inf]])
        self.assertRaises(fuge.InputError, fuge.fill_surface, height[0])

    def test_levelling(self):
        for ny, nx, *plane in [(1, 1, 3, 0, 0), (1, 2, 3, 0.1, 0), (300, 1, 3, 0, 0.1), (63, 100, 1e-6, 0.7, -0.3)] + [
            (50, 40, scale, 1e-2 * scale, -1e-3 * scale) for scale in (1e-290, 1e290)
        ]:
            i, j = np.meshgrid(np.arange(nx), np.arange(ny))
            height = plane[0] + plane[1] * i + plane[2] * j
            largest = np.abs(height).max()
            assert_allclose(fuge.level_surface(height, "plane") / largest, 0.0, atol=2 * np.finfo(float).eps)
        # A part that is orthogonal to all planes stays.
        wave = (i % 2 * 2 - 1) * (i // 2 % 2 * 2 - 1) * (j % 2 * 2 - 1)
        assert_allclose(fuge.level_surface(wave + 100 + 0.5 * i - 0.25 * j, "plane"), wave, atol=1e-13)
        assert_array_equal(fuge.level_surface([[1, 2], [3, 6]], "mean"), [[-2, -1], [0, 3]])
        for height, form in [([[1.0]], "line"), ([[NAN]], "mean"), ([[-1e308]], "mean"), ([[]], "mean")]:
            self.assertRaises(fuge.Error, fuge.level_surface, height, form)

    def test_slopes_are_told(self):
        height = np.outer([1.0, 1.0], [0.0, 3.0, 0.0, 3.0]) + [[0.0], [8.0]]
        self.assertAlmostEqual(rms_slope(height, (1.0, 2.0)), 5.0, delta=1e-14)
        surface = fuge.SurfaceHeights(height, (1.0, 2.0), (0.0, 0.0), 0)
        self.assertRegex(surface.notes[0], "slope of the surface is 5, too steep")
        self.assertRegex(replace(surface, height=1e-5 * height).notes[0], "slope .* is 5e-05, less than")
        self.assertEqual(replace(surface, height=1e-2 * height).notes, ())
        self.assertEqual(replace(surface, spacing=None).notes, ())

    def test_sampling(self):
        x, z = [0.0, 1.0, 3.0, 4.0], [2.0, 0.0, 4.0, 4.5]
        assert_array_equal(fuge.sample_profile(x, z, [[4, 0, 0.5], [1.5, 3, 3.5]]), [[4.5, 2, 1], [1, 4, 4.25]])
        assert_array_equal(fuge.sample_profile(x, z, [4 + 3e-12, -3e-12]), [4.5, 2])
        for *arguments, part in [
            (x, z, [1.0, 4.001], r"centre\[1\] = 4.001 is outside the profile, 0 .. 4"),
            (x, z, NAN, r"centre\[0\] = NaN"),
            (x, z[:3], 1.0, "z has the shape"),
            ([1.0], [1.0], 1.0, "1 value"),
            (x, [0, 1, NAN, 1], 1.0, r"z\[2\] = NaN"),
            ([0, 2, 2, 3], z, 1.0, r"x\[2\] = 2 does not exceed"),
            ([0, 1, 2, 1e305], z, 1.0, r"x\[3\] = 1e\+305 is out of range"),
        ]:
            self.assertRaisesRegex(fuge.Error, part, fuge.sample_profile, *arguments)

    def test_levelling_of_profiles(self):
        x, weight = np.array([-1.0, 0.0, 0.5, 3.0, 4.0]), np.array([0.5, 0.75, 1.5, 1.75, 0.5])
        assert_allclose(fuge.level_profile(x, 7 - 2 * x, "line"), 0.0, atol=1e-14)
        assert_allclose(fuge.level_profile(x, 7 - 2 * x, "mean"), -2 * (x - 1.5), atol=1e-14)
        z = fuge.level_profile(x, [3, 1, 4, 1, 5], "line")
        assert_allclose([weight @ z, weight @ (x * z)], 0.0, atol=1e-14)
        self.assertGreater(z.max(), 1.0)
        self.assertRaises(fuge.InputError, fuge.level_profile, x, x, "plane")


class Profiles(Files):
    def test_profiles(self):
        for content in ("x;z\r\n0;1\r\n1.5;-2;\r\n", "# a\n\nx, z\n! b\n0,1d0\n\t1.5 , -2 # c\n", "\ufeff0 1\n1.5 -2"):
            x, z = self.read(content, reader=fuge.read_profile)
            self.assertEqual((x.tolist(), z.tolist()), ([0.0, 1.5], [1.0, -2.0]))
        for content, part in [
            ("", '": the file ends after 0 point(s)'),
            ("x z\n1 2\n", "line 2: the file ends after 1 point(s): a profile needs 2"),
            ("1 2\n# c\n2;\n", "line 3: only one column"),
            ("1 2\n2 NaN\n", 'line 2: "NaN" is not a finite number'),
            ("1 2\nx z\n", 'line 2: "x" is not a number'),
            ("words\nx z\n1 2", 'line 2: "x" is not a number'),
            ("1 2\n2 3\n2 4\n", "line 3: x = 2 does not exceed x = 2 of the point before"),
            ("1 2\n3,5;2,5\n", "line 2: more than two columns: x and z are needed, with a decimal point"),
            ("1 2\n1,,2\n", "an empty column"),
        ]:
            self.refuses(content, part, reader=fuge.read_profile)


if __name__ == "__main__":
    unittest.main()
