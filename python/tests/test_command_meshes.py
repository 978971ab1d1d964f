"""The command with bodies that have meshes: tables beside what the library finds, fields and refusals."""

import csv
import itertools
import re
import shutil
import unittest
from pathlib import Path

import numpy as np

import fuge
from fuge.command.errors import INPUT, UNSOLVED, USAGE
from fuge.command.face_forces import pressure_forces
from test_command import DATA, CommandCase

TWO = "--mesh lower.inp --stiffness lower.sti --mesh upper.inp --stiffness upper.sti"
PAIR = " --pair upper.FACE:lower.FACE"
HELD = " --support lower.BOTTOM:y --support lower.LEFT:x --support upper.LEFT:x"
UPPER = "--mesh upper.inp --stiffness upper.sti --support upper.LEFT:x"
PARTS = TWO.replace("upper.sti", "parts.sti")
CORNER = f"{TWO}{HELD} --support upper.LEFT:y --load upper.60:y=-3"
SPACE = f"{TWO}{PAIR} --support lower.BOTTOM:z"

# Options of a pair, what they are in Python, and by how much the upper block is lifted there for a clearance.
PAIRS = [
    ("--clearance 0.25", {}, 0.25),
    ("--clearance 0.25 --node-to-face", {"method": "node_to_face"}, 0.25),
    ("--clearance 0.25 --normals opposite", {"normals": "opposite"}, 0.25),
    ("--normals 0.25,-1", {"normals": "given", "normal": np.tile([0.25, -1.0], (15, 1))}, 0.0),
    ("--clearance 0.25 --play 0.2", {"play": 0.2}, 0.25),
    ("--clearance 0.25 --tied", {"tied": True}, 0.0),
    ("--clearance 0.25 --faceted --reach 100 --crease 20", {"smooth": False, "reach": 100.0}, 0.25),
]

MESHES = {
    "ridge.inp": "*NODE\n1,0,0\n2,3,0\n3,6,0\n4,6,1.75\n5,3,2\n6,0,1.75\n*ELEMENT,TYPE=CPE4\n1,1,2,5,6\n2,2,3,4,5\n"
    "*SURFACE,NAME=RIDGE\n1,S3\n2,S3\n",
    "plate.inp": "*NODE\n1,-1,5\n2,7,5\n3,7,6\n4,-1,6\n*ELEMENT,TYPE=CPS4\n1,1,2,3,4\n*SURFACE,NAME=FACE\n1,S1\n",
    "base.inp": "*NODE\n1,-1,-1,2\n2,7,-1,2\n3,7,7,2\n4,-1,7,2\n*ELEMENT,TYPE=R3D4\n1,1,2,3,4\n*SURFACE,NAME=FACE\n"
    "1,SPOS\n",
    "back.inp": "*NODE\n1,-1,1\n2,7,1\n3,7,2\n4,-1,2\n*ELEMENT,TYPE=CPS4\n1,4,3,2,1\n*SURFACE,NAME=PLATE\n1,S3\n",
    # A quadratic ring with a node on the axis.
    "washer.inp": "*NODE\n1,0,2\n2,6,2\n3,6,3\n4,0,3\n5,3,2\n6,6,2.5\n7,3,3\n8,0,2.5\n*ELEMENT,TYPE=CAX8\n"
    "1,1,2,3,4,5,6,7,8\n*SURFACE,NAME=END\n1,S1\n",
    "odd.inp": "*NODE\n1,0,0\n2,1,0\n*USER ELEMENT,NODES=2,TYPE=U1\n*ELEMENT,TYPE=U1\n1,1,2\n",
    "deck.inp": "** Of the patch test\n*BOUNDARY, OP=NEW\nlower.BOTTOM, 2, 2\nlower.LEFT, 1\nupper.LEFT, 1, 1, 0.\n"
    "*STEP\n*STATIC\n*CLOAD\nupper.50, 2, -3.\nupper.87, 2, -3.\nupper.23, 2, -3.\nupper.60, 2, -1.5\n*END STEP\n",
    "held.csv": "\ufeffNODES;AXES\nBOTTOM;y\nLEFT;x\n",
    "pushed.csv": "TOP y -1.5   # all\n50 y -1.5\n\n87 y -1.5\n23 2 -1.5\n",
    "swapped.csv": "value\tnode\tdirection\n-1.5\tTOP\ty\n-1.5\t50\ty\n-1.5\t87\ty\n-1.5\t23\ty\n",
}


