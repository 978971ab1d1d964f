"""Other contact codes on the areas that `surfaces` wrote.

    python area_peers.py DIRECTORY [quick] [once] [threads=N | equal]

`quick` gives a code less time, `once` does not repeat fast solves; `threads=N` runs those codes that have threads by
as many, in elapsed time, and adds to the answers; `equal` runs each code to the tolerances that bring its error below
LEAST_ERROR, against the forces in NAME.reference.

Reads each DIRECTORY/NAME.area and NAME.gaps; writes the forces found to NAME.METHODTOLERANCE and a line for each solve
to area_answers.csv: name, method, tolerance, time, nothing, memory, failure. The program `judge_surfaces` does the
rest. Each code runs in a process of its own; the time is from the gaps to the pressures, operator included. ASPHER is
measured as its documentation solves by FFT, and with the settings that are fastest here: nested grids, the
preconditioner by FFT, single precision as far as FASTEST says, then double precision.
"""
import functools
import glob
import os
import sys

from peer_runs import THREADS, Answers

import aspher
import numpy as np
import tamaas
from ContactMechanics import FreeFFTElasticHalfSpace, PeriodicFFTElasticHalfSpace
from ContactMechanics.Systems import NonSmoothContactSystem
from SurfaceTopography import Topography

# Processor time in seconds until a code is stopped.
TIMEOUT, TIMEOUT_QUICK = 60, 10
# Of the sphere, of large rough surfaces, and of those in the picture: fewer for codes that take long.
SPHERE_TOLERANCE, LARGE_TOLERANCE = "1e-10", "1e-8"
TOLERANCES, FEW_TOLERANCES = ("1e-4", "1e-6", "1e-8", "1e-10"), ("1e-4", "1e-8")
# Cells along a side on which a code is run, at most: beyond it would only use up its time.
MOST = {"aspher": 2048, "aspher_nested": 2048, "tamaas": 1024, "contactmechanics": 512}
# ASPHER's fastest settings, of those tried on 512 x 512 and 1024 x 1024 cells: `coarsest` 16 to 64, `coarse_tol` 1e-2
# to 1e-6, `float_floor` 1e-4 to 2e-7, double precision alone, its three preconditioners, its H2 matrices on the active
# set, both rules of conjugate gradients, its build with FFTW for this processor, and its thresholds of the allocator.
FASTEST = {"sphere": {"coarse_tol": 1e-5, "float_floor": 5e-7},
           "light_area": {"coarse_tol": 1e-4, "float_floor": 5e-7},
           "heavy_area": {"coarse_tol": 1e-4, "float_floor": 2e-7}}
# At equal errors: what is fastest where single precision is enough, as far as it goes; which of the two, depends on
# scene and error.
SINGLE = {"aspher_single": {"precision": "float", "coarse_tol": 1e-3},
          "aspher_single_4": {"precision": "float", "coarse_tol": 1e-4}}
LEAST_SINGLE = 2e-6
# And tolerances of each code, and the error below which none tighter is tried.
EQUAL_TOLERANCES = [f"{digit}e-{power}" for power in range(1, 11) for digit in (3, 1)]
LEAST_ERROR = 1e-5


def by_aspher(gap, periodic, pressure, tolerance):
    """Projected conjugate gradients with a spectral preconditioner, in C++."""
    solver = aspher.ContactSolver(len(gap), backend="periodic" if periodic else "fft")
    found = solver.solve(gap.ravel(), pressure, tol=tolerance, precond="fourier-fft", max_iter=100000)
    return pressures(found)


def by_aspher_nested(settings, gap, periodic, pressure, tolerance):
    """The same on nested grids, in single and then in double precision."""
    found = aspher.solve_nested(grid_size=len(gap), gap=gap.ravel(), p_nominal=pressure, tol=tolerance, coarsest=32,
                                backend="periodic" if periodic else "fft", precond_engine="fft", max_iter=100000,
                                **({"precision": "float_then_double"} | settings))
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
# Those that know a hardness, and those that have threads.
SATURATED_CODES = {"tamaas": by_tamaas_saturated}
THREADED_CODES = ("aspher_nested", "tamaas")


def read_area(path):
    with open(path + ".area") as header:
        fields = dict(line.split() for line in header)
    n = int(fields["n"])
    return fields, np.fromfile(path + ".gaps").reshape(n, n)


def for_family(method, solver, family):
    """The solver with its settings for a family of problems."""
    if solver is not by_aspher_nested:
        return solver
    return functools.partial(solver, SINGLE.get(method) or FASTEST[family])


def measure(answers, done, name, fields, gap):
    """All codes on one surface: the tolerance of the tables, and several where it is in the picture."""
    family, n, periodic = fields["problem"], len(gap), fields["periodic"] == "1"
    problem = (gap, periodic, float(fields["pressure"]))
    saturated = "hardness" in fields
    pictured = periodic and family not in done and not saturated and THREADS == 1
    done.add(family)
    codes = SATURATED_CODES if saturated else CODES
    if THREADS > 1:
        codes = {} if saturated else {method: CODES[method] for method in THREADED_CODES}
    for method, solver in codes.items():
        tolerances = (LARGE_TOLERANCE if periodic else SPHERE_TOLERANCE,)
        if pictured:
            tolerances = TOLERANCES if method.startswith("aspher") else FEW_TOLERANCES
        for tolerance in tolerances if n <= MOST[method] else ():
            # Pressures to forces of the cells.
            hardness = (float(fields["hardness"]),) if saturated else ()
            answers.add(name, method, tolerance, family, for_family(method, solver, family),
                        (*problem, float(tolerance), *hardness), 1.0 / n**2)


def measure_errors(answers, directory, name, fields, gap):
    """Each code from its loosest tolerance on, until the error is small enough."""
    family, n, periodic = fields["problem"], len(gap), fields["periodic"] == "1"
    reference = np.fromfile(os.path.join(directory, name + ".reference"))
    for method, solver in (CODES | dict.fromkeys(SINGLE, by_aspher_nested)).items():
        for tolerance in EQUAL_TOLERANCES:
            if method in SINGLE and float(tolerance) < LEAST_SINGLE:
                break
            force = answers.add(name, method, tolerance, family, for_family(method, solver, family),
                                (gap, periodic, float(fields["pressure"]), float(tolerance)), 1.0 / n**2)
            if (family, method) in answers.given_up:
                break
            if force is not None and np.abs(force - reference).sum() < LEAST_ERROR * reference.sum():
                break


def main():
    directory = sys.argv[1]
    names = [os.path.basename(path)[:-5] for path in glob.glob(os.path.join(directory, "*.area"))]
    names.sort(key=lambda name: (name.rsplit("_", 1)[0], int(name.rsplit("_", 1)[1])))
    answers = Answers(directory, "area_answers.csv", TIMEOUT_QUICK if "quick" in sys.argv[2:] else TIMEOUT)
    done = set()
    for name in names:
        fields, gap = read_area(os.path.join(directory, name))
        threads = f", {THREADS} threads" if THREADS > 1 else ""
        print(f"              {fields['problem']}, {len(gap)} x {len(gap)}{threads}", flush=True)
        if "equal" in sys.argv[2:]:
            measure_errors(answers, directory, name, fields, gap)
        else:
            measure(answers, done, name, fields, gap)


main()
