"""Every public name says what it is, and examples that can run give what they say."""

import ast
import doctest
import inspect
import pydoc
import re
import unittest
from pathlib import Path

import fuge

PICTURES = ("gap", "levels", "line", "map", "path", "stress")


def public(module):
    """The public functions and classes of a module, by their names."""
    return {
        name: item
        for name, item in vars(module).items()
        if not name.startswith("_") and getattr(item, "__module__", "").startswith("fuge.")
    }


ALL = {**public(fuge), **{f"plot.{name}": item for name, item in vars(fuge.plot).items() if name in PICTURES}}


class Docstrings(unittest.TestCase):
    def test_every_public_name_has_one(self):
        missing = []
        for name, item in ALL.items():
            if not inspect.getdoc(item):
                missing.append(name)
            if inspect.isclass(item):
                for member, value in vars(item).items():
                    if not member.startswith("_") and (callable(value) or isinstance(value, (property, classmethod))):
                        if not inspect.getdoc(getattr(item, member)):
                            missing.append(f"{name}.{member}")
        self.assertEqual(missing, [])

    def test_the_map_has_all_names(self):
        words = set(re.findall(r"[\w.]+", fuge.__doc__))
        self.assertEqual(set(ALL) - words, set())
        # What looks like a function or a class in the map is one.
        known = {*ALL, "e_star", "ParaView", "CalculiX"}
        known |= {f"{name}.{member}" for name, item in ALL.items() if inspect.isclass(item) for member in vars(item)}
        looks = r"\b(?:plot\.|[A-Z]\w+\.)?[A-Za-z]+(?:_[a-z]+)+|\b[A-Z]\w+\.\w+|\b[A-Z][a-z]+[A-Z]\w+"
        unknown = [word for word in re.findall(looks, fuge.__doc__) if word not in known]
        self.assertEqual(unknown, [])

    def test_help_is_the_map(self):
        text = pydoc.plain(pydoc.render_doc(fuge))
        self.assertIn("load_path(alpha, gap, load)", text)
        self.assertLess(len(text.splitlines()), 150)

    def test_names_are_exported_to_type_checkers(self):
        facade = ast.parse(Path(fuge.__file__).read_text(encoding="utf-8"))
        exported = set()
        for node in facade.body:
            if isinstance(node, ast.ImportFrom):
                exported |= {alias.name for alias in node.names if alias.asname == alias.name}
        self.assertEqual(exported, set(public(fuge)) | {"plot"})

    def test_parameters_are_described(self):
        # A function that has the section "Parameters" names all of them there.
        missing = []
        for name, item in ALL.items():
            text = inspect.getdoc(item) or ""
            if not inspect.isfunction(item) or "Parameters\n---" not in text:
                continue
            for parameter in inspect.signature(item).parameters:
                if parameter not in text.split("Parameters\n", 1)[1].split("\n\nReturns")[0]:
                    missing.append(f"{name}: {parameter}")
        self.assertEqual(missing, [])

    def test_examples(self):
        parser, runner = doctest.DocTestParser(), doctest.DocTestRunner()
        for item in (
            fuge,
            fuge.solve,
            fuge.Solver.prove,
            fuge.Solver.vjp,
            fuge.Solver.gap_for_pressure,
            fuge.solve_round_powers,
            fuge.solve_line,
        ):
            test = parser.get_doctest(inspect.getdoc(item), {"fuge": fuge}, item.__name__, None, None)
            self.assertTrue(test.examples)
            self.assertEqual(runner.run(test).failed, 0, item.__name__)


if __name__ == "__main__":
    unittest.main()
