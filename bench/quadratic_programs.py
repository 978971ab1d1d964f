"""Quadratic programs of Maros and Meszaros: fuge.solve_qp beside DAQP and PIQP.

quadratic_programs.py FOLDER: the .mat files of github.com/qpsolvers/maros_meszaros_qpbenchmark (data/). Of these the
dense strictly convex ones are solved: at most 1000 variables and 10000 constraints, P positive definite to 1e-12 of its
largest eigenvalue. Prints problem | variables | rows | solver | seconds | primal residual | dual residual | gap, each
relative to the largest number that it sums; the best of three times.
"""

from __future__ import annotations

import sys
import time
import warnings
from pathlib import Path
from typing import Any, Iterator

import daqp
import numpy as np
import piqp
import scipy.io

import fuge

FAR = 1e20


def programs(folder: Path) -> Iterator[Program]:
    """Those that are dense and strictly convex."""
    for path in sorted(folder.glob("*.mat")):
        data = scipy.io.loadmat(path)
        rows, n = data["A"].shape
        if n > 1000 or rows - n > 10000:
            continue
        values = np.linalg.eigvalsh(data["P"].toarray())
        if values[0] > 1e-12 * values[-1]:
            yield Program(path.stem, data)


class Program:
    """min x^T P x/2 + q^T x, lower <= R x <= upper, lb <= x <= ub."""

    def __init__(self, name: str, data: dict[str, Any]) -> None:
        self.name = name
        self.p = data["P"].toarray().astype(float)
        self.q = data["q"].T.flatten().astype(float)
        n = self.q.size
        rows = data["A"].toarray().astype(float)
        lower, upper = data["l"].T.flatten().astype(float), data["u"].T.flatten().astype(float)
        # The last n rows are the bounds of the variables.
        self.rows, self.lower, self.upper = rows[:-n], lower[:-n], upper[:-n]
        self.lb, self.ub = (np.where(np.abs(v[-n:]) < FAR, v[-n:], np.copysign(np.inf, v[-n:])) for v in (lower, upper))

    def split(self) -> tuple[np.ndarray, ...]:
        """G, h, A, b."""
        equal = self.lower == self.upper
        above, below = ~equal & (self.upper < FAR), ~equal & (self.lower > -FAR)
        g = np.vstack([self.rows[above], -self.rows[below]])
        return g, np.r_[self.upper[above], -self.lower[below]], self.rows[equal], self.upper[equal]

    def residuals(self, x: np.ndarray, z: np.ndarray, y: np.ndarray, box: np.ndarray) -> tuple[float, float, float]:
        """Primal and dual residual and duality gap, relative."""
        g, h, a, b = self.split()
        outside = np.r_[g @ x - h, np.abs(a @ x - b), self.lb - x, x - self.ub, 0.0]
        sizes = np.r_[np.abs(h), np.abs(b), np.abs(g) @ np.abs(x), np.abs(a) @ np.abs(x), np.abs(x), 1e-300]
        forces = [self.p @ x, self.q, g.T @ z, a.T @ y, box]
        dual = np.abs(sum(forces)).max() / max(np.abs(force).max() for force in forces)
        bound = np.where(box > 0.0, self.ub, np.where(box < 0.0, self.lb, 0.0))
        terms = [x @ self.p @ x, self.q @ x, h @ z, b @ y, np.where(box != 0.0, box * bound, 0.0).sum()]
        return max(outside.max(), 0.0) / sizes.max(), dual, abs(sum(terms)) / max(np.abs(terms).max(), 1e-300)


def by_fuge(program: Program) -> tuple[np.ndarray, ...]:
    g, h, a, b = program.split()
    found = fuge.solve_qp(program.p, program.q, g, h, a, b, program.lb, program.ub)
    return found.x, found.z, found.y, found.z_box


def by_daqp(program: Program) -> tuple[np.ndarray, ...]:
    n, rows = program.q.size, np.ascontiguousarray(program.rows)
    upper, lower = np.r_[program.ub, program.upper], np.r_[program.lb, program.lower]
    upper, lower = np.clip(upper, -1e30, 1e30), np.clip(lower, -1e30, 1e30)
    sense = np.where(upper == lower, 5, 0).astype(np.int32)
    x, _, flag, info = daqp.solve(program.p, program.q, rows, upper, lower, sense)
    if flag < 1:
        raise ArithmeticError(f"flag {flag}")
    return split_multipliers(program, x, info["lam"][n:], info["lam"][:n])


def by_piqp(program: Program) -> tuple[np.ndarray, ...]:
    g, h, a, b = program.split()
    solver = piqp.DenseSolver()
    solver.settings.eps_abs, solver.settings.eps_rel = 1e-10, 1e-10
    none = np.full(h.size, -np.inf)
    solver.setup(program.p, program.q, a, b, g, none, h, program.lb, program.ub)
    status = solver.solve()
    if status != piqp.PIQP_SOLVED:
        raise ArithmeticError(str(status))
    found = solver.result
    return found.x, found.z_u, found.y, found.z_bu - found.z_bl


def split_multipliers(program: Program, x: np.ndarray, rows: np.ndarray, box: np.ndarray) -> tuple[np.ndarray, ...]:
    """Multipliers of two-sided rows as those of G and of A."""
    equal = program.lower == program.upper
    above, below = ~equal & (program.upper < FAR), ~equal & (program.lower > -FAR)
    return x, np.r_[np.maximum(rows[above], 0.0), np.maximum(-rows[below], 0.0)], rows[equal], box


def timed(solve: object, program: Program) -> tuple[float, tuple[np.ndarray, ...]]:
    seconds = np.inf
    for _ in range(3):
        start = time.perf_counter()
        found = solve(program)  # type: ignore[operator]
        seconds = min(seconds, time.perf_counter() - start)
    return seconds, found


def main() -> None:
    warnings.simplefilter("ignore", fuge.Warning)
    print("problem,variables,rows,solver,seconds,primal,dual,gap")
    for program in programs(Path(sys.argv[1])):
        for solver in (by_fuge, by_daqp, by_piqp):
            head = f"{program.name},{program.q.size},{len(program.rows)},{solver.__name__[3:]}"
            try:
                seconds, found = timed(solver, program)
            except (ArithmeticError, fuge.Error) as failure:
                print(f"{head},failed: {failure}", flush=True)
                continue
            print(head, f"{seconds:.2e}", *(f"{value:.1e}" for value in program.residuals(*found)), sep=",", flush=True)


if __name__ == "__main__":
    main()