def write_block(name, n, low, modulus):
    """Files of a block, 6 by 6 wide and 2 high, with its sides and surfaces of solids and shells: n by n columns that
    give way along z only, and springs that keep top and bottom plane."""
    number = {place[::-1]: 3 * k + 1 for k, place in enumerate(itertools.product((0, 1), range(n + 1), range(n + 1)))}
    share = np.where(np.isin(np.arange(n + 1), (0, n)), 3.0, 6.0) / n
    columns, plane = np.diag(0.5 * modulus * np.outer(share, share).ravel()), np.eye((n + 1) ** 2) - (n + 1.0) ** -2
    stiffness = np.kron([[1, -1], [-1, 1]], columns) + np.kron(np.eye(2), plane)
    lines = ["*NODE"] + [f"{m},{6 * i / n},{6 * j / n},{low + 2 * k}" for (i, j, k), m in number.items()]
    for kind, first, layers in (("C3D8", 1, (0, 1)), ("S4R", 101, (0,))):
        lines += [f"*ELEMENT, TYPE={kind}, ELSET={kind}"]
        for element, (i, j) in enumerate(itertools.product(range(n), range(n)), first):
            around = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
            lines += [",".join(map(str, [element, *(number[(*place, k)] for k in layers for place in around)]))]
    lines += ["*NSET, NSET=BOTTOM", *(str(m) for place, m in number.items() if place[2] == 0)]
    for surface, faces in (("FACE", "C3D8, S1" if low else "C3D8, S2"), ("ABOVE", "C3D8, S2"), ("SKIN", "S4R, SNEG")):
        lines += [f"*SURFACE, NAME={surface}", faces]
    Path(f"{name}.inp").write_text("\n".join(lines) + "\n")
    upper = zip(*np.nonzero(np.triu(stiffness)))
    Path(f"{name}.sti").write_text("".join(f"{i + 1} {j + 1} {float(stiffness[i, j])!r}\n" for i, j in upper))
    Path(f"{name}.dof").write_text("".join(f"{m}.3\n" for m in number.values()))


class MeshesCase(CommandCase):
    def setUp(self):
        super().setUp()
        for path in (DATA / "blocks").iterdir():
            shutil.copy(path, self.folder)
        for name, text in MESHES.items():
            Path(name).write_text(text, encoding="utf-8")

    def solve(self, line, says=""):
        """Columns and comments of a table."""
        code, output, errors = self.run_command(*line.split())
        self.assertEqual(code, 0, errors)
        self.assertRegex(errors, f"^{says}$")
        rows = list(csv.reader(text for text in output.splitlines() if text[0] != "#"))
        table = {}
        for name, *column in zip(*rows):
            table[name] = np.array(column, dtype=str if name in ("body", "state") else float)
        return table, [text for text in output.splitlines() if text[0] == "#"]

    def expect_pressure(self, line, points, pressure=2.0, **more):
        table, comments = self.solve(line, **more)
        self.assertEqual(table["pressure"].size, points)
        np.testing.assert_allclose(table["pressure"], pressure, rtol=1e-12)
        np.testing.assert_allclose(table["gap"], 0.0, atol=1e-13)
        return table, comments


