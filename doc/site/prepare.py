"""Write the input from which FORD makes the site: prepare.py ROOT WORK

WORK/src gets the public part of the sources, WORK/pages the pages: those of ROOT/doc with the
front matter that FORD needs and with links that are valid in the site, the C headers, the repository's
files that pages link to, and a list of all names of module fuge.
"""

import pathlib
import re
import shutil
import sys

from dialect import for_markdown
from links import LINK, outside_blocks, outside_code, targets
from reduce import PROCEDURE, TYPE, exports, own_exports, reduced, without_uses

# Modules in the order in which a reader meets them; others follow.
FIRST = ("fuge_solver_type", "fuge_problem_type", "fuge_options_type", "fuge_status", "fuge_matrix_operator",
         "fuge_halfplane_influence", "fuge_halfplane_fft", "fuge_halfspace_influence", "fuge_halfspace_fft",
         "fuge_hertz_theory", "fuge_edge_refinement", "fuge_certificate",
         "fuge_contact_path", "fuge_path_type", "fuge_elastic_moduli", "fuge_profile_files", "fuge_profile_sampling")
# A name of fuge as code that is no link yet.
NAME = re.compile(r"(?<!\[)`(fuge_\w+)`(?!\])")
ROOT_PAGES = ("README.md", "CONTRIBUTING.md", "CHANGELOG.md")
LANGUAGES = {".f90": "fortran", ".f": "fortranfixed", ".pf": "fortran", ".c": "c", ".h": "c", ".cpp": "cpp",
             ".py": "python", ".sh": "sh", ".cmake": "cmake", ".md": "markdown"}


class Site:
    """The pages and where each file of the repository is among them."""

    def __init__(self, root, work):
        self.root, self.work = root, work
        self.pages = work/"pages"
        self.names = public_names(root)
        self.place = {}
        for path in sorted((root/"doc").glob("*.md")):
            self.place[path] = path.stem
        for name in ROOT_PAGES:
            self.place[root/name] = name[:-3].lower()
        self.place[root/"src/fuge.f90"] = "fortran"
        for path in sorted((root/"include").glob("*.h")):
            self.place[path] = path.name.replace(".", "_")

    def write(self):
        """Write all pages; files that they link to become pages too."""
        self.pages.mkdir(parents=True)
        for path in list(self.place):
            if path.suffix == ".f90":
                self.put(path, "Fortran interface", interface(self.root))
            elif path.suffix == ".h":
                self.put(path, path.name, header(path.read_text()))
            else:
                title, body = split_title(path.read_text())
                self.put(path, title, self.linked(path, body))
        self.put_order()

    def put(self, path, title, body):
        self.put_page(self.place[path], title, body)

    def put_page(self, name, title, body, more=""):
        (self.pages/f"{name}.md").write_text(f"---\ntitle: {title}\n{more}---\n\n{body}")

    def put_order(self):
        """The start page, and the pages in the order in which it names them."""
        start = self.root/"doc/index.md"
        named = []
        for target in targets(start.read_text()):
            path = (start.parent/target.split("#")[0]).resolve()
            if self.place.get(path) not in (None, "index", *named):
                named.append(self.place[path])
        # Pages of files come last.
        order = sorted(named, key=lambda name: name.startswith("file_"))
        for path, name in self.place.items():
            if path.parent == start.parent and path != start and name not in order:
                print(f"fuge: doc/index.md does not name {path.relative_to(self.root)}", file=sys.stderr)
        title, body = split_title(start.read_text())
        front = "".join(f"ordered_subpage: {name}.md\n" for name in order)
        self.put_page("index", title, self.linked(start, body), front)
        settings = (self.root/"doc/site/ford.md").read_text()
        body = self.linked(start, body, "page/")
        version = re.search(r'FUGE_VERSION "(.*)"', (self.root/"include/fuge.h").read_text()).group(1)
        settings = settings.replace("project: fuge\n", f"project: fuge\nversion: {version}\n")
        (self.work/"ford.md").write_text(settings + "\n" + body)

    def linked(self, page, text, prefix=""):
        """The text with links to files replaced by links to pages."""
        def replace(match):
            target, _, anchor = match.group(2).partition("#")
            if "://" in target or not target:
                return match.group(0)
            path = (page.parent/target).resolve()
            name = self.picture(path) if path.suffix in (".png", ".svg") else f"{self.page_of(path)}.html"
            return f"{match.group(1)}({prefix}{name}{'#' + anchor if anchor else ''})"
        def refer(match):
            name = match.group(1)
            up = "" if prefix else "../"
            return f"[`{name}`]({up}{self.names[name]}/{name}.html)" if name in self.names else match.group(0)
        text = outside_code(text, lambda part: LINK.sub(replace, part))
        return for_markdown(outside_blocks(text, lambda part: NAME.sub(refer, part)))

    def picture(self, path):
        if path.exists():
            shutil.copy(path, self.pages/path.name)
        return path.name

    def page_of(self, path):
        """The page of a file; one with its text, or its names if it is a folder, is made where there is none."""
        if path not in self.place:
            short = str(path.relative_to(self.root))
            name = "file_" + re.sub(r"\W", "_", short)
            self.place[path] = name
            if path.is_dir():
                body = "".join(f"- {item.name}\n" for item in sorted(path.iterdir()))
            elif path.exists():
                body = code(path.read_text(), LANGUAGES.get(path.suffix, "text"))
            else:
                raise SystemExit(f"fuge: a page links to {short}, which is not there")
            self.put(path, short, body)
        return self.place[path]


