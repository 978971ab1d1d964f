"""The reference of the Python package: signatures and docstrings, read without importing it."""

import ast
import html
import re

from headers import arguments

ROLE = re.compile(r":\w+:`~?\.?([^`]+)`")


def page(package, fragments):
    """The page of a package: the names that it exports, by the module that defines them."""
    facade = ast.parse((package/"__init__.py").read_text())
    body = fragments.hold("html", docstring_html(ast.get_docstring(facade))) + "\n\n"
    for node in facade.body:
        if not isinstance(node, ast.ImportFrom) or not (node.module or "").startswith("fuge"):
            continue
        if node.module == "fuge":
            body += "".join(_module(package/f"{alias.name}.py", fragments) for alias in node.names if alias.asname)
            continue
        source = package/(node.module.split(".")[-1] + ".py")
        tree = ast.parse(source.read_text())
        said = ast.get_docstring(tree) or source.stem
        body += f"\n## {source.stem.replace('_', ' ').capitalize()}\n\n{said.splitlines()[0]}\n"
        wanted = {alias.name for alias in node.names}
        for item in tree.body:
            if isinstance(item, (ast.FunctionDef, ast.ClassDef)) and item.name in wanted:
                body += _entry(item, fragments)
    return body


def _module(source, fragments):
    """A module that is exported as a whole: all of its functions, with its name in front."""
    tree = ast.parse(source.read_text())
    body = f"\n## {source.stem.capitalize()}\n\n" + fragments.hold("html", docstring_html(ast.get_docstring(tree))) + "\n"
    for item in tree.body:
        if isinstance(item, ast.FunctionDef) and not item.name.startswith("_"):
            name = f"{source.stem}.{item.name}"
            body += _head(3, name, name) + _described(_signature(item), item, fragments)
    return body


def _entry(node, fragments):
    if isinstance(node, ast.FunctionDef):
        return _head(3, node.name, node.name) + _described(_signature(node), node, fragments)
    bases = [ast.unparse(base) for base in node.bases]
    shown = f"class {node.name}" + (f"({', '.join(bases)})" if bases else "")
    body = _head(3, node.name, node.name) + _described(shown, node, fragments)
    for item in node.body:
        if isinstance(item, ast.FunctionDef) and (not item.name.startswith("_") or item.name == "__init__"):
            if ast.get_docstring(item) or not item.name.startswith("_"):
                name = f"{node.name}.{item.name}"
                body += _head(4, name, name) + _described(_signature(item), item, fragments)
    return body


def _head(level, shown, anchor):
    return f"\n{'#'*level} {shown.replace('__', '&#95;&#95;')} {{: #{anchor} }}\n\n"


def _signature(node):
    marks = "".join(f"@{ast.unparse(mark)}\n" for mark in node.decorator_list
                    if isinstance(mark, ast.Name) and mark.id in ("property", "classmethod", "staticmethod"))
    result = f" -> {ast.unparse(node.returns)}" if node.returns else ""
    line = f"{marks}def {node.name}({ast.unparse(node.args)}){result}"
    if len(line) > 88:
        parts = re.split(r", (?=\*?\*?\w+(?::|,|=|$|\)))", ast.unparse(node.args))
        line = f"{marks}def {node.name}(" + "".join(f"\n    {part}," for part in parts) + f"\n){result}"
    return line


def _described(code, node, fragments):
    said = ast.get_docstring(node)
    text = f"~~~python\n{code}\n~~~\n\n"
    return text + (fragments.hold("html", docstring_html(said)) + "\n" if said else "")


def docstring_html(text):
    """A docstring with numpy's sections as HTML."""
    out = []
    lines = text.split("\n")
    k = 0
    while k < len(lines):
        line = lines[k]
        if not line.strip():
            k += 1
        elif k + 1 < len(lines) and re.fullmatch(r"-{3,}", lines[k + 1].strip()):
            end = k + 2
            while end < len(lines) and not (end + 1 < len(lines) and re.fullmatch(r"-{3,}", lines[end + 1].strip())):
                end += 1
            out.append(f"<p><strong>{html.escape(line.strip())}</strong></p>" + _section(lines[k + 2:end]))
            k = end
        else:
            end = k
            while end < len(lines) and lines[end].strip() and not (
                    end + 1 < len(lines) and re.fullmatch(r"-{3,}", lines[end + 1].strip())):
                end += 1
            out.append(_paragraph(lines[k:end]))
            k = end
    return "\n".join(out)


def _paragraph(lines):
    if lines[0].startswith(("    ", ">>>")):
        indent = min(len(line) - len(line.lstrip()) for line in lines)
        return "<pre>" + html.escape("\n".join(line[indent:] for line in lines), quote=False) + "</pre>"
    return "<p>" + _inline(" ".join(line.strip() for line in lines)) + "</p>"


def _section(lines):
    """A list of items, or text with examples."""
    has_items = any(line.startswith(" ") or " : " in line for line in lines)
    if any(line.startswith(">>>") for line in lines) or not has_items:
        parts = re.split(r"\n\s*\n", "\n".join(lines).strip("\n"))
        return "\n".join(_paragraph(part.split("\n")) for part in parts if part.strip())
    return _items(lines)


def _items(lines):
    """The rows of a section: a name with its type, and below it, indented, what it is."""
    rows = []
    for line in lines:
        if line.strip() and not line.startswith(" "):
            name, _, kind = line.partition(" : ")
            rows.append([name, kind, ""])
        elif rows and line.strip():
            rows[-1][2] += " " + line.strip()
    return arguments([name, _inline(kind), _inline(text.strip())] for name, kind, text in rows)


def _inline(text):
    text = html.escape(text, quote=False)
    text = ROLE.sub(lambda m: f"<code>{m[1]}</code>", text)
    return re.sub(r"``?([^`]+)``?", r"<code>\1</code>", text)