class Solutions(MeshesCase):
    def test_uniform_pressure_is_handed_on(self):
        names = "--body a --mesh lower.inp --stiffness lower.sti --body upper"
        for line in (
            "job.txt",
            f"{TWO}{PAIR}{HELD} --pressure ABOVE=2",
            f"{TWO}{PAIR} --supports deck.inp --loads deck.inp --load upper.13:y=-1 --load upper.13:2=-5d-1",
            f"{names} {UPPER} --pair upper.FACE:a.face --supports a=held.csv --loads upper=pushed.csv",
            f"--mesh lower.inp {UPPER}{PAIR} --loads loads.csv",
            f"--mesh lower.inp {UPPER}{PAIR} --loads upper=swapped.csv",
        ):
            with self.subTest(line=line):
                table, comments = self.expect_pressure(line, 5)
                self.assertEqual(table["node"].tolist(), [20, 47, 57, 84, 94])
                self.assertEqual(set(table["body"]) | set(table["state"]), {"upper", "contact"})
                np.testing.assert_allclose(table["area"].sum(), 6.0)
                self.assertRegex(comments[-1], r"^# pair 1: upper.FACE:\w+.\w+, force on upper: +0.0+E.000, 1\.[12]")

    def test_two_pairs(self):
        line = f"{TWO} --mesh plate.inp{PAIR} --pair upper.ABOVE:plate.FACE --clearance -0.5{HELD}"
        table, comments = self.expect_pressure(line, 10, 2.4)
        self.assertEqual(table["pair"].tolist(), [1] * 5 + [2] * 5)
        self.assertRegex(comments[-1], r"# pair 2: upper.ABOVE:plate.FACE, force on upper: .*-1\.4[34]\d+E\+001,")

    def test_space_shells_and_rigid_faces(self):
        write_block("lower", 2, 0.0, 20.0)
        write_block("upper", 3, 2.0, 50.0)
        note = "fuge: note: --pair .* touch where their nodes are.*\n"
        for line, says in (
            (SPACE, ""),
            (SPACE.replace("upper.FACE", "upper.SKIN"), note),
            ("--body lower --mesh base.inp --mesh upper.inp --stiffness upper.sti" + PAIR, ""),
        ):
            with self.subTest(line=line):
                _, comments = self.expect_pressure(f"{line} --pressure upper.ABOVE=2", 16, says=says)
                self.assertRegex(comments[-1], r" 7\.(20000000000|1999999999)\d+E\+001$")

    def test_options_of_pairs(self):
        lower, upper = (fuge.read_mesh(f"{name}.inp") for name in ("lower", "upper"))
        matrices = [fuge.read_stiffness(f"{name}.sti") for name in ("lower", "upper")]
        for options, words, lift in PAIRS:
            with self.subTest(options=options), fuge.ElasticBodies() as bodies:
                below, above = (bodies.add(matrix) for matrix in matrices)
                for body, mesh, matrix, sets in zip((below, above), (lower, upper), matrices, ("BOTTOM", "LEFT")):
                    held = [mesh.set_dof("LEFT", 1, matrix), mesh.set_dof(sets, 2, matrix)]
                    body.fix(np.concatenate(held))
                load = np.zeros(matrices[1].shape[0])
                load[np.flatnonzero((matrices[1].node == 60) & (matrices[1].direction == 2))] = -3.0
                above.set_load(load)
                own = upper.surface("FACE", matrices[1], 2)
                lifted = fuge.Surface(own.node + [0.0, lift], own.face, own.dof)
                bodies.add_pair(above, lifted, below, lower.surface("FACE", matrices[0], 2), **words)
                expected = bodies.solve()
                table, _ = self.solve(f"{CORNER}{PAIR} {options}")
                before, _ = self.solve(f"{options} {CORNER}{PAIR}")
                order = np.argsort(upper.node[expected.node], kind="stable")
                for name in ("force", "gap", "area", "pressure"):
                    np.testing.assert_allclose(table[name], getattr(expected, name)[order], rtol=1e-12, atol=1e-12)
                    np.testing.assert_array_equal(before[name], table[name])
                np.testing.assert_array_equal(table["ny"], expected.direction[order, 1])
                self.assertEqual(set(table["state"]) == {"held"}, "--tied" in options)

    def test_rings(self):
        Path("ring.inp").write_text(Path("upper.inp").read_text().replace("CPS4", "CAX4"))
        command = "--mesh lower.inp --stiffness lower.sti --body upper --mesh ring.inp --stiffness upper.sti"
        note = "fuge: note: .upper.sti. is multiplied by 180: .*\n"
        table, comments = self.solve(CORNER.replace(TWO, command) + PAIR + " --clearance 0.25", note)
        np.testing.assert_allclose(table["area"].sum(), np.pi * 36.0)
        inside = (table["x"] > 0.0) & (table["x"] < 6.0)
        np.testing.assert_allclose(table["area"][inside], 2.0 * np.pi * table["x"][inside] * 1.5)
        self.assertRegex(comments[-2], f"force on upper: +0.0+E.000, +{table['force'].sum():.10f}")
        self.assertIn("sum of the radial forces", comments[-1])
        end = "--mesh washer.inp --mesh lower.inp --stiffness lower.sti --pair END:FACE --clearance -0.1"
        table, _ = self.solve(f"{end} --support lower.BOTTOM:y --support lower.LEFT:x")
        np.testing.assert_allclose(table["area"], np.pi * 36.0 * np.array([1, 3, 2]) / 6.0)
        self.assertGreater(table["force"].min(), 0.0)

    def test_ring_of_calculix_is_whole(self):
        Path("ring.inp").write_text(Path("lower.inp").read_text().replace("CPS4", "CAX4"))
        shutil.copy("lower.sti", "whole.txt")
        pressed = "--mesh washer.inp --pair END:FACE --clearance -0.1 --support BOTTOM:y --support LEFT:x"
        forces = [
            self.solve(f"--mesh ring.inp --stiffness {path} {pressed}", says)[0]["force"]
            for path, says in (("lower.sti", "fuge: note: .*\n"), ("whole.txt --rows lower.dof", ""))
        ]
        np.testing.assert_allclose(forces[0], 180.0 * forces[1])
        self.assertGreater(forces[1].min(), 0.0)

    def test_options_on_a_ridge(self):
        line = f"--mesh ridge.inp {UPPER} --loads loads.csv --pair "
        for text in (
            "FACE:RIDGE --normals opposite",
            "RIDGE:FACE --faceted",
            "RIDGE:FACE --crease 5",
            "FACE:RIDGE --reach 0.1",
            "FACE:RIDGE --exclude 20",
        ):
            pair, option = text.split(maxsplit=1)
            with self.subTest(option=option):
                plain, comments = self.solve(line + pair)
                # The load of 12 goes through the contact, whichever surface has the points.
                self.assertRegex(comments[3], r"force on \w+: *[^,]+, *-?1\.(20000000000|19999999999)\d+E\+001,")
                table, comments = self.solve(f"{line}{pair} {option}")
                same = len(table["node"]) == len(plain["node"]) and np.allclose(table["force"], plain["force"], 1e-6)
                self.assertFalse(same)
                self.assertEqual("excluded" in table["state"], "exclude" in option)
                self.assertEqual(any("without an opposite: " in text for text in comments), "reach" in option)

    def test_fields(self):
        _, field = self.solve(f"{TWO}{PAIR}{HELD} --pressure ABOVE=2 --field u.csv"), Path("u.csv").read_text()
        self.assertTrue(field.startswith("body,node,direction,displacement\nlower,997,1,"))
        rows = {(body, int(node), int(axis)): float(u) for body, node, axis, u in csv.reader(field.splitlines()[1:])}
        # E = 24 on both, without lateral strain: 2/24 of 2 and of 5.
        np.testing.assert_allclose([rows["lower", 985, 2], rows["upper", 60, 2]], [-2.0 / 12.0, -5.0 / 12.0])
        self.solve(f"{TWO}{PAIR}{HELD} --pressure ABOVE=2 --field u.vtu")
        names = re.findall(rb'Name="([a-z_]+)"', Path("u.vtu").read_bytes()[:3000])
        self.assertLessEqual({b"displacement", b"pressure", b"contact_force", b"body"}, set(names))

    def test_what_opens_is_told(self):
        says = "fuge: warning: no point touches, and loads and supports open every gap.*\n"
        _, comments = self.solve(f"{TWO}{PAIR}{HELD} --support upper.TOP:y=0.5", says)
        self.assertRegex(comments[0], "# status: 5,")