def split_title(text):
    """The heading of a page, and what follows."""
    title, _, body = text.partition("\n")
    if not title.startswith("# "):
        raise SystemExit(f"fuge: a page begins with '{title}' in place of a heading")
    return title[2:].strip(), body


def code(text, language):
    return f"~~~{language}\n{text.rstrip()}\n~~~\n"


def header(text):
    """A C header: its sections as headings, between them the code as it is."""
    parts = re.split(r"^/\* ---- (.*?) -+(?: \*/)?\n", text, flags=re.M)
    body = "[TOC]\n\n" + code(parts[0], "c")
    for name, part in zip(parts[1::2], parts[2::2]):
        # A section's comment may go on below its heading.
        opened = part.lstrip().startswith("*") and not part.lstrip().startswith("*/")
        body += f"\n## {name[:1].upper() + name[1:]}\n\n" + code(("/*\n" if opened else "") + part.strip("\n"), "c")
    return body


def first_sentence(doc):
    text = " ".join(line.strip()[2:].strip() for line in doc)
    text = text.split("  ")[0]
    return re.split(r"(?<=\.)\s", text)[0].rstrip(":") if text else ""


def described(source):
    """The description of each name of a source: kind and first sentence."""
    found, doc = {}, []
    for line in source.split("\n"):
        if line.lstrip().startswith("!>"):
            doc.append(line)
            continue
        constant = re.match(r"\s*(?:integer|character\(len=\*\)), parameter, public\s*::\s*(\w+)", line)
        if PROCEDURE.match(line):
            found[PROCEDURE.match(line).group(2)] = (PROCEDURE.match(line).group(1), first_sentence(doc))
        elif TYPE.match(line):
            found[TYPE.match(line).group(1)] = ("type", first_sentence(doc))
        elif constant:
            found[constant.group(1)] = ("constant", first_sentence(doc))
        elif re.match(r"module (\w+)", line):
            found[""] = ("module", first_sentence(doc))
        doc = []
    return found


def interface(root):
    """A table for each module that module fuge takes names from, and for fuge_sparse."""
    taken = exports((root/"src/fuge.f90").read_text())
    order = [name for name in FIRST if name in taken] + [name for name in taken if name not in FIRST]
    body = ("`use fuge` gives all names of this page but those of fuge_sparse. They are grouped by the module that "
            "defines them.\n")
    for module, path, names in public_modules(root, order, taken):
        found = described(path.read_text())
        body += f"\n## {module}\n\n{found[''][1]}\n\n| name | | |\n| --- | --- | --- |\n"
        for name in names:
            kind, text = found[name]
            shown = f"[{name}](../module/{module}.html)" if kind == "constant" else f"[[{name}]]"
            body += f"| {shown} | {kind} | {text} |\n"
    return body


def public_modules(root, order, taken):
    for module in order:
        yield module, next((root/"src").rglob(f"{module}.f90")), taken[module]
    sparse = root/"sparse/fuge_sparse.f90"
    yield "fuge_sparse", sparse, own_exports(sparse.read_text())


def public_names(root):
    """In which folder of the site each public procedure and type has its page."""
    taken = exports((root/"src/fuge.f90").read_text())
    found = {}
    for _, path, names in public_modules(root, list(taken), taken):
        said = described(path.read_text())
        found.update({name: "type" if said[name][0] == "type" else "proc"
                      for name in names if said[name][0] != "constant"})
    return found


def write_sources(root, work):
    (work/"src").mkdir(parents=True)
    known = public_names(root)

    def refer(match):
        return f"[[{match.group(1)}]]" if match.group(1) in known else match.group(0)

    facade = root/"src/fuge.f90"
    taken = exports(facade.read_text())
    more = "!> All names, by subject: [Fortran interface](|page|/fortran.html).\n"
    text = facade.read_text().replace("\nmodule fuge\n", f"\n{more}module fuge\n")
    (work/"src/fuge.f90").write_text(text)
    for _, path, names in public_modules(root, list(taken), taken):
        text = without_uses(reduced(path.read_text(), set(names)), [*taken, "fuge_sparse"])
        text = re.sub(r"^ *!>.*$", lambda line: NAME.sub(refer, line.group(0)), text, flags=re.M)
        (work/"src"/path.name).write_text(for_markdown(text, "!>"))


def main():
    root, work = (pathlib.Path(name).resolve() for name in sys.argv[1:3])
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    write_sources(root, work)
    Site(root, work).write()
    shutil.copytree(root/"doc/site/templates", work/"templates")
    shutil.copy(root/"doc/site/site.css", work)


if __name__ == "__main__":
    main()
