"""Finish the pages that FORD has made: finish.py WORK SITE KATEX

Every page gets the tree of all pages, the path to itself, its formulas, and below its heading a list of its
sections; then the page of the search and its index are written. KATEX is the folder with KaTeX's katex.js,
katex.css and fonts; the formulas are set here, so that the site needs no script for them.
"""

import html
import json
import pathlib
import re
import shutil
import subprocess
import sys

import formulas
import navigation
import search
from fragments import Fragments
from pygments.formatters import HtmlFormatter

SECTIONS_LISTED = 4
LISTS = {"lists/procedures.html": "All procedures", "lists/types.html": "All types",
         "lists/modules.html": "All modules", "lists/absint.html": "Abstract interfaces"}
SEARCH_BODY = f"""<h1>Search</h1>
<fieldset id="languages"><legend>Language</legend>
<label><input type="radio" name="language" value="" checked> all</label>
{"".join(f'<label><input type="radio" name="language" value="{name}"> {name}</label>' + chr(10)
         for name in search.LANGUAGES)}</fieldset>
<noscript><p>The search needs JavaScript; <a href="page/index.html">the manual</a> lists all pages.</p></noscript>
<p id="status" role="status"></p>
<div id="results"></div>
<script src="search_index.js"></script>
<script src="search.js"></script>
"""


def shown_parts(fragments, script, katex):
    """The HTML of all held parts."""
    formulas = [(kind == "display", text) for kind, text in fragments.parts if kind != "html"]
    done = subprocess.run(["node", str(script), str(katex/"katex.js")], input=json.dumps(formulas), text=True,
                          stdout=subprocess.PIPE, check=False)
    if done.returncode:
        raise SystemExit("fuge: formulas cannot be set")
    set_formulas = iter(json.loads(done.stdout))
    return [text if kind == "html" else next(set_formulas) for kind, text in fragments.parts]


def trail_of(groups, address):
    if address == "index.html":
        return [["fuge", "index.html"]]
    fortran = navigation.trail(groups, "page/fortran.html")
    if address in LISTS:
        return [*fortran, [LISTS[address], address]]
    if address.startswith("interface/"):
        return [*fortran, [LISTS["lists/absint.html"], "lists/absint.html"], [address[10:-5], address]]
    found = navigation.trail(groups, address)
    if found is None and not address.startswith("module/"):
        raise SystemExit(f"fuge: the tree of pages does not have {address}")
    return found or [*fortran, [f"module {address[7:-5]}", address]]


def trail_html(trail, up):
    items = [f'<li><a href="{up}{place}">{html.escape(title)}</a></li>' if place else f"<li>{html.escape(title)}</li>"
             for title, place in trail[:-1]]
    last = f'<li aria-current="page">{html.escape(trail[-1][0])}</li>'
    return f'<nav class="trail" aria-label="Breadcrumbs"><ol>{"".join(items)}{last}</ol></nav>' if items else ""


def contents(page):
    """The list of the sections of a page, where it has some."""
    found = re.findall(r'<h2 id="([^"]+)">(.*?)</h2>', page, re.S)
    if len(found) < SECTIONS_LISTED:
        return ""
    rows = "".join(f'<li><a href="#{anchor}">{re.sub("<[^>]*>", "", title)}</a></li>\n' for anchor, title in found)
    return f'<details class="contents"><summary>On this page</summary>\n<ul>\n{rows}</ul></details>'


def broken_headings(page):
    """The page with names in its headings that may be broken behind an underscore."""
    return re.sub(r"(<h[1-4][^>]*>)([^<]*_[^<]*)", lambda m: m[1] + m[2].replace("_", "_<wbr>"), page)


def scrollable(page):
    """The page with its tables in boxes that scroll, and with names in them that may be broken."""
    page = re.sub(r"(?<=<code>)[^<\n]*_[^<\n]*(?=</code>)", lambda m: m[0].replace("_", "_<wbr>"), page)
    return re.sub(r'(?<!<div class="wide">)(<table.*?</table>)', r'<div class="wide">\1</div>', page, flags=re.S)


