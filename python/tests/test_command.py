"""The command, run in this process: tables, refusals, exit codes, and results that would overwrite an input."""

import contextlib
import io
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import numpy as np

import fuge
from fuge.command import main
from fuge.command.man import man_page
from fuge.command.option_table import NAMES

HERE = Path(__file__).resolve().parent
DATA = HERE.parents[1] / "examples" / "data"
GOLDEN = HERE / "golden"
MTX = f"{DATA}/mtx/"


def words(text):
    """Arguments, in which @ stands for the folder of the matrices."""
    return [word.replace("@", MTX) for word in text.split()]


def cells(text):
    return [line.split(",") for line in text.splitlines() if line and line[0] != "#"]


class CommandCase(unittest.TestCase):
    """Each test in a folder of its own, with these files."""

    FILES = {}

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        self.folder = Path(folder.name)
        os.chdir(self.folder)
        for name, text in self.FILES.items():
            Path(name).write_text(text)

    def run_command(self, *arguments):
        """Exit code, standard output and standard error."""
        output, errors = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(output), contextlib.redirect_stderr(errors):
            code = main([str(argument) for argument in arguments])
        return code, output.getvalue(), errors.getvalue()

    def assert_table(self, found, name):
        """The heading and words of a golden table and, to 1e-12 of the largest of a column, its numbers."""
        rows, expected = cells(found), cells((GOLDEN / f"{name}.csv").read_text())
        self.assertEqual((rows[0], len(rows)), (expected[0], len(expected)))
        for column, other in zip(zip(*rows[1:]), zip(*expected[1:])):
            try:
                values = np.array([column, other], dtype=float)
            except ValueError:
                self.assertEqual(column, other)
            else:
                np.testing.assert_allclose(values[0], values[1], 0.0, 1e-12 * abs(values[1]).max())

    def assert_refusals(self, table):
        for arguments, message, code in table:
            with self.subTest(arguments):
                self.assert_refused(words(arguments), message, code)

    def assert_refused(self, arguments, message, code):
        """No table is written, and the message is on one line."""
        before = sorted(self.folder.rglob("*"))
        found, output, errors = self.run_command(*arguments)
        self.assertEqual((found, output), (code, ""), errors)
        self.assertRegex(errors, rf"^fuge: [^\n]*{message}[^\n]*\n$")
        self.assertEqual(sorted(self.folder.rglob("*")), before)

    def table(self, *arguments):
        """The table on standard output of a run without warnings."""
        code, output, errors = self.run_command(*arguments)
        self.assertEqual((code, errors), (0, ""))
        return output


TWO = "--alpha @two_nodes_alpha.mtx --gap @two_nodes_gap.mtx"
MODES = f"{TWO} --modes @two_nodes_modes.mtx --resultant @two_nodes_resultant.mtx"
BEAM = (
    "--stiffness @beam_stiffness.mtx --contact @beam_contact.mtx --gap @beam_gap.mtx --external @beam_external.mtx"
)
BLOCK = BEAM.replace("beam", "block")
LOADED = f"{TWO} --load 2"
PAIR = "--mesh a.inp --stiffness a.sti --pair A:B"

# Tables, their arguments, and tables of displacements. The paper's Tabelle 1, the load given in several ways; then laws
# of the points; statics of a cantilever on a prop; equilibrium of a block that only the supports hold.
GIVEN = (
    ("two_nodes", LOADED, ""),
    ("two_nodes", f"{TWO} --approach 4d-1", ""),
    ("two_nodes", MODES, ""),
    ("two_nodes", f"{MODES} --motion 1=0.4", ""),
    ("two_nodes", "@two_nodes.txt", ""),
    ("excluded", f"{LOADED} --exclude 1", ""),
    ("tied", f"{LOADED} --play @two_nodes_play.mtx", ""),
    ("limited", f"{TWO} --load 20 --compliance 0.3 --limit limits.mtx", ""),
    ("limited_upper", f"{LOADED} --play @two_nodes_play.mtx --limit-upper 3", ""),
    ("beam", f"{BEAM} --fixed @beam_fixed.mtx", "beam_field"),
    ("beam_raised", f"{BEAM} --fixed @beam_fixed.mtx --approach 1", ""),
    ("beam_raised", f"{BEAM} --fixed @beam_settled.mtx", ""),
    ("block", f"{BLOCK} --floats", "block_field"),
    ("block", f"{BLOCK} --floats --approach 1", ""),
)

