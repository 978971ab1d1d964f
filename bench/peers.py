"""Other solvers on the problems that the benchmark wrote.

    python peers.py DIRECTORY [quick] [once]

`quick` gives a solver less time, `once` does not repeat fast solves.

Reads each DIRECTORY/NAME.txt and NAME.bin; writes the forces found to NAME.METHODTOLERANCE and a
line for each solve to answers.csv: name, method, tolerance, time, residual, memory, failure. The program
`judge` does the rest. Every solver of quadratic programs gets the same scaled problem (largest
diagonal of H 1, mean of F 1)

    minimise F.HF/2 + g.F,   F >= 0,   C F = d   (sum of F; its moment, if the punch tilts)

in a process of its own, with one thread. Settings are those with which a solver is fastest for
the accuracy it reaches. Tamaas gets the profiles.
"""
import glob
import os
import sys

from peer_runs import Answers

import clarabel
import daqp
import highspy
import numpy as np
import osqp
import piqp
import proxsuite
import quadprog
import scipy.linalg
import scipy.optimize
import scipy.sparse
import tamaas

# Processor time in seconds until a solver is stopped.
TIMEOUT, TIMEOUT_QUICK = 20, 5
ROUGH_TOLERANCES = ["1e-2", "1e-4", "1e-6", "1e-8"]


def by_daqp(H, g, C, d, _):
    """Dual active set in C, default tolerances (tighter ones change nothing)."""
    n, m = len(g), len(d)
    lower, upper = np.zeros(n + m), np.full(n + m, 1e30)
    lower[n:] = upper[n:] = d
    sense = np.zeros(n + m, dtype=np.int32)
    sense[n:] = 5
    x, _, flag, _ = daqp.solve(H, g.copy(), C, upper, lower, sense, iter_limit=100000)
    if flag not in (1, 2):
        raise RuntimeError(f"exit flag {flag}")
    return x


def by_piqp(H, g, C, d, tolerance):
    """Interior point in C++."""
    n = len(g)
    solver = piqp.DenseSolver()
    solver.settings.eps_abs = solver.settings.eps_rel = tolerance
    solver.settings.max_iter = 500
    solver.setup(H, g, C, d, None, None, None, np.zeros(n), np.full(n, np.inf))
    status = solver.solve()
    if status != piqp.PIQP_SOLVED:
        raise RuntimeError(str(status).split(".")[-1])
    return np.array(solver.result.x)


def by_proxqp(H, g, C, d, tolerance):
    """Augmented Lagrangian in C++."""
    n = len(g)
    dense = proxsuite.proxqp.dense
    solver = dense.QP(n, len(d), 0, True)
    solver.settings.eps_abs, solver.settings.eps_rel, solver.settings.max_iter = tolerance, 0.0, 10000
    solver.init(H, g, C, d, None, None, None, np.zeros(n), np.full(n, 1e20))
    solver.solve()
    if solver.results.info.status != proxsuite.proxqp.QPSolverOutput.PROXQP_SOLVED:
        raise RuntimeError(str(solver.results.info.status).split(".")[-1])
    return solver.results.x.copy()


def by_quadprog(H, g, C, d, _):
    """Goldfarb-Idnani in Fortran."""
    constraints = np.hstack([C.T, np.eye(len(g))])
    return quadprog.solve_qp(H, -g, constraints, np.append(d, np.zeros(len(g))), len(d))[0]