# Options behind both blocks, the message, and the exit code.
WRONG = [
    ("--pair upper.FACES:lower.FACE", 'body upper has no surface "FACES"; there are upper.FACE', USAGE),
    ("--pair FACE:lower.FACE", 'bodies lower and upper both have "FACE": write upper.FACE or lower.FACE', USAGE),
    ("--pair uper.FACE:lower.FACE", 'there is no surface "uper.FACE"; there are lower.FACE, upper.FACE', USAGE),
    ("--pair upper.FACE", "--pair upper.FACE: two surfaces are needed", USAGE),
    ("--pair upper.FACE:upper.FACE", "--pair upper.FACE:upper.FACE: face 1 .*reverse the order", INPUT),
    ("--mesh back.inp --pair upper.FACE:PLATE", "face S3 of element 1 looks into the element", INPUT),
    (f"{PAIR} --support lower.BOTOM:y", 'no set of nodes "BOTOM"; there are lower.ALL, lower.BOTTOM', USAGE),
    (f"{PAIR} --load upper.5:y=1", "--load upper.5:y=1: body upper has no node 5", USAGE),
    (f"{PAIR} --support lower.BOTTOM:z", "no node there has a row along z", USAGE),
    (f"{PAIR} --support lower.BOTTOM:q", '"q" is no axis', USAGE),
    (f"{PAIR} --support lower.BOTTOM", "nodes and an axis are needed", USAGE),
    (f"{PAIR} --support lower.BOTTOM:y=1,5", 'a number is needed, not "1,5"', USAGE),
    (f"{PAIR}{HELD} --support lower.LEFT:y=1", "node lower.997 along y is displaced by another value already", USAGE),
    (f"{PAIR} --load upper.TOP:z=3", "node upper.13 along z has no row in the stiffness", USAGE),
    (f"{PAIR} --load upper.TOP:y", "a force is needed", USAGE),
    (f"{PAIR} --pressure upper.ABOVE", "a surface and a pressure are needed", USAGE),
    (f"{PAIR} --loads lower.inp", 'lower.inp" has no line like 17,z,-100', INPUT),
    (f"{PAIR}{HELD} --loads loads.csv --exclude lower.FACE", "no node there is a contact point", USAGE),
    (f"{PAIR}{HELD} --loads loads.csv --exclude upper.FACE", "--exclude leaves no contact point", USAGE),
    (f"{PAIR} --loads loads.csv", r"node upper.\d+ along y most: no contact force can resist it", UNSOLVED),
    (f"{PAIR}{HELD} --load upper.TOP:y=100", "body upper, displacement along y: its loads move it that way", UNSOLVED),
    (f"{PAIR} --support lower.BOTTOM:xy --support upper.47:xy --load upper.60:y=9", "body upper, a rotation", UNSOLVED),
    (f"{PAIR}{HELD} --support upper.BOTTOM:xy --support lower.TOP:xy", "hold both surfaces at each of the 5", INPUT),
    (f"{PAIR}{HELD} --support upper.BOTTOM:y=-1 --support lower.TOP:y", "node upper.47 .* gap of -1, beyond", INPUT),
    (f"{PAIR} --normals 0,-1,0", "--normals needs one number for each axis, 2 in all", USAGE),
    (f"{PAIR} --reach -1", "--reach -1: a length above 0 is needed", USAGE),
    (f"{PAIR} --crease 91", "an angle from 0 to 90 degrees", USAGE),
    (f"--play 0 {PAIR} --play 1 --tied --play 2", "--play 2: the pair has one already", USAGE),
    (f"{PAIR} --output a.csv --field a.csv", "--output a.csv: the same file as of --field", USAGE),
    (f"{PAIR} --field lower.dof", "lower.dof: the same file as of --stiffness", USAGE),
    (f"{PAIR} --loads upper=loads.csv --field loads.csv", "loads.csv: the same file as of --loads", USAGE),
    (f"--body odd --mesh odd.inp{PAIR}{HELD} --field a.vtu", "--field a.vtu: .*U1", INPUT),
    (f"--rows upper.dof --rows lower.dof{PAIR}", "--rows lower.dof: its body has one already", USAGE),
    (f"--body UPPER --mesh upper.inp{PAIR}", 'two bodies have the name "UPPER"', USAGE),
    (f"--body a.b --mesh ridge.inp{PAIR}", 'body "a.b" has a point', USAGE),
    (f"--body c{PAIR}", "--body c: its body has no --mesh", USAGE),
    (f"--mesh plate.inp --rows lower.dof{PAIR}", "--rows lower.dof: its body has no --stiffness", USAGE),
    (f"--body plate --mesh plate.inp{PAIR} --support plate.1:x", "body plate has no --stiffness: it is rigid", USAGE),
]

