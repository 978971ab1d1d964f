"""Matrix Market files."""

import unittest

import numpy as np
import scipy.io
import scipy.sparse

import fuge
from files import InFolder

ARRAY = "%%MatrixMarket matrix array real general\n"
LOWER_ARRAY = "%%MatrixMarket matrix array real symmetric\n"
ENTRIES = "%%MatrixMarket matrix coordinate real general\n"
LOWER = "%%MatrixMarket matrix coordinate real symmetric\n"
WHOLE = "%%MatrixMarket matrix array integer general\n"
COLUMN = [[1.5], [-0.002]]

# A text and its matrix.
READ = [
    (ARRAY + "2 3\n1\n2\n3\n4\n5\n-6.5\n", [[1, 3, 5], [2, 4, -6.5]]),
    (LOWER_ARRAY + "3 3\n1\n2\n3\n4\n5\n6\n", [[1, 2, 3], [2, 4, 5], [3, 5, 6]]),
    (ARRAY + "0 3\n", np.empty((0, 3))),
    (ARRAY + "3 0", np.empty((3, 0))),
    (ENTRIES + "2 3 3\n2 3 -2\n1 1 1\n1 3 4\n", [[1, 0, 4], [0, 0, -2]]),
    (LOWER + "2 2 2\n2 1 5\n1 1 3\n", [[3, 5], [5, 0]]),
    # Entries of one place are added, in their order: 1e16 + 1 - 1e16 is 0.
    (ENTRIES + "2 2 5\n2 1 1e16\n1 1 0.5\n2 1 1\n2 1 -1e16\n2 2 7\n", [[0.5, 0], [0, 7]]),
    (LOWER + "2 2 4\n2 1 1\n2 2 1\n2 1 2\n2 2 3\n", [[0, 3], [3, 4]]),
    # Letters, line ends, blanks, comments, exponents.
    ("%%MATRIXMARKET Matrix ARRAY Real GENERAL\n2 1\n1.5\n-2e-3\n", COLUMN),
    (ARRAY.replace("\n", "\r\n") + "%\r\n\r\n2 1\r\n1.5\r\n-2d-3\r\n", COLUMN),
    (ARRAY + "% a\n\n 2\t1 \n% b\n+1.5D0\n\n  -.2D-02  \n% c\n", COLUMN),
    ("\ufeff" + ARRAY + "2 1\n15E-1\n-0.002", COLUMN),
    (ARRAY + "%" + "long " * 9999 + "\n" + " " * 9999 + "2 1\n" + " " * 9999 + "1.5\n-0.002\n", COLUMN),
    (WHOLE + "2 1\n-3\n+4\n", [[-3], [4]]),
]

# A text, the line that is refused (0: the whole file), and why.
BANNER = "%%MatrixMarket matrix "
REFUSED = [
    ("", 0, "the file is empty"),
    ("\n" + ARRAY + "1 1\n1", 1, 'a Matrix Market file begins with a line like "%%MatrixMarket matrix'),
    ("%%MatrixMarket vector array real general\n1", 1, '"vector" cannot be read, only "matrix"'),
    (BANNER + "dense real general\n1 1", 1, '"dense" is not a supported format'),
    (BANNER + "array complex general\n1 1", 1, '"complex" values are not supported'),
    (BANNER + "coordinate pattern general\n1 1 1", 1, '"pattern" values are not'),
    (BANNER + "array real skew-symmetric\n1 1", 1, '"skew-symmetric" matrices are not supported'),
    (BANNER + "array real", 1, '"" matrices are not supported'),
    (BANNER + "array real general 1\n1 1", 1, "more than five words"),
    (ARRAY + "%\n\n", 3, "ends before the line with the sizes"),
    (ARRAY + "%\n2\n1\n", 3, "two whole numbers are needed here: rows, columns"),
    (ENTRIES + "1 1\n1 1 1\n", 2, "three whole numbers are needed here: rows, columns, entries"),
    (ENTRIES + "1 -1 0\n", 2, "sizes must be from 0 to 2147483646"),
    (ENTRIES + "1 1 2147483648\n", 2, "sizes must be from 0 to 2147483646"),
    (LOWER + "2 1 0\n", 2, "a symmetric matrix needs as many rows as columns"),
    (ARRAY + "2 2\n1\n2\n3\n", 5, "the file ends after 3 of 4 entries"),
    (ARRAY + "60000 60000\n1\n\n2", 5, "the file ends after 2 of 3600000000 entries"),
    (ENTRIES + "2 2 2000000000\n1 1 1\n", 3, "the file ends after 1 of 2000000000 entries"),
    (ARRAY + "1 1\n1\n\n%\n2\n", 6, "more entries than the line with the sizes announces"),
    (ENTRIES + "1000000000 1000000000 1\n1 1 1", 2, "have none of the entries: are the sizes right?"),
    (ARRAY + "2 1\n1\nx\n", 4, '"x" is not a number'),
    (ARRAY + "2 1\r\n\r\nNaN\r\n1", 4, '"NaN" is not a finite number'),
    (ARRAY + "2 1\n1\n-1.8e308", 4, '"-1.8e308" is not a finite number'),
    (ARRAY + "2 1\n1\n2.\x0c\n", 4, '"2.?" is not a number'),
    (ARRAY + "2 1\n1\n3.+5\n", 4, '"3.+5" is not a number'),
    (ARRAY + "1 2\n1 2\n3\n", 3, "more than one entry on the line"),
    (WHOLE + "1 1\n1.5", 3, '"1.5" is not a whole number, although the banner says integer'),
    (ENTRIES + "2 2 1\n3 1 1", 3, 'row "3" is outside 1 .. 2'),
    (ENTRIES + "2 3 1\n1 4 1", 3, 'column "4" is outside 1 .. 3'),
    (ENTRIES + "2 2 1\n1.0 1 1", 3, 'row "1.0" is not a whole number'),
    (ENTRIES + "2 2 1\n1 1\n ", 3, "the value is missing"),
    (ENTRIES + "2 2 1\n1,1,2\n", 3, 'row "1,1,2" is not a whole number'),
    (LOWER + "2 2 2\n1 1 1\n1 2 1", 4, "entry (1, 2) is above the diagonal"),
    (ENTRIES + "2 2 3\n2 1 1e308\n1 1 1\n2 1 1e308", 0, "the sum of the entries for (2, 1) is out of range"),
]


