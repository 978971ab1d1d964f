"""Every public name says what it is, and examples that can run give what they say."""

import doctest
import inspect
import unittest

import fuge


class Docstrings(unittest.TestCase):
    def test_every_public_name_has_one(self):
        missing = []
        for name in fuge.__all__:
            item = getattr(fuge, name)
            if not inspect.getdoc(item):
                missing.append(name)
            if inspect.isclass(item):
                for member, value in vars(item).items():
                    if not member.startswith("_") and (callable(value) or isinstance(value, (property, classmethod))):
                        if not inspect.getdoc(getattr(item, member)):
                            missing.append(f"{name}.{member}")
        self.assertEqual(missing, [])

    def test_all_public_names_are_listed(self):
        found = set()
        for name, item in vars(fuge).items():
            if not name.startswith("_") and getattr(item, "__module__", "").startswith("fuge."):
                found.add(name)
        self.assertEqual(found, set(fuge.__all__))
        self.assertEqual(sorted(fuge.__all__), list(fuge.__all__))

    def test_parameters_are_described(self):
        # A function that has the section "Parameters" names all of them there.
        missing = []
        for name in fuge.__all__:
            item = getattr(fuge, name)
            text = inspect.getdoc(item) or ""
            if not inspect.isfunction(item) or "Parameters\n---" not in text:
                continue
            for parameter in inspect.signature(item).parameters:
                if parameter not in text.split("Parameters\n", 1)[1].split("\n\nReturns")[0]:
                    missing.append(f"{name}: {parameter}")
        self.assertEqual(missing, [])

    def test_examples(self):
        parser, runner = doctest.DocTestParser(), doctest.DocTestRunner()
        for item in (fuge, fuge.solve, fuge.solve_round_powers):
            test = parser.get_doctest(inspect.getdoc(item), {"fuge": fuge}, item.__name__, None, None)
            self.assertTrue(test.examples)
            self.assertEqual(runner.run(test).failed, 0, item.__name__)


if __name__ == "__main__":
    unittest.main()
