"""Write the pages from which Sphinx makes the site: pages.py ROOT WORK

One folder has all: README.md as index.md, the pages of doc/ (index.md as manual.md), the Fortran interface as
cmake/reference.cmake describes it, a page for each C header, for each notebook, and for each other file that a page
links to. Links to files become links to these pages, and names of fuge links to their descriptions.
"""

import base64
import itertools
import json
import pathlib
import re
import shutil
import subprocess
import sys
import textwrap

FENCED = re.compile(r"(^ *(?:```|~~~).*?^ *(?:```|~~~)~?$)", re.M | re.S)
# A link to a file. Words that are the name of a page give way to its title.
LINK = re.compile(r"(?:\[([\w.]+\.md))?\]\((?!\w+:)([^)\s#]+)(#[^)\s]*)?\)")
# A name as code, neither in a heading nor a link.
NAME = re.compile(r"^#.*$|(?<!\[)`(\w+)`(?!\])", re.M)
INDEX = re.compile(r"^<!-- index: (.*?) -->$", re.M)
ANCHOR = re.compile(r"^\((fuge_\w+)\)=$", re.M)
SECTION = re.compile(r"^/\* -+ (.*?) -+[ ]*(\*/)?$", re.M)
DECLARED = re.compile(r"^(?:\w[\w *]*?\b|typedef \w+ \(\*|\} |typedef struct \w+ )(fuge_\w+)\)?[(;]", re.M)
# The beginnings of lines that nobody reads.
GUARDS = re.compile(r"#(ifndef|define) \w+_H$|#(ifdef __cplusplus|endif|include <)|extern \"C\" {$|}$")
# The section of doc/index.md that is a table, with links to pages of all groups.
CHOICES = "What do you have?"
# The beginning of the names of pages that are not in the tree: each has the text of a file.
FILE = "file_"
LANGUAGES = ("f90", "c", "cpp", "py", "sh", "cmake")


class Pages:
    """The pages, by name, and where each file of the repository is among them."""

    def __init__(self, root, work):
        self.root, self.work, self.text = root, work, {}
        self.place = {root/"README.md": "index", root/"doc/index.md": "manual", root/"src/facade/fuge.f90": "fortran",
                      root/"python/fuge/__init__.py": "autoapi/fuge/index"}
        # Where names of Fortran and of C are described.
        self.names, self.c_names = {}, {}

    def write(self):
        sources = [self.root/"README.md", self.root/"CONTRIBUTING.md", self.root/"CHANGELOG.md",
                   *sorted((self.root/"doc").glob("*.md"))]
        for path in sources:
            self.place.setdefault(path, path.stem.lower())
        headers = sorted([*self.root.glob("include/*.h"), *self.root.glob("src/mpi/include/*.h")])
        self.place |= {path: path.stem + "_h" for path in headers}
        bodies = {path: header(path.read_text()) for path in headers}
        self.c_names = {name: f"{path.stem}_h.md#{name}" for path in headers for name in ANCHOR.findall(bodies[path])}
        for path in headers:
            self.text[self.place[path]] = self.linked(path, f"# {path.name}\n\n{bodies[path]}")
        self.fortran()
        for path in sources:
            self.text[self.place[path]] = self.linked(path, path.read_text())
        self.text["index"] += self.contents()
        for name, text in self.text.items():
            (self.work/f"{name}.md").write_text(text)

    def fortran(self):
        """The Fortran interface: a page for each component, and one that lists them."""
        whole = self.work/"whole.txt"
        components = re.findall(r"^ *use fuge_(\w+)$", (self.root/"src/facade/fuge.f90").read_text(), re.M)
        script = self.work/"reference.cmake"
        script.write_text(f'cmake_minimum_required(VERSION 3.20)\ninclude("{self.root}/cmake/reference.cmake")\n'
                          f'fuge_write_reference("{self.root}" "{whole}" {" ".join(components)})\n')
        subprocess.run(["cmake", "-P", script], check=True)
        opening, *sections = re.split(r"^(?=## )", whole.read_text(), flags=re.M)
        parts = {}
        for section in sections:
            part = re.match(r"## (?:The module fuge_|bodies/)?(\w+)", section)[1]
            parts.setdefault("fortran_" + part, []).append(section)
        for part, texts in parts.items():
            text = "".join(texts)
            self.names |= {name: f"{part}.md#{name}" for name in re.findall(r"^### (fuge_\w+)$", text, re.M)}
            self.names |= {name: f"{part}.md" for name in re.findall(r"^- `(FUGE_\w+)`", text, re.M)}
            self.text[part] = f"# Fortran: {part[8:]}\n\n{text}"
        opening = re.sub(r"\(#(\w+)\)", lambda match: f"({self.names[match[1]]})", opening)
        self.text["fortran"] = opening + toctree("", parts)

    def linked(self, path, text):
        """The text of a file with links to pages."""
        def link(match):
            target = (path.parent/match[2]).resolve()
            if target.suffix in (".png", ".svg", ".csv") and target.exists():
                shutil.copy(target, self.work)
                return f"]({target.name})"
            page = self.page_of(target)
            return f"{'[' if match[1] else ''}]({page}.{'rst' if '/' in page else 'md'}{match[3] or ''})"

        def refer(match):
            by_c = path.suffix == ".h" or path.name == "tutorial_c.md"
            first, second = (self.c_names, self.names) if by_c else (self.names, self.c_names)
            place = first.get(match[1]) or second.get(match[1])
            return f"[{match[0]}]({place})" if place else match[0]

        parts = FENCED.split(text)
        parts[::2] = [NAME.sub(refer, LINK.sub(link, part)) for part in parts[::2]]
        # Main entries come first in a search.
        return INDEX.sub(lambda match: f"```{{index}} ! {match[1].replace(', ', ', ! ')}\n```", "".join(parts))

    def page_of(self, path):
        """The page of a file; one with its text, or its names if it is a folder, is made where there is none."""
        if path in self.place:
            return self.place[path]
        short = path.relative_to(self.root).as_posix()
        if not path.exists():
            raise SystemExit(f"fuge: a page links to {short}, which is not there")
        is_notebook = path.suffix == ".ipynb"
        self.place[path] = name = ("notebook_" if is_notebook else FILE) + re.sub(r"\W", "_", short)
        if is_notebook:
            self.text[name] = self.notebook(path)
        else:
            text = "\n".join(sorted(item.name for item in path.iterdir())) if path.is_dir() else path.read_text()
            language = path.suffix[1:] if path.suffix[1:] in LANGUAGES else "text"
            self.text[name] = f"---\norphan: true\n---\n\n# {short}\n\n{fenced(text, language)}"
        return name

    def notebook(self, path):
        """Text, code, and what the cells print and draw."""
        parts = []
        for cell in json.loads(path.read_text())["cells"]:
            source = "".join(cell["source"])
            parts.append(self.linked(path, source) if cell["cell_type"] == "markdown" else fenced(source, "python"))
            for output in cell.get("outputs", []):
                if output["output_type"] == "stream":
                    parts.append(fenced("".join(output["text"]), "text"))
                else:
                    picture = self.work/f"{path.stem}_{len(parts)}.png"
                    picture.write_bytes(base64.b64decode(output["data"]["image/png"]))
                    parts.append(f"![A picture that the cell above draws]({picture.name})")
        return "\n\n".join(parts)

    def contents(self):
        """The tree of the pages: the sections of doc/index.md, and the pages to which they link."""
        named, trees = {"index"}, toctree("", ["manual"])
        for section in re.split(r"^## ", (self.root/"doc/index.md").read_text(), flags=re.M)[1:]:
            title, _, text = section.partition("\n")
            places = dict.fromkeys(self.place[(self.root/"doc"/match[2]).resolve()] for match in LINK.finditer(text))
            if title != CHOICES:
                trees += toctree(title, [name for name in places if name not in named and not name.startswith(FILE)])
                named.update(places)
        return trees


