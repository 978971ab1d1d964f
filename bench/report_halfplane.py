"""Tables of DIRECTORY/halfplane.csv in Markdown: targets, compact and rough contact, convergence.

    python report_halfplane.py DIRECTORY

Needs nothing but Python. What was not measured is left empty.
"""
import csv
import math
import os
import statistics
import sys

BYTES = 8
# Half widths nearer to the exact one than this are rounding and what the solve leaves.
ROUNDING = 1e-10
# Seconds that peers_tools gives a peer.
TIMEOUT = 120.0
ROUGH = ("light", "heavy", "nearfull")


class Table:
    """Rows by problem and method; figures or None."""

    def __init__(self, path):
        with open(path) as table:
            self.rows = list(csv.DictReader(table))

    def row(self, problem, method, tolerance=None, element=("centre", "")):
        for row in self.rows:
            same = row["problem"] == problem and row["method"] == method and row["element"] in element
            if same and (tolerance is None or float(row["tolerance"]) == tolerance):
                return row
        return {}

    def figure(self, column, *key):
        text = self.row(*key).get(column)
        return float(text) if text else None

    def names(self, families):
        found = dict.fromkeys(row["problem"] for row in self.rows if row["method"] == "product")
        return sorted((name for name in found if name.split("_")[0] in families), key=lambda name: (
            families.index(name.split("_")[0]), size(name)))


def size(name):
    return int(name.split("_")[1])


def power(n):
    """4096 as 2^12."""
    return f"2^{n.bit_length() - 1}" if n & (n - 1) == 0 else str(n)


def label(name):
    return f"{name.split('_')[0]} {power(size(name))}"


def seconds(value):
    if value is None:
        return ""
    return f"{value:.3g} s" if value >= 1.0 else f"{1e3 * value:.3g} ms"


def figure(value, form="{:.3g}"):
    return "" if value is None else form.format(value)


def short(value):
    return "" if value is None else f"{value:.0e}".replace("e-0", "e-")


def line(cells):
    return "| " + " | ".join(cells) + " |\n"


def arrays(table, name):
    memory = table.figure("memory_bytes", name, "first")
    return None if memory is None else memory / (BYTES * size(name))


def over_peer(table, name):
    """fuge's operator and solve over the peer's, which takes no less than its limit if it failed by it."""
    parts = [table.figure("time_s", name, "set"), table.figure("time_s", name, "iterative", 1e-10)]
    peer = table.figure("time_s", name, "tamaas")
    if table.row(name, "tamaas").get("failure") == "timeout":
        peer = TIMEOUT
    return None if peer is None or None in parts else sum(parts) / peer


def counts(table, names):
    return [table.figure(column, name, "iterative", 1e-10) for name in names for column in ("products", "filters")]


def write_targets(out, table):
    compact = [f"{family}_{2**k}" for family in ("punch", "cylinder") for k in (12, 16, 20)]
    finest = [name for name in compact if size(name) == 2**20]
    rows = [
        ("products and filters, compact contact, 2^12 .. 2^20, 1e-10", 25, counts(table, compact)),
        ("products and filters, light and heavy 2^16, 1e-10", 250,
         counts(table, [f"{family}_{2**16}" for family in ("light", "heavy")])),
        ("time over one product, compact contact, 2^20, 1e-10", 40,
         [table.figure("time_over_product", name, "iterative", 1e-10) for name in finest]),
        ("memory, compact contact, 2^20: arrays of n numbers", 20, [arrays(table, name) for name in finest]),
        ("time over Tamaas, light 2^12", 0.3, [over_peer(table, "light_4096")]),
        ("time over Tamaas, heavy 2^12", 0.3, [over_peer(table, "heavy_4096")]),
        ("time over Tamaas, light 2^16", 0.05, [over_peer(table, "light_65536")]),
    ]
    out.write(line(["target", "at most", "measured", ""]) + line(["---", "---:", "---:", "---"]))
    for text, most, values in rows:
        known = [value for value in values if value is not None]
        worst = max(known) if known else None
        if worst is None:
            verdict = "not measured"
        else:
            verdict = ("met" if worst <= most else "missed") + (" where measured" if len(known) < len(values) else "")
        if "Tamaas" in text:
            name = text.split(", ")[1].replace(" 2^", "_")
            failure = table.row(f"{name.split('_')[0]}_{2**int(name.split('_')[1])}", "tamaas").get("failure")
            verdict += f", Tamaas: {failure}" if failure else ""
        out.write(line([text, figure(most), figure(worst), verdict]))


