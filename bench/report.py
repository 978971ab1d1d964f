"""Tables and the numbers of the pictures, from DIRECTORY/results.csv.

    python report.py DIRECTORY [DOCUMENT ...]

writes DIRECTORY/speed_error.csv, growth.csv, area_growth.csv and tables.md; in each DOCUMENT it replaces the text
between `<!-- NAME begin -->` and `<!-- NAME end -->`. What was not measured stays as it is, and is named, as are tables
that are typed by hand. Needs only Python.
"""
import csv
import math
import os
import re
import statistics
import sys
import textwrap

import area_report
import call_tables
from report_text import Table, cell, fit, memory, power, seconds, short, table, tidied, total

KNOWN = ("quartic", "cylinder", "wave", "flat", "tilted", "lifted")
# Codes for quadratic programs, and the tolerances of their rows.
QUADRATIC = {"daqp": None, "piqp": 1e-12, "proxqp": 1e-9, "quadprog": None, "highs": None, "clarabel": 1e-10,
             "osqp": 1e-3, "scipy_nnls": None}
PEERS = (*QUADRATIC, "tamaas", *area_report.CODES)
# README compares line contacts of this many points or more.
SMALLEST_LINE = 32
# Programs bound_*, each a part of one table.
BOUNDS = ("dense", "path", "fft", "surface", "condensation")
# Other programs that write their tables themselves, by the name of their place in the manual.
PROGRAMS = {"accuracy": "accuracy", "graded": "graded_cells", "costs": "costs", "products_of_scenes": "scenes",
            "general_scenes": "general_scenes", "general_scenes_mpi": "general_scenes_mpi",
            "surface_mpi": "surface_mpi", "mpi_model": "mpi_model", "steps": "load_steps", "stresses": "stresses",
            "rough": "rough_grids", "one_way": "structures",
            "load_cases": "load_cases", "increments": "increments", "threads": "threads",
            "threads_model": "threads_model", "layered_waves": "layered_waves",
            "layered_surfaces": "layered_surfaces", "proofs": "proofs",
            "gradients": "gradients", "wanted_error": "wanted_error", "proof_table": "proof_table"}
# The rows of these that the manual has; all of the others.
ROWS = {"graded": r"\| (?:contact|---|(?:cylinder|flat|lifted) \| (?:64|256) )"}
# Words of the programs, and those of the manual; and columns that the manual does not have.
WORDS = {"graded": ((r"\| cylinder \|", "| cylinder, edges |"), (r"\| flat \|", "| flat face, corners |"),
                    (r"\| lifted \|", "| tilted face that lifts off, one edge and one corner |")),
         "products_of_scenes": ((r"\b4096\b", "2^12"), (r"\b65536\b", "2^16"), (r"\b262144\b", "2^18"),
                                (r"(\d+)x(\d+)", r"\1 x \2")),
         "wanted_error": ((r"\| face \|", "| flat face |"), (r"\| jumps \|", "| flat face on a wider interval |"),
                          (r"\| wave \|", "| wave, periodic |"), (r"\| rough_light \|", "| rough, periodic, light |"),
                          (r"\| rough_heavy \|", "| rough, periodic, heavy |"),
                          (r"\| rough_barrel \|", "| rough cylinder |"),
                          (r"\| disc \|", "| flat disc |"), (r"\| rough_area \|", "| rough, periodic, area |")),
         "steps": ((r"\b(quartic|light|heavy)_(\d+)", r"\1 2^\2"),)}
# Engines that solve with a given matrix.
DENSE_ENGINES = {"tableau": "tableau", "active_set": "active set", "iterative": "iteration with a matrix"}
LEFT_OUT = {"steps": ("excess", "difference")}
ENGINES = ("tableau", "active_set", "iterative_dense", "iterative_fft")
# Errors that differ by less are rounding and the remaining residual of the solve.
ROUNDING = 2e-12
# Less memory than this is that of the program itself.
SMALL = 8e6


def label(method):
    return {"active_set": "active set, equal cells", "graded": "active set, graded cells",
            "iterative_fft": "iteration, FFT", "order": "iteration, FFT", "smooth": "smooth punch"}[method]


# The picture: panel, curve, n, error, time, failure.

