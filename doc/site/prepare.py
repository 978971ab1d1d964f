"""Write the input from which FORD makes the site: prepare.py ROOT WORK

WORK/src gets the public part of the sources, WORK/pages the pages: those of ROOT/doc with the
front matter that FORD needs and with links that are valid in the site, the C headers, the Python package, the
repository's files that pages link to, and a list of all names of module fuge. WORK/fragments.json has the
formulas and other parts that FORD does not see, WORK/navigation.json the tree of the pages.
"""

import pathlib
import re
import shutil
import sys

import headers
import landing
import navigation
import notebooks
import python_pages
from dialect import for_markdown, with_products
from fragments import Fragments
from links import outside_blocks, outside_code, with_links
from reduce import reduced, without_uses
from sources import FACADES, described, opening_sentence, public_modules, public_names, taken_names

# Modules in the order in which a reader meets them; others follow.
FIRST = ("fuge_solver_type", "fuge_problem_type", "fuge_options_type", "fuge_status", "fuge_matrix_operator",
         "fuge_halfplane_influence", "fuge_halfplane_fft", "fuge_halfspace_influence", "fuge_halfspace_fft",
         "fuge_hertz_theory", "fuge_edge_refinement", "fuge_certificate",
         "fuge_contact_path", "fuge_path_type", "fuge_elastic_moduli")
# A name of fuge as code that is no link yet.
NAME = re.compile(r"(?<!\[)`(fuge_\w+)`(?!\])")
# A constant of fuge.
CONSTANT = re.compile(r"\b(FUGE_[A-Z_]+)\b")
# Pages whose names are those of C, where Fortran has the same.
C_PAGES = ("tutorial_c.md",)
PACKAGE = "python/fuge/__init__.py"
ROOT_PAGES = ("README.md", "CONTRIBUTING.md", "CHANGELOG.md")
LANGUAGES = {".f90": "fortran", ".f": "fortranfixed", ".pf": "fortran", ".c": "c", ".h": "c", ".cpp": "cpp",
             ".py": "python", ".sh": "sh", ".cmake": "cmake", ".md": "markdown"}


class Site:
    """The pages and where each file of the repository is among them."""

    def __init__(self, root, work):
        self.root, self.work = root, work
        self.pages = work/"pages"
        self.names = public_names(root)
        self.fragments = Fragments()
        self.titles = {}
        self.place = {}
        for path in sorted((root/"doc").glob("*.md")):
            self.place[path] = path.stem
        for name in ROOT_PAGES:
            self.place[root/name] = name[:-3].lower()
        self.place[root/"src/facade/fuge.f90"] = "fortran"
        self.place[root/PACKAGE] = "python"
        self.c_names = {}
        for path in sorted([*(root/"include").glob("*.h"), *(root/"src/mpi/include").glob("*.h")]):
            self.place[path] = path.name.replace(".", "_")
            self.c_names[path.name] = f"{self.place[path]}.html"
            self.c_names.update({name: f"{self.place[path]}.html#{name}"
                                 for name in headers.anchors(path.read_text())})

    def write(self):
        """Write all pages; files that they link to become pages too."""
        self.pages.mkdir(parents=True)
        for path, name in self.place.items():
            if path.suffix == ".md":
                self.titles[name] = split_title(path.read_text())[0]
        for path in list(self.place):
            if path.suffix == ".f90":
                self.put(path, "Fortran interface", interface(self.root))
            elif path.suffix == ".h":
                self.put(path, path.name, headers.page(path.read_text(), self.c_names, self.fragments))
            elif path.suffix == ".py":
                self.put(path, "Python interface", python_pages.page(path.parent, self.fragments))
            else:
                title, body = split_title(path.read_text())
                self.put(path, title, self.linked(path, body))
        self.put_start()
        navigation.save(navigation.tree(self), self.work/"navigation.json")
        self.fragments.save(self.work/"fragments.json")

    def put(self, path, title, body):
        self.titles[self.place[path]] = title
        (self.pages/f"{self.place[path]}.md").write_text(f"---\ntitle: {title}\n---\n\n{body}")

    def put_start(self):
        """The landing page."""
        settings = (self.root/"doc/site/ford.md").read_text()
        version = re.search(r'FUGE_VERSION "(.*)"', (self.root/"include/fuge_core.h").read_text()).group(1)
        settings = settings.replace("project: fuge\n", f"project: fuge\nversion: {version}\n")
        readme = self.root/"README.md"
        body = landing.page(readme.read_text())
        (self.work/"ford.md").write_text(settings + "\n" + self.linked(readme, body, "page/"))

    def linked(self, page, text, prefix=""):
        """The text with links to files replaced by links to pages, and without its formulas."""
        def replace(match):
            target, _, anchor = match.group(2).partition("#")
            if "://" in target or not target:
                return match.group(0)
            path = (page.parent/target).resolve()
            name = self.picture(path) if path.suffix in (".png", ".svg") else f"{self.page_of(path)}.html"
            shown = match.group(1)
            # On the site pages have titles, not names of files.
            if shown == f"[{path.name}]" and path.suffix == ".md":
                shown = f"[{navigation.shown_title(self, self.place[path])}]"
            return f"{shown}({prefix}{name}{'#' + anchor if anchor else ''})"

        def refer(match):
            name = match.group(1)
            up = "" if prefix else "../"
            fortran = f"{up}{self.names[name]}/{name}.html" if name in self.names else None
            c = prefix + self.c_names[name] if name in self.c_names else None
            place = c or fortran if page.name in C_PAGES else fortran or c
            return f"[`{name}`]({place})" if place else match.group(0)
        text = self.fragments.hold_fenced_formulas(text)
        text = outside_code(text, lambda part: with_products(self.fragments.hold_formulas(part)))
        text = with_links(text, replace)
        return for_markdown(outside_blocks(text, lambda part: NAME.sub(refer, part)))

    def picture(self, path):
        if path.exists():
            shutil.copy(path, self.pages/path.name)
        return path.name

    def page_of(self, path):
        """The page of a file; one with its text, or its names if it is a folder, is made where there is none."""
        if path not in self.place:
            short = str(path.relative_to(self.root))
            if path.suffix == ".ipynb":
                self.place[path] = f"notebook_{path.stem}"
                title, body = notebooks.page(path, self.place[path], self.pages)
                self.put(path, title, self.linked(path, body))
                return self.place[path]
            self.place[path] = "file_" + re.sub(r"\W", "_", short)
            if path.is_dir():
                body = "".join(f"- {item.name}\n" for item in sorted(path.iterdir()))
            elif path.exists():
                text = path.read_text()
                said = opening_sentence(text)
                body = (f"{said}\n\n" if said else "") + code(text, LANGUAGES.get(path.suffix, "text"))
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


