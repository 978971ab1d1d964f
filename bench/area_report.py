"""Tables and pictures of areas, for report.py."""
import csv
import math
import statistics

from report_text import cell, fit, memory, seconds, short, table, total

ROUGH = ("light_area", "heavy_area")
# Codes that solve nothing but areas, and all of them.
CODES = ("aspher", "aspher_nested", "contactmechanics")
ALL_CODES = {"aspher": "ASPHER", "aspher_nested": "ASPHER, nested", "tamaas": "Tamaas",
             "contactmechanics": "ContactMechanics"}
NAMES = {"sphere": "sphere", "light_area": "rough, light", "heavy_area": "rough, heavy"}
# Points of the largest rough surface that is in the picture.
PICTURE = 512**2
# The size at which the orders give an error, in cells along a side.
AT = 256
# Errors that differ by less are rounding, and the remaining residual of the solve.
ROUNDING = 1e-11
# Problems with a hardness: the mean pressure in per cent of it follows.
SATURATED = "saturated_"
TOLERANCE = {"sphere": 1e-10, "light_area": 1e-8, "heavy_area": 1e-8}
# Cells along a side from which two threads are of interest.
THREADED = 512
# Errors of the pressure at which codes are compared, and which curve each method of the measurements belongs to.
EQUAL_ERRORS = (1e-2, 3e-3, 1e-3, 1e-4, 1e-5)
EQUAL_CURVES = {"iterative_fft": "iterative_fft", "aspher_nested": "aspher_nested", "aspher_single": "aspher_nested",
                "aspher_single_4": "aspher_nested", "aspher": "aspher", "tamaas": "tamaas",
                "contactmechanics": "contactmechanics"}
EQUAL_SETTINGS = {"aspher": "one grid", "aspher_nested": "single, then double precision",
                  "aspher_single": "single precision", "aspher_single_4": "single precision"}


def side(row):
    return math.isqrt(row["n"])


def sphere_points(data):
    """Error of the pressure over the time from the gaps to the answer."""
    grid = {row["n"]: row["error_pressure"] for row in data.where(problem="sphere", method="iterative_fft")}
    for row in data.where(problem="sphere"):
        if row["method"] == "iterative_fft" or row["method"] in ALL_CODES:
            # A failure is placed at the error that its grid would have had.
            yield ("sphere", row["method"], row["n"], row["error_pressure"] or grid.get(row["n"]), total(row),
                   row["failure"])


def growth(data, problem, method):
    """Rows by size: those of fuge are measured in processes of their own."""
    if method == "fuge":
        found = data.where(problem="area_growth", method=problem)
    else:
        found = data.where(problem=problem, method=method, tolerance=TOLERANCE[problem], failure="")
    return sorted(found, key=lambda row: row["n"])


def write_growth(path, data):
    with open(path, "w", newline="") as out:
        writer = csv.writer(out, lineterminator="\n")
        writer.writerow(["curve", "n", "time_s", "memory_bytes"])
        for problem in NAMES:
            for method in ("fuge", *(ALL_CODES if problem == "sphere" else ())):
                for row in growth(data, problem, method):
                    writer.writerow([f"{method}_{problem}", side(row), f"{total(row):.3e}",
                                     "" if row["memory_bytes"] is None else f"{row['memory_bytes']:.3e}"])


def comparison_table(data):
    """First solves of all codes, and the time of the fastest other one over that of fuge."""
    rows = []
    for problem in NAMES:
        for own in data.where(problem=problem, method="iterative_fft", tolerance=TOLERANCE[problem]):
            peers = [data.one(problem=problem, n=own["n"], method=method, tolerance=TOLERANCE[problem])
                     for method in ALL_CODES]
            times = [row["time_s"] for row in peers if row and not row["failure"]]
            n = side(own)
            rows.append([f"{NAMES[problem]}, {n} x {n}", f"{100.0 * own['unknowns'] / own['n']:.0f} %",
                         f"{own['products_or_pivots']:.0f} + {own['preconditionings']:.0f}",
                         f"**{seconds(own['first_s'])}** {short(own['residual'])}", seconds(own["time_s"]),
                         *map(cell, peers), f"{min(times) / own['first_s']:.1f}" if times else ""])
    head = ["problem", "in contact", "products + preconditioner", "fuge: operator and first solve", "next solve",
            *ALL_CODES.values(), "fastest other one over fuge"]
    return table(head, rows)


def speed_up(one, two):
    return f"{total(one) / total(two):.2f}" if one and two and not one["failure"] and not two["failure"] else ""