def known_points(data):
    """Error of the pressure over the time from the profile to the answer."""
    for problem in KNOWN:
        grid = {row["n"]: row["error_pressure"] for row in data.where(problem=problem, method="active_set")}
        for row in data.where(problem=problem):
            method = row["method"]
            if method in ("active_set", "graded", "iterative_fft", "smooth"):
                yield problem, method, row["n"], max(row["error_pressure"], 1e-16), total(row), row["failure"]
            elif method in PEERS and row["failure"]:
                # A failure is placed at the error that its grid would have had.
                yield problem, method, row["n"], grid.get(row["n"]), None, row["failure"]
            elif method in PEERS:
                yield problem, method, row["n"], row["error_pressure"], total(row), ""


def solver_points(data, problem, n):
    """Residual over time; a failure is placed at the requested tolerance."""
    for row in data.where(problem=problem, n=n):
        method = row["method"]
        if method not in ("active_set", "iterative_dense", "iterative_fft", *PEERS):
            continue
        if row["failure"] and method in PEERS:
            yield problem, method, n, row["tolerance"] or 1e-15, None, row["failure"]
        else:
            yield problem, method, n, max(row["residual"], 1e-16), total(row), row["failure"]


def largest(data, problem, most):
    sizes = [row["n"] for row in data.where(problem=problem) if row["n"] <= most]
    return max(sizes) if sizes else 0


def write_picture(path, data, equal):
    points = list(known_points(data))
    points += solver_points(data, "random", largest(data, "random", 800))
    for problem in ("light", "heavy"):
        points += solver_points(data, problem, largest(data, problem, 65536))
    points += area_report.sphere_points(data)
    for problem in area_report.ROUGH:
        points += solver_points(data, problem, largest(data, problem, area_report.PICTURE))
    points += area_report.equal_points(equal) if equal else []
    panels = {p[0] for p in points}
    limit = {panel: max((p[4] for p in points if p[0] == panel and p[4]), default=1.0) for panel in panels}
    with open(path, "w", newline="") as out:
        writer = csv.writer(out, lineterminator="\n")
        writer.writerow(["panel", "curve", "n", "error", "time_s", "outcome"])
        curves = ("active_set", "graded", "iterative_dense", "iterative_fft", "smooth", *PEERS)
        points.sort(key=lambda p: (p[0], curves.index(p[1]), p[2], -(p[3] or 0.0)))
        for panel, curve, n, error, time, failure in points:
            if error is None:
                continue
            found = re.match(r"more than (\d+) s", failure)
            if time is None:
                time = float(found.group(1)) if found else 2.0 * limit[panel]
            writer.writerow([panel, curve, n, f"{error:.3e}", f"{time:.3e}", failure or "solved"])


def write_growth(path, data):
    with open(path, "w", newline="") as out:
        writer = csv.writer(out, lineterminator="\n")
        writer.writerow(["engine", "n", "time_s", "setup_s", "memory_bytes"])
        for engine in ENGINES:
            for row in sorted(data.where(problem="growth", method=engine), key=lambda row: row["n"]):
                writer.writerow([engine, row["n"], f"{row['time_s']:.3e}", f"{row['setup_s']:.3e}",
                                 "" if row["memory_bytes"] is None else f"{row['memory_bytes']:.3e}"])


# The tables.

def choice_table(data):
    """The fastest method for a given error; a curve counts from the grid from which on it stays below that error."""
    rows = []
    for column, text in (("error_pressure", "pressure"), ("error_halfwidth", "half width")):
        for target in (1e-3, 1e-6, 1e-9):
            cells = [f"{text}, {short(target)}"]
            for methods in (("active_set", "graded", "iterative_fft", "order"), ("smooth",)):
                found = fastest(data, methods, column, target)
                if found is None:
                    cells += ["none", "", ""] if len(methods) > 1 else ["", ""]
                elif len(methods) > 1:
                    cells += [f"{label(found['method'])}, {found['element']}", power(found["n"]), seconds(total(found))]
                else:
                    cells += [str(found["n"]), seconds(total(found))]
            rows.append(cells)
    return table(["relative error", "with cells", "n", "time", "smooth punch: coefficients", "time"], rows)


def fastest(data, methods, column, target):
    best = None
    for method in methods:
        for element in ("centre", "mean", "hat", ""):
            curve = sorted(data.where(problem="quartic", method=method, element=element), key=lambda row: -row["n"])
            reached = None
            for row in curve:
                if row[column] is None or row["failure"] or row[column] > target:
                    break
                reached = row
            if reached and (best is None or total(reached) < total(best)):
                best = reached
    return best


