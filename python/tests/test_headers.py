"""What the package reads in the C headers is what a C compiler reads there, and the package has all of it."""

import ctypes
import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

import fuge
from fuge import _library, _words
from fuge._headers import Headers

INCLUDE = Path(__file__).resolve().parents[2] / "include"
COMPILER = shutil.which(os.environ.get("CC", "cc"))

# Functions of the headers that the package does not call, with what does the same or the reason why nothing does.
NOT_CALLED = {
    "fuge_solve_dense": "fuge.solve does the same through a solver, whose report it returns",
    "fuge_default_link_law": "the keywords of Links.add_support have its values as defaults",
    "fuge_mesh_join": "join_meshes puts arrays of numpy one after the other",
}


def text():
    """All headers without comments."""
    texts = (path.read_text(encoding="utf-8") for path in INCLUDE.glob("*.h"))
    return re.sub(r"/\*.*?\*/", " ", "\n".join(texts), flags=re.S)


def pointer_to(kind):
    """The C type of a pointer to a member of a struct."""
    if issubclass(kind, ctypes.Array):
        return f"{pointer_to(kind._type_)[:-2]} (*)[{kind._length_}]"
    return {
        ctypes.c_int: "int *",
        ctypes.c_double: "double *",
        ctypes.c_char: "char *",
        ctypes.POINTER(ctypes.c_double): "const double * *",
    }[kind]


def in_c():
    """A file that a C compiler accepts if the headers declare what the package has read in them."""
    declared = _library.HEADERS
    lines = ['#include "fuge.h"', f'_Static_assert(sizeof FUGE_VERSION == sizeof "{declared.version}", "version");']
    lines += [f"typedef struct {name} {name};" for name in declared.handles]
    for name, (result, parameters) in declared.functions.items():
        lines.append(f"{result} {name}({', '.join(parameters) or 'void'});")
    for name, (result, parameters) in declared.callbacks.items():
        lines.append(f"typedef {result} (*{name})({', '.join(parameters)});")
    for name, value in declared.constants.items():
        lines.append(f'_Static_assert(FUGE_{name} == {value}, "{name}");')
    for name, struct in _library.STRUCTS.items():
        lines.append(f'_Static_assert(sizeof({name}) == {ctypes.sizeof(struct)}, "{name}");')
        for member, kind in struct._fields_:
            lines.append(f'_Static_assert(offsetof({name}, {member}) == {getattr(struct, member).offset}, "{member}");')
            same = f"_Generic(&(({name} *)0)->{member}, {pointer_to(kind)}: 1, default: 0)"
            lines.append(f'_Static_assert({same}, "{member}");')
    return "\n".join(lines) + "\n"


def compiles(code):
    command = [COMPILER, "-std=c11", "-fsyntax-only", f"-I{INCLUDE}", "-x", "c", "-"]
    result = subprocess.run(command, input=code, capture_output=True, text=True)
    return result.returncode == 0, result.stderr


@unittest.skipUnless(COMPILER, "no C compiler")
class Compiled(unittest.TestCase):
    """A C compiler reads the same in the headers as the package."""

    def test_all_is_the_same(self):
        same, messages = compiles(in_c())
        self.assertTrue(same, messages)

    def test_differences_are_found(self):
        for there, changed in [
            ("int fuge_solve(fuge_solver *);", "int fuge_solve(const fuge_solver *);"),
            ("void fuge_solver_free(fuge_solver * *);", "int fuge_solver_free(fuge_solver * *);"),
            ("int fuge_set_approach(fuge_solver *, double);", "int fuge_set_approach(fuge_solver *, int);"),
            ("(int, double, int, void *)", "(int, int, double, void *)"),
            ("FUGE_ERR_SIZE == -1", "FUGE_ERR_SIZE == 1"),
            ("offsetof(fuge_info, residual) == 32", "offsetof(fuge_info, residual) == 40"),
            ("sizeof(fuge_info) == 96", "sizeof(fuge_info) == 88"),
            ("->iterations, int *", "->iterations, double *"),
            ("->tensor, double (*)[6]", "->tensor, double (*)[5]"),
            ("->load, const double * *", "->load, double * *"),
        ]:
            code = in_c()
            self.assertIn(there, code)
            self.assertFalse(compiles(code.replace(there, changed))[0], changed)