def thread_table(data):
    """First solves by one thread and by two, beside ASPHER and Tamaas."""
    rows = []
    for problem in NAMES:
        for own in data.where(problem=problem, method="iterative_fft", tolerance=TOLERANCE[problem]):
            asked = {"problem": problem, "n": own["n"], "tolerance": TOLERANCE[problem]}
            two = data.one(method="iterative_fft_2", **asked)
            one_other, two_other = (data.one(method=method, **asked) for method in ("aspher_nested", "aspher_nested_2"))
            if not two or (side(own) < THREADED
                           and data.where(problem=problem, method="iterative_fft_2", n=THREADED**2)):
                continue
            ratios = [f"{total(other) / total(found):.1f}" if other and not other["failure"] else ""
                      for found, other in ((own, one_other), (two, two_other))]
            rows.append([f"{NAMES[problem]}, {side(own)} x {side(own)}", seconds(total(own)), seconds(total(two)),
                         speed_up(own, two), cell(one_other), cell(two_other), speed_up(one_other, two_other),
                         cell(data.one(method="tamaas_2", **asked)), *ratios])
    head = ["problem", "fuge: one thread", "two", "times as fast", "ASPHER, nested: one thread", "two", "times as fast",
            "Tamaas: two", "ASPHER over fuge: one thread", "two"]
    return table(head, rows) if rows else ""


def fronts(data):
    """Of each problem and curve the measurements that nothing faster is as exact as: the largest error first."""
    for problem in NAMES:
        for curve in dict.fromkeys(EQUAL_CURVES.values()):
            found = [row for row in data.where(problem=problem)
                     if EQUAL_CURVES.get(row["method"]) == curve and row["error_solver"] is not None]
            front = []
            for row in sorted(found, key=lambda row: (row["error_solver"], total(row))):
                if not front or total(row) < total(front[-1]):
                    front.append(row)
            if front:
                yield problem, curve, front[::-1]


def equal_points(data):
    for problem, curve, front in fronts(data):
        for row in front:
            yield f"equal_{problem}", curve, row["n"], max(row["error_solver"], 1e-16), total(row), ""


def equal_table(data):
    """The least time in which each code reaches an error, over its tolerances and settings."""
    found = {(problem, curve): front for problem, curve, front in fronts(data)}
    rows = []
    for problem, name in NAMES.items():
        own_front = found.get((problem, "iterative_fft"), [])
        for error in EQUAL_ERRORS:
            least = {curve: min((row for row in found.get((problem, curve), []) if row["error_solver"] <= error),
                                key=total, default=None)
                     for curve in ("iterative_fft", *ALL_CODES)}
            own = least["iterative_fft"]
            if not own:
                continue
            aspher = min((least[curve] for curve in ("aspher", "aspher_nested") if least[curve]), key=total,
                         default=None)
            others = [aspher, least["tamaas"], least["contactmechanics"]]
            times = [total(row) for row in others if row]
            side_of = side(own_front[0])
            rows.append([f"{name}, {side_of} x {side_of}", short(error), f"**{seconds(total(own))}**",
                         short(own["tolerance"]), seconds(total(aspher)) if aspher else "",
                         EQUAL_SETTINGS[aspher["method"]] if aspher else "",
                         *(seconds(total(row)) if row else "" for row in others[1:]),
                         f"{min(times) / total(own):.1f}" if times else ""])
    head = ["problem", "error of the pressure", "fuge", "its tolerance", "ASPHER", "its setting", "Tamaas",
            "ContactMechanics", "fastest other one over fuge"]
    return table(head, rows) if rows else ""


def memory_table(data):
    """Memory of large free surfaces beyond the caller's arrays."""
    found = data.where(problem="area_memory")
    rows = []
    for n in sorted({row["n"] for row in found}):
        cells = [f"{math.isqrt(n)} x {math.isqrt(n)}", memory(8.0 * n)]
        for contact in ("whole", "tenth"):
            row = data.one(problem="area_memory", method=contact, n=n)
            if row is None or row["time_s"] is None:
                cells += [row["failure"] if row else "", "", ""]
            else:
                cells += [memory(row["memory_bytes"]),
                          f"{row['memory_bytes'] / n / 8.0:.1f}" if row["memory_bytes"] else "", seconds(total(row))]
        rows.append(cells)
    head = ["cells", "one array", "whole contact: memory", "arrays", "first solve", "a tenth in contact: memory",
            "arrays", "first solve"]
    return table(head, rows) if rows else ""


