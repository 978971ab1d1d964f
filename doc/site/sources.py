"""What the sources say about the public names."""

import re

from reduce import PROCEDURE, TYPE, exports, own_exports


def opening_sentence(text):
    """The first sentence of the comment at the top of a source, without its colon or stop; None without one."""
    match = re.match(r"(?:#!.*\n)?(?:!>?|/\*|#|C|\"\"\") *([A-Z][^\n]*)", text)
    return match[1].rstrip("*/ ") if match else None


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


# Modules that pass on the names of others: of all, of each component, and of the library fuge_mpi. fuge_sparse has one
# module.
BODIES = ("elastic", "halfplane", "halfspace", "rings", "layers", "punches")
FACADES = ("src/facade/fuge.f90", *(f"src/{name}/fuge_{name}.f90" for name in ("core", "fe", "files")),
           *(f"src/bodies/{name}/fuge_{name}.f90" for name in BODIES), "src/mpi/fuge_mpi.f90")


def source_of(root, module):
    return next((root/"src").rglob(f"{module}.f90"))


def taken_names(root):
    """The names that the facades take from other modules, by the module that defines them.

    A module may pass on what it takes from another one.
    """
    found = {}
    for facade in FACADES:
        for module, names in exports((root/facade).read_text()).items():
            for name in names:
                found.setdefault(_defining(root, module, name), []).append(name)
    return found


def _defining(root, module, name):
    source = source_of(root, module).read_text()
    if name not in described(source):
        for other, names in exports(source).items():
            if name in names:
                return _defining(root, other, name)
        raise SystemExit(f"fuge: module {module} does not define {name}")
    return module


def public_modules(root, order, taken):
    for module in order:
        yield module, source_of(root, module), taken[module]
    sparse = root/"src/sparse/fuge_sparse.f90"
    yield "fuge_sparse", sparse, own_exports(sparse.read_text())


def public_names(root):
    """In which folder of the site each public procedure and type has its page."""
    taken = taken_names(root)
    found = {}
    for _, path, names in public_modules(root, list(taken), taken):
        said = described(path.read_text())
        found.update({name: "type" if said[name][0] == "type" else "proc"
                      for name in names if said[name][0] != "constant"})
    return found
