"""Stiffness matrices in files of finite element programs: one matrix in all spellings, and files that are refused."""

import unittest
from pathlib import Path

import numpy as np

import fuge
from files import InFolder
from test_matrix_market import LOWER

# Four nodes, not one after another; node 12 cannot move along y. Row 2 has a zero beside the diagonal.
NAMES = [(3, 1), (3, 2), (3, 3), (7, 1), (7, 2), (12, 1), (12, 3), (40, 2)]
N = len(NAMES)
K = np.where(np.add.outer(range(N), range(N)) % 3 > 0, 0.125 * (np.multiply.outer(range(N), range(N)) % 13) - 0.5, 0.0)
K += np.diag(np.arange(N) + 8.0)
TURNED = [3, 7, 0, 6, 1, 2, 5, 4]
DATA = Path(__file__).parents[2] / "examples" / "data" / "stiffness"


def entries(matrix, form, which=np.ones_like):
    return "".join(form(i, j, matrix[i, j]) for i, j in np.argwhere((matrix != 0.0) & (which(matrix) != 0.0)))


def numbered(matrix, which, comma=" "):
    return entries(matrix, lambda i, j, k: f"{i + 1}{comma}{j + 1}{comma}{k:.16e}\n", which)


def named(which):
    text = entries(K, lambda i, j, k: "{},{}, {},{},{:24.16e}\n".format(*NAMES[i], *NAMES[j], k), which)
    return "** by Abaqus\n*MATRIX INPUT, NAME=K\n" + text


def punched(width, title):
    """A punch file, with fields of 8 or 16 columns, or free; two rows on a line where there is room."""

    def line(keyword, *fields):
        if width == 0:
            return ",".join([keyword, *fields]) + "\n"
        return (keyword + "*" * (width == 16)).ljust(8) + "".join(field.ljust(width) for field in fields) + "\n"

    text = "$TITLE   = STIFFNESS\n" + line("DMIG", title, "0", "6", "2")
    for j in range(N):
        rows = [[*map(str, NAMES[i]), f"{K[i, j]:.4f}", ""] for i in range(j, N) if K[i, j] != 0.0]
        head = [title, *map(str, NAMES[j]), ""]
        step = 1 if width == 16 else 2
        text += line("DMIG", *head, *(rows.pop(0) if step == 2 else []))
        text += "".join(line("", *sum(rows[k : k + step], [])) for k in range(0, len(rows), step))
    return text


def output4(form, title):
    """A formatted file of OUTPUT4, dense, sparse or BIGMAT."""
    text = f"{N:8}{-N if form == 'bigmat' else N:8}{6:8}{2:8}{title:8}1P,3E23.16\n"
    for j in range(N):
        filled = np.flatnonzero(K[:, j])
        runs = [np.arange(filled[0], filled[-1] + 1)]
        if form != "dense":
            runs = np.split(filled, np.flatnonzero(np.diff(filled) > 1) + 1)
        words = 2 * sum(map(len, runs)) + {"dense": 0, "sparse": 1, "bigmat": 2}[form] * len(runs)
        text += f"{j + 1:8}{runs[0][0] + 1 if form == 'dense' else 0:8}{words:8}\n"
        for run in runs:
            length, row = 2 * len(run) + 1, run[0] + 1
            text += {"dense": "", "sparse": f"{row + 65536 * length:12}\n", "bigmat": f"{length:8}{row:8}\n"}[form]
            values = [f"{value:23.16E}" for value in K[run, j]]
            text += "".join("".join(values[k : k + 3]) + "\n" for k in range(0, len(values), 3))
    return text + f"{N + 1:8}{1:8}{1:8}\n 1.0000000000000000E+00\n"


OP4 = "       2       2       6       2K       1P,3E23.16\n"
ONE, TWO = " 1.0000000000000000E+00\n", " 1.0000000000000000E+00-1.0000000000000000E+00\n"
DENSE = OP4 + f"{1:8}{1:8}{2:8}\n{ONE}{2:8}{2:8}{2:8}\n{ONE}"
LAST = f"{3:8}{1:8}{1:8}\n{ONE}"
DMIG = "DMIG,K,0,6,2\n"

