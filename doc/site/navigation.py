"""The tree of the site's pages: groups and pages as doc/index.md names them, and the names of the Fortran interface.

The second headings of doc/index.md are the groups, and the pages to which its sections link are in them, in that
order. Pages are named by their headings. Every page of doc/ has to be there.
"""

import html
import json
import re

from links import targets
from sources import described, opening_sentence, public_modules, taken_names

# Topics of the Fortran interface: folders of src/, the most exact name first.
TOPICS = {
    "core/solver/path": "Load path and history", "core/dense": "Load path and history", "core/solver": "Solver",
    "core/problem": "Problem and options", "core/base": "Status and kinds", "core": "Core",
    "bodies/halfplane": "Half-plane", "bodies/halfspace": "Half-space", "bodies/rings": "Rings",
    "bodies/punches/smooth": "Smooth punch", "bodies/punches/round": "Round punch", "bodies/punches": "Fields of punches",
    "bodies/layers": "Layers", "bodies/elastic": "Elastic bodies",
    "fe/condensation": "Finite elements", "sparse": "Sparse stiffness", "fe/assembly": "Several bodies", "fe": "Pairs of surfaces", "files": "Results for ParaView", "mpi": "Surfaces over MPI",
}
# The modules that give the names of topics with a library of their own.
LIBRARIES = {"Sparse stiffness": "fuge_sparse", "Surfaces over MPI": "fuge_mpi"}
# The section of doc/index.md that is a table of what to call, with links to pages of all groups.
CHOICES = "What do you have?"
# Pages whose headings do not say what they are among others.
TITLES = {"readme": "Overview"}


def topic(root, path):
    """The topic of a source: that of its folder."""
    folder = path.relative_to(root/"src").parent.as_posix()
    return next(title for name, title in TOPICS.items() if f"{folder}/".startswith(f"{name}/"))


def in_order(topics):
    order = list(dict.fromkeys(TOPICS.values()))
    return sorted(topics, key=lambda name: order.index(name) if name in order else len(order))


def tree(site):
    """The groups: pairs of a title and entries [title, address, entries below it]."""
    start = site.root/"doc/index.md"
    groups, named = [], {"index"}
    for section in re.split(r"^## ", start.read_text(), flags=re.M)[1:]:
        title, _, text = section.partition("\n")
        if title.strip() == CHOICES:
            continue
        entries = []
        for target in targets(text):
            name = site.place.get((start.parent/target.split("#")[0]).resolve())
            if name and name not in named:
                named.add(name)
                entries.append(_entry(site, name))
        groups.append([title.strip(), entries])
    missing = [path for path, name in site.place.items() if path.parent == start.parent and path.suffix == ".md"
               and name not in named]
    if missing:
        raise SystemExit(f"fuge: doc/index.md does not name {', '.join(path.name for path in missing)}")
    others = [_entry(site, name) for name in site.place.values() if name not in named]
    return [["Contents", [["The manual", "page/index.html", []]]], *groups,
            ["Other files", sorted(others, key=lambda entry: entry[1])]]


def _entry(site, name):
    below = fortran_topics(site.root) if name == "fortran" else []
    return [shown_title(site, name), f"page/{name}.html", below]


def shown_title(site, name):
    """The title of a page; of a source file what it says about itself."""
    title = TITLES.get(name) or site.titles[name]
    if name.startswith("file_"):
        path = site.root/title
        said = opening_sentence(path.read_text()) if path.is_file() else None
        return re.split(r"[:.](?: |$)", said)[0] + f" ({path.name})" if said else title
    return title


def fortran_topics(root):
    """The topics with their types and procedures."""
    taken = taken_names(root)
    found = {}
    for _, path, names in public_modules(root, list(taken), taken):
        said = described(path.read_text())
        entries = found.setdefault(topic(root, path), [])
        entries.extend([name, f"{'type' if said[name][0] == 'type' else 'proc'}/{name}.html", []]
                       for name in names if said[name][0] != "constant")
    return [[title, "page/fortran.html#" + re.sub(r"\W+", "-", title.lower()), found[title]] for title in in_order(found)]


def save(groups, path):
    path.write_text(json.dumps(groups))


def load(path):
    return json.loads(path.read_text())


def trail(groups, address):
    """The titles and addresses above a page, from the start page on, and its own title; None for no page."""
    for title, entries in groups:
        below = _path(entries, address)
        if below:
            return [["fuge", "index.html"], *([] if title == "Contents" else [[title, None]]), *below]
    return None


def _path(entries, address):
    for title, place, below in entries:
        if place == address:
            return [[title, place]]
        further = _path(below, address)
        if further:
            return [[title, place], *further]
    return None


def as_html(groups, address, up):
    """The tree for the page at an address; `up` leads from there to the top of the site.

    The groups can be opened and closed without a script; that of the page is open.
    """
    out = []
    for title, entries in groups:
        inside = _path(entries, address)
        if title == "Contents":
            out.append(_list(entries, address, up))
            continue
        opened = " open" if inside else ""
        out.append(f"<details{opened}><summary>{html.escape(title)}</summary>\n"
                   f"{_list(entries, address, up)}</details>")
    return "\n".join(out)


def breakable(name):
    """A name as HTML that may be broken behind an underscore."""
    return html.escape(name).replace("_", "_<wbr>")


def _list(entries, address, up):
    rows = ""
    for title, place, below in entries:
        current = ' aria-current="page"' if place == address else ""
        inside = place == address or _path(below, address)
        rows += (f'<li><a href="{up}{place}"{current}>{breakable(title)}</a>'
                 f"{_list(below, address, up) if below and inside else ''}</li>\n")
    return f"<ul>\n{rows}</ul>\n"