def toctree(caption, names):
    head = f":caption: {caption}\n" if caption else ""
    return "\n\n```{toctree}\n:hidden:\n" + head + "\n" + "\n".join(names) + "\n```\n"


def fenced(text, language):
    return f"~~~~{language}\n{text.rstrip()}\n~~~~\n"


def header(text):
    """The body of the page of a C header: headings, what comments say, and declarations."""
    page, level = "", "###" if SECTION.search(text) else "##"
    for part in re.split(r"\n\n+", text):
        section = SECTION.match(part)
        if section:
            page += f"## {section[1][0].upper()}{section[1][1:]}\n\n"
            part = part[section.end():] if section[2] else "/*" + part[section.end():]
        comment, code = re.match(r"\s*(/\*.*?\*/)?(.*)", part, re.S).groups()
        code = "\n".join(line for line in code.strip("\n").split("\n") if not GUARDS.match(line)).strip("\n")
        declared = DECLARED.findall(code)
        if declared:
            page += "".join(f"({name})=\n" for name in declared) + f"{level} {', '.join(declared)}\n\n"
        page += said(comment or "") + (fenced(code, "c") + "\n" if code else "")
    return page


def said(comment):
    """The text of a comment in C: paragraphs, and indented lines as they are."""
    inner = re.sub(r"^/\*+ ?|\s*\*/$|SPDX-License-Identifier: \S+", "", comment)
    lines = [re.sub(r"^ \* ?", "", line).rstrip() for line in inner.split("\n")]
    out = ""
    for is_code, group in itertools.groupby(lines, lambda line: line.startswith("  ")):
        text = "\n".join(group)
        if not is_code:
            text = re.sub(r"\b(?:fuge|FUGE)_\w+\b(?!\.h)", r"`\g<0>`", re.sub(r"[*<$\[\]#`]", r"\\\g<0>", text))
        out += fenced(textwrap.dedent(text), "text") + "\n" if is_code else text + "\n\n"
    return out


def main():
    root, work = (pathlib.Path(name).resolve() for name in sys.argv[1:3])
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    Pages(root, work).write()


if __name__ == "__main__":
    main()
