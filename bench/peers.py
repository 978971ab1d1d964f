"""Other solvers on the problems that the Fortran benchmark wrote.

    python peers.py DIRECTORY [TIMEOUT]

Reads DIRECTORY/dense.csv, NAME.txt and NAME.bin; writes peers.csv, and tables.md with fuge beside
the peers; then the half-plane by FFT, see peers_halfplane.py. Every solver gets the same scaled
problem (largest diagonal of H 1, mean of F 1)

    minimise F.HF/2 + g.F,   F >= 0,   sum F = S

in a process of its own, with one thread, and is judged by `residual`, which sees only its forces.
"""
import os
for variable in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[variable] = "1"
import csv
import importlib.metadata
import sys

import daqp
import numpy as np
import peers_halfplane
import piqp
import proxsuite
import quadprog
import scipy.linalg
import scipy.optimize
from peers_tools import TIMEOUT, line, milliseconds, run


def by_daqp(H, g, S):
    """Dual active set in C, default tolerances (tighter ones change nothing)."""
    n = len(g)
    lower, upper = np.zeros(n + 1), np.full(n + 1, 1e30)
    lower[n] = upper[n] = S
    sense = np.zeros(n + 1, dtype=np.int32)
    sense[n] = 5
    x, _, flag, _ = daqp.solve(H, g.copy(), np.ones((1, n)), upper, lower, sense, iter_limit=100000)
    if flag not in (1, 2):
        raise RuntimeError(f"exit flag {flag}")
    return x


def by_piqp(H, g, S):
    """Interior point in C++ to 1e-12."""
    n = len(g)
    solver = piqp.DenseSolver()
    solver.settings.eps_abs = solver.settings.eps_rel = 1e-12
    solver.settings.max_iter = 500
    solver.setup(H, g, np.ones((1, n)), np.array([S]), None, None, None, np.zeros(n), np.full(n, np.inf))
    status = solver.solve()
    if status != piqp.PIQP_SOLVED:
        raise RuntimeError(str(status))
    return np.array(solver.result.x)


def by_proxqp(H, g, S):
    """Augmented Lagrangian in C++ to 1e-9."""
    n = len(g)
    dense = proxsuite.proxqp.dense
    solver = dense.QP(n, 1, 0, True)
    solver.settings.eps_abs, solver.settings.eps_rel, solver.settings.max_iter = 1e-9, 0.0, 10000
    solver.init(H, g, np.ones((1, n)), np.array([S]), None, None, None, np.zeros(n), np.full(n, 1e20))
    solver.solve()
    if solver.results.info.status != proxsuite.proxqp.QPSolverOutput.PROXQP_SOLVED:
        raise RuntimeError(str(solver.results.info.status))
    return solver.results.x.copy()


def by_quadprog(H, g, S):
    """Goldfarb-Idnani in Fortran."""
    n = len(g)
    constraints = np.empty((n, n + 1))
    constraints[:, 0] = 1.0
    constraints[:, 1:] = np.eye(n)
    bounds = np.zeros(n + 1)
    bounds[0] = S
    return quadprog.solve_qp(H, -g, constraints, bounds, 1)[0]


def by_nnls(H, g, S):
    """Non-negative least squares of scipy: Cholesky factor, equilibrium as a weighted row."""
    n, weight = len(g), 1e6
    upper = scipy.linalg.cholesky(H)
    right = scipy.linalg.solve_triangular(upper, -g, trans="T")
    rows = np.vstack([upper, np.full((1, n), weight / n)])
    return scipy.optimize.nnls(rows, np.append(right, weight * S / n), maxiter=30 * n)[0]


def by_numpy_active_set(H, g, S):
    """Primal-dual active set in numpy, all points in contact at first."""
    contact = np.ones(len(g), bool)
    for _ in range(100):
        points = np.flatnonzero(contact)
        factor = scipy.linalg.cho_factor(H[np.ix_(points, points)], lower=True, check_finite=False)
        right = np.stack([np.ones(len(points)), g[points]], 1)
        ones, gaps = scipy.linalg.cho_solve(factor, right, check_finite=False).T
        approach = (S + gaps.sum()) / ones.sum()
        part = approach * ones - gaps
        force = np.zeros(len(g))
        force[points] = part
        change = contact.copy()
        change[points] = part > 0
        change[~contact] = (g + H[:, points] @ part - approach)[~contact] < 0
        if (change == contact).all():
            return force
        contact = change
    raise RuntimeError("cycle")


def by_numpy_gradients(H, g, S):
    """Projected conjugate gradients (Polonsky and Keer) in numpy to 1e-10."""
    n = len(g)
    force, direction, previous, keep = np.full(n, S / n), np.zeros(n), 1.0, 0.0
    for _ in range(20000):
        deflection = H @ force
        contact, slope = force > 0, deflection + g
        slope -= slope[contact].mean()
        squares, scale = (slope[contact] ** 2).sum(), np.ptp(deflection) + 1e-300
        outside = max(0.0, -slope[~contact].min()) if not contact.all() else 0.0
        if max((force * np.abs(slope)).sum() / S, outside) < 1e-10 * scale:
            return force
        direction = np.where(contact, slope + keep * squares / previous * direction, 0.0)
        previous = squares
        change = H @ direction
        change -= change[contact].mean()
        step = (slope * direction)[contact].sum() / (change * direction)[contact].sum()
        force = np.maximum(force - step * direction, 0.0)
        join = (force == 0) & (slope < 0)
        force[join] -= step * slope[join]
        keep = 0.0 if join.any() else 1.0
        force *= S / force.sum()
    raise RuntimeError("iteration limit")