# Arguments, a part of the message as a regular expression, the exit code.
REFUSED = (
    ("--alpha no_such.mtx --gap @two_nodes_gap.mtx --load 2", '"no_such.mtx" cannot be opened', 3),
    ("--alpha banner.mtx --gap @two_nodes_gap.mtx --load 2", 'banner.mtx", line 1: "complex" values are not', 3),
    ("--alpha number.mtx --gap @two_nodes_gap.mtx --load 2", 'number.mtx", line 6: "0,2" is not a number', 3),
    ("--alpha @two_nodes_alpha.mtx --gap short.mtx --load 2", 'short.mtx", line 4: the file ends after 1 of 2', 3),
    ("--alpha triangle.mtx --gap @two_nodes_gap.mtx --load 2", r'triangle.mtx", line 5: entry \(1, 2\) is above', 3),
    ("--alpha @beam_fixed.mtx --gap @two_nodes_gap.mtx --load 2", "a matrix of 2 x 1, a square one is needed", 3),
    ("--alpha @two_nodes_alpha.mtx --gap @block_gap.mtx --load 2", "a matrix of 3 x 1, 2 x 1 is needed", 3),
    (f"{TWO} --load -1", "load F_0 = -1.0+ is negative", 4),
    (f"{LOADED} --limit 0.5", "within their limits", 4),
    (f"{LOADED} --compliance -1", r"compliance\(1\) = -1[.]0+ is negative", 3),
    (f"{PAIR} --prove", "--prove needs --alpha, --contact, --deck or --surface", 2),
    (f"{PAIR} --gap gap.mtx", "--gap needs --alpha or --contact", 2),
    ("--pair A:B --stiffness a.sti", "--pair needs --mesh, the mesh with the surfaces", 2),
    ("--mesh a.inp --stiffness a.sti", "--mesh needs --pair, the surfaces in contact", 2),
    ("--mesh a.inp --pair A:B", "--stiffness is needed: at least one body has to be elastic", 2),
    ("--stiffness a.sti", "--gap is needed", 2),
    ("--stiffness a.sti --gap a", "--contact, or --mesh and --pair, are needed with --stiffness", 2),
    (f"{BLOCK} --load 1 --approach 1", "no more than one of --load and --approach", 2),
    (BEAM, "degree of freedom 4 still moves freely", 3),
    (f"{BLOCK} --floats --load 1", "nothing resists a motion of both together; prescribe the counter-body by", 3),
    (f"{BLOCK} --floats --exclude 1-3", "moves no point that may touch: exclude fewer points", 3),
    (f"{BEAM} --fixed @two_nodes_alpha.mtx", r"entry \(1, 1\) = 2.00000E-001 is no degree of freedom", 3),
    (BLOCK.replace("@block_contact", "@beam_contact"), 'beam_contact.mtx": a matrix of 2 x 10, n x 3 is needed', 3),
    (f"{TWO} --laod 2", r'unknown option "--laod" \(did you mean --load\?\): see fuge --help', 2),
    (f"{TWO} --load", "--load needs a value", 2),
    (f"{TWO} --load two", '--load two: a number is needed, not "two"', 2),
    (f"{LOADED} --threads -1", "--threads -1: a number of threads is needed, or 0 for all cores", 2),
    (f"{TWO} --gap gap.mtx", "--gap is given twice", 2),
    (TWO, "one of --load, --approach and --modes", 2),
    (f"{TWO} --modes R.mtx", "--modes and --resultant go together", 2),
    (f"{LOADED} --floats", "--floats needs --stiffness", 2),
    (f"{LOADED} --level none", "--level needs --surface", 2),
    (f"{LOADED} --pressure 1", "--pressure needs --mesh and --pair, or --surface", 2),
    (f"{LOADED} --cases cases.csv", "--cases needs --deck or --links", 2),
    (f"{LOADED} --field a.csv", "--field needs --stiffness", 2),
    (f"{LOADED} --exclude 1,3", '--exclude 1,3: "3" is not within 1 to 2', 2),
    (f"{LOADED} --exclude 1-2", "all points are excluded", 4),
    (f"{MODES} --motion 2=1", '--motion 2=1: ".*two_nodes_modes.mtx" has 1 motions', 2),
    (f"{MODES} --motion 1=1 --motion 1=2", "--motion 1=2: motion 1 is given twice", 2),
    (f"{LOADED} --motion 1=1", "--motion needs --modes", 2),
    ("--alpha 0 --gap @two_nodes_gap.mtx --load 2", "--alpha 0 needs --compliance", 2),
    ("no_such.txt", '"no_such.txt" cannot be opened', 3),
    ("@two_nodes.txt @two_nodes.txt", "are two job files", 2),
    ("option.txt", 'option.txt", line 3: unknown option "--laod"', 2),
    ("second.txt", 'second.txt", line 2: "gap" begins a second option, but there is one on each', 2),
    ("hyphens.txt", 'hyphens.txt", line 1: "--field" begins a second option', 2),
    ("bodies.txt", 'bodies.txt", line 1: "pair" begins a second option', 2),
    ("comment.txt", 'comment.txt" has no options', 2),
    ("value.txt", 'value.txt", line 1: --alpha needs a value', 2),
    ("flag.txt", 'flag.txt", line 1: --fill has no value', 2),
    ("", "no options are given", 2),
    (f"{BEAM} --fixed @beam_fixed.mtx --field no_such_folder/a.csv", '"no_such_folder/a.csv" cannot be opened', 3),
    (f"{LOADED} --output .", '"." cannot be opened', 3),
    (f"{LOADED} --plot a.nonsense", "--plot a.nonsense: no kind of picture; one of .*.png", 2),
)

