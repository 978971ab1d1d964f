"""The recipes for conda-forge and Spack against the sources: python3 recipes.py <sources>.

Neither tool is needed: the recipe of Spack is run with a package module of the test's own, which records what it says,
and what the recipes of conda pass to CMake is read from their text.
"""

import pathlib
import re
import sys
import types

sources = pathlib.Path(sys.argv[1])
recipes = sources / "packages"
faults = []


def expect(condition, what):
    if not condition:
        faults.append(what)


header = (sources / "include" / "fuge_core.h").read_text(encoding="utf-8")
version = re.search(r'FUGE_VERSION "([^"]+)"', header).group(1)
cmake = (sources / "CMakeLists.txt").read_text(encoding="utf-8")
options = set(re.findall(r"(?:option\(|set\()((?:FUGE|BUILD)_\w+)", cmake))
find_fftw = (sources / "cmake" / "FindFFTW.cmake").read_text(encoding="utf-8")
fftw = re.search(r"FFTW (\d[\d.]*) or newer", find_fftw).group(1)
least_cmake = re.search(r"cmake_minimum_required\(VERSION ([\d.]+)\)", cmake).group(1)


def check_options(names, where):
    for name in names:
        expect(name in options, f"{where}: {name} is no option of CMakeLists.txt")


for name in ("recipe.yaml", "meta.yaml"):
    text = (recipes / "conda" / name).read_text(encoding="utf-8")
    expect(f"version: {version}" in text or f'version = "{version}"' in text, f"{name}: not version {version}")
    check_options(set(re.findall(r"-D((?:FUGE|BUILD)_\w+)=", text)), name)
    expect(f"cmake >={least_cmake}" in text, f"{name}: not CMake {least_cmake}")
    for needed in ("fftw", "liblapack", "libblas", "suitesparse", "compiler('fortran')", "compiler('c')"):
        expect(needed in text, f"{name}: {needed} is missing")
    expect("- fuge " not in text, f"{name}: the command `fuge` is part of the Python package")
    expect("\n  path: ../..\n" in text, f"{name}: script/release does not find the path of the sources")
    expect("license: BSD-3-Clause AND GPL-2.0-or-later\n" in text, f"{name}: licences")

said = []


def statement(name):
    return lambda *values, **settings: said.append((name, values, settings))


class CMakePackage:
    run_tests = False

    @staticmethod
    def define(name, value):
        return f"-D{name}={value}"

    def define_from_variant(self, name, variant):
        declared = [values[0] for kind, values, _ in said if kind == "variant"]
        expect(variant in declared, f"package.py: there is no variant {variant}")
        return f"-D{name}={variant}"


module = types.ModuleType("spack.package")
module.CMakePackage = CMakePackage
for name in ("license", "version", "variant", "depends_on"):
    setattr(module, name, statement(name))
sys.modules["spack"] = types.ModuleType("spack")
sys.modules["spack.package"] = module
path = recipes / "spack" / "packages" / "fuge" / "package.py"
scope = {"__name__": "package"}
exec(compile(path.read_text(encoding="utf-8"), str(path), "exec"), scope)  # noqa: S102
arguments = scope["Fuge"]().cmake_args()
check_options({argument[2:].split("=")[0] for argument in arguments}, "package.py")
expect(f'\n    version("{version}")\n' in path.read_text(encoding="utf-8"), "package.py: no line for script/release")
versions = [values for kind, values, _ in said if kind == "version"]
expect((version,) in versions, f"package.py: not version {version}")
needs = [values[0] for kind, values, _ in said if kind == "depends_on"]
for needed in ("c", "fortran", "lapack", "blas", "mpi", "suite-sparse", f"cmake@{least_cmake}:"):
    expect(needed in needs, f"package.py: does not depend on {needed}")
expect(f"fftw@{fftw}: precision=float,double" in needs, f"package.py: not FFTW {fftw} in both precisions")

for fault in faults:
    print(fault)
print(f"{len(arguments)} options of Spack, FFTW {fftw}, version {version}")
sys.exit(1 if faults else 0)
