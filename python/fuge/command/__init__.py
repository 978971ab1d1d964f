"""The command ``fuge``: contact problems from files to tables; ``fuge --help`` describes it."""

from __future__ import annotations

import importlib
import sys
import warnings
from collections.abc import Sequence

import fuge
from fuge.command import errors
from fuge.command.checks import check_options, is_output
from fuge.command.errors import UsageError
from fuge.command.option_table import HELP
from fuge.command.options import Options, Setting
from fuge.command.run import Log, Outcome, print_error
from fuge.command.tables import write_lines, written
from fuge.errors import Error

# The module and the function of each kind of problem, which are imported when they are needed.
_SOLVERS = {
    "alpha": ("matrices", "solve_influence"),
    "matrices": ("matrices", "solve_body"),
    "meshes": ("meshes", "solve_meshes"),
    "deck": ("decks", "solve_deck"),
    "surface": ("surfaces", "solve_surface"),
}


def main(words: Sequence[str] | None = None) -> int:
    """Run the command with these words, by default those of the command line, and return its exit code."""
    for stream in (sys.stdout, sys.stderr):
        # Names of files keep their bytes.
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(encoding=sys.getfilesystemencoding(), errors="surrogateescape")
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return _run(sys.argv[1:] if words is None else words)
    except Error as failure:
        print_error(f"fuge: {errors.shown(failure)}")
        return errors.exit_code(failure)
    except KeyboardInterrupt:
        return errors.INTERRUPTED
    except BrokenPipeError:
        return errors.CLOSED_PIPE
    except MemoryError:
        print_error("fuge: there is not enough memory")
        return errors.UNSOLVED
    except Exception as failure:
        print_error(f"fuge: unexpected error, {type(failure).__name__}: {' '.join(str(failure).split())}")
        return errors.UNEXPECTED


def _run(words: Sequence[str]) -> int:
    given = Options(words)
    if given.has("help"):
        write_lines("", HELP.splitlines())
        return errors.DONE
    if given.has("version"):
        write_lines("", _version_lines())
        return errors.DONE
    kind = check_options(given)
    if given.has("plot"):
        _check_picture(given.first("plot"))
    module, name = _SOLVERS[kind]
    with Log(given.has("verbose")) as log:
        outcome: Outcome = getattr(importlib.import_module(f"fuge.command.{module}"), name)(given, log)
        _write(given, outcome)
        log.say("done")
    if outcome.failure:
        print_error(f"fuge: {outcome.failure}")
        return errors.UNSOLVED
    return errors.WARNED if log.warned and given.has("strict") else errors.DONE


def _write(given: Options, outcome: Outcome) -> None:
    """All results that are asked for; the table is the last one."""
    if given.has("field") and outcome.write_field is not None:
        outcome.write_field(given.file("field"))
    if given.has("reactions") and outcome.reactions is not None:
        write_lines(given.file("reactions"), outcome.reactions.lines())
    if given.has("plot"):
        _draw(given.file("plot"), outcome)
    to_output = given.has("json") and is_output(given.first("json"))
    if given.has("json"):
        write_lines("" if to_output else given.file("json"), outcome.table.json_lines())
    if given.has("output") or not to_output:
        write_lines(given.file("output"), outcome.table.lines())


def _check_picture(setting: Setting) -> None:
    """Refuse a picture without matplotlib, or of a kind that it does not know, before anything is solved."""
    try:
        importlib.import_module("matplotlib").use("Agg")
        kinds = importlib.import_module("matplotlib.figure").Figure().canvas.get_supported_filetypes()
    except ImportError:
        raise UsageError("--plot needs matplotlib, which cannot be imported: pip install matplotlib") from None
    ending = setting.value.rpartition(".")[2].lower()
    if ending not in kinds:
        raise setting.refuse(f"no kind of picture; one of {', '.join(f'.{kind}' for kind in sorted(kinds))} is needed")


def _draw(path: str, outcome: Outcome) -> None:
    figure, axes = importlib.import_module("matplotlib.pyplot").subplots(layout="constrained")
    if outcome.draw is not None:
        outcome.draw(axes)
    else:
        (force,) = (column.values for column in outcome.table.columns if column.name == "force")
        axes.plot(range(1, len(force) + 1), force, drawstyle="steps-mid")
        axes.set(xlabel="point", ylabel="force")
    with written(path):
        figure.savefig(path, dpi=150)


def _version_lines() -> list[str]:
    stored = "sparse, by CHOLMOD (LGPL, in part GPL)" if fuge._library.has_sparse() else "bands, built without CHOLMOD"
    return [
        f"fuge {fuge.__version__}",
        "transforms: by FFTW (GPL, version 2 or later)",
        f"stiffness matrices: {stored}",
    ]