FILES = {
    "limits.mtx": "%%MatrixMarket matrix array real general\n2 1\n10\n-1\n",
    "touching.mtx": "%%MatrixMarket matrix array real general\n2 1\n0\n0.2\n",
    "one_place.mtx": "%%MatrixMarket matrix array real general\n2 2\n1\n1\n1\n1\n",
    "banner.mtx": "%%MatrixMarket matrix array complex general\n2 2\n0.2 0\n0.1 0\n0.1 0\n0.2 0\n",
    "number.mtx": "%%MatrixMarket matrix array real symmetric\n% A comma for the point\n2 2\n0.2\n0.1\n0,2\n",
    "short.mtx": "%%MatrixMarket matrix array real general\n2 1\n0\n% the second one is missing\n",
    "triangle.mtx": "%%MatrixMarket matrix coordinate real symmetric\n2 2 3\n1 1 0.2\n2 2 0.2\n1 2 0.1\n",
    "option.txt": "# a job\nalpha a.mtx\nlaod 2\n",
    "second.txt": "# two options on a line\nalpha a.mtx gap g.mtx\nload 2\n",
    "hyphens.txt": "output a.csv --field\n",
    "bodies.txt": "loads upper=none.csv pair\n",
    "comment.txt": "# nothing but a comment\n** and another one\n",
    "value.txt": "alpha   # no file\n",
    "flag.txt": "fill yes\n",
}