# The same without the blocks.
ALONE = [
    (f"--mesh lower.inp --mesh upper.inp --stiffness upper.sti --pair a:b{HELD}", 'there is no surface "a"', USAGE),
    (f"--mesh plate.inp --mesh ridge.inp {UPPER} --pair RIDGE:plate.FACE", "both bodies are rigid", USAGE),
    (f"--stiffness upper.sti --mesh upper.inp --stiffness lower.sti{PAIR}", "lower.sti: its body has no --mesh", USAGE),
    (f"--mesh lower.inp --stiffness upper.sti {UPPER}{PAIR}", 'upper.sti" has no row of a node of "lower.inp"', INPUT),
    (f"--mesh lower.inp --stiffness beam.mtx{PAIR}", "rows without names: .* by --rows", INPUT),
    (f"--mesh lower.inp --stiffness lower.sti --rows twice.dof{PAIR}", "node 997, direction 2 is the name of", INPUT),
    (f"{PARTS}{PAIR}{HELD} --load upper.TOP:y=9", "body upper, displacement along y", UNSOLVED),
]

# Tables and input files of loads, the line, and the message; of supports where they begin with *B or have two columns.
FILES = [
    ("node,axis,value\nTOP,y,-1\nTOP,y,two\n", 'line 3: a number is needed, not "two"'),
    ("# nodes\n\nTOP;y\n", "line 3: nodes, an axis and a force are needed"),
    ("TOP\ty\t\t-1\n", "line 1: there are more columns than nodes, axes, value"),
    ("node,force,value\n", 'line 1: two columns have the name "value"'),
    ("node,axis,stiffness\nTOP,y,-1\n", 'line 1: "axis" is no axis'),
    ("BOTOM,y,1\n", 'line 1: body upper has no set of nodes "BOTOM"'),
    ("*CLOAD\nTOP,11,1\n", 'line 2: "11" is no axis: 1 to 6'),
    ("*CLOAD, AMPLITUDE=A\nTOP,2,1\n", 'line 1: \\*CLOAD: the parameter "AMPLITUDE" is not read'),
    ("*CLOAD\nTOP,2,1\n*DLOAD\n101,P1,1\n", "line 3: \\*DLOAD is not read here: give a uniform pressure by --pressure"),
    ("*STEP\n*CLOAD\nTOP,2,1\n*END STEP\n*STEP\n*CLOAD\nTOP,2,1\n", "line 6: \\*CLOAD of another load case follows"),
    ("*BOUNDARY\nTOP,2,1\n", "line 2: the last direction is less than the first one"),
    ("*BOUNDARY\nTOP,PINNED\n", 'line 2: "PINNED" is no axis: 1 to 6'),
    ("*BOUNDARY, FIXED\nTOP,2\n", 'line 1: \\*BOUNDARY: the parameter "FIXED" is not read'),
]


