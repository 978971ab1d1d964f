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
    """Rows of fuge with the fastest other code on the same sphere, as (row, seconds, name), the smallest sphere first."""
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
    return (f"**Speed**: a sphere on {side(small)} x {side(small)} cells, for an error of {short(small['error_pressure'])}, "
            f"takes {seconds(total(small))}, and {seconds(small_time)} with the fastest other contact code measured, "
            f"{small_name}; on {side(large)} x {side(large)} cells, for {short(large['error_pressure'])}, "
            f"{seconds(total(large))} and {seconds(large_time)} with {large_name}. The fastest other code takes "
            f"{span(list(peer_ratios(data, 'sphere')))} times as long for spheres, and {span(rough)} times for rough "
            "surfaces.")


def tables(data):
    return {"areas": comparison_table(data), "saturated": saturated_table(data), "area_orders": order_table(data),
            "area_growth": growth_table(data)}
