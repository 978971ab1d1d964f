"""Text for Python's Markdown, which FORD uses, so that it is read as GitHub and others read it."""

import re

# A product, a power, or FORTRAN 77's CHARACTER*(*), in which Markdown would see emphasis.
PRODUCT = re.compile(r"(?<=[\w)])\*+(?=[\w(])|(?<=\()\*(?=\))")


class _State:
    """The context of a line."""

    def __init__(self):
        self.fenced = False   # in a block between ``` or ~~~
        self.listed = False   # in a list
        self.loose = False    # after an empty line in the present item
        self.before = ""      # the line before, without empty lines in a block of code


def with_products(text):
    """The text, none of it code, with the stars of products as they are."""
    return PRODUCT.sub(lambda stars: stars[0].replace("*", r"\*"), text)


def for_markdown(text, mark=""):
    """The text with an empty line before lists, four spaces below their items, and a language for formulas.

    On GitHub a list needs no empty line before it, and its items are indented by two spaces. Without a
    language, indented blocks would be coloured by a guess, but they are formulas. With a `mark`, that of a
    docstring, only lines that begin with it are text.
    """
    out, state = [], _State()
    for line in text.split("\n"):
        if not line.lstrip().startswith(mark):
            state = _State()
            out.append(line)
            continue
        head = line[:len(line) - len(line.lstrip()) + len(mark)] + " " if mark else ""
        out.extend((head + body).rstrip() for body in _lines(line[len(head):], state))
    return "\n".join(out)


def _lines(body, state):
    """A line of text, after the lines that have to be before it."""
    state.fenced ^= body.startswith(("```", "~~~"))
    if state.fenced:
        state.before = body
        return [body]
    added = []
    item = bool(re.match(r"[-*] |1\. ", body) or (state.listed and re.match(r"\d+\. ", body)))
    if item and state.before.strip() and (state.loose or not state.listed):
        added.append("")
    state.loose = not item and (state.loose or not body.strip())
    state.listed = item or (state.listed and (body.startswith("  ") or not body.strip()))
    if state.listed and body.startswith("  "):
        body = "  " + body
    code = "        " if state.listed else "    "
    if body.startswith(code) and not state.before.strip():
        added.append(code + ":::text")
    if body.strip() or not state.before.startswith(code):
        state.before = body
    return [*added, body]