def saturated_table(data):
    """Surfaces with a hardness: from a few points at their limit to all of them, beside Tamaas."""
    rows = []
    found = [row for row in data.rows if row["problem"].startswith(SATURATED) and row["method"] == "iterative_fft"]
    for own in sorted(found, key=lambda row: (row["n"], int(row["problem"][len(SATURATED):]))):
        peer = data.one(problem=own["problem"], n=own["n"], method="tamaas")
        n = side(own)
        shares = [f"{100.0 * own[key] / own['n']:.2g} %" if own[key] < own["n"] else "100 %"
                  for key in ("unknowns", "limited")]
        rows.append([f"{n} x {n}", f"{int(own['problem'][len(SATURATED):])} %", *shares,
                     f"{own['products_or_pivots']:.0f} + {own['preconditionings']:.0f}",
                     f"**{seconds(own['first_s'])}** {short(own['residual'])}", seconds(own["time_s"]), cell(peer),
                     f"{total(peer) / own['first_s']:.0f}" if peer and not peer["failure"] else ""])
    head = ["cells", "mean pressure over hardness", "in contact", "at the limit", "products + preconditioner",
            "fuge: operator and first solve", "next solve", "Tamaas, `KatoSaturated`", "Tamaas over fuge"]
    return table(head, rows) if rows else ""


def order_table(data):
    rows = []
    for element in ("centre", "mean"):
        cells = [f"sphere, {element}"]
        for column in ("error_peak", "error_pressure", "error_approach", "error_halfwidth"):
            points = [(math.log(side(row) / AT), math.log(row[column]))
                      for row in data.where(problem="sphere", method="order", element=element)
                      if row[column] and row[column] > ROUNDING]
            cells += list(fit(points))
        rows.append(cells)
    head = [f"order, error at {AT} x {AT}", "largest pressure", "", "pressure", "", "approach", "", "radius", ""]
    return table(head, rows)


def growth_table(data):
    rows = []
    for problem, name in NAMES.items():
        for method in ("fuge", *ALL_CODES):
            curve = growth(data, problem, method)
            if len(curve) < 4:
                continue
            last = curve[-1]
            cells = [f"{name}, {ALL_CODES.get(method, '**fuge**')}", f"{side(curve[0])} .. {side(last)}"]
            for value in (total, lambda row: row["memory_bytes"]):
                points = [(math.log(side(row)), math.log(value(row))) for row in curve[-max(3, len(curve) // 2):]
                          if value(row)]
                cells.append(f"n^{statistics.linear_regression(*zip(*points)).slope:.1f}" if len(points) > 2 else "")
            cells += [seconds(total(last)), memory(last["memory_bytes"]),
                      f"{last['memory_bytes'] / last['n']:.0f}" if last["memory_bytes"] else "",
                      f"{last['time_over_limit']:.2f}" if last["time_over_limit"] else ""]
            rows.append(cells)
    head = ["problem", "n", "time grows", "memory grows", "largest n: first solve", "memory", "bytes per cell",
            "next solve over its products"]
    return table(head, rows)


def solved_spheres(data):
    """Rows of fuge with the fastest other code on the same sphere: (row, seconds, name), the smallest sphere first."""
    for own in sorted(data.where(problem="sphere", method="iterative_fft", tolerance=TOLERANCE["sphere"]),
                      key=lambda row: row["n"]):
        peers = [(total(row), name) for method, name in ALL_CODES.items()
                 for row in data.where(problem="sphere", n=own["n"], method=method, tolerance=TOLERANCE["sphere"])
                 if not row["failure"]]
        if peers:
            yield own, *min(peers)


def peer_ratios(data, problem):
    """Times of the fastest other code over those of fuge, on each size of a problem that another code has solved."""
    for own in data.where(problem=problem, method="iterative_fft", tolerance=TOLERANCE[problem]):
        times = [total(row) for method in ALL_CODES
                 for row in data.where(problem=problem, n=own["n"], method=method, tolerance=TOLERANCE[problem])
                 if not row["failure"]]
        if times:
            yield min(times)/total(own)


def span(ratios):
    return f"{min(ratios):.1f} to {max(ratios):.1f}"


def speed_sentence(data):
    """The claim of README on areas: the smallest and the largest sphere that another code has solved, and the span of
    the times of the fastest other code over those of fuge."""
    spheres = list(solved_spheres(data))
    rough = [ratio for problem in ROUGH for ratio in peer_ratios(data, problem)]
    if not spheres or not rough:
        return ""
    (small, small_time, small_name), (large, large_time, large_name) = spheres[0], spheres[-1]
    return (f"**Speed**: a sphere on {side(small)} x {side(small)} cells, for an error of "
            f"{short(small['error_pressure'])}, takes {seconds(total(small))}, and {seconds(small_time)} with the "
            f"fastest other contact code measured, {small_name}; on {side(large)} x {side(large)} cells, for "
            f"{short(large['error_pressure'])}, {seconds(total(large))} and {seconds(large_time)} with {large_name}. "
            f"The fastest other code takes {span(list(peer_ratios(data, 'sphere')))} times as long for "
            f"spheres, and {span(rough)} times for rough surfaces.")


def tables(data):
    return {"areas": comparison_table(data), "saturated": saturated_table(data), "area_orders": order_table(data),
            "area_growth": growth_table(data), "area_threads": thread_table(data), "area_memory": memory_table(data)}
