"""What the C headers declare, to hold the package against; `python headers.py` prints fuge/_declarations.py anew."""

from __future__ import annotations

import re
import textwrap
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]

# Headers that the package has no part of, with the reason.
LEFT_OUT: dict[str, str] = {}

STRUCTS = ("fuge_options", "fuge_info", "fuge_smooth_report", "fuge_round_report", "fuge_stress_peak")
CALLBACKS = ("fuge_apply", "fuge_progress", "fuge_smooth_profile")


def text() -> str:
    """All headers without comments and preprocessor lines."""
    parts = []
    for header in sorted((ROOT / "include").glob("*.h")):
        if header.name not in LEFT_OUT:
            parts.append(re.sub(r"/\*.*?\*/", " ", header.read_text(encoding="utf-8"), flags=re.S))
    return re.sub(r"^\s*#.*$", "", "\n".join(parts), flags=re.M)


def parameter_code(parameter: str) -> str:
    """The code, as in fuge/_declarations.py, of one parameter or of the type of a result."""
    declared = re.sub(r"\bconst\b", " ", parameter).strip()
    match = re.fullmatch(r"([a-z_]+)\s*((?:\*\s*)*)([a-z_0-9]*)(\[\])?", declared)
    if match is None:
        raise ValueError(f"not understood: {parameter}")
    base, stars = match[1], match[2].count("*")
    constant = parameter.lstrip().startswith("const")
    if base == "char":
        return "texts" if stars == 2 else "text" if constant else "buffer"
    if base == "double" and stars:
        return "arrays" if stars == 2 else "doubles"
    if base == "int" and stars:
        return "ints"
    if base == "void":
        return "user" if stars else "void"
    if base.startswith("fuge_") and base not in CALLBACKS:
        return base + "*" * (stars - 1)
    return base


def declarations() -> dict[str, str]:
    """name: code of the result, then those of the parameters."""
    found = {}
    pattern = r"(?:^|\n)\s*((?:const )?[a-z_]+\s+\**)\s*(fuge_[a-z_0-9]+)\(([^)]*)\)\s*;"
    for result, name, parameters in re.findall(pattern, text()):
        codes = [parameter_code(result)]
        if parameters.strip() != "void":
            codes += [parameter_code(parameter) for parameter in parameters.split(",")]
        found[name] = " ".join(codes)
    return found


def constants() -> dict[str, int]:
    """name: value of all enumeration constants, without the prefix FUGE_."""
    found = {}
    for body in re.findall(r"enum\s*\{([^}]*)\}", text()):
        for name, value in re.findall(r"FUGE_(\w+)\s*=\s*(-?\d+)", body):
            found[name] = int(value)
    return found


def struct(name: str) -> list[tuple[str, str, int]]:
    """Name, base type and length (1 for a scalar) of the members of a struct."""
    match = re.search(rf"typedef struct {name}\s*\{{([^}}]*)\}}", text())
    if match is None:
        raise ValueError(f"no struct {name}")
    members = []
    for declaration in match[1].split(";")[:-1]:
        base, names = declaration.split(None, 1)
        for member in names.split(","):
            parts = re.fullmatch(r"\s*(\w+)(?:\[(\d+)\])?\s*", member)
            assert parts is not None, declaration
            members.append((parts[1], base, int(parts[2] or 1)))
    return members


def declarations_module() -> str:
    """The text of fuge/_declarations.py."""
    lines = [
        '"""The C functions: `name: result parameters`, in the codes of fuge._library; a test compares them with the '
        'headers."""',
        "",
        'DECLARATIONS = """',
    ]
    for function, codes in declarations().items():
        lines += textwrap.wrap(f"{function}: {codes}", 118, subsequent_indent="  ", break_on_hyphens=False)
    return "\n".join([*lines, '"""', ""])


if __name__ == "__main__":
    print(declarations_module(), end="")