def write_solves(out, table, names):
    """What the engine alone is like, one problem to a line."""
    tolerances = sorted({float(row["tolerance"]) for row in table.rows
                         if row["method"] == "iterative" and row["problem"] in names}, reverse=True)
    known = any(table.figure("error_halfwidth", name, "iterative") is not None for name in names)
    head = ["problem", "in contact"]
    for tolerance in tolerances:
        head += [f"{short(tolerance)}: products, filters", "time", "over one product", "residual"]
    head += ["first solve", "operator", "product", "memory / n"] + ["half width", "pressure"] * known
    out.write(line(head) + line(["---", *["---:"] * (len(head) - 1)]))
    for name in names:
        cells = [label(name), figure(table.figure("unknowns", name, "iterative"), "{:.0f}")]
        for tolerance in tolerances:
            key = (name, "iterative", tolerance)
            pair = [figure(table.figure(column, *key), "{:.0f}") for column in ("products", "filters")]
            cells += [" + ".join(pair), seconds(table.figure("time_s", *key)),
                      figure(table.figure("time_over_product", *key), "{:.0f}"),
                      table.row(*key).get("failure") or short(table.figure("residual", *key))]
        cells += [seconds(table.figure("time_s", name, method)) for method in ("first", "set", "product")]
        cells.append(figure(arrays(table, name), "{:.0f}"))
        if known:
            # The smallest tolerance: its answer has the least of the solve in it.
            cells += [short(table.figure(column, name, "iterative", tolerances[-1]))
                      for column in ("error_halfwidth", "error_pressure")]
        out.write(line(cells))


def write_peer(out, table, names):
    out.write(line(["operator and solve; residual", *map(label, names)]) + line(["---", *["---:"] * len(names)]))
    fuge, peer, ratio = [], [], []
    for name in names:
        spent = table.figure("time_s", name, "set") + table.figure("time_s", name, "iterative", 1e-10)
        fuge.append(f"{seconds(spent)} {short(table.figure('residual', name, 'judged'))}")
        row = table.row(name, "tamaas")
        other = f"{seconds(table.figure('time_s', name, 'tamaas'))} {short(table.figure('residual', name, 'tamaas'))}"
        peer.append(row["failure"] or other)
        ratio.append(figure(over_peer(table, name), "{:.2g}"))
    out.write(line(["**fuge**, 1e-10", *fuge]))
    out.write(line(["Tamaas, 1e-8", *peer]))
    out.write(line(["fuge over Tamaas", *ratio]))


def order(points):
    """Slope of the errors over the widths in logarithms, by least squares."""
    if len(points) < 3:
        return None
    x, y = zip(*[(math.log(width), math.log(error)) for width, error in points])
    return statistics.linear_regression(x, y).slope


def write_convergence(out, table):
    series = [(family, element) for family in ("punch", "cylinder") for element in ("centre", "mean")]
    sizes = sorted({int(row["n"]) for row in table.rows if row["element"] == "mean"})
    for column, text, floor in (("error_halfwidth", "half width", ROUNDING), ("error_pressure", "pressure", 0.0)):
        errors = {(n, one): table.figure(column, f"{one[0]}_{n}", "iterative", 1e-12, (one[1],))
                  for n in sizes for one in series}
        out.write("\n" + line([f"error of the {text}, n", *[f"{family}, {element}" for family, element in series]]))
        out.write(line(["---:", *["---:"] * len(series)]))
        for n in sizes:
            out.write(line([str(n), *[figure(errors[n, one], "{:.1e}") for one in series]]))
        known = [[(1.0 / n, errors[n, one]) for n in sizes if (errors[n, one] or 0.0) > floor] for one in series]
        slopes = [order(points) for points in known]
        out.write(line(["order", *[figure(slope, "{:.2f}") for slope in slopes]]))


def main():
    directory = sys.argv[1]
    table = Table(os.path.join(directory, "halfplane.csv"))
    with open(os.path.join(directory, "halfplane.md"), "w") as out:
        write_targets(out, table)
        for families in (("punch", "cylinder"), ROUGH):
            names = table.names(families)
            if names:
                out.write("\n")
                write_solves(out, table, names)
        judged = [name for name in table.names(ROUGH) if table.row(name, "tamaas")]
        if judged:
            out.write("\n")
            write_peer(out, table, judged)
        write_convergence(out, table)


main()