def without_ford(page):
    """The page without what FORD puts in for its own style sheets."""
    page = re.sub(r'<a href="[^"]*" class="pull-right"><emph>.*?</emph></a>', "", page)
    return re.sub(r"<div class=\"toc\">.*?</div>", "", page, flags=re.S)


def with_whole_pictures(page):
    """The page with a link from each picture to its file, which shows it as large as it is."""
    return re.sub(r'(<img [^>]*?src="([^"]+)"[^>]*>)(?!</a>)', r'<a href="\2">\1</a>', page)


def finish(site, groups, fragments, shown):
    """All pages, and the entries of the search."""
    entries = []
    spoken = [text if kind == "html" else html.escape(formulas.spoken(text)) for kind, text in fragments.parts]
    for path in sorted(site.rglob("*.html")):
        address = path.relative_to(site).as_posix()
        up = "../"*address.count("/")
        trail = trail_of(groups, address)
        text = without_ford(path.read_text())
        if search.is_searched(address):
            entries += search.sections(fragments.restored(text, spoken), address, trail)
        page = with_whole_pictures(fragments.restored(text, shown))
        page = scrollable(page.replace("<!--contents-->", contents(page)))
        page = broken_headings(page)
        library = next((navigation.LIBRARIES[title] for title, _ in trail if title in navigation.LIBRARIES), "fuge")
        page = page.replace("<code>use fuge</code> gives it too", f"<code>use {library}</code> gives it")
        page = page.replace("<!--trail-->", trail_html(trail, up))
        page = page.replace("<!--tree-->", navigation.as_html(groups, address, up))
        path.write_text(page)
    return entries


def write_search(site, here):
    """The page of the search: the frame of the start page with the form and the list of results."""
    start = (site/"index.html").read_text()
    head, rest = start.split('<main id="text">')
    tail = rest[rest.index("</main>"):]
    head = re.sub(r"<title>.*?</title>", "<title>Search &ndash; fuge</title>", head, flags=re.S)
    trail = trail_html([["fuge", "index.html"], ["Search", "search.html"]], "")
    (site/"search.html").write_text(f'{head}<main id="text">\n{trail}\n{SEARCH_BODY}{tail}')
    shutil.copy(here/"search.js", site)


def write_styles(site, katex):
    """The colours of code in the light and in the dark, and KaTeX's style sheet with the fonts of browsers of today."""
    light = HtmlFormatter(style="default").get_style_defs(".codehilite")
    dark = HtmlFormatter(style="github-dark").get_style_defs(".codehilite")
    lines = re.sub(r"^(pre|td\.linenos|span\.linenos)[^\n]*\n", "", dark, flags=re.M)
    (site/"css/pygments.css").write_text(f"{light}\n@media (prefers-color-scheme: dark) {{\n{lines}\n}}\n")
    (site/"css/katex/fonts").mkdir(parents=True)
    for font in sorted((katex/"fonts").glob("*.woff2")):
        shutil.copyfile(font, site/"css/katex/fonts"/font.name)
    style = (katex/"katex.css").read_text()
    style = re.sub(r",\s*url\([^)]*\.(?:woff|ttf)\)\s*format\([^)]*\)", "", style)
    (site/"css/katex/katex.css").write_text(style)
    # The licence of what is copied here, where Debian or npm has it.
    for licence in (pathlib.Path("/usr/share/doc/libjs-katex/copyright"), katex.parent/"LICENSE"):
        if licence.is_file():
            shutil.copyfile(licence, site/"css/katex/LICENSE.txt")
            break


def main():
    work, site, katex = (pathlib.Path(name).resolve() for name in sys.argv[1:4])
    here = pathlib.Path(__file__).resolve().parent
    groups = navigation.load(work/"navigation.json")
    fragments = Fragments.load(work/"fragments.json")
    entries = finish(site, groups, fragments, shown_parts(fragments, here/"formulas.js", katex))
    write_styles(site, katex)
    write_search(site, here)
    search.write(entries, site/"search_index.js")
    print(f"fuge: {len([1 for kind, _ in fragments.parts if kind != 'html'])} formulas, "
          f"{len(entries)} sections to search in")


if __name__ == "__main__":
    main()
