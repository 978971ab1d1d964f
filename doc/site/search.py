"""The index that search.js looks in: a script with a list of the sections of all pages, because a page that is
opened as a file may load a script, but no data."""

import html.parser
import json
import re

# Headings that many pages have.
PARTS = ("Components", "Procedures", "Inherited procedures", "Constants", "Types and procedures")
HEADINGS = ("h1", "h2", "h3", "h4")
SKIPPED = ("nav", "script", "style", "details")
# Tags within a word or a line of text.
INLINE = ("a", "b", "code", "em", "i", "small", "span", "strong", "sub", "sup", "wbr")
# Pages that say again what others say: the start page is a part of README.md, the lists are of the Fortran interface.
REPEATED = re.compile(r"index\.html$|lists/")
# The languages of the results, and the pages that are about one of them only.
LANGUAGES = ("Fortran", "C", "Python", "FORTRAN 77")
REFERENCES = (("Fortran", r"(?:type|proc|module|interface)/|page/fortran\.html$"), ("C", r"page/fuge_\w*h\.html$"),
              ("Python", r"page/python\.html$"), ("FORTRAN 77", r"page/legacy\.html$"))
OTHERS = (("Fortran", r"page/(?:tutorial_fortran|file_\w+_f90)\.html$"), ("C", r"page/(?:tutorial_c|file_\w+_[ch])\.html$"),
          ("Python", r"page/(?:tutorial_python|file_\w+_py)\.html$"), ("FORTRAN 77", r"page/file_\w+_f\.html$"))
# The groups of the results, as in search.js, for those of the tree of pages; all others are tutorials and how-to.
GROUPS = {"Reference": "Files and the command", "Theory": "Theory and performance",
          "Performance": "Theory and performance", "Examples": "Examples and the project",
          "The project": "Examples and the project", "Other files": "Examples and the project"}
GUIDES = "Tutorials and how-to"
# Letters of the text below that a heading without text of its own shows.
BORROWED = 300


class _Sections(html.parser.HTMLParser):
    """The text of a page below each of its headings: lists of an anchor, a title, pieces of text, pieces of code in
    blocks, and the names of constants that have an anchor there or begin a row of a table."""

    def __init__(self, page):
        super().__init__()
        self.found, self.inside, self.skipped, self.heading, self.row, self.block = [], False, 0, False, False, 0
        self.feed(page)

    def handle_starttag(self, tag, attrs):
        attrs = dict(attrs)
        if tag == "main":
            self.inside = True
        elif tag in SKIPPED:
            self.skipped += 1
        if not self.inside or self.skipped:
            return
        if tag in HEADINGS:
            self.found.append([attrs.get("id", ""), "", [], [], set()])
            self.heading = True
        elif not self.heading and self.found:
            self.block += tag == "pre"
            self.found[-1][3 if self.block else 2].append("" if tag in INLINE else " ")
            self.name(re.sub(r"^variable-|~\d+$", "", attrs.get("id", "")))
            self.row = tag == "tr" or (self.row and tag in ("td", "code", "a", "p"))

    def name(self, text):
        if text.lower().startswith("fuge_"):
            self.found[-1][4].add(text.lower())

    def handle_endtag(self, tag):
        if tag == "main":
            self.inside = False
        elif self.skipped and tag in SKIPPED:
            self.skipped -= 1
        elif tag in HEADINGS:
            self.heading = False
        elif self.inside and not self.skipped:
            self.block -= tag == "pre" and self.block > 0

    def handle_data(self, data):
        if self.inside and not self.skipped and self.found:
            if self.heading:
                self.found[-1][1] += data
            else:
                self.found[-1][3 if self.block else 2].append(data)
                if self.row and data.strip():
                    self.name(data.strip())
                    self.row = False


def is_searched(address):
    """Has the page something that no other page has?"""
    return address == "page/index.html" or not REPEATED.match(address)


def sections(page, address, trail):
    """The entries of a page: address, title, where it is, its prose, its code, the group of results, the language
    that it is about, and the names that it declares."""
    entries = []
    place = " › ".join(title for title, _ in trail[1:])
    group, language = _group(address, trail), _language(address)
    for anchor, title, prose, code, names in _Sections(page).found:
        prose, code = (re.sub(r"\s+", " ", "".join(pieces)).strip() for pieces in (prose, code))
        where = place if entries else " › ".join(title for title, _ in trail[1:-1])
        title = " ".join(title.split())
        # What a type has is named by the type; only its page is about a name.
        if entries and (title in PARTS or address.startswith("type/")):
            title = f"{entries[0][1].split()[0]}: {title}"
        if group == "Python" and anchor in title.split():
            names.add(anchor.lower())
        # The first heading of a page is the page.
        entries.append([address + (f"#{anchor}" if anchor and entries else ""), title, where, prose, code, group,
                        language, sorted(names)])
    return _with_borrowed_text(entries)


def _with_borrowed_text(entries):
    """The entries; a heading without text gets the beginning of what is below it."""
    for entry, below in reversed(list(zip(entries, entries[1:]))):
        if not entry[3] and not entry[4]:
            entry[3] = f"{below[1]}: {below[3]}"[:BORROWED].rsplit(" ", 1)[0]
    return entries


def _language(address):
    return next((language for language, pattern in (*REFERENCES, *OTHERS) if re.match(pattern, address)), "")


def _group(address, trail):
    reference = next((language for language, pattern in REFERENCES if re.match(pattern, address)), None)
    return reference or GROUPS.get(trail[1][0] if len(trail) > 1 else "", GUIDES)


def write(entries, path):
    path.write_text("const sections = " + json.dumps(entries, ensure_ascii=False, separators=(",", ":")) + "\n")