def by_highs(H, g, C, d, _):
    """Primal active set in C++, default tolerances of 1e-7."""
    n, m = len(g), len(d)
    model = highspy.HighsModel()
    lp, hessian = model.lp_, model.hessian_
    lp.num_col_, lp.num_row_ = n, m
    lp.col_cost_, lp.col_lower_, lp.col_upper_ = g, np.zeros(n), np.full(n, highspy.kHighsInf)
    lp.row_lower_, lp.row_upper_ = d, d
    columns = scipy.sparse.csc_matrix(C)
    lp.a_matrix_.format_ = highspy.MatrixFormat.kColwise
    lp.a_matrix_.start_, lp.a_matrix_.index_, lp.a_matrix_.value_ = columns.indptr, columns.indices, columns.data
    hessian.dim_, hessian.format_ = n, highspy.HessianFormat.kTriangular
    hessian.start_, hessian.index_, hessian.value_ = H.indptr, H.indices, H.data
    solver = highspy.Highs()
    solver.setOptionValue("output_flag", False)
    solver.setOptionValue("threads", 1)
    solver.setOptionValue("qp_iteration_limit", 100 * n + 1000)
    solver.passModel(model)
    solver.run()
    status = solver.getModelStatus()
    if status != highspy.HighsModelStatus.kOptimal:
        raise RuntimeError(solver.modelStatusToString(status))
    return np.array(solver.getSolution().col_value)


def by_clarabel(H, g, C, d, tolerance):
    """Interior point in Rust, for sparse matrices."""
    n, m = len(g), len(d)
    settings = clarabel.DefaultSettings()
    settings.verbose = False
    settings.max_threads = 1
    settings.tol_gap_abs = settings.tol_gap_rel = settings.tol_feas = tolerance
    rows = scipy.sparse.vstack([scipy.sparse.csc_matrix(C), -scipy.sparse.identity(n, format="csc")], format="csc")
    solver = clarabel.DefaultSolver(H, g, rows, np.append(d, np.zeros(n)),
                                    [clarabel.ZeroConeT(m), clarabel.NonnegativeConeT(n)], settings)
    found = solver.solve()
    if found.status != clarabel.SolverStatus.Solved:
        raise RuntimeError(str(found.status))
    return np.array(found.x)


def by_osqp(H, g, C, d, tolerance):
    """Operator splitting (ADMM) in C, for sparse matrices, with its polishing."""
    n = len(g)
    rows = scipy.sparse.vstack([scipy.sparse.csc_matrix(C), scipy.sparse.identity(n, format="csc")], format="csc")
    solver = osqp.OSQP()
    solver.setup(H, g, rows, np.append(d, np.zeros(n)), np.append(d, np.full(n, np.inf)), verbose=False,
                 eps_abs=tolerance, eps_rel=tolerance, max_iter=1000000, polishing=True)
    found = solver.solve()
    if found.info.status != "solved":
        raise RuntimeError(found.info.status)
    return np.array(found.x)


def by_nnls(H, g, C, d, _):
    """Non-negative least squares of scipy: Cholesky factor, equilibrium as weighted rows."""
    n, weight = len(g), 1e6
    upper = scipy.linalg.cholesky(H)
    right = scipy.linalg.solve_triangular(upper, -g, trans="T")
    rows = np.vstack([upper, weight / n * C])
    return scipy.optimize.nnls(rows, np.append(right, weight / n * d), maxiter=30 * n)[0]


def by_tamaas(surface, e_star, length, pressure, tolerance):
    """Projected conjugate gradients (Polonsky and Keer; Rey) in C++, for a periodic surface."""
    tamaas.set_log_level(tamaas.LogLevel.error)
    model = tamaas.ModelFactory.createModel(tamaas.model_type.basic_1d, [length], [len(surface)])
    model.E, model.nu = e_star, 0.0
    kind = tamaas.PolonskyKeerRey.type.pressure
    solver = tamaas.PolonskyKeerRey(model, surface.copy(), tolerance, kind, kind)
    # Only the time limit ends it.
    solver.max_iter = 10**7
    error = solver.solve(pressure)
    if not error <= tolerance:
        raise RuntimeError(f"error {error:.1e}")
    return np.array(model.traction).ravel() * length / len(surface)


# Method, solver, tolerance, and larger tolerances where they are measured too.
QUADRATIC = [
    ("daqp", by_daqp, "", []),
    ("piqp", by_piqp, "1e-12", ["1e-4", "1e-6", "1e-8", "1e-10"]),
    ("proxqp", by_proxqp, "1e-9", ["1e-3", "1e-5", "1e-7"]),
    ("quadprog", by_quadprog, "", []),
    ("highs", by_highs, "", []),
    ("clarabel", by_clarabel, "1e-10", ["1e-4", "1e-6", "1e-8"]),
    ("osqp", by_osqp, "1e-3", []),
    ("scipy_nnls", by_nnls, "", []),
]
# Those that take one triangle of H as a sparse matrix, by columns.
TRIANGLE = {"highs": np.tril, "clarabel": np.triu, "osqp": np.triu}


