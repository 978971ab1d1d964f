"""The figures of the source as a table in a page: figures.py ROOT PAGE [--check]

A row for each component of src/components.txt, between the marks `figures begin` and `figures end` of PAGE, which is
doc/architecture.md. With --check nothing is written; the exit status says whether each
figure there is within 3 % of that of the source.
"""

import pathlib
import re
import sys

COLUMNS = ("files", "lines", "folders", "modules", "procedures", "C functions", "public names")
TABLE = re.compile(r"(<!-- figures begin -->\n).*(<!-- figures end -->)", re.S)
INTERFACE = re.compile(r"^ *(?:abstract )?interface\b.*?^ *end interface", re.M | re.S)
PROCEDURE = re.compile(r"^ *(?!end\b)(?:[a-z][\w*=()]* +)*(?:subroutine|function) +\w+ *\(.*$", re.M | re.I)


def component(source, names, path):
    """The component of a file: the topmost of its folders that has one of the names, else the topmost one."""
    folders = [folder for folder in path.parents if source in folder.parents]
    return next((folder for folder in reversed(folders) if folder.name in names), folders[-1])


def counts(root):
    """The figures of each component, in the order of COLUMNS."""
    source = root/"src"
    files = [path for path in sorted(source.rglob("*")) if path.suffix in (".f90", ".f", ".c", ".h", ".inc")]
    texts = {path: path.read_text().replace("&\n", "") for path in files}
    names = re.findall(r"^\w+", (source/"components.txt").read_text(), re.M)
    place = {path: component(source, names, path) for path in files}
    rows = {place[path]: [0]*len(COLUMNS) for path in files}
    for path, text in texts.items():
        heads = PROCEDURE.findall(INTERFACE.sub("", text))
        found = [1, path.read_text().count("\n"), 0, len(re.findall(r"^module \w+$", text, re.M)), len(heads),
                 sum("bind(c" in head.lower() for head in heads), 0]
        rows[place[path]] = [sum(pair) for pair in zip(rows[place[path]], found)]
    for folder, name in {(path.parent, place[path]) for path in files}:
        rows[name][2] += 1
    defined = {path.stem: path for path in reversed(files)}
    for facade in re.findall(r"^ *use (\w+)$", texts[source/"facade/fuge.f90"], re.M):
        for module, public in re.findall(r"^ *use (\w+), *only: *(.*)$", texts[defined[facade]], re.M):
            rows[place[defined[module]]][6] += len(public.split(","))
    return {folder.relative_to(source).as_posix(): row for folder, row in rows.items()}


def table(rows):
    whole = [sum(column) for column in zip(*rows.values())]
    lines = ["| | " + " | ".join(COLUMNS) + " |", "| --- |" + " ---: |"*len(COLUMNS)]
    lines += [f"| {name} | " + " | ".join(map(str, row)) + " |" for name, row in [*rows.items(), ("all", whole)]]
    return "\n".join(lines) + "\n"


def numbers(text):
    rows = re.findall(r"^\|([^|]*\w *)\|([ \d|]*)\|$", text, re.M)
    return {name.strip(): list(map(int, row.split("|"))) for name, row in rows}


def main():
    page = pathlib.Path(sys.argv[2])
    text, new = page.read_text(), table(counts(pathlib.Path(sys.argv[1]).resolve()))
    if sys.argv[3:] != ["--check"]:
        page.write_text(TABLE.sub(lambda marks: marks[1] + new + marks[2], text))
        return
    shown, wanted = numbers(TABLE.search(text)[0]), numbers(new)
    off = shown.keys() - wanted.keys() | {name for name, row in wanted.items() if name not in shown
           or any(abs(a - b) > 0.03*b for a, b in zip(shown[name], row, strict=True))}
    if off:
        sys.exit(f"figures of {', '.join(sorted(off))} in {page} are off by more than 3 %: run doc/site/figures.py")


if __name__ == "__main__":
    main()