class Package(unittest.TestCase):
    """The package has all that the headers declare."""

    def test_the_headers_are_those_of_the_sources(self):
        for path in INCLUDE.glob("*.h"):
            self.assertIn(path.name, [read.name for read in _library.HEADERS.paths])
        for read in _library.HEADERS.paths:
            self.assertEqual(read.read_bytes(), (INCLUDE / read.name).read_bytes())

    def test_all_functions_can_be_called(self):
        names = set(re.findall(r"\b(fuge_\w+) *\(", text()))
        self.assertEqual(set(_library.HEADERS.functions), names)
        numbers = {ctypes.c_int: "int", ctypes.c_double: "double", ctypes.c_size_t: "size_t"}
        for name in names:
            if hasattr(_library._core, name) or _library.has_sparse():
                found = [numbers.get(kind, "address") for kind in _library.function(name).argtypes]
                (declared,) = re.findall(rf"\b{name} *\(([^)]*)\)", text())
                wanted = [] if declared == "void" else declared.split(",")
                wanted = ["address" if "*" in words or "fuge_" in words else words.split()[0] for words in wanted]
                self.assertEqual(found, wanted, name)

    def test_each_function_is_called_or_has_a_reason_why_not(self):
        folder = Path(fuge.__file__).parent
        source = "".join(path.read_text(encoding="utf-8") for path in folder.glob("*.py"))
        called = set(re.findall(r'"(fuge_\w+)"', source))
        self.assertEqual(set(_library.HEADERS.functions) - called, set(NOT_CALLED))

    def test_each_constant_has_a_word_or_a_name(self):
        names = {*_words.WORDS, *fuge.Status.__members__, *fuge.PointState.__members__, "MESSAGE_LENGTH"}
        names |= {f"EDGE_{kind.name}" for kind in fuge.EdgeKind}
        self.assertEqual(set(_library.HEADERS.constants), names)
        self.assertEqual(len(set(re.findall(r"\bFUGE_\w+(?= *= *-?\d)", text()))), len(names))

    def test_names_stand_for_their_constants(self):
        self.assertEqual(fuge.Status.ERR_MESH, -23)
        self.assertEqual(fuge.PointState.AT_UPPER_STOP, -1)
        self.assertEqual(fuge.PointState.LIMITED_UPPER, -2)
        self.assertEqual(fuge.EdgeKind.GRID_END, 3)
        self.assertEqual(_words.WORDS["PAPER_RULE"], "paper")
        self.assertEqual(_words.WORDS["PERIODIC_Y"], "periodic_y")

    def test_version_is_that_of_the_headers(self):
        self.assertIn(f'FUGE_VERSION "{fuge.__version__}"', text())
        version = _library.HEADERS.version
        try:
            _library.HEADERS.version = "9.9"
            self.assertRaisesRegex(ImportError, "9.9", _library.version)
        finally:
            _library.HEADERS.version = version


class Reader(unittest.TestCase):
    """The reader refuses what it would misread."""

    def read(self, code):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "fuge.h"
            path.write_text(f"#ifndef FUGE_H\n#define FUGE_H\n/* A header; of a test. */\n{code}\n#endif\n")
            return Headers(path)

    def test_what_it_understands(self):
        found = self.read(
            "typedef struct fuge_a fuge_a; typedef struct fuge_b { int n, m; double x[3]; } fuge_b;\n"
            "typedef struct fuge_c { const double *y; char word[8]; } fuge_c;\n"
            "enum { FUGE_ONE = 1, FUGE_LESS = -2 };  typedef int (*fuge_f)(const double *x, void *user);\n"
            "const char *fuge_g(void);\nvoid fuge_h(fuge_a **a, /* which; where */ const char *const *names, fuge_f f);"
        )
        self.assertEqual(found.handles, ["fuge_a"])
        self.assertEqual(found.structs["fuge_b"], [("n", "int", None), ("m", "int", None), ("x", "double", 3)])
        self.assertEqual(found.structs["fuge_c"], [("y", "const double *", None), ("word", "char", 8)])
        self.assertEqual(found.constants, {"ONE": 1, "LESS": -2})
        self.assertEqual(found.callbacks, {"fuge_f": ("int", ["const double *", "void *"])})
        self.assertEqual(found.functions["fuge_g"], ("const char *", []))
        self.assertEqual(found.functions["fuge_h"], ("void", ["fuge_a * *", "const char * const *", "fuge_f"]))

    def test_what_it_does_not_understand(self):
        for code in [
            "#define FUGE_LENGTH 256",
            "#if FUGE_NEW",
            "#include",
            "#define FUGE_VERSION",
            "#include <stdint.h>",
            "#ifdef __cplusplus\nnamespace fuge {\n#endif",
            "int fuge_f(int)",
            "int fuge_f(int);",
            "int fuge_f(double *);",
            "int fuge_f(double x[]);",
            "int fuge_f(int n, ...);",
            "int fuge_f(int (*apply)(int n));",
            "int fuge_f();",
            "extern int fuge_n;",
            "static inline int fuge_f(int n) { return n; }",
            "enum { FUGE_ONE };",
            "enum { FUGE_ONE = 1, };",
            "enum { FUGE_ONE = 1 << 2 };",
            "enum { ONE = 1 };",
            "enum fuge_e { FUGE_ONE = 1 };",
            "typedef int fuge_int;",
            "typedef enum { FUGE_ONE = 1 } fuge_e;",
            "typedef struct fuge_a fuge_b;",
            "typedef struct { int n; } fuge_a;",
            "typedef struct fuge_a { int *n; } fuge_a;",
            "typedef struct fuge_a { const int n; } fuge_a;",
            "typedef struct fuge_a { const double *x, *y; } fuge_a;",
            "typedef struct fuge_a { int n : 3; } fuge_a;",
            "typedef struct fuge_a { int n[N]; } fuge_a;",
            "typedef struct fuge_a { int n[2][2]; } fuge_a;",
            "typedef struct fuge_a { union { int n; double x; } } fuge_a;",
            "typedef struct fuge_a { int n; fuge_a;",
            "union fuge_u { int n; };",
        ]:
            with self.assertRaisesRegex(ValueError, "does not understand", msg=code) as caught:
                self.read(code)
            self.assertIn("fuge.h", str(caught.exception))

    def test_types_that_the_package_does_not_know(self):
        for name in ("unsigned int", "float *", "fuge_new *", "fuge_operator * * *", "const"):
            with self.assertRaisesRegex(ValueError, "does not know the type"):
                _library._type(name, _library._TYPES)


if __name__ == "__main__":
    unittest.main()