class Matrices(CommandCase):
    FILES = FILES

    def test_tables(self):
        for name, arguments, field in GIVEN:
            with self.subTest(arguments):
                more = ["--field", "field.csv"] if field else []
                found = self.table(*words(arguments), *more)
                self.assert_table(found, name)
                if field:
                    self.assert_table(Path("field.csv").read_text(), field)

    def test_refusals(self):
        self.assert_refusals(REFUSED)

    def test_form_of_numbers(self):
        head, *lines = self.table(*words(f"{TWO} --load 2e-120")).splitlines()[-3:]
        self.assertEqual(head, "point,force,gap,state")
        self.assertEqual(lines[0], "1, 2.0000000000000000E-120, 0.0000000000000000E+000,contact")

    def test_proofs(self):
        """Of a plain problem, a prescribed motion, a body that floats, a point that just touches, one place."""
        small, columns = "[1-9][.][0-9]+E-0(1[5-9]|2[0-9])", "point,force,gap,state,force_bound,gap_bound,proved\n"
        touching = "--gap touching.mtx --load"
        for arguments, pattern, remark in (
            (LOADED, rf", bound: +{small}\n# largest .*: from .* to .*\n{columns}1,.*,contact, {small}, .*,yes\n", ""),
            (f"{TWO} --approach 4d-1", r"# motion 1: .*, bound: +0[.]0+E[+]000\n", ""),
            (f"{BLOCK} --floats", rf"# status: 0, done\n(.*\n)*{columns}([1-3],.*,yes\n)+$", ""),
            (f"--alpha @two_nodes_alpha.mtx {touching} 2", r"# message: .*point 2\n(.*\n)*2,.*,no\n", "note"),
            (f"--alpha one_place.mtx {touching} 0.1", r"# status: 7, (.*\n)*1,.*, +Infinity, +Infinity,no\n", "warn"),
        ):
            with self.subTest(arguments):
                code, output, errors = self.run_command("--prove", *words(arguments))
                self.assertEqual(code, 0)
                self.assertRegex(output, pattern)
                self.assertRegex(errors, f"^fuge: {remark}" if remark else "^$")
        strict = ["--prove", "--strict", *words(f"--alpha one_place.mtx {touching} 0.1")]
        self.assertEqual(self.run_command(*strict)[0], 5)

    def test_winkler_bed(self):
        """Springs of their own: by statics for a matrix of zeros, and for more points than a matrix would hold."""
        for n in (40, 20000):
            gap = np.linspace(0.0, 1.0, n)
            fuge.write_matrix("gap.mtx", gap.reshape(-1, 1))
            for alpha in ([], ["--alpha", "0"]):
                found = self.table(*alpha, *words("--gap gap.mtx --compliance 0.5 --approach 0.25"))
                force = np.array([row[1] for row in cells(found)[1:]], dtype=float)
                np.testing.assert_allclose(force, np.maximum(0.25 - gap, 0.0) / 0.5, atol=1e-12)
            load = force.sum()
            found = self.table(*words(f"--gap gap.mtx --compliance 0.5 --load {load:.17g}"))
            self.assertAlmostEqual(float(re.search(r"# motion 1: *(\S+),", found)[1]), 0.25, 9)

    def test_json(self):
        content = json.loads(self.table(*words(f"{LOADED} --json -")))
        self.assertEqual(content["columns"], ["point", "force", "gap", "state"])
        self.assertEqual(content["rows"], [[1, 2.0, 0.0, "contact"], [2, 0.0, 0.8, "open"]])
        self.assertEqual(content["comments"][0], "status: 0, done")
        arguments = "--prove --alpha one_place.mtx --gap touching.mtx --load 0.1 --json a.json --output a.csv"
        self.assertEqual(self.run_command(*words(arguments))[:2], (0, ""))
        self.assertEqual(json.loads(Path("a.json").read_text())["rows"][0][-3:], [None, None, "no"])
        self.assertIn("Infinity", Path("a.csv").read_text())

    def test_steps_have_times(self):
        errors = self.run_command(*words(f"{LOADED} --verbose"))[2]
        self.assertRegex(errors, r"^(fuge: +\d+\.\d\d s  [^\n]+\n)+$")
        self.assertRegex(errors, r"contact is solved: 1 of 2 points.*\n.* s  done\n$")

    def test_picture(self):
        self.table(*words(f"{LOADED} --plot a.png"))
        self.assertEqual(Path("a.png").read_bytes()[1:4], b"PNG")


class HelpAndVersion(CommandCase):
    def test_help(self):
        for word in ("--help", "-h"):
            found = self.table(word)
            self.assertEqual(sorted(set(re.findall(r"--([a-z][-a-z]+)", found))), NAMES)
            self.assertLessEqual(max(map(len, found.splitlines())), 96)

    def test_man_page(self):
        page = man_page()
        self.assertEqual(sorted(set(re.findall(r"\n\.B --([-a-z]+)", page.replace("\\-", "-")))), NAMES)
        if shutil.which("groff"):
            done = subprocess.run(["groff", "-man", "-ww", "-Tascii"], input=page.encode(), capture_output=True)
            self.assertEqual((done.returncode, done.stderr), (0, b""))

    def test_version(self):
        self.assertRegex(self.table("-V"), rf"^fuge {fuge.__version__}\ntransforms: .*FFTW.*\nstiffness matrices: ")


