"""The rows of results.csv, and figures as texts."""
import csv
import math
import re
import statistics


class Table:
    """The rows of results.csv, their figures as numbers or None."""

    WORDS = ("problem", "method", "element", "failure")

    def __init__(self, path):
        with open(path) as table:
            self.rows = [{key: value if key in self.WORDS else float(value) if value else None
                          for key, value in row.items()} for row in csv.DictReader(table)]
        for row in self.rows:
            row["n"] = int(row["n"])

    def where(self, **wanted):
        return [row for row in self.rows if all(row[key] == value for key, value in wanted.items())]

    def one(self, **wanted):
        found = self.where(**wanted)
        return found[0] if found else None


def tidied(text, rows="", words=(), columns=()):
    """The tables of a program as in the manual: 1.5E-03 as 1.5e-3, .31 as 0.31, 1524 us as 1.5 ms, and single blanks.

    `rows`: a pattern with which a line has to begin. `words`: pairs of a pattern and what takes its place. `columns`:
    heads of those that are left out.
    """
    lines = [re.sub(r" +", " ", line).strip() for line in text.splitlines()
             if not line.strip() or (line.startswith("|") and re.match(rows, line))]
    lines = _without(columns, lines)
    # A table begins after a blank line.
    for k in range(len(lines) - 2, 0, -1):
        if lines[k + 1].startswith("| ---") and lines[k - 1]:
            lines.insert(k, "")
    text = re.sub(r"\b(\d)(\.\d*)?E([+-]\d+)", _plain_power, "\n".join(lines).strip("\n"))
    text = re.sub(r"(?<![\d\w])\.(?=\d)", "0.", text)
    text = re.sub(r"(?<![\w.^])(\d+(?:\.\d+)?(?:e-?\d+)?) (us|ms|s)\b(?! a )", _plain_time, text)
    for pattern, word in words:
        text = re.sub(pattern, word, text)
    return text + "\n" if text else ""


def _without(columns, lines):
    """The lines of tables without the columns of these heads."""
    kept, result = None, []
    for line in lines:
        cells = line.strip("|").split("|")
        if kept is None:
            kept = [k for k, cell in enumerate(cells) if cell.strip() not in columns]
        if not line:
            kept = None
        result.append("|" + "|".join(cells[k] for k in kept) + "|" if line else line)
    return result


def _plain_time(found):
    return seconds(float(found[1])*{"us": 1e-6, "ms": 1e-3, "s": 1.0}[found[2]])


def _plain_power(found):
    power = int(found[3])
    if -2 <= power <= 2:
        return f"{float(found[0]):g}"
    return found[1] + (found[2] or "").rstrip("0").rstrip(".") + f"e{power}"


def seconds(value):
    if value is None:
        return ""
    if value >= 1.0:
        return f"{value:.2g} s" if value < 9.95 else f"{value:.0f} s"
    scale, unit = (1e3, "ms") if value >= 1e-3 else (1e6, "us")
    value *= scale
    return f"{value:.2g} {unit}" if value < 99.5 else f"{value:.0f} {unit}"


def short(value):
    """Such as 2e-5; 0 for zero."""
    if value is None:
        return ""
    return "0" if value == 0.0 else re.sub(r"e([+-])0*(\d+)", r"e\g<1>\2", f"{value:.0e}").replace("e+", "e")


def power(n):
    return f"2^{n.bit_length() - 1}" if n & (n - 1) == 0 and n > 4096 else str(n)


def memory(value):
    """Such as 1.5 MB; a dash where the system does not tell the peak."""
    if value is None:
        return "-"
    if value >= 1e9:
        return f"{value / 1e9:.2g} GB"
    return f"{value / 1e6:.2g} MB" if value < 99.5e6 else f"{value / 1e6:.0f} MB"


def table(head, rows, left=1):
    """A table in Markdown, its first `left` columns aligned to the left, the others to the right."""
    lines = [head, [*["---"] * left, *["---:"] * (len(head) - left)], *rows]
    return "".join("| " + " | ".join(cells) + " |\n" for cells in lines)


def total(row):
    """On an area operator and first solve, elsewhere also the best of repeated solves."""
    if row.get("first_s") is not None:
        return row["first_s"]
    return None if row["time_s"] is None else row["time_s"] + (row["setup_s"] or 0.0)


def cell(row):
    if row is None:
        return ""
    if row["time_s"] is None:
        return row["failure"]
    failure = f" ({row['failure'][:20]})" if row["failure"] else ""
    return f"{seconds(row['time_s'])} {short(row['residual'])}{failure}"


def fit(points):
    if len(points) < 4:
        return "", ""
    line = statistics.linear_regression(*zip(*points))
    rest = [y - line.intercept - line.slope * x for x, y in points]
    spread = math.sqrt(sum(r * r for r in rest) / (len(points) - 2)
                       / sum((x - statistics.fmean(x for x, _ in points)) ** 2 for x, _ in points))
    return f"{-line.slope:.2f} +- {spread:.2f}", short(math.exp(line.intercept))
