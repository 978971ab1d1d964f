"""Runs of other solvers, each in a process of its own with limited processor time and one thread, or as many as the
argument `threads=N` of the program says."""
import os
import sys

THREADS = next((int(word.partition("=")[2]) for word in sys.argv if word.startswith("threads=")), 1)
for variable in ("OMP_NUM_THREADS", "OMP_THREAD_LIMIT", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[variable] = str(THREADS)
import multiprocessing
import resource
import signal
import time

import numpy as np

# How many times longer a busy machine may take; a solve is repeated for a fraction of a second.
BUSY = 3
PATIENCE = 0.0 if "once" in sys.argv else 0.1


def in_short(error):
    """A long message in short, without commas."""
    words = str(error).lower().replace("_", " ").replace(",", " ")
    for told, meant in (("positive definite", "not positive definite"), ("leading minor", "not positive definite"),
                        ("max iter", "iteration limit"), ("infs or nans", "not finite")):
        if told in words:
            return meant
    return (words.splitlines() or [type(error).__name__])[0][:40]


def resident(word):
    """A line of the status of this process, such as VmRSS or VmHWM, in bytes; 0 where there is none."""
    try:
        with open("/proc/self/status") as status:
            return next(1024 * int(line.split()[1]) for line in status if line.startswith(word))
    except (OSError, StopIteration):
        return 0


def forget_peak():
    """The largest resident memory counts from here on."""
    try:
        with open("/proc/self/clear_refs", "w") as flags:
            flags.write("5")
    except OSError:
        pass


def work(pipe, timeout, solver, *problem):
    """In a process of its own: the forces, the fastest time, and the memory that the solver takes."""
    resource.setrlimit(resource.RLIMIT_CPU, (THREADS * timeout, THREADS * timeout + 5))
    quiet = os.open(os.devnull, os.O_WRONLY)
    os.dup2(quiet, 1)
    os.dup2(quiet, 2)
    forget_peak()
    before = resident("VmRSS")
    try:
        times = []
        while not times or (sum(times) < 20 * PATIENCE and (len(times) < 3 or sum(times) < PATIENCE)):
            start, processor = time.perf_counter(), time.thread_time()
            force = solver(*problem)
            spent = time.perf_counter() - start
            # As in the benchmark, a long run of one thread counts by its processor time (that of the thread: under a
            # limit the clock of the process moves in ticks).
            by_processor = THREADS == 1 and spent > 1e-3
            times.append(min(spent, time.thread_time() - processor) if by_processor else spent)
        pipe.send((force, min(times), resident("VmHWM") - before, ""))
    except Exception as error:
        pipe.send((None, None, None, in_short(error)))


def run(solver, timeout, *problem):
    """Forces, time, memory, failure."""
    context = multiprocessing.get_context("fork")
    ours, theirs = context.Pipe()
    process = context.Process(target=work, args=(theirs, timeout, solver, *problem))
    process.start()
    theirs.close()
    late = (None, None, None, f"more than {timeout} s")
    try:
        # On a busy machine processor time passes more slowly.
        found = ours.recv() if ours.poll(BUSY * timeout) else late
    except EOFError:
        found = None
    if found is late:
        process.kill()
    process.join()
    if found is None:
        found = late if process.exitcode == -signal.SIGXCPU else (None, None, None, "crash")
    force, seconds, memory, failure = found
    if not failure:
        force = np.asarray(force, float).ravel()
        if not np.all(np.isfinite(force)):
            failure = "not finite"
    return force, seconds, memory, failure


class Answers:
    """Answers as files for `judge` and `judge_surfaces`, a line for each in `table`; a solver that ran out of time on a
    smaller problem is not run again. With several threads their number is part of the method's name."""

    def __init__(self, directory, table, timeout):
        self.directory, self.timeout, self.given_up = directory, timeout, {}
        self.out = open(os.path.join(directory, table), "w" if THREADS == 1 else "a")
        self.log = open(os.path.join(directory, "peers.log"), "a")

    def add(self, name, method, tolerance, family, solver, problem, mean=1.0, judged=None):
        """The forces, or None."""
        if THREADS > 1:
            method = f"{method}_{THREADS}"
        force = None
        failure = self.given_up.get((family, method))
        if not failure:
            force, seconds, memory, failure = run(solver, self.timeout, *problem)
            if failure.startswith("more than"):
                self.given_up[family, method] = failure
        residual = ""
        if not failure:
            (force * mean).tofile(os.path.join(self.directory, f"{name}.{method}{tolerance}"))
            residual = f"{judged(force):.3e}" if judged else ""
        fields = [name, method, tolerance, "" if failure else f"{seconds:.4e}", residual,
                  "" if failure else f"{memory:.4e}", failure]
        self.out.write(",".join(fields) + "\n")
        self.out.flush()
        print(*fields, file=self.log, flush=True)
        return None if failure else force * mean
