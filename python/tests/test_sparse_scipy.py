"""Condensation of sparse stiffness matrices, and sparse matrices in files; needs scipy and CHOLMOD."""

import tempfile
import unittest
from pathlib import Path

import numpy as np
import scipy.sparse

import fuge
from test_body import chain


class Sparse(unittest.TestCase):
    n = 2000

    def setUp(self):
        self.stiffness = scipy.sparse.diags([-1.0, 2.0, -1.0], [-1, 0, 1], shape=(self.n, self.n)).tolil()
        self.stiffness[-1, -1] = 1.0

    def check(self, stiffness):
        body = fuge.Body(stiffness)
        body.set_contact([9, self.n - 1], [1.0, 1.0])
        condensed = body.condense()
        np.testing.assert_allclose(condensed.influence, [[10.0, 10.0], [10.0, self.n]], rtol=1e-9)
        np.testing.assert_allclose(body.recover([1.0, 0.0])[[0, 9, 50]], [1.0, 10.0, 10.0], rtol=1e-9)

    def test_formats(self):
        csc = self.stiffness.tocsc()
        for stiffness in (csc, csc.tocsr(), csc.tocoo(), scipy.sparse.tril(csc).tocsc()):
            self.check(stiffness)
        self.check(fuge.CompressedColumns(csc.shape, csc.indptr, csc.indices, csc.data))
        self.check(
            fuge.CompressedColumns(csc.shape, csc.indptr.astype(np.int64), csc.indices.astype(np.int64), csc.data)
        )

    def test_the_matrix_is_kept(self):
        body = fuge.Body(self.stiffness.tocsr())
        body.set_contact([0], [1.0])
        np.testing.assert_allclose(body.condense().influence, [[1.0]], rtol=1e-12)

    def test_remove_member(self):
        csc = self.stiffness.tocsc()
        found = fuge.remove_member(self.stiffness.tocoo(), 4, 5, 0.0, 1.0, area=1.0, modulus=1.0)
        self.assertTrue(scipy.sparse.issparse(found))
        np.testing.assert_array_equal((csc - found)[4:6, 4:6].toarray(), [[1.0, -1.0], [-1.0, 1.0]])
        self.assertEqual(abs(csc - found).sum(), 4.0)

    def test_errors(self):
        csc = self.stiffness.tocsc()
        self.assertRaises(fuge.InputError, fuge.Body, csc[:, :3])
        self.assertRaises(
            fuge.InputError, fuge.Body, fuge.CompressedColumns(csc.shape, csc.indptr[:-1], csc.indices, csc.data)
        )
        self.assertRaises(
            fuge.InputError, fuge.Body, fuge.CompressedColumns(csc.shape, csc.indptr, csc.indices[:5], csc.data)
        )
        self.assertRaises(TypeError, fuge.Body, csc * 1j)

    def test_dense_is_the_same(self):
        matrix = chain(30)
        found = []
        for stiffness in (matrix, scipy.sparse.csc_matrix(matrix)):
            body = fuge.Body(stiffness)
            body.fix([0])
            body.set_contact([5, 20], [1.0, -1.0])
            found.append(body.condense().influence)
        np.testing.assert_allclose(found[0], found[1], rtol=1e-12)

    def test_files(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "k.mtx"
            fuge.write_sparse(path, self.stiffness, symmetric=True)
            back = fuge.read_sparse(path)
            self.assertEqual(abs(back.tocsc() - self.stiffness.tocsc()).max(), 0.0)
            self.check(back)


if __name__ == "__main__":
    unittest.main()
