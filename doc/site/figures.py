"""The figures of the source as a table in a page: figures.py ROOT PAGE [--check]

A row for each component, the topmost folders of src/ with a CMakeLists.txt, between the marks `figures begin` and
`figures end` of PAGE, which is doc/architecture.md. With --check nothing is written; the exit status says whether each
figure there is within 3 % of that of the source.
"""

import pathlib
import re
import sys

COLUMNS = ("files", "lines", "folders", "modules", "procedures", "C functions", "public names")
TABLE = re.compile(r"(<!-- figures begin -->\n).*(<!-- figures end -->)", re.S)
INTERFACE = re.compile(r"^ *(?:abstract )?interface\b.*?^ *end interface", re.M | re.S)
PROCEDURE = re.compile(r"^ *(?!end\b)(?:[a-z][\w*=()]* +)*(?:subroutine|function) +\w+ *\(.*$", re.M | re.I)
TOLERANCE = 0.03


def component(source, path):
    """The component of a file: the topmost of its folders that has a CMakeLists.txt."""
    folders = [folder for folder in path.parents if source in folder.parents]
    return next((folder for folder in reversed(folders) if (folder/"CMakeLists.txt").exists()), folders[-1])


def counts(root):
    """The figures of each component, in the order of COLUMNS."""
    source = root/"src"
    files = [path for path in sorted(source.rglob("*")) if path.suffix in (".f90", ".f", ".c", ".h", ".inc")]
    texts = {path: path.read_text().replace("&\n", "") for path in files}
    place = {path.stem: component(source, path) for path in files}
    rows = {place[path.stem]: [0]*len(COLUMNS) for path in files}
    for path, text in texts.items():
        heads = PROCEDURE.findall(INTERFACE.sub("", text))
        found = [1, path.read_text().count("\n"), 0, len(re.findall(r"^module \w+$", text, re.M)), len(heads),
                 sum("bind(c" in head.lower() for head in heads), 0]
        rows[place[path.stem]] = [sum(pair) for pair in zip(rows[place[path.stem]], found)]
    for folder in {path.parent for path in files}:
        rows[component(source, folder/"file")][2] += 1
    for facade in re.findall(r"^ *use (\w+)$", texts[source/"facade/fuge.f90"], re.M):
        text = next(text for path, text in texts.items() if path.stem == facade)
        for module, names in re.findall(r"^ *use (\w+), *only: *(.*)$", text, re.M):
            rows[place[module]][6] += len(names.split(","))
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
           or any(abs(a - b) > TOLERANCE*b for a, b in zip(shown[name], row, strict=True))}
    if off:
        sys.exit(f"figures of {', '.join(sorted(off))} in {page} are off by more than 3 %: run doc/site/figures.py")


if __name__ == "__main__":
    main()