def order_table(data):
    """Slopes of logarithms by least squares, and the fit's value at 1000 cells."""
    rows = []
    for problem in ("quartic", "cylinder"):
        for element in ("centre", "mean", "hat"):
            cells = [f"{problem}, {element}"]
            for column in ("error_halfwidth", "error_pressure", "error_approach"):
                points = [(math.log(row["n"] / 1000.0), math.log(row[column]))
                          for row in data.where(problem=problem, method="order", element=element)
                          if row[column] and row[column] > ROUNDING]
                cells += list(fit(points))
            rows.append(cells)
        cells = [f"{problem}, mean, graded", "", ""]
        for column in ("error_pressure", "error_approach"):
            points = [(math.log(row["unknowns"] / 1000.0), math.log(row[column]))
                      for row in data.where(problem=problem, method="graded") if row[column]]
            cells += list(fit(points))
        rows.append(cells)
    head = ["order, error at n = 1000", "half width", "", "pressure", "", "approach", ""]
    return table(head, rows)


def dense_table(data):
    """fuge's dense engines and the peers: time and residual; the limit."""
    columns = [("quartic", n) for n in (64, 256, 1024)] + [("random", n) for n in (50, 200, 800, 2000)]
    columns = [key for key in columns if data.one(problem=key[0], n=key[1], method="active_set")]
    rows = []
    methods = (("active_set", "**active set**"), ("active_set_warm", "active set, warm"), ("tableau", "tableau"))
    for method, text in methods:
        rows.append([text, *[cell(data.one(problem=p, n=n, method=method)) for p, n in columns]])
    for method, tolerance in QUADRATIC.items():
        found = [data.one(problem=p, n=n, method=method, tolerance=tolerance) for p, n in columns]
        if any(found):
            rows.append([NAMES[method], *map(cell, found)])
    base = [data.one(problem=p, n=n, method="active_set") for p, n in columns]
    warm = [data.one(problem=p, n=n, method="active_set_warm") for p, n in columns]
    rows.append(["points in contact", *[f"{row['unknowns']:.0f}" for row in base]])
    rows.append(["limit: one `dposv`", *[seconds(row["limit_s"]) for row in base]])
    rows.append(["active set over the limit", *[f"{row['time_over_limit']:.1f}" for row in base]])
    rows.append(["warm over the limit", *[f"{row['time_over_limit']:.1f}" if row else "" for row in warm]])
    return table(["time, residual", *[f"{p} {n}" for p, n in columns]], rows)


NAMES = {"daqp": "DAQP", "piqp": "PIQP, 1e-12", "proxqp": "ProxQP, 1e-9", "quadprog": "quadprog", "highs": "HiGHS",
         "clarabel": "Clarabel, 1e-10", "osqp": "OSQP, polished", "scipy_nnls": "scipy nnls"}


def products_table(data):
    """Contacts by FFT at 1e-10, compact and rough, beside Tamaas."""
    rows = []
    for problem in ("quartic", "cylinder", "wave", "light", "heavy"):
        for n in (2**12, 2**16, 2**20):
            row = data.one(problem=problem, n=n, method="iterative_fft", tolerance=1e-10)
            if row is None:
                continue
            peer = data.one(problem=problem, n=n, method="tamaas", tolerance=1e-8)
            rows.append([f"{problem} 2^{n.bit_length() - 1}", f"{row['unknowns']:.0f}",
                         f"{row['products_or_pivots']:.0f} + {row['preconditionings'] or 0:.0f}",
                         seconds(row["setup_s"]), seconds(row["time_s"]), f"{row['time_over_limit']:.0f}",
                         short(row["residual"]), cell(peer)])
    head = ["problem", "in contact", "products + preconditioner", "operator", "solve", "over one product", "residual",
            "Tamaas, 1e-8"]
    return table(head, rows)


