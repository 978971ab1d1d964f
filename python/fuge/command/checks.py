"""Which options go together, and results that would overwrite what is read."""

from __future__ import annotations

import os
import stat
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from fuge.command.errors import UsageError
from fuge.command.option_table import INPUTS, RESULTS
from fuge.command.options import Options, Setting
from fuge.command.tables import open_file

ALPHA, MATRICES, MESHES, DECK, SURFACE = "alpha", "matrices", "meshes", "deck", "surface"

_MESH_OPTIONS = "body clearance crease faceted loads node-to-face normals pair reach support tied"
_SURFACE_OPTIONS = "boundary element fill height-scale level modulus poisson scale spacing surface young"

# Options, the kinds of problems that have them, and what they need.
_NEEDS = (
    ("modes motion resultant", {ALPHA}, "--alpha"),
    ("contact external fixed", {MATRICES}, "--stiffness without --mesh"),
    ("floats", {MATRICES, DECK}, "--stiffness without --mesh"),
    (_MESH_OPTIONS, {MESHES}, "--mesh and --pair"),
    ("matrix mesh supports", {MESHES, DECK}, "--mesh and --pair"),
    ("cases deck links long reactions", {DECK}, "--deck or --links"),
    (_SURFACE_OPTIONS, {SURFACE}, "--surface"),
    ("pressure", {MESHES, SURFACE}, "--mesh and --pair, or --surface"),
    ("compliance limit limit-upper", {ALPHA, MATRICES}, "--alpha or --contact"),
    ("prove", {ALPHA, MATRICES, DECK, SURFACE}, "--alpha, --contact, --deck or --surface"),
    ("approach exclude gap load play", {ALPHA, MATRICES, MESHES, SURFACE}, "another problem than --deck and --links"),
    ("approach exclude gap play rows", {ALPHA, MATRICES, MESHES, DECK}, "matrices or meshes"),
    ("gap approach", {ALPHA, MATRICES}, "--alpha or --contact"),
    ("field rows", {MATRICES, MESHES, DECK, SURFACE}, "--stiffness"),
)

# Options that only several bodies may have each.
_SINGLE = {
    ALPHA: "load play stiffness",
    MATRICES: "load play stiffness rows",
    MESHES: "",
    DECK: "matrix mesh rows stiffness supports",
    SURFACE: "load pressure",
}


def check_options(given: Options) -> str:
    """The kind of the problem; what does not go with it is refused.

    Raises
    ------
    UsageError
        Options are missing or do not go together, or a result would overwrite an input or another result.
    FileError
        A result cannot be written where it should.
    """
    kind = _kind(given)
    missing = _missing(given.has, kind)
    if missing:
        raise UsageError(missing)
    for names, kinds, needed in _NEEDS:
        for name in names.split():
            if given.has(name) and kind not in kinds:
                raise UsageError(f"--{name} needs {needed}")
    for name in _SINGLE[kind].split():
        if len(given.all(name)) > 1:
            raise UsageError(f"--{name} is given twice")
    _check_results(given)
    return kind


def _kind(given: Options) -> str:
    """What is asked for. Points with compliances need no influence matrix."""
    is_deck = given.has("deck") or given.has("links")
    is_body = given.has("stiffness") or given.has("mesh") or is_deck
    is_bed = given.has("compliance") and not is_body and not given.has("surface")
    if [given.has("alpha") or is_bed, is_body, given.has("surface")].count(True) != 1:
        raise UsageError("one of --alpha, --stiffness and --surface is needed")
    if is_deck:
        return DECK
    if given.has("surface"):
        return SURFACE
    if not is_body:
        return ALPHA
    return MESHES if given.has("mesh") or given.has("pair") else MATRICES