# A text and why it is refused; the matrix is K.
REFUSED = [
    ("** only\n% comments\n", '": the file has no entry of a matrix'),
    ("1 1 2.\n1 2\n", "line 2: 2 column(s), but the first entry has 3: is the file cut off?"),
    ("1 1 2. 4\n", "line 1: an entry has 3 columns (row, column, value) or 5 (node"),
    ("1 1 2.\n\n1 0 2.\n", 'line 3: column "0" is outside 1 ..'),
    ("1 1.5 2.\n", 'line 1: column "1.5" is not a whole number'),
    ("1 1 NaN\n", 'line 1: "NaN" is not a finite number'),
    ("1 1 1e999\n", 'line 1: "1e999" is not a finite number'),
    ("1 1 1.5.2\n", 'line 1: "1.5.2" is not a number'),
    ("1 1 2.\n2000000000 2000000000 2.\n", "2 entries for 2000000000 rows: each row"),
    ("1 1 2.\n2 1 1\n2 2 3\n1 1 2\n", "line 4: a second entry for row 1 and row 1: the file was written twice"),
    ("1 1 2.\n2 1 1\n1 2 1\n2 2 3\n1 2 1\n", "line 5: a second entry for row 2 and row 1"),
    ("5,1,5,1,2.\n5,x,5,1,2.\n", 'line 2: direction "x" is not a whole number'),
    ("5,1,5,1,2.\n5,1,,1,2.\n", "line 2: the node is missing"),
    ("5,1,5,1,2.\n5,1,,5,1,2.\n", "line 2: 6 column(s), but the first entry has 5"),
    ("5,1,5,1,2.\n5,1,5,1,2.\n", "a second entry for node 5, direction 1 and node 5, direction 1"),
    ("*STEP\n5,1,5,1,2.\n", 'line 1: "*STEP" is no entry of a matrix'),
    ("*MATRIX INPUT, NAME=K, SCALE FACTOR=2.\n5,1,5,1,2.\n", 'line 1: "*MATRIX INPUT, NAME=K, S..'),
    ("5,1,5,1,2.\n*MATRIX INPUT, NAME=M\n6,1,6,1,2.\n", 'line 2: "*MATRIX INPUT, NAME=M" is no entry'),
    (" \0\xff%%", "line 1"),
    (DMIG, "has no entry of a DMIG matrix"),
    ("GRID,1,,0.,0.,0.\n", "has no entry of a DMIG matrix"),
    ("DMIG,K,0,9,2\n", "line 1: IFO = 9 is no stiffness matrix"),
    ("DMIG,K,0,6,3\n", "line 1: TIN = 3 is not read"),
    ("DMIG,KAAXKAAXK,0,6,2\n", 'line 1: "KAAXKAAXK" is no name of a matrix'),
    ("DMIGK,K,0,6,2\n", 'line 1: "DMIGK" is no card'),
    (DMIG + "DMIG,K,5,1,,5,1,2.0,1.0\n", "line 2: the value has an imaginary part"),
    (DMIG + "DMIG,K,5,1,,5,1\n", "line 2: the value is missing"),
    (DMIG + "DMIG,K,5,1,,5,1,2.x\n", 'line 2: "2.x" is not a number'),
    (DMIG + "DMIG,K,5,1,,5,1,2.\n,,1,2.\n", "line 3: the node is missing"),
    (DMIG + "DMIG,K,5,1,,5,1,2.\n+,5,1,2.\n", "line 3: a second entry for node 5"),
    (DMIG + "DMIG,K,5,-1,,5,1,2.\n", 'line 2: component "-1" is outside'),
    (DMIG + "DMIG,K,5,1,7,5,1,2.\n", 'line 2: "7" stands where a column has a blank field'),
    (DMIG + "DMIG,K,5,1,,5,1,2.,,6,1,3.\n", "line 2: more than 8 fields"),
    (DMIG + "DMIG,K,5,1,,5,1,2.\n=,6,1,3.\n", "line 3: neither a card nor a continuation"),
    (OP4, "the file ends in or before column 1 of 2"),
    (DENSE, "and without the column after the last one: is it cut off?"),
    (OP4.replace("2       6", "3       2"), 'the matrix "K" is 3 x 2: a stiffness matrix is square'),
    (OP4.replace("2K", "4K"), "is not real"),
    (OP4 + f"{1:8}{1:8}{6:8}\n{TWO}{LAST}", "column 1 has 2 values above this line, but 6 words"),
    (OP4 + f"{1:8}{2:8}{4:8}\n{TWO}{LAST}", "line 3: row 3 is outside 1 .. 2"),
    (OP4 + f"{5:8}{1:8}{2:8}\n{ONE}{LAST}", "line 2: column 5 after column 0"),
    (OP4 + f"{1:8}{3:8}{2:8}\n{ONE}{LAST}", "line 2: row 3 is outside 1 .. 2"),
    (OP4 + ONE, "line 2: values before the header"),
    (OP4 + f"{3:8}{1:8}\n{ONE}", "line 2: a string before the first column"),
    (OP4 + f"{1:8}{1:8}{2:8}\n                    NaN.\n", "line 3"),
    (DENSE + LAST + "rubbish\n", "the header of a matrix is needed here"),
    ("\x18\0\0\0\1", "this is a binary file, as of OUTPUT4"),
    ("\0\0\0\x18\1", "write it with FORM=FORMATTED"),
]