def growth_table(data):
    rows = []
    for engine in ENGINES:
        curve = sorted(data.where(problem="growth", method=engine), key=lambda row: row["n"])
        if len(curve) < 4:
            continue
        upper = curve[-max(3, len(curve) // 2):]
        last = curve[-1]
        cells = [engine.replace("_", " "), f"{curve[0]['n']} .. {power(last['n'])}"]
        for column in ("time_s", "memory_bytes"):
            points = [(math.log(row["n"]), math.log(row[column])) for row in upper
                      if row[column] and (column == "time_s" or row[column] > SMALL)]
            cells.append(f"n^{statistics.linear_regression(*zip(*points)).slope:.1f}" if len(points) > 2 else "")
        cells += [seconds(next((row["time_s"] for row in curve if row["n"] == n), None)) for n in (64, 256, 1024)]
        cells += [seconds(last["time_s"]), seconds(last["setup_s"]), memory(last["memory_bytes"])]
        rows.append(cells)
    head = ["engine", "n", "time grows", "memory grows", "n = 64", "n = 256", "n = 1024", "largest n", "its set-up",
            "its memory"]
    return table(head, rows)


def crossing(data, slower, faster, cost):
    """Smallest n of the growth curves from which on `faster` is the faster one."""
    left = {row["n"]: cost(row) for row in data.where(problem="growth", method=slower)}
    right = {row["n"]: cost(row) for row in data.where(problem="growth", method=faster)}
    both = sorted(set(left) & set(right), reverse=True)
    found = None
    for n in both:
        if right[n] >= left[n]:
            break
        found = n
    return found, (both[0] if both else None)


def crossing_list(data):
    """The crossings as sentences, because some do not exist."""
    names = {"tableau": "the tableau", "active_set": "the active set", "iterative_dense": "the iteration with a matrix",
             "iterative_fft": "the iteration by FFT"}
    lines = []
    for slower, faster, what, cost in (
            ("active_set", "iterative_fft", "matrix and operator included", total),
            ("active_set", "iterative_fft", "the solve alone", lambda row: row["time_s"]),
            ("active_set", "iterative_dense", "the solve alone", lambda row: row["time_s"]),
            ("tableau", "active_set", "the solve alone", lambda row: row["time_s"])):
        found, most = crossing(data, slower, faster, cost)
        if most is None:
            continue
        where = f"from n = {found} on" if found else f"nowhere up to n = {most}"
        lines.append(f"- {names[faster]} is faster than {names[slower]}, {what}: **{where}**\n")
    return "".join(lines)


def contents(directory, name):
    """The text of a file; empty without it."""
    path = os.path.join(directory, name)
    if not os.path.exists(path):
        return ""
    with open(path) as words:
        return words.read()


def machine_texts(directory):
    """The machine, the commit and the day, for the place where they are named and for the top of the page."""
    said = contents(directory, "machine.txt")
    if not said:
        return {}
    own = said.split("Peers: ")[0].strip().rstrip(".")
    measured = f"All figures are from one run of `script/bench --doc`: {own}."
    return {"machine": "\n".join(textwrap.fill(part, 120, break_on_hyphens=False) for part in said.splitlines()) + "\n",
            "measured": textwrap.fill(measured, 120, break_on_hyphens=False) + "\n", "older": ""}


def bound_table(directory):
    """The rows that the programs bound_* have written, below one head."""
    head, rows = "", []
    for part in BOUNDS:
        path = os.path.join(directory, f"bound_{part}.md")
        if not os.path.exists(path):
            continue
        with open(path) as lines:
            lines = lines.readlines()
        head, rows = "".join(lines[:2]), rows + lines[2:]
    return head + "".join(rows)


def condition_table(directory):
    """Largest errors of each engine's forces, and how many are silent, for each condition number: of all kinds of
    problems that `force_error_table` has solved."""
    found, columns = {}, []
    for engine, name in DENSE_ENGINES.items():
        rows = contents(directory, f"force_error_{engine}.md").splitlines()[2:]
        columns += [f"{name}: largest error", "silent"]
        for row in rows:
            _, condition, answers, error, *_, silent, _ = (cell.strip() for cell in row.strip("|").split("|"))
            worst, missed, all_answers = found.setdefault(condition, {}).get(engine, (0.0, 0, 0))
            found[condition][engine] = (max(worst, float(error)), missed + int(silent), all_answers + int(answers))
    if not found or any(len(cells) < len(DENSE_ENGINES) for cells in found.values()):
        return ""
    return table(["condition", *columns],
                 [[condition, *(text for worst, silent, answers in cells.values()
                                for text in (short(worst), f"{silent} of {answers}"))]
                  for condition, cells in found.items()])


def line_ratios(data, n):
    """Times of the fastest code for quadratic programs over those of the active set, on contacts with n points."""
    for problem in KNOWN:
        own = data.one(problem=problem, method="active_set", n=n)
        times = [total(row) for method in QUADRATIC
                 for row in data.where(problem=problem, method=method, n=n, failure="")]
        if own and times:
            yield min(times)/total(own)


def speed_text(data):
    """The claims of README: the span of all sizes, not the best one."""
    areas = area_report.speed_sentence(data)
    sizes = sorted({row["n"] for row in data.where(method="active_set") if row["n"] >= SMALLEST_LINE})
    ratios = [(n, list(line_ratios(data, n))) for n in sizes]
    ratios = [(n, found) for n, found in ratios if len(found) == len(KNOWN)]
    if not areas or not ratios:
        return ""
    (few, small), (many, large) = ratios[0], ratios[-1]
    lines = (f" For line contacts by a matrix the fastest of {len(QUADRATIC)} quadratic programming codes takes "
             f"{area_report.span(small)} times as long with {few} points, and {area_report.span(large)} times with "
             f"{many} (`script/bench --peers`).")
    return textwrap.fill(areas + lines, 120, break_on_hyphens=False) + "\n"


def main():
    directory = sys.argv[1]
    data = Table(os.path.join(directory, "results.csv"))
    equal = os.path.join(directory, "equal", "results.csv")
    equal = Table(equal) if os.path.exists(equal) else None
    write_picture(os.path.join(directory, "speed_error.csv"), data, equal)
    write_growth(os.path.join(directory, "growth.csv"), data)
    area_report.write_growth(os.path.join(directory, "area_growth.csv"), data)
    parts = {"choice": choice_table(data), "orders": order_table(data), "dense": dense_table(data),
             "products": products_table(data), "growth": growth_table(data), "crossings": crossing_list(data),
             "bound": tidied(bound_table(directory)), "conditions": condition_table(directory),
             "estimates": tidied(contents(directory, "force_error_active_set.md")),
             "speed": speed_text(data), **area_report.tables(data),
             "equal": area_report.equal_table(equal) if equal else "",
             **call_tables.tables(contents(directory, "choices.md"), contents(directory, "costs_bodies.md")),
             **{name: tidied(contents(directory, f"{program}.md"), ROWS.get(name, ""), WORDS.get(name, ()),
                             LEFT_OUT.get(name, ()))
                for name, program in PROGRAMS.items()}}
    said = machine_texts(directory)
    with open(os.path.join(directory, "tables.md"), "w") as out:
        out.write("\n".join(part for part in (said.get("machine", ""), *parts.values()) if part))
    measured = {name: part for name, part in parts.items() if part} | said
    for path in sys.argv[2:]:
        fill(path, measured | hard_tables(os.path.join(directory, "hard")))


def hard_tables(directory):
    """The tables that `stability_table` and `hard` have written."""
    if not os.path.exists(os.path.join(directory, "hard.md")):
        return {}
    with open(os.path.join(directory, "scenes.md")) as scenes, open(os.path.join(directory, "hard.md")) as peers:
        plain, general = scenes.read().split("\n\n")
        return {"hard_scenes": plain + "\n", "general": general, "peers": peers.read()}


def fill(path, parts):
    with open(path) as document:
        words = document.read()
    for name in re.findall(r"<!-- (\w+) begin -->", words):
        if name not in parts:
            print(f"fuge: {path}: '{name}' is not measured, and stays as it is", file=sys.stderr)
            continue
        mark = re.compile(f"(<!-- {name} begin -->\n).*?(<!-- {name} end -->)", re.S)
        words = mark.sub(lambda found: found.group(1) + parts[name] + found.group(2), words)
    for number, line in typed_tables(words):
        print(f"fuge: {path}, line {number}: a table with figures that is typed by hand: {line[:60]}", file=sys.stderr)
    with open(path, "w") as document:
        document.write(words)


def typed_tables(words):
    """Tables with times in them that no mark holds: the number of the line, and the head."""
    blank = re.sub(r"<!-- (\w+) begin -->.*?<!-- \1 end -->", lambda found: "\n" * found[0].count("\n"), words,
                   flags=re.S)
    for found in re.finditer(r"^(\|[^\n]*)\n\|[ :|-]+\n((?:\|[^\n]*\n)+)", blank, re.M):
        if re.search(r"\d (?:ms|us|µs|s|MB|GB) ", found[2]) or "µs" in found[1]:
            yield blank[:found.start()].count("\n") + 1, found[1]


main()
