"""Install a wheel into a system that has nothing but Python, numpy, scipy and the C library, and use it there.

bare.py PROGRAM SCRATCH WHEEL: Python runs PROGRAM in a folder that is the root of all files for it. The folder has this
Python with its standard library, numpy and scipy of this Python, and of the libraries of this system those that
Python's own modules need and those that every wheel may count on. There is no shell, no compiler, no Fortran, no BLAS,
no FFTW. WHEEL is a file, or a folder with its content.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
import sysconfig
from pathlib import Path

# What the rules of manylinux let a wheel expect of a system.
EXPECTED = re.compile(r"(ld-linux.*|lib(c|m|mvec|dl|rt|pthread|util|resolv|gcc_s|stdc\+\+))\.so[.\d]*$")
# What must not be there, or the test would prove nothing.
FORBIDDEN = re.compile(r"lib(gfortran|quadmath|blas|lapack|openblas|fftw3|cholmod|gomp|fuge)")
LEFT_OUT = shutil.ignore_patterns("site-packages", "dist-packages", "test", "idlelib", "tkinter", "__pycache__", "*.a",
                                  "config-*", "_tkinter*")


def needed(path: Path) -> list[Path]:
    """The libraries that a file needs, by `ldd`."""
    listed = subprocess.run(["ldd", str(path)], capture_output=True, text=True).stdout
    return [Path(found) for found in re.findall(r"(/\S+) \(0x", listed)]


def copy(path: Path, root: Path) -> None:
    target = root / path.relative_to("/")
    if not target.exists():
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(path, target)


def install_python(root: Path) -> Path:
    """This Python and its standard library; the path of Python."""
    python = Path(os.path.realpath(sys.executable))
    library = Path(sysconfig.get_path("stdlib"))
    copy(python, root)
    shutil.copytree(library, root / library.relative_to("/"), ignore=LEFT_OUT)
    for file in [python, *(root / library.relative_to("/") / "lib-dynload").glob("*.so")]:
        for found in needed(file):
            if not FORBIDDEN.match(found.name):
                copy(found, root)
    return python


def install_wheels(wheel: Path, root: Path) -> Path:
    """The wheel, and numpy and scipy as they are; the folder of all."""
    import numpy

    site = root / "site"
    if wheel.is_dir():
        shutil.copytree(wheel, site)
    else:
        pip = [sys.executable, "-m", "pip", "--disable-pip-version-check", "install", "--quiet"]
        subprocess.run([*pip, "--no-index", "--no-deps", "--no-compile", "--target", str(site), str(wheel)], check=True)
    source = Path(numpy.__file__).parents[1]
    for folder in ["numpy", "numpy.libs", "scipy", "scipy.libs"]:
        shutil.copytree(source / folder, site / folder, ignore=shutil.ignore_patterns("tests", "__pycache__"))
    for file in site.rglob("*.so*"):
        for found in needed(file):
            if EXPECTED.match(found.name):
                copy(found, root)
    return site


def main() -> None:
    program, root, wheel = (Path(word) for word in sys.argv[1:])
    shutil.rmtree(root, ignore_errors=True)
    root.mkdir(parents=True)
    python = install_python(root)
    site = install_wheels(wheel, root)
    shutil.copy(program, root / "program.py")
    foreign = [path for path in root.rglob("*.so*") if FORBIDDEN.match(path.name) and site not in path.parents]
    if foreign:
        sys.exit(f"the system is not bare: {foreign}")
    enter = ["chroot"] if os.geteuid() == 0 else ["unshare", "--map-root-user", "chroot"]
    environment = {"PYTHONPATH": "/site", "PYTHONDONTWRITEBYTECODE": "1", "PYTHONFAULTHANDLER": "1",
                   "OPENBLAS_NUM_THREADS": "1"}
    subprocess.run([*enter, str(root), str(python), "/program.py"], check=True,
                   env={**environment, "PATH": os.environ["PATH"]})
    shutil.rmtree(root)


if __name__ == "__main__":
    main()
