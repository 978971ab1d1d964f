"""C headers as pages: sections, and for each function its declaration and its comment as text."""

import html
import re

SECTION = re.compile(r"^/\* ---- (.*?) -+[ ]*(\*/)?$", re.M)
# A comment in the first column, with what is before the next one.
COMMENT = re.compile(r"^/\*.*?\*/[^\n]*$", re.M | re.S)
FUNCTION = re.compile(r"^(?!typedef\b)[a-z][\w ]*[ *](fuge_\w+)\(", re.M)
CALLBACK = re.compile(r"^typedef \w+ \(\*(fuge_\w+)\)\(", re.M)
TYPE = re.compile(r"^(?:typedef struct fuge_\w+ (fuge_\w+);|\} (fuge_\w+);)", re.M)
CONSTANT = re.compile(r"^(?:#define|  )\s*(FUGE_\w+)(?= |,|$)|(?<=[{,] )(FUGE_\w+)(?= =)", re.M)
# A header that another one includes, and what it is for.
INCLUDE = re.compile(r'^#include "(fuge_\w+\.h)" +/\* (.*?) \*/$', re.M)
# A row of the list of arguments: their names, in or out, and what they are.
ROW = re.compile(r"(?P<names>(?:\*?\w+(?:, )?)+?) {2,}(?:(?P<way>in, out|in/out|inout|in|out) {1,})?(?P<text>.*)")
NEXT_ROW = re.compile(r" {3,}(?=\w+ {1,}(?:in|out) {2})")
ROW_INDENT = 2
# Names, or a kind, of up to this many letters keep to one line.
ONE_LINE = 28
KEPT = re.compile(r"^#(?:ifndef|define) FUGE_(?:\w+_)?H$|^#ifdef __cplusplus\nextern \"C\" \{\n#endif$"
                  r"|^#ifdef __cplusplus\n\}\n#endif$|^#endif$|^#include <stddef.h>$", re.M)


def names(code):
    """The functions and types that a part of a header declares, and its constants."""
    declared = [m[1] for m in FUNCTION.finditer(code)] + [m[1] for m in CALLBACK.finditer(code)]
    declared += [m[1] or m[2] for m in TYPE.finditer(code)]
    return declared, [m[1] or m[2] for m in CONSTANT.finditer(code)]


def anchors(text):
    """All names of a header that its page has an anchor for."""
    code = re.sub(r"/\*.*?\*/", "", text, flags=re.S)
    declared, constants = names(code)
    return [*declared, *constants]


def page(text, places, fragments):
    """The page of a header. `places` has the address of every C name, as seen from the page."""
    first, *rest = SECTION.split(text)
    body = _opening(first, places, fragments)
    for title, closed, part in zip(rest[::3], rest[1::3], rest[2::3]):
        body += f"\n## {title[:1].upper() + title[1:]}\n\n"
        if closed is None:
            comment, _, part = part.partition("*/")
            body += _held(comment_html("/*" + comment + "*/", places), fragments)
        body += "".join(_item(comment, code, places, fragments) for comment, code in _items(part))
    return body


def _opening(text, places, fragments):
    """The comment at the top, and what is declared before the first section."""
    end = text.index("*/") + 2
    comment = re.sub(r"SPDX-License-Identifier: \S+", "", text[:end])
    comment = re.sub(r"/\* fuge - ([^\n]*)", lambda m: "/* " + m[1].strip().capitalize(), comment)
    body = _held(comment_html(comment, places), fragments)
    included = INCLUDE.findall(text)
    if included:
        rows = "".join(f"<li>{_linked(name, places)}: {_linked(said, places)}</li>" for name, said in included)
        body += _held(f"<ul>{rows}</ul>", fragments)
    rest = INCLUDE.sub("", text[end:])
    return body + "".join(_item(said, code, places, fragments) for said, code in _items(rest))