# A file of names, a text, and why the two are refused.
MARKET = "%%MatrixMarket matrix array real general\n"
WRONG_NAMES = [
    ("3.1\n3.2\n", "1 1 2.\n", "ends with row 1, but 2 rows are named"),
    ("3.1\n3.2\n", "1 1 2.\n3 3 2.\n", 'line 2: row "3" is outside 1 .. 2'),
    ("3.1\n3.2\n", "5,1,5,1,2.\n", "pass no file of names"),
    ("3.1\n3.2\n", MARKET + "1 1\n4\n", "the file has 1 rows, but 2 are named"),
    ("3.1\n3.2\n3.3\n", DENSE + LAST, 'the matrix "K" has 2 rows, but 3 are named'),
    ("3.1\n3.1\n", "1 1 2.\n", "line 2: node 3, direction 1 is the name of row 1 already: CalculiX"),
    ("3.1\n7 2 1\n", "1 1 2.\n", "line 2: the node and the direction of one row are needed here, like 17.3"),
    ("3.10000\n", "1 1 2.\n", 'line 1: direction "10000" is outside 0 .. 9999'),
    ("\n", "1 1 2.\n", "the file names no row"),
    ("3.1\n", MARKET + "1 2\n4\n5\n", "1 x 2: a stiffness matrix is square"),
]


