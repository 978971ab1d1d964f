"""The start page of the site, from README.md: what it is, a picture, the ways in, how to install it."""

import re

# The blocks of code that show a call in each language, and the page that goes on from there.
WAYS = (("Fortran", "fortran", "use fuge", "Tutorial in Fortran", "doc/tutorial_fortran.md"),
        ("C", "c", "fuge_", "Tutorial in C", "doc/tutorial_c.md"),
        ("Python", "python", "fuge", "Tutorial in Python", "doc/tutorial_python.md"),
        ("FORTRAN 77", "fortran", "CALL FUGE", "All procedures for FORTRAN 77", "doc/legacy.md"))
INSTALL = r"(?:^ *cmake [^\n]*\n)+"
PICTURE = r"^!\[[^\]]*\]\([^)]*\)$"


def page(readme):
    """The start page, with links as those of README.md."""
    title, _, text = readme.partition("\n")
    lead = re.split(r"\n(?=!\[|## )", text.strip(), maxsplit=1)[0]
    picture = _only(PICTURE, readme, "picture")
    ways = "".join(f'<section markdown="1">\n\n### {name}\n\n{_call(name, language, mark, readme)}\n\n'
                   f"[{more}]({target})\n\n</section>\n" for name, language, mark, more, target in WAYS)
    commands = "\n".join(line.strip() for line in _only(INSTALL, readme, "cmake commands").splitlines()
                         if line.strip() and not line.startswith("```"))
    return (f"{title}\n\n{lead}\n\n{picture}\n\n"
            f'## Ways in\n\n<div class="ways" markdown="1">\n{ways}</div>\n\n'
            f"## Install\n\n~~~sh\n{commands}\n~~~\n\n"
            "For Python `pip install .`; all other ways are in [Installation](doc/install.md).\n\n"
            "## Where to go\n\n"
            "[The manual](doc/index.md) lists all pages; [Performance](doc/performance.md) says which engine to "
            "choose, [Theory](doc/theory.md) how they work, [Conventions](doc/conventions.md) what signs and units "
            "mean.\n")


def _call(name, language, mark, text):
    """The first block of code in a language that has a mark in it."""
    rest = r"(?:(?!^```).)*?"
    return _only(f"^```{language}\\n{rest}{mark}{rest}^```$", text, "call from " + name)


def _only(pattern, text, what):
    match = re.search(pattern, text, re.M | re.S)
    if not match:
        raise SystemExit(f"fuge: README.md has no {what} for the start page of the site")
    return match[0]