def interface(root):
    """All public names, by topic and module."""
    taken = taken_names(root)
    order = [name for name in FIRST if name in taken] + [name for name in taken if name not in FIRST]
    topics = {}
    for module, path, names in public_modules(root, order, taken):
        found = described(path.read_text())
        rows = f"\n### {module}\n\n{found[''][1]}\n\n| name | | |\n| --- | --- | --- |\n"
        for name in names:
            kind, text = found[name]
            shown = f"[{name}](../module/{module}.html)" if kind == "constant" else f"[[{name}]]"
            rows += f"| {shown} | {kind} | {text} |\n"
        topics.setdefault(navigation.topic(root, path), []).append(rows)
    body = ("`use fuge` gives all names of this page, by subject and by the module that defines them; only those on "
            "[sparse stiffness](#sparse-stiffness) need `use fuge_sparse`, and those on [surfaces over "
            "MPI](#surfaces-over-mpi) `use fuge_mpi`. Other lists: [all procedures](../lists/procedures.html), "
            "[all types](../lists/types.html), [all modules](../lists/modules.html), "
            "[abstract interfaces](../lists/absint.html).\n")
    for topic in navigation.in_order(topics):
        body += f"\n## {topic}\n" + "".join(topics[topic])
    return body


def write_sources(root, work):
    (work/"src").mkdir(parents=True)
    known = public_names(root)

    def refer(match):
        return f"[[{match.group(1)}]]" if match.group(1) in known else match.group(0)

    taken = taken_names(root)
    more = "!> All names, by subject: [Fortran interface](|page|/fortran.html).\n"
    for facade in FACADES:
        text = (root/facade).read_text()
        (work/"src"/pathlib.Path(facade).name).write_text(re.sub(r"^(?=module \w+$)", more, text, flags=re.M))
    for _, path, names in public_modules(root, list(taken), taken):
        text = without_uses(reduced(path.read_text(), set(names)), [*taken, "fuge_sparse"])
        text = re.sub(r"(?<=extends\()\w+", lambda base: public_base(root, base.group(0), known), text)
        text = re.sub(r"^ *!>.*$", lambda line: NAME.sub(refer, with_constants(line.group(0))), text, flags=re.M)
        (work/"src"/path.name).write_text(for_markdown(text, "!>"))


def public_base(root, base, known):
    """The type itself, or the next one of those that it extends which has a page."""
    if base not in known:
        for path in (root/"src").rglob("*.f90"):
            match = re.search(rf"^ *type\b.*extends\((\w+)\).*:: *{base}$", path.read_text(), re.M)
            if match:
                return public_base(root, match.group(1), known)
    return base


def with_constants(line):
    """A line of a docstring with the names of constants as code, and products as they are."""
    def marked(part):
        return CONSTANT.sub(r"`\1`", with_products(part))
    indent, _, said = line.partition("!>")
    return indent + "!>" + outside_code(said, marked)


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
