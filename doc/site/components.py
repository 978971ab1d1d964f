"""Draw who may use whom, by Graphviz: components.py TABLE PICTURE [--check]

TABLE is src/components.txt, PICTURE the SVG that is written. An arrow leads from a component to one that it may use;
arrows that follow from others are left out. With --check nothing is written, and Graphviz not needed; the exit status
says whether PICTURE has the components, words and arrows of TABLE.
"""

import html
import pathlib
import re
import subprocess
import sys
import textwrap

# What a component holds, in a few words for its box.
HOLDS = {
    "core": "problem, engines, certificate, proofs",
    "elastic": "moduli, cells, fields inside",
    "halfplane": "cells, edges of contact",
    "halfspace": "rectangles",
    "rings": "round bodies",
    "layers": "coated and graded bodies",
    "punches": "Hertz, smooth and round, no grid",
    "fe": "stiffness, pairs, bodies",
    "files": "results for ParaView",
    "accuracy": "grids for a wanted error",
    "facade": "the module fuge",
    "f77": "FORTRAN 77",
    "mpi": "surfaces over MPI",
    "sparse": "CHOLMOD",
}
LIBRARY = {"core", "elastic", "halfplane", "halfspace", "rings", "layers", "punches", "fe", "files", "accuracy"}


def arrows(table):
    """For each component those that it may use and reaches by no other one."""
    used = {name: set(after.split()) for name, after in re.findall(r"^([^#\s]+)[^#:\n]*:(.*)$", table, re.M)}

    def reached(name):
        return used[name].union(*(reached(other) for other in used[name]))
    return {name: sorted(mine - set().union(*(reached(other) for other in mine))) for name, mine in used.items()}


def words(name):
    return textwrap.wrap(HOLDS.get(name, ""), 18, break_on_hyphens=False)


def graph(arrows_of):
    """The graph in Graphviz's language."""
    lines = ['digraph { node [shape=box style="filled,rounded" fontname="Helvetica" fontsize=13 color="#9aa5b1"]',
             'edge [color="#4a5563" arrowsize=0.7] nodesep=0.2 ranksep=0.4']
    for name, targets in arrows_of.items():
        fill = "#dcecf7" if name in LIBRARY else "#fbe9d0"
        text = "<br/>".join([f"<b>{name}</b>", *map(html.escape, words(name))])
        lines.append(f'"{name}" [label=<{text}> fillcolor="{fill}"]')
        lines += [f'"{name}" -> "{target}"' for target in targets]
    return "\n".join([*lines, "}"])


def main():
    table, picture = (pathlib.Path(name) for name in sys.argv[1:3])
    arrows_of = arrows(table.read_text())
    if sys.argv[3:] != ["--check"]:
        picture.write_bytes(subprocess.run(["dot", "-Tsvg"], input=graph(arrows_of).encode(), check=True,
                                           capture_output=True).stdout)
        return
    drawn = html.unescape(picture.read_text())
    wanted = {*arrows_of, *(f"{name}->{target}" for name, targets in arrows_of.items() for target in targets)}
    shown = set(re.findall(r"<g id=.*\n<title>(.*)</title>", drawn)) - {"%0", "%3"}
    if shown != wanted or not all(f">{line}<" in drawn for name in arrows_of for line in words(name)):
        sys.exit(f"{picture} is not what {table} gives: run\n  python3 doc/site/components.py {table} {picture}")


if __name__ == "__main__":
    main()
