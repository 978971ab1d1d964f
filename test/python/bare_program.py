"""What an installed wheel has to do: a matrix, a ball by FFT against Hertz, sparse bodies, and an error."""

import math
import os
import sys

import numpy as np

import fuge
from fuge.command import main

if any(os.path.exists(path) for path in ["/bin/sh", "/usr/bin/gcc", "/usr/bin/gfortran"]):
    sys.exit("this is no bare system")

contact = fuge.solve([[0.2, 0.1], [0.1, 0.2]], gap=[0.0, 1.0], load=2.0)
np.testing.assert_allclose(contact.force, [2.0, 0.0], atol=1e-12)
np.testing.assert_allclose(contact.approach, 0.4, rtol=1e-12)

try:
    operator = fuge.HalfspaceOperator(64, 64, 0.05, 0.05, 1.0, "mean", "free")
except fuge.UnsupportedError:
    print("without FFTW")
else:
    x = 0.05 * (np.arange(64) - 31.5)
    gap = 0.5 * (x[:, np.newaxis] ** 2 + x**2)
    ball = fuge.solve(operator, gap, load=4.0 / 3.0)
    # A contact of radius 1 under a ball of radius 1: the approach is 1.
    if not abs(ball.approach - 1.0) < 1e-2 or not abs(ball.force.max() / 0.05**2 - 2.0 / math.pi) < 1e-2:
        sys.exit(f"approach {ball.approach}, largest pressure {ball.force.max() / 0.05**2}")

# A spring of stiffness 2 in compressed columns, by the library for sparse matrices where the wheel has it.
with_sparse = True
try:
    body = fuge.Body(fuge.CompressedColumns((1, 1), np.array([0, 1]), np.array([0]), np.array([2.0])))
    body.set_contact([[0]], [[1.0]])
    np.testing.assert_allclose(body.condense().influence, [[0.5]], rtol=1e-12)
except fuge.UnsupportedError:
    with_sparse = False

try:
    fuge.read_matrix("/no_such.mtx")
except fuge.FileError as error:
    print(error)
else:
    sys.exit("a file that does not exist was read")
# The command, without a shell.
with open("/alpha.mtx", "w") as file:
    file.write("%%MatrixMarket matrix array real symmetric\n2 2\n0.2\n0.1\n0.2\n")
with open("/gap.mtx", "w") as file:
    file.write("%%MatrixMarket matrix array real general\n2 1\n0\n1\n")
if main(["--alpha", "/alpha.mtx", "--gap", "/gap.mtx", "--load", "2", "--output", "/result.csv"]) != 0:
    sys.exit("the command has failed")
if "\n1, 2.0000000000000000E+000, 0.0000000000000000E+000,contact\n" not in open("/result.csv").read():
    sys.exit("the command has written a wrong table")
print("fuge", fuge.__version__, "with" if with_sparse else "without", "sparse matrices")
