"""The index that search.js looks in: a script with a list of the sections of all pages, because a page that is
opened as a file may load a script, but no data."""

import html.parser
import json
import re

# Headings that many pages have.
PARTS = ("Components", "Procedures", "Inherited procedures", "Constants", "Types and procedures")
HEADINGS = ("h1", "h2", "h3", "h4")
SKIPPED = ("nav", "script", "style", "details")


class _Sections(html.parser.HTMLParser):
    """The text of a page below each of its headings: lists of an anchor, a title, pieces of text, and the names of
    constants that have an anchor there or begin a row of a table."""

    def __init__(self, page):
        super().__init__()
        self.found, self.inside, self.skipped, self.heading, self.row = [], False, 0, False, False
        self.feed(page)

    def handle_starttag(self, tag, attrs):
        attrs = dict(attrs)
        if tag == "main":
            self.inside = True
        elif tag in SKIPPED or "katex-mathml" in (attrs.get("class") or ""):
            self.skipped += 1
        elif self.skipped and tag == "span":
            self.skipped += 1
        if not self.inside or self.skipped:
            return
        if tag in HEADINGS:
            self.found.append([attrs.get("id", ""), "", [], set()])
            self.heading = True
        elif not self.heading and self.found:
            self.found[-1][2].append(" " if tag not in ("a", "code", "em", "strong", "span") else "")
            self.name(re.sub(r"^variable-|~\d+$", "", attrs.get("id", "")))
            self.row = tag == "tr" or (self.row and tag in ("td", "code", "a", "p"))

    def name(self, text):
        if text.lower().startswith("fuge_"):
            self.found[-1][3].add(text.lower())

    def handle_endtag(self, tag):
        if tag == "main":
            self.inside = False
        elif self.skipped and (tag in SKIPPED or tag == "span"):
            self.skipped -= 1
        elif tag in HEADINGS:
            self.heading = False

    def handle_data(self, data):
        if self.inside and not self.skipped and self.found:
            if self.heading:
                self.found[-1][1] += data
            else:
                self.found[-1][2].append(data)
                if self.row and data.strip():
                    self.name(data.strip())
                    self.row = False


def sections(page, address, trail):
    """The entries of a page: address, title, where it is, its text and its constants."""
    entries = []
    place = " › ".join(title for title, _ in trail[1:])
    for anchor, title, pieces, names in _Sections(page).found:
        text = re.sub(r"\s+", " ", "".join(pieces)).strip()
        where = place if entries else " › ".join(title for title, _ in trail[1:-1])
        title = f"{entries[0][1].split()[0]}: {title}" if entries and title in PARTS else title
        # The first heading of a page is the page.
        entries.append([address + (f"#{anchor}" if anchor and entries else ""), " ".join(title.split()), where, text,
                        sorted(names)])
    return entries


def write(entries, path):
    path.write_text("const sections = " + json.dumps(entries, ensure_ascii=False, separators=(",", ":")) + "\n")