SOLVERS = {
    "daqp": by_daqp,
    "piqp": by_piqp,
    "proxqp": by_proxqp,
    "quadprog": by_quadprog,
    "scipy_nnls": by_nnls,
    "numpy_active_set": by_numpy_active_set,
    "numpy_gradients": by_numpy_gradients,
}
LABELS = {
    "daqp": "DAQP {daqp} (dual active set, C)",
    "piqp": "PIQP {piqp}, 1e-12 (interior point, C++)",
    "proxqp": "ProxQP {proxsuite}, 1e-9 (augmented Lagrangian, C++)",
    "quadprog": "quadprog {quadprog} (Goldfarb-Idnani, Fortran)",
    "scipy_nnls": "scipy {scipy} nnls",
    "numpy_active_set": "primal-dual active set in numpy {numpy}",
    "numpy_gradients": "projected conjugate gradients in numpy {numpy}, 1e-10",
}


def residual(alpha, gap, load, force):
    """The worst scaled violation of non-negative gaps and forces, complementarity and equilibrium.

    From the forces alone: the approach is the one that makes the work of the gaps zero.
    """
    deflection = alpha @ force
    pushing = np.maximum(force, 0.0)
    approach = (pushing * (gap + deflection)).sum() / pushing.sum()
    gaps = gap + deflection - approach
    length = max(np.ptp(deflection), 1e-3 * np.ptp(gap))
    return max(
        max(0.0, -gaps.min()) / length,
        max(0.0, -force.min()) / force.max(),
        np.abs(force * gaps).sum() / (load * length),
        abs(force.sum() - load) / load,
    )


def read_problem(directory, name):
    with open(os.path.join(directory, name + ".txt")) as header:
        fields = dict(line.split() for line in header)
    n, load = int(fields["n"]), float(fields["load"])
    data = np.fromfile(os.path.join(directory, name + ".bin"))
    # alpha is symmetric: the order of its storage does not matter.
    return data[: n * n].reshape(n, n), data[n * n : n * n + n], load, data[n * n + n :]


def measure(directory, names, fuge, timeout):
    rows, given_up = [], set()
    for name in names:
        alpha, gap, load, force = read_problem(directory, name)
        n = len(gap)
        rows.append([name, "fuge", n, fuge[name]["time_s"], f"{residual(alpha, gap, load, force):.1e}", ""])
        stiffness, mean = np.abs(alpha.diagonal()).max(), load / n
        H, g = alpha / stiffness, gap / (stiffness * mean)
        for solver, solve in SOLVERS.items():
            # Its failure by time at a smaller n of the same family is one here.
            if (name[:2], solver) in given_up:
                rows.append([name, solver, n, "", "", "timeout"])
                continue
            found, seconds, failure = run(solve, timeout, H, g, float(n))
            if failure == "timeout":
                given_up.add((name[:2], solver))
            found = None if found is None else np.asarray(found, float).ravel()
            if found is not None and not np.all(np.isfinite(found)):
                failure = "not finite"
            if failure:
                rows.append([name, solver, n, "", "", failure])
            else:
                rows.append([name, solver, n, f"{seconds:.3e}", f"{residual(alpha, gap, load, found * mean):.1e}", ""])
            print(*rows[-1], flush=True)
    return rows


def write_tables(path, names, rows, measured):
    versions = {package: importlib.metadata.version(package) for package in
                ("daqp", "piqp", "proxsuite", "quadprog", "scipy", "numpy")}
    labels = {"fuge": "**fuge, active set**", **{key: text.format(**versions) for key, text in LABELS.items()}}
    cells = {(row[0], row[1]): row[5] or f"{milliseconds(row[3])} {float(row[4]):.0e}" for row in rows}
    with open(path, "w") as out:
        out.write(line("time, residual", *names) + line("---", *["---:"] * len(names)))
        for solver in ["fuge", *SOLVERS]:
            out.write(line(labels[solver], *[cells[name, solver].replace("e-0", "e-") for name in names]))
        out.write("\n" + line("fuge", *names) + line("---", *["---:"] * len(names)))
        point = {name: measured[name, "active_set"] for name in names}
        out.write(line("points in contact", *[point[name]["unknowns"] for name in names]))
        out.write(line("limit: one `dposv`", *[milliseconds(measured[name, "limit"]["time_s"]) for name in names]))
        for method in ("active_set", "active_set_warm", "tableau"):
            label = method.replace("_set_", " set, ").replace("_", " ")
            row = [measured.get((name, method)) for name in names]
            out.write(line(label + ", time", *[milliseconds(r["time_s"]) if r else "" for r in row]))
            ratios = [f"{float(r['time_over_limit']):.1f}" if r else "" for r in row]
            out.write(line(label + ", over the limit", *ratios))


def main():
    directory = sys.argv[1]
    timeout = float(sys.argv[2]) if len(sys.argv) > 2 else TIMEOUT
    with open(os.path.join(directory, "dense.csv")) as table:
        measured = {(row["problem"], row["method"]): row for row in csv.DictReader(table) if row["element"] != "mean"}
    names = [name for name, method in measured if method == "active_set"
             and os.path.exists(os.path.join(directory, name + ".txt"))]
    rows = measure(directory, names, {name: measured[name, "active_set"] for name in names}, timeout)
    with open(os.path.join(directory, "peers.csv"), "w", newline="") as out:
        table = csv.writer(out, lineterminator="\n")
        table.writerow(["problem", "method", "n", "time_s", "residual", "failure"])
        table.writerows(rows)
    write_tables(os.path.join(directory, "tables.md"), names, rows, measured)
    peers_halfplane.measure(directory, timeout)


main()