class Ends(CommandCase):
    """However a run ends, there is no traceback."""

    def test_interrupt_and_unexpected_errors(self):
        for failure, code, message in (
            (KeyboardInterrupt(), 130, "^$"),
            (BrokenPipeError(), 141, "^$"),
            (MemoryError(), 4, "^fuge: there is not enough memory\n$"),
            (KeyError("x"), 1, "^fuge: unexpected error, KeyError: 'x'\n$"),
        ):
            with mock.patch("fuge.command.check_options", side_effect=failure):
                found, _, errors = self.run_command(*words(LOADED))
            self.assertEqual(found, code)
            self.assertRegex(errors, message)

    def shell(self, text, *arguments):
        """Exit code and messages of the command, `fuge` in the text of a shell with standard output as it likes."""
        command = f"'{sys.executable}' -m fuge {' '.join(words(' '.join(arguments) or LOADED))}"
        environment = {**os.environ, "PYTHONPATH": str(HERE.parent)}
        shell = ["bash", "-o", "pipefail", "-c", text.replace("fuge", command)]
        done = subprocess.run(shell, capture_output=True, text=True, env=environment, check=False)
        return done.returncode, done.stdout, done.stderr

    @unittest.skipUnless(os.path.exists("/dev/full"), "there is no /dev/full")
    def test_full_disks_and_closed_pipes(self):
        full = "fuge: standard output cannot be written: No space left on device\n"
        self.assertEqual(self.shell("fuge > /dev/full"), (3, "", full))
        self.assertEqual(self.shell("fuge > /dev/full", "--help"), (3, "", full))
        self.assertRegex(self.shell("fuge >&-")[2], "^fuge: standard output cannot be written: [^\n]*\n$")
        self.assertEqual(self.shell("fuge | true")[1:], ("", ""))
        self.assert_refused([*words(LOADED), "--output", "/dev/full"], '"/dev/full" cannot be written', 3)


class SameFiles(CommandCase):
    """No result overwrites an input, under whatever name, and none is lost without an error."""

    FILES = {
        "alpha.mtx": Path(f"{MTX}two_nodes_alpha.mtx").read_text(),
        "gap.mtx": Path(f"{MTX}two_nodes_gap.mtx").read_text(),
        "job.txt": "alpha alpha.mtx\ngap gap.mtx\nload 2\n",
        "names.txt": "alpha alpha.mtx\ngap gap.mtx\nload 2\noutput my contact table.csv\n",
    }

    def setUp(self):
        super().setUp()
        Path("within").mkdir()
        for link, target in (("soft.mtx", "alpha.mtx"), ("softer.mtx", "soft.mtx"), ("other.csv", "new.csv")):
            os.symlink(target, link)
        for link in ("alpha.mtx", "gap.mtx"):
            os.link(link, f"hard_{link}")

    ARGUMENTS = "--alpha alpha.mtx --gap gap.mtx --load 2"

    def test_refusals(self):
        contents = {path: path.read_bytes() for path in self.folder.iterdir() if path.is_file()}
        self.assert_refusals(
            (f"{self.ARGUMENTS} {option} {name}", f"{option} {re.escape(name)}: the same file as of --alpha", 2)
            for name in f"./alpha.mtx within/../alpha.mtx softer.mtx hard_alpha.mtx {self.folder}/alpha.mtx".split()
            for option in ("--output", "--json", "--plot")
        )
        self.assert_refusals((
            (f"{self.ARGUMENTS} --output hard_gap.mtx", "hard_gap.mtx: the same file as of --gap", 2),
            ("job.txt --output ./job.txt", "job.txt: it is the job file", 2),
            (f"{self.ARGUMENTS} --output new.csv --json ./new.csv", "new.csv: the same file as of --json", 2),
            (f"{self.ARGUMENTS} --output new.csv --json other.csv", "new.csv: the same file as of --json", 2),
        ))  # fmt: skip
        self.assert_refused([*words(self.ARGUMENTS), "--output", ""], "--output needs a path", 2)
        self.assertEqual({path: path.read_bytes() for path in contents}, contents)

    def test_standard_output_is_a_result(self):
        for name, words_, message in (
            ("hard_gap.mtx", self.ARGUMENTS, "the same file as of --gap, use --output"),
            ("job.txt", "job.txt", "it is the job file"),
            ("new.csv", f"{self.ARGUMENTS} --json new.csv", "the same file as of --json"),
        ):
            errors = io.StringIO()
            with open(name, "a") as output, contextlib.redirect_stdout(output), contextlib.redirect_stderr(errors):
                self.assertEqual(main(words_.split()), 2)
            self.assertIn(f"fuge: standard output: {message}", errors.getvalue())

    def test_other_files_are_replaced(self):
        for name in ("other.csv", "new.csv", "within/a.csv", "/dev/null"):
            self.table(*words(self.ARGUMENTS), "--output", name)
            self.assertRegex(Path(name).read_text(), "^$" if "dev" in name else "point,force,gap,state\n1, *2\\.")
        self.assertTrue(Path("other.csv").is_symlink())

    def test_names_in_job_files(self):
        """Words of a value that are options begin a second one only with hyphens, or where an input does not exist."""
        self.table("names.txt")
        self.assertTrue(Path("my contact table.csv").exists())


if __name__ == "__main__":
    unittest.main()
