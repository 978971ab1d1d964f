"""The command with measured surfaces: surfaces with known answers, in several files, and what is refused."""

import re
import unittest
from pathlib import Path

import numpy as np

import fuge
from test_command import DATA, CommandCase, cells, words

# A ball, by Hertz; N and mm.
CELLS, RADIUS, E_STAR, LOAD, STEP = 121, 10.0, 115385.0, 100.0, 0.0035
# A wave of length 1 on a periodic surface, by H. M. Westergaard (K. L. Johnson, Contact Mechanics, 1985, 13.2).
WAVE_CELLS, WAVE_ROWS, AMPLITUDE = 128, 4, 0.01

PLACE = STEP * (np.arange(1, CELLS + 1) - 0.5 * (CELLS + 1))
BALL = -(PLACE**2 + PLACE[:, None] ** 2) / (2.0 * RADIUS)
COLUMNS = "pressure,load,cells,area,fraction,approach,mean_gap,contact_pressure,largest_pressure,residual,status"

FREE = "--boundary free --load 100 --modulus 115385"

TILTED = "--surface tilted.txt --boundary free"

# The same ball in many ways: arguments, and a file of fields.
BALLS = (
    (f"--surface ball.txt {FREE} --level none", "map.csv"),
    (f"--surface ball.txt {FREE} --level mean --element centre", "centre.vti"),
    (f"--surface ball.sdf {FREE} --scale 1e3 --level mean", "map.csv"),
    (f"--surface columns.txt {FREE} --height-scale 1e-3 --level mean", ""),
    (f"--surface plain.txt {FREE} --spacing 0.0035 --level mean", ""),
    (f"--surface holes.txt {FREE} --fill --level none", ""),
    ("job.txt", ""),
    (f"{TILTED} --pressure 557.5620043796496 --young 210000.7,210000.7 --poisson 0.3,0.3", ""),
)
WAVE = f"--surface wave.txt --level none --modulus {E_STAR} --pressure 906.23167083614,1812.4633416722,5437.3900250168"

BALL_1 = "--surface ball.txt --load 1"
REFUSED = (
    (f"--surface cut.txt --spacing 1 {FREE}", r'"cut.txt", line 2: 3 value\(s\), but the first row has 4', 3),
    (f"--surface holes.txt {FREE}", '"holes.txt", line 3: column 1 has no height.* be filled by --fill', 3),
    (f"--surface plain.txt {FREE}", '"plain.txt" does not say how far apart its points are: give --spacing', 2),
    (f"--surface ball.txt --spacing 1 {FREE}", '--spacing: "ball.txt" has spacings of its own, 3.50000E-003 and', 2),
    (f"--surface plain.txt --spacing 1,2,3 {FREE}", "--spacing 1,2,3: one or two lengths", 2),
    (f"--surface ball.txt --scale 0 {FREE}", "--scale 0: it has to be > 0", 2),
    (f"--surface ball.txt --scale 1,2 {FREE}", "--scale 1,2: one number is needed", 2),
    (f"--surface ball.txt --height-scale 1e300 {FREE}", "heights or spacings are out of range after --height-scale", 3),
    ("--surface ball.txt --modulus 1", "with --surface one of --pressure and --load is needed", 2),
    (f"--surface ball.txt {FREE} --pressure 1", "with --surface one of --pressure and --load is needed", 2),
    ("--surface ball.txt --modulus 1 --load 100,", '--load 100,: numbers with commas .* are needed, not "100,"', 2),
    (BALL_1, "with --surface either --modulus, or --young and --poisson", 2),
    (f"{BALL_1} --young 1,2 --poisson 0.3", "--young and --poisson need one number each, or two each", 2),
    (f"{BALL_1} --modulus 1 --boundary open", "open: one of periodic, free, periodic-x, periodic-y is needed", 2),
    (f"--surface ball.txt {FREE} --field a.vtu", r"--field a.vtu: a surface is a grid, for ParaView a file \*.vti", 2),
    (f"--surface ball.txt {FREE} --gap gap.mtx", "--gap needs matrices or meshes", 2),
)


def write_files():
    """The ball with spacings in the file, none, holes, tilted, in columns in um, as SDF in metres; the wave."""
    spacing = f"# spacing_x = {STEP}\n# spacing_y = {STEP}\n"
    holes = np.full(BALL.shape, np.nan)
    holes[1:, 1:] = BALL[1:, 1:]
    x, y = np.meshgrid(PLACE, PLACE)
    sdf = (
        f"aISO-1.0\nManufacID = fuge\nCreateDate = 010120260000\nModDate = 010120260000\nNumPoints = {CELLS}\n"
        f"NumProfiles = {CELLS}\nXscale = {1e-3 * STEP}\nYscale = {1e-3 * STEP}\nZscale = 1\nZresolution = -1\n"
        "Compression = 0\nDataType = 7\nCheckType = 0\n*\n"
    )
    wave = AMPLITUDE * np.cos(2.0 * np.pi * np.arange(1, WAVE_CELLS + 1) / WAVE_CELLS)
    for name, head, heights, end in (
        ("ball.txt", spacing, BALL, ""),
        ("plain.txt", "", BALL, ""),
        ("holes.txt", spacing, holes, ""),
        ("tilted.txt", spacing, BALL + 0.01 * x - 0.02 * y, ""),
        ("columns.txt", "", np.column_stack([x.ravel(), y.ravel(), 1e3 * BALL.ravel()]), ""),
        ("ball.sdf", sdf, 1e-3 * BALL, "*\n"),
        ("wave.txt", spacing.replace(str(STEP), str(1 / WAVE_CELLS)), np.tile(wave, (WAVE_ROWS, 1)), ""),
        ("cut.txt", "1 2 3 4\n1 2 3\n", np.empty((0, 0)), ""),
    ):
        lines = "".join(" ".join(f"{value:.16e}" for value in row) + "\n" for row in heights)
        Path(name).write_text(head + lines.replace("nan", "NaN") + end)
    Path("job.txt").write_text("surface ball.txt\nboundary free\nlevel none\nload 100   # N\nmodulus 115385\n")


