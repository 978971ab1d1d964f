"""Tamaas on the rough periodic profiles that the Fortran benchmark of the half-plane wrote.

Adds rows to DIRECTORY/halfplane.csv: `tamaas`, and `judged` with the residual of fuge's forces by
the same definition. It sees nothing but the forces. Each answer is judged by the operator that its
solver uses: Tamaas displaces by 2/(E* q) at the waves of the grid, fuge adds what a grid cannot
tell from them (the elements' shorter waves), so the answers differ by the discretisation.
"""
import csv
import glob
import os

import numpy as np
import scipy.special
import tamaas
from peers_tools import run

TOLERANCE = 1e-8
# Where it ends is for the clock to say.
ITERATIONS = 10**7
SMALLEST, LARGEST = 2**12, 2**18


def by_tamaas(surface, load):
    """Projected conjugate gradients (Polonsky and Keer; Rey) in C++."""
    tamaas.set_log_level(tamaas.LogLevel.error)
    model = tamaas.ModelFactory.createModel(tamaas.model_type.basic_1d, [1.0], [len(surface)])
    model.E, model.nu = 1.0, 0.0
    kind = tamaas.PolonskyKeerRey.type.pressure
    solver = tamaas.PolonskyKeerRey(model, surface.copy(), TOLERANCE, kind, kind)
    solver.max_iter = ITERATIONS
    error = solver.solve(load)
    if not error <= TOLERANCE:
        raise RuntimeError(f"error {error:.1e}")
    return np.array(model.traction).ravel() / len(surface)


def tamaas_spectrum(n):
    """Displacement per force of a cell, period 1 and E* = 1."""
    wave = np.arange(n // 2 + 1, dtype=float)
    wave[0] = np.inf
    return n / (np.pi * wave)


def centre_spectrum(n):
    """The same for even pressure on each cell, seen at the centres: the sum over all waves that
    look alike there, by alternating series on both sides."""
    fraction = np.arange(1, n // 2 + 1) / n
    series = [0.25 * (scipy.special.zeta(2, 0.5 * a) - scipy.special.zeta(2, 0.5 * a + 0.5))
              for a in (fraction, 1.0 - fraction)]
    return np.append(0.0, np.sin(np.pi * fraction) / np.pi**2 * sum(series))


def residual(spectrum, gap, load, force):
    """The worst scaled violation of signs, complementarity and equilibrium, as in peers.py."""
    deflection = np.fft.irfft(spectrum * np.fft.rfft(force), len(force))
    pushing = np.maximum(force, 0.0)
    approach = (pushing * (gap + deflection)).sum() / pushing.sum()
    gaps = gap + deflection - approach
    length = np.ptp(deflection)
    return max(
        max(0.0, -gaps.min()) / length,
        max(0.0, -force.min()) / force.max(),
        np.abs(force * gaps).sum() / (load * length),
        abs(force.sum() - load) / load,
    )


def read_profile(directory, name):
    with open(os.path.join(directory, name + ".txt")) as header:
        fields = dict(line.split() for line in header)
    n = int(fields["n"])
    data = np.fromfile(os.path.join(directory, name + ".bin"))
    return data[:n], float(fields["load"]), data[n:]


def measure_one(directory, name, timeout, given_up):
    gap, load, force = read_profile(directory, name)
    n = len(gap)
    own = {"problem": name, "method": "judged", "element": "centre", "n": n, "tolerance": "1e-10",
           "residual": f"{residual(centre_spectrum(n), gap, load, force):.1e}"}
    peer = {"problem": name, "method": "tamaas", "n": n, "tolerance": f"{TOLERANCE:.0e}"}
    found, seconds, failure = None, None, "timeout"
    if not given_up:
        found, seconds, failure = run(by_tamaas, timeout, gap.max() - gap, load)
    if failure:
        peer["failure"] = failure
    else:
        peer |= {"time_s": f"{seconds:.3e}", "unknowns": np.count_nonzero(found > 0.0),
                 "residual": f"{residual(tamaas_spectrum(n), gap, load, found):.1e}"}
    print(*peer.values(), flush=True)
    return [own, peer]


def measure(directory, timeout):
    """Every profile there is, the smaller first."""
    path = os.path.join(directory, "halfplane.csv")
    names = [os.path.basename(name)[:-4] for family in ("light", "heavy", "nearfull")
             for name in glob.glob(os.path.join(directory, family + "_*.txt"))]
    names = [name for name in names if SMALLEST <= int(name.split("_")[1]) <= LARGEST]
    rows, given_up = [], set()
    for name in sorted(names, key=lambda name: int(name.split("_")[1])):
        family = name.split("_")[0]
        # Its failure by time at a smaller n of the same family is one here.
        rows += measure_one(directory, name, timeout, family in given_up)
        if rows[-1].get("failure") == "timeout":
            given_up.add(family)
    with open(path) as table:
        columns = table.readline().strip().split(",")
        others = [line for line in table if line.split(",")[1] not in ("tamaas", "judged")]
    with open(path, "w", newline="") as table:
        table.write(",".join(columns) + "\n")
        table.writelines(others)
        csv.DictWriter(table, columns, lineterminator="\n").writerows(rows)
