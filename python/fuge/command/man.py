"""The manual page fuge(1), made from the help of the command: ``python -m fuge.command.man > fuge.1``."""

from __future__ import annotations

import fuge
from fuge.command.option_table import HELP, split_entry

_END = r""".SH SEE ALSO
.BR fuge (3);
the manual, of which
.I files.md
has the formats of all files."""


def man_page() -> str:
    """The page in the language of troff."""
    summary, synopsis, *groups = HELP.strip().split("\n\n")
    lines = [
        r".\" SPDX-License-Identifier: BSD-3-Clause",
        f'.TH FUGE 1 "" "fuge {fuge.__version__}" "User Commands"',
        ".SH NAME",
        _escaped(summary).replace(":", r" \-", 1),
        ".SH SYNOPSIS",
        ".nf",
        *map(_escaped, synopsis.splitlines()),
        ".fi",
    ]
    for group in groups:
        title, *rest = group.splitlines()
        lines.append(f'.SH "{_escaped(title).upper()}"')
        before = ""
        for line in rest:
            syntax, text = split_entry(line)
            if syntax:
                lines += [".TP", f".B {_escaped(syntax)}"]
            elif line[0] != " " and before.startswith(" "):
                lines.append(".PP")
            lines.append(_escaped(text))
            before = line
    return "\n".join([*lines, _END])


def _escaped(text: str) -> str:
    """Text in which hyphens stay what they are, and no line is a request."""
    escaped = text.replace("\\", r"\e").replace("-", r"\-")
    return rf"\&{escaped}" if escaped[:1] in (".", "'") else escaped


if __name__ == "__main__":
    print(man_page())