class Stiffness(InFolder):
    def check(self, stiffness, matrix=K, names=tuple(NAMES)):
        np.testing.assert_array_equal(stiffness.tocsc().toarray(), matrix)
        self.assertEqual(list(zip(stiffness.node.tolist(), stiffness.direction.tolist())), list(names))
        self.assertEqual(len(stiffness.value), np.count_nonzero(matrix))

    def test_all_formats(self):
        turned, names = K[np.ix_(TURNED, TURNED)], [NAMES[k] for k in TURNED]
        dof = self.file("k.dof", "".join("{}.{}\n".format(*name) for name in names))
        self.check(fuge.read_stiffness(self.file("k.sti", numbered(turned, np.triu))), turned, names)
        for text, format in (
            (numbered(turned, np.ones_like, ", "), "abaqus"),
            (numbered(turned, np.tril, "\t").replace("e", "D"), "calculix"),
            (LOWER + f"{N} {N} {np.count_nonzero(np.tril(turned))}\n" + numbered(turned, np.tril), "any"),
        ):
            self.check(fuge.read_stiffness(self.file("k", text), format, names_path=dof), turned, names)
        for which in (np.tril, np.triu, np.ones_like):
            self.check(fuge.read_stiffness(self.file("k", named(which))))
        dof = self.file("k.dof", "".join("{} {}  # names\n".format(*name) for name in NAMES))
        for form in (0, 8, 16, "dense", "sparse", "bigmat"):
            write, rows = (output4, dof) if isinstance(form, str) else (punched, None)
            self.check(fuge.read_stiffness(self.file("k", write(form, "KAA")), names_path=rows))
            path = self.file("k", write(form, "MAA") + write(form, "KAA"))
            self.check(fuge.read_stiffness(path, names_path=rows, name="kaa"))
            self.refused('holds the matrices "MAA" and "KAA": pass the name', fuge.read_stiffness, path)
            self.refused('has no matrix "KXX", but "KAA"', fuge.read_stiffness, path, name="KXX")

    def test_spellings_of_bulk_data(self):
        """Exponents without a letter, fields that touch, other cards, lower case, a scalar point, blank columns."""
        text = (
            "PARAM,POST,-1\ndmig    k              0       6       2\nDMIG*   K{0:>31}{1:>16}\n"
            "*       {0:>16}{1:>16} 1.500000000D+02\n $ comment\n*       {2:>16}                -2.500000000D-01\n"
            "GRID           1              0.      0.      0.\n                3.\n"
            "DMIG    K       6                       6               4.+3\nDMIG,K,7,1\n"
        ).format(5, 1, 6)
        stiffness = fuge.read_stiffness(self.file("k", text.replace("\n", "\r\n")))
        self.check(stiffness, [[150, -0.25, 0], [-0.25, 4000, 0], [0, 0, 0]], [(5, 1), (6, 0), (7, 1)])
        whole = "DMIG,K,0,1,2\nDMIG,K,5,1,,5,1,2.\n+,6,1,3.\nDMIG,K,6,1,,6,1,4.\n"
        self.check(fuge.read_stiffness(self.file("k", whole)), [[2, 0], [3, 4]], [(5, 1), (6, 1)])

    def test_examples(self):
        matrix = fuge.read_matrix(DATA / "block.mtx")
        for path in sorted(DATA.iterdir()):
            if path.suffix not in (".dof", ".inp"):
                rows = None if path.suffix == ".pch" or "input" in path.name else DATA / "block.dof"
                names = [(node, k) for node in (1, 2, 3, 4, 11, 12) for k in (1, 2)]
                self.check(fuge.read_stiffness(path, names_path=rows), matrix, names)

    def test_refusals(self):
        for text, reason in REFUSED:
            with self.subTest(text):
                self.refused(reason, fuge.read_stiffness, self.file("k", text))
        for names, text, reason in WRONG_NAMES:
            with self.subTest(text):
                self.refused(reason, fuge.read_stiffness, self.file("k", text), names_path=self.file("k.dof", names))
        self.assertRaisesRegex(fuge.FileError, 'none.sti" cannot be opened', fuge.read_stiffness, "none.sti")
        self.assertRaisesRegex(fuge.FileError, 'j.dof" cannot be opened', fuge.read_stiffness, self.file("j.sti", ""))
        self.assertRaisesRegex(fuge.InputError, "must be one of 'any'", fuge.read_stiffness, "k", "nastran")

    def test_many_lines(self):
        """A chain of springs, nodes from the last to the first, in more lines than are read at a time."""
        n = 60000
        lines = [f"{3 * k},1,{3 * k},1,2.5\n{3 * k},1,{3 * k - 3},1,-1.25\n" for k in range(n, 1, -1)] + ["3,1,3,1,2.5"]
        stiffness = fuge.read_stiffness(self.file("k", "".join(lines)))
        np.testing.assert_array_equal(stiffness.node, 3 * np.arange(1, n + 1))
        np.testing.assert_array_equal(stiffness.column[1:-1], 3 * np.arange(1, n) - 1)
        self.assertEqual((len(stiffness.row), stiffness.value.sum()), (3 * n - 2, 2.5))
        wrong = self.file("k", "".join(lines) + "\n9,1,9,1,3.x")
        self.refused(f'line {2 * n}: "3.x" is not a number', fuge.read_stiffness, wrong)


if __name__ == "__main__":
    unittest.main()
