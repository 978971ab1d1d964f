"""What the measurements of other solvers share: processes of their own, times, tables."""
import multiprocessing
import os
import statistics
import time

TIMEOUT = 120.0
# A solver slower than this runs once, others until a second has passed, three times at least.
SLOW = 10.0


def work(pipe, solver, *problem):
    """In a process of its own: the forces, then the times."""
    quiet = os.open(os.devnull, os.O_WRONLY)
    os.dup2(quiet, 1)
    os.dup2(quiet, 2)
    try:
        times = []
        while not times or (times[0] < SLOW and (len(times) < 3 or sum(times) < 1.0) and len(times) < 1001):
            start = time.perf_counter()
            force = solver(*problem)
            times.append(time.perf_counter() - start)
        pipe.send((force, statistics.median(times), ""))
    except Exception as error:
        pipe.send((None, None, f"{type(error).__name__}: {error}".replace(",", " ").splitlines()[0][:60]))


def run(solver, timeout, *problem):
    """Forces, median time, failure."""
    context = multiprocessing.get_context("fork")
    ours, theirs = context.Pipe()
    process = context.Process(target=work, args=(theirs, solver, *problem))
    process.start()
    theirs.close()
    try:
        # A second of runs, three fast ones at most beyond the limit.
        result = ours.recv() if ours.poll(max(timeout, 3 * SLOW)) else (None, None, "timeout")
    except EOFError:
        result = (None, None, "crash")
    if process.is_alive():
        process.kill()
    process.join()
    if result[1] is not None and result[1] > timeout:
        result = (None, None, "timeout")
    return result


def milliseconds(seconds):
    value = 1e3 * float(seconds)
    if value >= 1000.0:
        return f"{value / 1e3:.1f} s"
    figures = f"{value:#.2g}".rstrip(".")
    return f"{figures} ms" if value < 100.0 else f"{value:.0f} ms"


def line(*cells):
    return "| " + " | ".join(cells) + " |\n"
