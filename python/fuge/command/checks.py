"""Which options go together, and results that would overwrite what is read."""

from __future__ import annotations

import os
import stat
import sys
from collections.abc import Callable, Iterator
from contextlib import ExitStack

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
    for kinds, is_wrong, reason in _rules(given.has):
        if kind in kinds and is_wrong:
            raise UsageError(reason)
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
    if not is_body:
        return SURFACE if given.has("surface") else ALPHA
    return MESHES if given.has("mesh") or given.has("pair") else MATRICES


def _rules(has: Callable[[str], bool]) -> Iterator[tuple[set[str], bool, str]]:
    """Kinds of problems, whether an option is missing or excludes another one, and what is then said."""
    motions = [has("load"), has("approach"), has("modes")].count(True)
    is_young = has("young") or has("poisson")
    yield {ALPHA, MATRICES}, not has("gap"), "--gap is needed"
    yield {ALPHA}, has("modes") != has("resultant"), "--modes and --resultant go together"
    yield {ALPHA}, motions != 1, "one of --load, --approach and --modes is needed"
    yield {ALPHA}, has("motion") and not has("modes"), "--motion needs --modes"
    yield {MATRICES}, has("modes"), "--modes needs --alpha"
    yield {MATRICES}, motions > 1, "with --stiffness no more than one of --load and --approach is possible"
    yield {MATRICES}, not has("contact"), "--contact, or --mesh and --pair, are needed with --stiffness"
    yield {MESHES}, not has("mesh"), "--pair needs --mesh, the mesh with the surfaces"
    yield {MESHES}, not has("pair"), "--mesh needs --pair, the surfaces in contact"
    needed = "--stiffness is needed: "
    yield {MESHES}, not has("stiffness"), f"{needed}at least one body has to be elastic"
    yield {DECK}, not has("stiffness"), f"{needed}the matrix of the structure without its one-way links"
    surface = "with --surface "
    yield {SURFACE}, has("pressure") == has("load"), f"{surface}one of --pressure and --load is needed"
    yield {SURFACE}, has("modulus") == is_young, f"{surface}either --modulus, or --young and --poisson, are needed"
    yield {SURFACE}, has("young") != has("poisson"), "--young and --poisson go together"


# ---- results


def _check_results(given: Options) -> None:
    if given.job is not None:
        check_input(given, given.job, "it is the job file")
    for setting in given.settings:
        if setting.name in INPUTS:
            for path in _inputs(setting):
                check_input(given, path, f"the same file as of --{setting.name}")
    results = [setting for setting in given.settings if setting.name in RESULTS and not is_output(setting)]
    with ExitStack() as made:
        for path in map(Setting.path, results):
            is_new = not os.path.exists(path)
            if is_new or os.path.isfile(path) or os.path.isdir(path):
                open_file(path, "a").close()
            if is_new:
                # Only where all exist can their names be compared. Links stay.
                made.callback(os.remove, os.path.realpath(path))
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
    try:
        found, expected = (os.stat(name) if name else os.fstat(sys.stdout.fileno()) for name in (path, other))
    except (OSError, ValueError, AttributeError):
        return False
    return stat.S_ISREG(found.st_mode) and os.path.samestat(found, expected)
