"""Put the licences of the libraries that auditwheel has copied into a wheel beside them: add_licences.py WHEEL FOLDER.

The wheel goes to FOLDER. Which package a library comes from is in the list of parts that auditwheel leaves in the
wheel, and the licence of a package of Debian in /usr/share/doc/<package>/copyright. Needs the package wheel.
"""

from __future__ import annotations

import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path
from urllib.parse import unquote

# Libraries under the GPL: a wheel with one of them is under it as a whole.
GPL = re.compile(r"lib(fftw3|cholmod)")
# Licences of the libraries in a wheel, in the words of SPDX, beside that of fuge, LAPACK, OpenBLAS and AMD.
LICENCES = {
    "GPL-2.0-or-later": GPL,
    "LGPL-2.1-or-later": re.compile(r"lib(cholmod|quadmath)"),
    "GPL-3.0-or-later WITH GCC-exception-3.1": re.compile(r"lib(gfortran|gcc_s|gomp)"),
    "Apache-2.0": re.compile(r"libmetis"),
}
HEAD = """\
fuge is under the BSD licence with three clauses, the file LICENSE. The folder fuge.libs of this wheel has
copies of libraries of these packages of Debian, changed only in their names and in where they look for each other.
Their licences are beside this file. {licence}
The source of each is what `apt-get source PACKAGE=VERSION` fetches, also from https://snapshot.debian.org.

"""
WHOLE = "FFTW and CHOLMOD are under the GPL, and so is\nthis wheel as a whole: who passes it on passes on these rights."


def packages(info: Path) -> dict[str, str]:
    """Packages whose libraries are in the wheel, with their versions."""
    found = {}
    for path in (info / "sboms").glob("*.json"):
        for part in json.loads(path.read_text()).get("components", []):
            match = re.match(r"pkg:deb/[^/]+/([^@]+)@([^?]+)", part.get("purl", ""))
            if match:
                found[unquote(match[1])] = unquote(match[2])
    return found


def copyright_of(package: str) -> str:
    path = Path("/usr/share/doc") / package / "copyright"
    if not path.is_file():
        sys.exit(f"fuge: {path} is missing, the licence of {package} cannot go into the wheel: make it on Debian")
    return path.read_text(errors="replace")


def expressions(libraries: list[str]) -> list[str]:
    """The licences of these libraries, beside the BSD licence."""
    return [name for name, pattern in LICENCES.items() if any(pattern.match(library) for library in libraries)]


def add_licences(content: Path) -> None:
    """Add licences to an unpacked wheel."""
    (info,) = content.glob("*.dist-info")
    libraries = sorted(path.name for path in content.glob("*.libs/*"))
    found = packages(info)
    if libraries and not found:
        sys.exit("fuge: auditwheel does not say which packages the libraries come from: make the wheel on Debian")
    licences = info / "licenses"
    licences.mkdir(exist_ok=True)
    for package in found:
        text = copyright_of(package)
        (licences / f"{package}.txt").write_text(text)
        # Debian's files name the common licences without their text.
        for path in re.findall(r"/usr/share/common-licenses/[\w.-]*\w", text):
            (licences / Path(path).name).write_text(Path(path).read_text())
    is_gpl = any(GPL.match(name) for name in libraries)
    lines = [f"{package} {version}\n" for package, version in sorted(found.items())]
    (licences / "LIBRARIES").write_text(HEAD.format(licence=WHOLE if is_gpl else "") + "".join(lines))
    metadata = info / "METADATA"
    text = metadata.read_text(encoding="utf-8")
    if not re.search(r"^License-Expression: BSD-3-Clause$", text, re.MULTILINE):
        sys.exit("fuge: the metadata of the wheel have no line License-Expression: BSD-3-Clause")
    expression = " AND ".join(["BSD-3-Clause", *expressions(libraries)])
    text = re.sub(r"^(License-Expression:) .*$", rf"\1 {expression}", text, count=1, flags=re.MULTILINE)
    metadata.write_text(text, encoding="utf-8")


def main() -> None:
    wheel, folder = sys.argv[1:]
    with tempfile.TemporaryDirectory() as scratch:
        command = [sys.executable, "-m", "wheel"]
        subprocess.run([*command, "unpack", "--dest", scratch, wheel], check=True, stdout=subprocess.DEVNULL)
        (content,) = Path(scratch).iterdir()
        add_licences(content)
        subprocess.run([*command, "pack", "--dest-dir", folder, str(content)], check=True, stdout=subprocess.DEVNULL)
    print(Path(folder) / Path(wheel).name)


if __name__ == "__main__":
    main()