def _missing(has: Callable[[str], bool], kind: str) -> str:
    """Which options of a kind of problem are missing or exclude each other, in words; empty if none."""
    motions = [has("load"), has("approach"), has("modes")].count(True)
    rules = {
        ALPHA: {
            "--gap is needed": not has("gap"),
            "--modes and --resultant go together": has("modes") != has("resultant"),
            "one of --load, --approach and --modes is needed": motions != 1,
            "--motion needs --modes": has("motion") and not has("modes"),
        },
        MATRICES: {
            "--gap is needed": not has("gap"),
            "--modes needs --alpha": has("modes"),
            "with --stiffness no more than one of --load and --approach is possible": motions > 1,
            "--contact, or --mesh and --pair, are needed with --stiffness": not has("contact"),
        },
        MESHES: {
            "--pair needs --mesh, the mesh with the surfaces": not has("mesh"),
            "--mesh needs --pair, the surfaces in contact": not has("pair"),
            "--stiffness is needed: at least one body has to be elastic": not has("stiffness"),
        },
        DECK: {
            "--stiffness is needed: the matrix of the structure without its one-way links": not has("stiffness"),
        },
        SURFACE: {
            "with --surface one of --pressure and --load is needed": has("pressure") == has("load"),
            "with --surface either --modulus, or --young and --poisson, are needed": has("modulus")
            == (has("young") or has("poisson")),
            "--young and --poisson go together": has("young") != has("poisson"),
        },
    }
    return next((reason for reason, is_wrong in rules[kind].items() if is_wrong), "")


# ---- results


def _check_results(given: Options) -> None:
    if given.job is not None:
        check_input(given, given.job, "it is the job file")
    for setting in given.settings:
        if setting.name in INPUTS:
            for path in _inputs(setting):
                check_input(given, path, f"the same file as of --{setting.name}")
    results = [setting for setting in given.settings if setting.name in RESULTS and not is_output(setting)]
    # Only where all exist can their names be compared, so those that are missing are made for a moment.
    with _prepared([setting.path() for setting in results]):
        for setting in reversed(results):
            check_input(given, setting.path(), f"the same file as of --{setting.name}", setting)


def is_output(setting: Setting) -> bool:
    """Whether a result goes to standard output by its value."""
    return setting.name == "json" and setting.value == "-"


def _inputs(setting: Setting) -> Iterator[str]:
    """The files that are read for an option."""
    yield setting.path()
    if setting.name == "stiffness":
        yield setting.path()[:-4] + ".dof"
    if setting.name in ("loads", "supports"):
        yield setting.path(setting.value.find("=") + 1)


def check_input(given: Options, path: str, reason: str, own: Setting | None = None) -> None:
    """Refuse a result in the file at `path`, whatever names and links lead there, but for the one of `own`.

    Without --output, standard output is a result.
    """
    for setting in given.settings:
        if setting.name not in RESULTS or setting == own:
            continue
        result = "" if is_output(setting) else setting.path()
        if not setting.value.strip():
            raise UsageError(f"--{setting.name} needs a path")
        if _same_file(result, path) or (result == path and not path.startswith("/dev/")):
            raise setting.refuse(reason)
    if not given.has("output") and _same_file("", path):
        raise UsageError(f"standard output: {reason}, use --output")


def _same_file(path: str, other: str) -> bool:
    """Whether two paths lead to one file; an empty one is standard output. Devices and pipes are no files."""
    found, expected = _status(path), _status(other)
    return found is not None and expected is not None and os.path.samestat(found, expected)


def _status(path: str) -> os.stat_result | None:
    try:
        found = os.stat(path) if path else os.fstat(sys.stdout.fileno())
    except (OSError, ValueError, AttributeError):
        return None
    return found if stat.S_ISREG(found.st_mode) else None


@contextmanager
def _prepared(paths: list[str]) -> Iterator[None]:
    """Files at all paths as long as it lasts; those that were there stay as they are. Errors: FileError."""
    made = []
    try:
        for path in paths:
            if os.path.exists(path) and not os.path.isfile(path) and not os.path.isdir(path):
                continue
            is_new = not os.path.exists(path)
            open_file(path, "a").close()
            if is_new:
                # The file at the end of the links, which stay.
                made.append(os.path.realpath(path))
        yield
    finally:
        for path in made:
            os.remove(path)