class Refusals(MeshesCase):
    def test_wrong_options(self):
        rows = Path("lower.dof").read_text().splitlines()
        Path("twice.dof").write_text("\n".join([rows[1], *rows[1:]]) + "\n")
        shutil.copy(DATA / "mtx" / "beam_stiffness.mtx", "beam.mtx")
        # Another part of the upper body, which does not move with it.
        rows = Path("upper.dof").read_text().splitlines()
        Path("parts.dof").write_text("\n".join([*rows, "7001.2"]))
        Path("parts.sti").write_text(f"{Path('upper.sti').read_text()}\n{len(rows) + 1} {len(rows) + 1} 5.\n")
        for line, message, code in [(f"{TWO} {line}", *rest) for line, *rest in WRONG] + ALONE:
            with self.subTest(line=line):
                self.assert_refused(line.split(), message, code)

    def test_wrong_files(self):
        for text, message in FILES:
            option = "--supports" if text.startswith("*B") else "--loads"
            with self.subTest(text=text):
                Path("given.txt").write_text(text)
                self.assert_refused(f"{TWO}{PAIR}{HELD} {option} upper=given.txt".split(), message, INPUT)


class FaceForces(unittest.TestCase):
    def test_closed_forms(self):
        square = np.array([(0, 0, 1), (2, 0, 1), (2, 2, 1), (0, 2, 1), (1, 0, 1), (2, 1, 1), (1, 2, 1), (0, 1, 1.0)])
        triangle = 0.5 * np.array([(0, 0, 2), (2, 0, 2), (0, 2, 2), (1, 0, 2), (1, 1, 2), (0, 1, 2.0)])
        edge = np.array([(1, 0), (3, 0), (2, 0.0)])
        for nodes, revolution, expected in (
            (square[:4], False, -np.ones(4)),
            (square, False, -np.repeat([-1.0, 4.0], 4) / 3.0),
            (triangle[:3], False, -np.ones(3) / 6.0),
            (triangle, False, -np.repeat([0.0, 1.0], 3) / 6.0),
            (edge[:2], False, [1.0, 1.0]),
            (edge, False, np.array([1.0, 1.0, 4.0]) / 3.0),
            (edge[:2], True, 2.0 * np.pi * np.array([5.0, 7.0]) / 3.0),
            (edge, True, 2.0 * np.pi * np.array([1.0, 3.0, 8.0]) / 3.0),
        ):
            force = pressure_forces(nodes[None], revolution)[0]
            np.testing.assert_allclose(force[:, -1], expected, atol=1e-14)
            np.testing.assert_allclose(force[:, :-1], 0.0, atol=1e-14)

    def test_closed_surface(self):
        """A pressure around a cube whose sides are bent has no resultant."""
        corner = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1.0)])
        x = corner[np.array([(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)])]
        y = np.roll(x, -1, axis=1)
        bent = np.stack([x[..., 2] + y[..., 2], x[..., 0] * y[..., 0], x[..., 1] + y[..., 1]], axis=-1)
        force = pressure_forces(np.concatenate([x, 0.5 * (x + y) + 0.1 * bent], axis=1))
        np.testing.assert_allclose(force.sum(axis=(0, 1)), 0.0, atol=1e-14)
        self.assertGreater(abs(force).max(), 0.1)
