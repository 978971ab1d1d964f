"""The start page of the site, from README.md: what it is, a picture, what it solves, the ways in, how to install it."""

import re

# The blocks of code that show a call in each language, and the page that goes on from there.
WAYS = (("Fortran", "fortran", "use fuge", "Tutorial in Fortran", "doc/tutorial_fortran.md"),
        ("C", "c", "fuge_", "Tutorial in C", "doc/tutorial_c.md"),
        ("Python", "python", "fuge", "Tutorial in Python", "doc/tutorial_python.md"),
        ("FORTRAN 77", "fortran", "CALL FUGE", "All procedures for FORTRAN 77", "doc/legacy.md"))
INSTALL = r"(?:^ *cmake [^\n]*\n)+"
PICTURE = r"^!\[[^\]]*\]\([^)]*\)$"
TABLE = r"^\| ---"


def page(readme):
    """The start page, with links as those of README.md."""
    opening, *sections = re.split(r"^(?=## )", readme, flags=re.M)
    if not re.search(PICTURE, opening, re.M):
        raise SystemExit("fuge: README.md has no picture for the start page of the site")
    title, _, lead = opening.partition("\n")
    # A table of what to call for which problem.
    choices = sections[0].strip() if re.search(TABLE, sections[0], re.M) else ""
    ways = "".join(f'<section markdown="1">\n\n### From {name}\n\n{_call(name, language, mark, readme)}\n\n'
                   f"[{more}]({target})\n\n</section>\n" for name, language, mark, more, target in WAYS)
    commands = "\n".join(line.strip() for line in _only(INSTALL, readme, "cmake commands").splitlines())
    text = (f"{title}\n\n{lead.strip()}\n\n{choices}\n\n"
            f'## Ways in\n\n<div class="ways" markdown="1">\n{ways}</div>\n\n'
            f"## Install\n\n~~~sh\n{commands}\n~~~\n\n"
            "For Python `pip install .`; all other ways are in [Installation](doc/install.md).\n\n"
            "## Where to go\n\n"
            "[The manual](doc/index.md) lists all pages. [Overview](README.md) goes on from here: limits, licence, "
            "how to cite. [Performance](doc/performance.md) has error and time of each call, "
            "[Theory](doc/theory.md) how they "
            "work, [Conventions](doc/conventions.md) what signs and units mean.\n")
    # What is not here is on the page of README.md.
    return re.sub(r"\]\(#", "](README.md#", text)


def _call(name, language, mark, text):
    """The first block of code in a language that has a mark in it."""
    rest = r"(?:(?!^```).)*?"
    return _only(f"^```{language}\\n{rest}{mark}{rest}^```$", text, "call from " + name)


def _only(pattern, text, what):
    match = re.search(pattern, text, re.M | re.S)
    if not match:
        raise SystemExit(f"fuge: README.md has no {what} for the start page of the site")
    return match[0]
