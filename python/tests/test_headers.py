"""The package holds what the C headers declare."""

import re
import unittest
from pathlib import Path

import fuge
import headers
from fuge import _library, _structs, files, halfplane, operators, pairs, solver, stress_peak
from fuge._calls import MESSAGE_LENGTH

# Functions of the headers that the package does not call, with what does the same or the reason why nothing does.
NOT_CALLED = {
    "fuge_solve_dense": "fuge.solve does the same through a solver, whose report it returns",
    "fuge_get_derivative": "Solver.derivative calls fuge_get_derivatives, which is the same for any number of motions",
}


class Headers(unittest.TestCase):
    def test_declarations_are_those_of_the_headers(self):
        found = {name: " ".join(codes) for name, codes in _library._CODES.items()}
        self.assertEqual(found, headers.declarations(), "run: python3 headers.py > ../fuge/_declarations.py")

    def test_all_functions_of_the_headers_are_seen(self):
        text = headers.text()
        names = set(re.findall(r"\b(fuge_\w+)\(", text)) - set(headers.CALLBACKS)
        self.assertEqual(set(headers.declarations()), names)

    def test_each_function_is_called_or_has_a_reason_why_not(self):
        source = "".join(
            path.read_text(encoding="utf-8")
            for path in Path(fuge.__file__).parent.glob("*.py")
            if path.name != "_declarations.py"
        )
        called = set(re.findall(r'"(fuge_\w+)"', source)) & set(headers.declarations())
        missing = set(headers.declarations()) - called
        self.assertEqual(missing, set(NOT_CALLED))

    def test_structs_are_those_of_the_headers(self):
        types = {"int": _structs.ctypes.c_int, "double": _structs.ctypes.c_double}
        self.assertEqual(set(_structs.STRUCTS), set(headers.STRUCTS))
        for name, struct in _structs.STRUCTS.items():
            wanted = [
                (member, types[base] if length == 1 else types[base] * length)
                for member, base, length in headers.struct(name)
            ]
            self.assertEqual(struct._fields_, wanted, name)

    def test_constants_are_those_of_the_headers(self):
        constants = headers.constants()
        status = {name: value for name, value in constants.items() if re.match("DONE$|WARN_|ERR_", name)}
        self.assertEqual({member.name: int(member) for member in fuge.Status}, status)
        self.assertEqual(MESSAGE_LENGTH, constants["MESSAGE_LENGTH"])
        for words, prefix in [
            (halfplane.ELEMENTS, ""),
            (halfplane.PLANE_STATES, "PLANE_"),
            (operators.BOUNDARIES, ""),
            (operators.AREA_BOUNDARIES, ""),
            (solver.METHODS, ""),
            (stress_peak.MEASURES, "MEASURE_"),
            (stress_peak.LOCATIONS, "PEAK_"),
            (pairs.PAIR_METHODS, ""),
            (pairs.NORMALS, "NORMALS_"),
            (files.STIFFNESS_FORMATS, "STIFFNESS_"),
            (files.SURFACE_FORMATS, "FILE_"),
            (files.LINE_FORMS, "LEVEL_"),
            (files.PLANE_FORMS, "LEVEL_"),
        ]:
            for word, value in words.items():
                self.assertEqual(value, constants[(prefix + word).upper()], word)
        for rule, name in [
            ("paper", "PAPER_RULE"),
            ("most_negative", "MOST_NEGATIVE"),
            ("greatest_decrease", "GREATEST_DECREASE"),
        ]:
            self.assertEqual(solver.PIVOT_RULES[rule], constants[name])
        for member in fuge.EdgeKind:
            self.assertEqual(member, constants["EDGE_" + member.name])
        for member in fuge.PointState:
            self.assertEqual(member, constants[member.name])

    def test_version_is_that_of_the_headers(self):
        header = (headers.ROOT / "include" / "fuge_core.h").read_text(encoding="utf-8")
        self.assertIn(f'FUGE_VERSION "{fuge.__version__}"', header)


if __name__ == "__main__":
    unittest.main()
