"""Parts of pages that Markdown must not touch: formulas and finished HTML.

A page gets a word in place of each, and the words are replaced when FORD has made HTML of the page.
"""

import json
import re

WORD = re.compile(r"(<p>\s*)?fragment(\d{6})held(\s*</p>)?")
# A short formula with what belongs to it on the same line.
JOINED = re.compile(r"[^\s<>]*fragment(\d{6})held[^\s<>]+|[^\s<>]+fragment(\d{6})held")
SHORT = 16
FENCED_FORMULA = re.compile(r"^( *)```math\n(.*?)\n *```$", re.M | re.S)
FORMULA = re.compile(r"(?<![\\\w$`])\$(?=[^\s$])([^$`]*?[^\s$\\])\$(?![\w$])")


class Fragments:
    """Held parts: pairs of a kind, `html`, `inline` or `display`, and a text."""

    def __init__(self, parts=None):
        self.parts = parts or []

    def hold(self, kind, text):
        """The word that stands for a text."""
        self.parts.append((kind, text))
        return f"fragment{len(self.parts) - 1:06d}held"

    def hold_fenced_formulas(self, text):
        """The text with each block of a formula in a line of its own."""
        return FENCED_FORMULA.sub(lambda m: f"\n{m[1]}{self.hold('display', m[2])}\n", text)

    def hold_formulas(self, text):
        """The text, none of it code, without the formulas between dollars."""
        return FORMULA.sub(lambda m: self.hold("inline", " ".join(m[1].split())), text)

    def save(self, path):
        path.write_text(json.dumps(self.parts))

    @staticmethod
    def load(path):
        return Fragments([tuple(part) for part in json.loads(path.read_text())])

    def restored(self, page, shown):
        """A page of HTML with its parts: `shown` has them as HTML."""
        def put(match):
            kind, number = self.parts[int(match[2])][0], int(match[2])
            if kind == "inline":
                return (match[1] or "") + shown[number] + (match[3] or "")
            return shown[number]

        def join(match):
            kind, text = self.parts[int(match[1] or match[2])]
            short = kind == "inline" and len(text) <= SHORT
            return f'<span class="joined">{match[0]}</span>' if short else match[0]
        # Within held HTML there may be held formulas.
        return WORD.sub(put, WORD.sub(put, JOINED.sub(join, page)))
