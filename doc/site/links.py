"""Look for broken links: links.py ROOT SITE

In the pages of the repository every link has to lead to a file, and to a heading of it if it names one. In
the site every href and src has to lead to a file, and to an anchor of it, and nothing may be loaded from
other sites. Broken links are printed, and the exit status is then 1.
"""

import html.parser
import pathlib
import re
import sys
import urllib.parse

LINK = re.compile(r"(\[(?:[^\[\]]|\[[^\]]*\]\([^)]*\))*\])\(([^)\s]+)\)")


BLOCK = r"^(?:```|~~~).*?^(?:```|~~~)[ \t]*$|^(?: {4}|\t)[^\n]*$"


def outside_code(text, change):
    """The text with `change` applied to what is not code."""
    return _outside(BLOCK + r"|`[^`\n]*`", text, change)


def outside_blocks(text, change):
    """The text with `change` applied to what is not a block of code."""
    return _outside(BLOCK, text, change)


def _outside(code, text, change):
    parts = re.split(f"({code})", text, flags=re.M | re.S)
    return "".join(part if k % 2 else change(part) for k, part in enumerate(parts))


def with_links(text, change):
    """The text with each link replaced by `change` of its match; code may be in a link, but no link in code."""
    either = re.compile(r"`[^`\n]*`|" + LINK.pattern)
    return outside_blocks(text, lambda part: either.sub(
        lambda match: match[0] if match[0].startswith("`") else change(match), part))


def targets(text):
    """The targets of the links of a page, as they come."""
    found = []
    with_links(text, lambda match: found.append(match[2]) or match[0])
    return found


def headings(text):
    """The anchors of a page, as GitHub makes them."""
    text = re.sub(r"^```.*?^```", "", text, flags=re.M | re.S)
    titles = re.findall(r"^#+ +(.*?) *$", text, re.M)
    return {re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-") for title in titles}


def check_pages(root):
    pages = [*root.glob("*.md"), *(root/"doc").glob("*.md")]
    count = 0
    for page in sorted(pages):
        for target in targets(page.read_text()):
            address, _, anchor = target.partition("#")
            if "://" in target:
                continue
            count += 1
            path = (page.parent/address).resolve() if address else page
            if not path.exists():
                yield f"{page.relative_to(root)}: {target} is not there"
            elif anchor and path.suffix == ".md" and anchor not in headings(path.read_text()):
                yield f"{page.relative_to(root)}: {target}: no such heading"
    print(f"fuge: {count} links in {len(pages)} pages of the repository")


class Page(html.parser.HTMLParser):
    """The links and anchors of a page of the site."""

    def __init__(self, path):
        super().__init__()
        self.links, self.anchors = [], set()
        self.feed(path.read_text())

    def handle_starttag(self, tag, attrs):
        for name, value in attrs:
            if name in ("id", "name") and value:
                self.anchors.add(value)
            elif name in ("href", "src"):
                self.links.append((tag, value or ""))


def check_site(site):
    pages = {path.resolve(): Page(path) for path in sorted(site.rglob("*.html"))}
    count = 0
    for path, page in pages.items():
        for tag, target in page.links:
            url = urllib.parse.urlsplit(target)
            where = f"{path.relative_to(site)}: {target}"
            if url.scheme or url.netloc:
                if tag != "a":
                    yield f"{where} is loaded from elsewhere"
                continue
            count += 1
            file = (path.parent/urllib.parse.unquote(url.path)).resolve() if url.path else path
            if not target or not file.is_file():
                yield f"{where} is not there"
            elif url.fragment and file in pages and pages[file].anchors.isdisjoint(
                    (url.fragment, urllib.parse.unquote(url.fragment))):
                yield f"{where}: no such anchor"
    print(f"fuge: {count} links in {len(pages)} pages of the site")


def main():
    root, site = (pathlib.Path(name).resolve() for name in sys.argv[1:3])
    broken = [*check_pages(root), *check_site(site)]
    for line in broken:
        print(f"fuge: broken link in {line}", file=sys.stderr)
    sys.exit(1 if broken else 0)


if __name__ == "__main__":
    main()
