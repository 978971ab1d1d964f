"""Other contact codes on the areas that `surfaces` wrote.

    python area_peers.py DIRECTORY [quick] [once]

`quick` gives a code less time, `once` does not repeat fast solves.

Reads each DIRECTORY/NAME.area and NAME.gaps; writes the forces found to NAME.METHODTOLERANCE and a line for each solve
to area_answers.csv: name, method, tolerance, time, nothing, memory, failure. The program `judge_surfaces` does the
rest. Each code runs in a process of its own, with one thread; the time is from the gaps to the pressures, operator
included. ASPHER is measured as its documentation solves by FFT, and with the settings that are fastest here: nested grids, the
preconditioner by FFT, single precision first.
"""
import glob
import os
import sys

from peer_runs import Answers

import aspher
import numpy as np
import tamaas
from ContactMechanics import FreeFFTElasticHalfSpace, PeriodicFFTElasticHalfSpace
from ContactMechanics.Systems import NonSmoothContactSystem
from SurfaceTopography import Topography

# Processor time in seconds until a code is stopped.
TIMEOUT, TIMEOUT_QUICK = 45, 10
# Of the sphere, of large rough surfaces, and of those in the picture: fewer for codes that take long.
SPHERE_TOLERANCE, LARGE_TOLERANCE = "1e-10", "1e-8"
TOLERANCES, FEW_TOLERANCES = ("1e-4", "1e-6", "1e-8", "1e-10"), ("1e-4", "1e-8")
# Cells along a side on which a code is run, at most: beyond it would only use up its time.
MOST = {"aspher": 2048, "aspher_nested": 2048, "tamaas": 1024, "contactmechanics": 512}


def by_aspher(gap, periodic, pressure, tolerance):
    """Projected conjugate gradients with a spectral preconditioner, in C++."""
    solver = aspher.ContactSolver(len(gap), backend="periodic" if periodic else "fft")
    found = solver.solve(gap.ravel(), pressure, tol=tolerance, precond="fourier-fft", max_iter=100000)
    return pressures(found)


def by_aspher_nested(gap, periodic, pressure, tolerance):
    """The same on nested grids, in single precision as far as that goes."""
    found = aspher.solve_nested(grid_size=len(gap), gap=gap.ravel(), p_nominal=pressure, tol=tolerance, coarsest=32,
                                backend="periodic" if periodic else "fft", precond_engine="fft",
                                precision="float_then_double", max_iter=100000)
    return pressures(found)


def pressures(found):
    if str(found.status) != "converged":
        raise RuntimeError(str(found.status))
    return np.asarray(found.pressure)


def by_tamaas(gap, periodic, pressure, tolerance):
    """Projected conjugate gradients in C++; dcfft is its operator of a free half-space."""
    tamaas.set_log_level(tamaas.LogLevel.error)
    model = tamaas.ModelFactory.createModel(tamaas.model_type.basic_2d, [1.0, 1.0], list(gap.shape))
    model.E, model.nu = 1.0, 0.0
    kind = tamaas.PolonskyKeerRey.pressure
    solver = tamaas.PolonskyKeerRey(model, gap.max() - gap, tolerance, kind, kind)
    if not periodic:
        tamaas.ModelFactory.registerNonPeriodic(model, "dcfft")
        solver.setIntegralOperator("dcfft")
    # Only the time limit ends it.
    solver.max_iter = 10**7
    error = solver.solve(pressure)
    if not error <= tolerance:
        raise RuntimeError(f"error {error:.1e}")
    return np.array(model.traction)


def by_tamaas_saturated(gap, periodic, pressure, tolerance, hardness):
    """Pressures up to the hardness (Kato), in C++."""
    tamaas.set_log_level(tamaas.LogLevel.error)
    model = tamaas.ModelFactory.createModel(tamaas.model_type.basic_2d, [1.0, 1.0], list(gap.shape))
    model.E, model.nu = 1.0, 0.0
    solver = tamaas.KatoSaturated(model, gap.max() - gap, tolerance, hardness)
    solver.max_iter = 10**7
    solver.solve(pressure)
    return np.array(model.traction)


def by_contactmechanics(gap, periodic, pressure, tolerance):
    """Projected conjugate gradients in Python; its tolerance is a length."""
    kind = PeriodicFFTElasticHalfSpace if periodic else FreeFFTElasticHalfSpace
    system = NonSmoothContactSystem(kind(gap.shape, 1.0, (1.0, 1.0)),
                                    Topography(gap.max() - gap, (1.0, 1.0), periodic=periodic))
    found = system.minimize_proxy(external_force=pressure, pentol=tolerance * np.ptp(gap), maxiter=100000)
    if not found.success:
        raise RuntimeError(str(found.message))
    n = len(gap)
    return np.asarray(found.jac)[:n, :n] * n * n


CODES = {"aspher": by_aspher, "aspher_nested": by_aspher_nested, "tamaas": by_tamaas,
         "contactmechanics": by_contactmechanics}
# Those that know a hardness.
SATURATED_CODES = {"tamaas": by_tamaas_saturated}


def read_area(path):
    with open(path + ".area") as header:
        fields = dict(line.split() for line in header)
    n = int(fields["n"])
    return fields, np.fromfile(path + ".gaps").reshape(n, n)


def main():
    directory = sys.argv[1]
    names = [os.path.basename(path)[:-5] for path in glob.glob(os.path.join(directory, "*.area"))]
    names.sort(key=lambda name: (name.rsplit("_", 1)[0], int(name.rsplit("_", 1)[1])))
    answers = Answers(directory, "area_answers.csv", TIMEOUT_QUICK if "quick" in sys.argv[2:] else TIMEOUT)
    done = set()
    for name in names:
        fields, gap = read_area(os.path.join(directory, name))
        family, n, periodic = fields["problem"], len(gap), fields["periodic"] == "1"
        print(f"              {family}, {n} x {n}", flush=True)
        problem = (gap, periodic, float(fields["pressure"]))
        saturated = "hardness" in fields
        pictured = periodic and family not in done and not saturated
        done.add(family)
        for method, solver in (SATURATED_CODES if saturated else CODES).items():
            tolerances = (LARGE_TOLERANCE if periodic else SPHERE_TOLERANCE,)
            if pictured:
                tolerances = TOLERANCES if method.startswith("aspher") else FEW_TOLERANCES
            for tolerance in tolerances if n <= MOST[method] else ():
                # Pressures to forces of the cells.
                hardness = (float(fields["hardness"]),) if saturated else ()
                answers.add(name, method, tolerance, family, solver, (*problem, float(tolerance), *hardness),
                            1.0 / n**2)


main()