def read_problem(path):
    """Header, gaps, tilt and its resultant, matrix."""
    with open(path + ".txt") as header:
        fields = dict(line.split() for line in header)
    n = int(fields["n"])
    data = np.fromfile(path + ".bin")
    gap, rest = data[:n], data[2 * n:]
    tilt = moment = matrix = None
    if fields["tilts"] == "1":
        tilt, moment, rest = rest[:n], rest[n], rest[n + 1:]
    if fields["matrix"] == "1":
        # Symmetric: the order of its storage does not matter.
        matrix = rest.reshape(n, n)
    return fields, gap, tilt, moment, matrix


def scaled(gap, load, tilt, moment, matrix):
    """H, g, C, d and the mean force."""
    n = len(gap)
    stiffness, mean = np.abs(matrix.diagonal()).max() or 1.0, load / n
    C, d = np.ones((1, n)), np.array([float(n)])
    if tilt is not None:
        reach = np.abs(tilt).max()
        C, d = np.vstack([C, tilt / reach]), np.append(d, moment / (mean * reach))
    return matrix / stiffness, gap / (stiffness * mean), C, d, mean


def own_residual(force, gap, load, e_star, length):
    """As in the program `judge`, with the operator of Tamaas: 2/(E* q) for each wave of the grid."""
    n = len(gap)
    wave = 2 * np.pi / length * np.arange(n // 2 + 1)
    wave[0] = np.inf
    deflection = np.fft.irfft(2 / (e_star * wave) * np.fft.rfft(force * n / length), n)
    pushing = np.maximum(force, 0.0)
    gaps = gap + deflection - (pushing * (gap + deflection)).sum() / pushing.sum()
    scale = max(np.ptp(deflection), 1e-3 * np.ptp(gap), load / e_star)
    return max(0.0, -gaps.min() / scale, -force.min() / force.max(), np.abs(force * gaps).sum() / (load * scale),
               abs(force.sum() - load) / load)


def measure(answers, directory, name):
    fields, gap, tilt, moment, matrix = read_problem(os.path.join(directory, name))
    n, load, family = len(gap), float(fields["load"]), fields["problem"]
    if matrix is not None:
        H, g, C, d, mean = scaled(gap, load, tilt, moment, matrix)
        for method, solver, tolerance, looser in QUADRATIC:
            given = scipy.sparse.csc_matrix(TRIANGLE[method](H)) if method in TRIANGLE else H
            for asked in (looser if name == "random_800" else []) + [tolerance]:
                answers.add(name, method, asked, family, solver, (given, g, C, d, float(asked or 0)), mean)
    if fields["periodic"] == "1" and n >= 64:
        e_star, length = float(fields["e_star"]), n * float(fields["width"])
        for asked in ROUGH_TOLERANCES if family in ("light", "heavy") else ["1e-8"]:
            problem = (gap.max() - gap, e_star, length, load / length, float(asked))
            answers.add(name, "tamaas", asked, family, by_tamaas, problem, 1.0,
                        lambda force: own_residual(force, gap, load, e_star, length))


def main():
    directory = sys.argv[1]
    names = [os.path.basename(path)[:-4] for path in glob.glob(os.path.join(directory, "*_*.txt"))]
    answers = Answers(directory, "answers.csv", TIMEOUT_QUICK if "quick" in sys.argv[2:] else TIMEOUT)
    family = ""
    # Smaller problems first.
    for name in sorted(names, key=lambda name: (name.split("_")[0], int(name.split("_")[1]))):
        if name.split("_")[0] != family:
            family = name.split("_")[0]
            print(f"              {family}", flush=True)
        measure(answers, directory, name)


main()