class Surfaces(CommandCase):
    def setUp(self):
        super().setUp()
        write_files()

    def rows(self, text, heading):
        names, *rows = cells(text)
        self.assertEqual(names, heading.split(","))
        return np.array(rows, dtype=float)

    def test_ball(self):
        hertz = fuge.hertz_ellipse(RADIUS, RADIUS, E_STAR, LOAD)
        surface = (CELLS * STEP) ** 2
        for arguments, field in BALLS:
            with self.subTest(arguments):
                found = self.table(*words(arguments), *(["--field", field] if field else []))
                (row,) = self.rows(found, COLUMNS)
                pressure, load, cells, area, fraction, approach, _, mean, largest, residual, status = row
                exact = [LOAD / surface, LOAD, cells * STEP**2, area / surface, LOAD / area]
                np.testing.assert_allclose([pressure, load, area, fraction, mean], exact, 1e-12)
                self.assertAlmostEqual(area / (np.pi * hertz.semi_axis_x ** 2), 1.0, delta=0.02)
                self.assertAlmostEqual(approach / hertz.approach, 1.0, delta=3e-4)
                self.assertAlmostEqual(largest / hertz.peak_pressure, 1.0, delta=1e-3)
                self.assertLessEqual(residual, 1e-10)
                self.assertEqual(status, 0)
                if field.endswith("csv"):
                    self.check_map(Path(field).read_text())
        head = Path("centre.vti").read_bytes()[:1000]
        for name in (b"height", b"pressure", b"gap"):
            self.assertIn(b'Name="' + name + b'"', head)

    def check_map(self, text):
        """Its pressures carry the load, and no cell has both a pressure and a gap."""
        x, y, _, pressure, gap = self.rows(text, "x,y,height,pressure,gap").T
        self.assertEqual(x.size, CELLS**2)
        self.assertEqual(text.count("\n\n"), CELLS - 1)
        self.assertAlmostEqual(pressure.sum() * STEP**2, LOAD, delta=1e-5)
        np.testing.assert_allclose([np.ptp(x), np.ptp(y), np.ptp(x[:CELLS])], STEP * (CELLS - 1), 1e-7)
        self.assertTrue(np.all((pressure >= 0.0) & (gap >= 0.0) & (pressure * gap == 0.0)))
        self.assertLessEqual(abs(x[pressure.argmax()] - 0.5 * (x[0] + x[-1])), 0.5 * STEP)

    def test_wave(self):
        """A quarter and a half of complete contact, and one and a half of it, which is told."""
        code, found, errors = self.run_command(*words(WAVE))
        self.assertEqual(code, 0)
        self.assertRegex(errors, "^fuge: note: the whole surface touches under load 3[^\n]*\n$")
        complete = np.pi * E_STAR * AMPLITUDE
        rows = self.rows(found, COLUMNS)
        self.assertEqual(len(rows), 3)
        for row in rows:
            share = row[0] / complete
            self.assertAlmostEqual((row[5] + row[6]) / AMPLITUDE, 1.0, delta=1e-9)
            fraction = 2.0 / np.pi * np.arcsin(np.sqrt(share)) if share < 1.0 else 1.0
            largest = 2.0 * complete * np.sqrt(share) if share < 1.0 else complete * (share + 1.0)
            self.assertAlmostEqual(row[4] / fraction, 1.0, delta=0.02)
            self.assertAlmostEqual(row[8] / largest, 1.0, delta=2e-3)

    def test_refusals(self):
        self.assert_refusals(REFUSED)

    def test_notes_and_bounds(self):
        """A rim, heights in wrong units, a load that rounds to zero; bounds, and all states proved."""
        steep = f"--surface columns.txt {FREE} --height-scale"
        for arguments, pattern in (
            ("--surface ball.txt --boundary free --load 1e4 --modulus 115385", r"# note: [^\n]*rim"),
            (f"{steep} 1", r"# note: the mean slope [^\n]*, too steep[^\n]*--height-scale"),
            (f"{steep} 1e-6", r"# note: the mean slope [^\n]*, flatter[^\n]*--height-scale"),
            ("--surface plain.txt --boundary free --modulus 1 --spacing 1e-10 --pressure 1e-310",
             r", 0\.0000[0-9E+]*, [^,]*,[^,]*,0"),
            (f"--surface ball.txt {FREE} --level none --prove", "residual,status,approach_bound,pressure_bound,"
             r"gap_bound,proved\n.*,0, [0-9.]+E-01[0-9], [0-9.]+E-00[0-9], [0-9.]+E-01[0-9],14641\n"),
        ):
            with self.subTest(arguments):
                code, output, _ = self.run_command(*words(arguments))
                self.assertEqual(code, 0)
                self.assertRegex(output, pattern)

    def test_manual(self):
        surface = f"--surface {DATA}/ground.sdf --scale 1e3 --fill --young 210000 --poisson 0.3"
        output = self.table(*words(f"{surface} --pressure 50,100,200 --field ground.vti --plot ground.png"))
        self.assertRegex(
            output, r"40 x 30 heights, 9 of them filled.*\n(.*\n)*.*,16, 8\.0000.*, 1\.33333.*\n.*,24, .*\n.*,37, "
        )
        self.assertTrue(Path("ground.png").exists())
        self.assertTrue(re.search(rb"VTKFile", Path("ground.vti").read_bytes()))


if __name__ == "__main__":
    unittest.main()