def numbers(n):
    """Doubles of all magnitudes, symmetric in pairs."""
    matrix = np.random.default_rng(1).uniform(-0.5, 0.5, (n, n)) * 2.0 ** np.linspace(-990, 990, n)
    matrix = np.tril(matrix) + np.tril(matrix, -1).T
    matrix[np.arange(5), np.arange(5)] = [np.finfo(float).max, -np.finfo(float).tiny, 5e-324, -0.0, 0.1]
    return matrix


class MatrixMarket(InFolder):
    def test_reading(self):
        for text, matrix in READ:
            with self.subTest(text[:80]):
                path = self.file("a.mtx", text)
                np.testing.assert_array_equal(fuge.read_matrix(path), matrix)
                sparse = fuge.read_sparse(path)
                self.assertEqual(sparse.shape, np.shape(matrix))
                np.testing.assert_array_equal(sparse.tocsc().toarray(), matrix)
                columns = np.repeat(np.arange(sparse.shape[1]), np.diff(sparse.column))
                self.assertTrue(np.all(np.diff(sparse.row + sparse.shape[0] * columns) > 0))

    def test_refusals(self):
        for text, line, reason in REFUSED:
            for read in (fuge.read_matrix, fuge.read_sparse):
                with self.subTest(text[:80], read=read):
                    message = self.refused(reason, read, self.file("a.mtx", text))
                    place = f'"{self.folder}/a.mtx"' + (f", line {line}: " if line else ": ")
                    self.assertEqual(message[: len(place)], place)
        for path, reason in ((self.folder / "none.mtx", "cannot be opened"), (self.folder, "folder"), (" ", "blank")):
            self.assertRaisesRegex(fuge.FileError, reason, fuge.read_matrix, path)

    def test_zeros(self):
        self.assertEqual(len(fuge.read_sparse(self.file("a", ARRAY + "2 1\n0\n1\n")).value), 1)
        self.assertEqual(len(fuge.read_sparse(self.file("a", ENTRIES + "2 1 2\n1 1 0\n2 1 1\n")).value), 2)

    def test_writing_to_the_last_bit(self):
        path, matrix = self.folder / "a.mtx", numbers(250)
        band = scipy.sparse.csc_matrix(np.where(np.abs(np.subtract.outer(range(250), range(250))) < 4, matrix, 0.0))
        for symmetric in (False, True):
            for array in (matrix, np.asfortranarray(matrix), matrix[:70, 3:4]):
                fuge.write_matrix(path, array, symmetric=symmetric and array.shape[1] > 1)
                self.assertEqual(fuge.read_matrix(path).tobytes(), array.tobytes())
            np.testing.assert_array_equal(scipy.io.mmread(path), matrix[:70, 3:4])
            fuge.write_sparse(path, band, symmetric=symmetric)
            self.assertEqual(fuge.read_sparse(path).value.tobytes(), band.data.tobytes())
            np.testing.assert_array_equal(scipy.io.mmread(path).toarray(), band.toarray())

    def test_the_file_as_it_is_written(self):
        path = self.folder / "a.mtx"
        fuge.write_sparse(path, fuge.CompressedColumns((2, 2), [0, 1, 2], [1, 0], [0.1, 9.0]), symmetric=True)
        self.assertEqual(path.read_text(), LOWER + "2 2 1\n2 1 1.0000000000000001e-01\n")
        fuge.write_matrix(path, [[2.0, 9.0], [3.0, -4.0]], symmetric=True)
        self.assertEqual(path.read_text().split()[-5:], ["2", "2"] + [f"{k}.0000000000000000e+00" for k in (2, 3, -4)])

    def test_what_is_not_written(self):
        path = self.folder / "a.mtx"
        fuge.write_matrix(path, [[3.0]])
        sparse = fuge.CompressedColumns
        for write, matrix, symmetric, reason in (
            (fuge.write_matrix, [[1.0, np.inf]], False, r"entry \(0, 1\) = inf is not a finite number"),
            (fuge.write_matrix, [[1.0, 2.0]], True, "a symmetric matrix cannot be 1 x 2"),
            (fuge.write_sparse, sparse((2, 1), [0, 1], [1], [np.nan]), False, r"entry \(1, 0\) = nan"),
            (fuge.write_sparse, sparse((2, 1), [0, 1], [2], [1.0]), False, r"row\(0\) = 2 is outside 0 .. 1"),
        ):
            self.assertRaisesRegex(fuge.InputError, reason, write, path, matrix, symmetric=symmetric)
        np.testing.assert_array_equal(fuge.read_matrix(path), [[3.0]])
        fuge.write_matrix(path, [[1.0, np.inf], [2.0, 3.0]], symmetric=True)
        self.assertRaisesRegex(fuge.FileError, "cannot be opened", fuge.write_matrix, self.folder / "no" / "a", [[1.0]])
        self.assertRaisesRegex(fuge.FileError, "blank", fuge.write_matrix, " ", [[1.0]])
        with self.assertRaisesRegex(fuge.FileError, "cannot be written"):
            fuge.write_matrix("/dev/full", [[1.0]])


if __name__ == "__main__":
    unittest.main()