def _items(text):
    """Comments in the first column, each with the code below it up to an empty line after a declaration."""
    text = KEPT.sub("", text)
    found, at, comment = [], 0, ""
    for match in [*COMMENT.finditer(text), None]:
        code = text[at:match.start() if match else len(text)]
        parts = [part.strip("\n") for part in re.split(r"\n\s*\n", code) if part.strip()]
        for part in parts:
            found.append((comment, part))
            comment = ""
        if match:
            if comment:
                found.append((comment, ""))
            comment, at = match[0], match.end()
    return [*found, (comment, "")] if comment else found


def _item(comment, code, places, fragments):
    """A heading of the names declared, the declaration, and what the comment says."""
    declared, constants = names(code)
    head = ""
    marks = "".join(f'<span id="{name}"></span>' for name in [*declared[1:], *constants])
    if declared:
        head = f"\n### {', '.join(declared)} {{: #{declared[0]} }}\n\n"
    if marks:
        head += _held(marks, fragments)
    shown = f"\n~~~c\n{code}\n~~~\n\n" if code else ""
    return head + shown + (_held(comment_html(comment, places), fragments) if comment else "")


def _held(text, fragments):
    return f"\n{fragments.hold('html', text)}\n\n"


def comment_html(comment, places):
    """The text of a comment: paragraphs, lists of arguments as tables, other indented lines as they are."""
    inner = re.sub(r"^/\*+ ?|\s*\*/$", "", comment.strip())
    lines = [re.sub(r"^ ?\*? ?", "", line, count=1) if k else line for k, line in enumerate(inner.split("\n"))]
    out, block = [], []
    kind = None
    for line in [*lines, ""]:
        stripped = line.strip()
        present = ("" if not stripped else "text" if not line.startswith("  ") else
                   "rows" if kind == "rows" or (kind != "code" and re.match(r" {2}\S", line) and ROW.match(stripped))
                   else "code")
        if present != kind:
            if block:
                out.append(_block(kind, block, places))
            block = []
            kind = present
        if stripped:
            block.append(line)
    return "\n".join([*out, *([_block(kind, block, places)] if block else [])])


def _block(kind, lines, places):
    if kind == "rows":
        return _table(lines, places)
    if kind == "code":
        indent = min(len(line) - len(line.lstrip()) for line in lines)
        return "<pre>" + html.escape("\n".join(line[indent:] for line in lines), quote=False) + "</pre>"
    return "<p>" + _linked(" ".join(line.strip() for line in lines), places) + "</p>"


def _table(lines, places):
    rows = []
    for line in lines:
        if re.match(rf" {{{ROW_INDENT}}}\S", line):
            for part in NEXT_ROW.split(line.strip()):
                match = ROW.match(part)
                rows.append([match["names"], match["way"] or "", match["text"]] if match else [part, "", ""])
        else:
            rows[-1][2] += " " + line.strip()
    return arguments([name, way, _linked(text, places)] for name, way, text in rows)


def arguments(rows):
    """The table of rows of names, their kind, and what they are; the last two are HTML."""
    cells = ""
    for name, kind, text in rows:
        marks = [' class="many"' if len(shown) > ONE_LINE else "" for shown in (name, re.sub("<[^>]*>", "", kind))]
        cells += (f"<tr><td{marks[0]}><code>{html.escape(name)}</code></td><td{marks[1]}>{kind}</td>"
                  f"<td>{text}</td></tr>\n")
    return f'<div class="wide"><table class="arguments">\n{cells}</table></div>'


def _linked(text, places):
    """The text with links from headers and names of C to their places, and capital openings as strong text."""
    text = html.escape(text.rstrip(";"), quote=False)
    text = re.sub(r"^([A-Z][A-Z ]+\.)  ", r"<strong>\1</strong> ", text)

    def link(match):
        name = match[1] or match[0]
        shown = f"<code>{name}</code>"
        return f'<a href="{places[name]}">{shown}</a>' if name in places else shown
    return re.sub(r"`(\w+)`|\bfuge\w*\.h\b|\b(?:fuge|FUGE)_\w+", link, text)
