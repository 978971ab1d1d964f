"""Does check_browser.py see what it looks for? check_browser_errors.py SITE

Copies of pages get one fault each: too wide, loaded from elsewhere, an error in a script, a formula as its
source, a lost picture, text that a sidebar leaves no space for; then a menu that does not open, and an index of
the search without what is looked for. Each has to be complained about, and the page as it is must not be.
"""

import pathlib
import shutil
import sys
import tempfile

import check_browser

END = "</main>"
PAGE = "page/errors.html"
# The fault, and a part of the complaint that is expected.
FAULTS = (
    ('<div style="max-width: none; width: 1300px">wide</div>', "px wide at 1280 px"),
    ('<p style="white-space: nowrap">A line of text that is wider than a window of 400 pixels, because it has no '
     "breaks</p>", "px wide at 400 px"),
    ('<style>body { overflow-x: hidden }</style><div style="max-width: none; width: 1300px">wide</div>', "does not count"),
    ('<img src="https://example.invalid/a.png" alt="">', "loads https://example.invalid"),
    ('<link rel="stylesheet" href="http://example.invalid/a.css">', "loads http://example.invalid"),
    ("<script>undefined_function()</script>", "undefined_function is not defined"),
    ("<script>console.error('a message')</script>", "console: a message"),
    ("<p>The load $F_0$ is given.</p>", "a formula is not set: $F_0$"),
    (r"<p>The load \(F_0\) is given.</p>", "a formula is not set"),
    ('<img src="lost.png" alt="">', "no picture"),
    ("<style>.page { display: flex } #tree { display: block; flex: 0 0 300px }</style>", "the text is"),
)


def complaints(site, folder):
    """What is said about each faulty page; about the page as it is for the last one."""
    text = (site/PAGE).read_text()
    with check_browser.opened(check_browser.program()) as browser:
        for number, (fault, _) in enumerate((*FAULTS, ("", ""))):
            path = folder/f"fault_{number}.html"
            # The address of the page as before, so that its own links hold.
            path.write_text(text.replace("<head>", f'<head><base href="{(site/PAGE).as_uri()}">').replace(
                END, fault + END))
            yield list(check_browser.checked(check_browser.check_page(browser, path, folder, None)))


def use_complaints(site, folder):
    """What is said about a site whose menu stays closed and whose index is empty."""
    copy = folder/"site"
    (copy/"page").mkdir(parents=True)
    shutil.copytree(site/"css", copy/"css")
    for name in ("search.html", "search.js", "page/index.html"):
        shutil.copy(site/name, copy/name)
    (copy/"search_index.js").write_text("const sections = []\n")
    style = copy/"css/user.css"
    style.write_text(style.read_text().replace("input.menu:checked ~ nav.tree { display: block; }", ""))
    return check_browser.check_use(check_browser.program(), copy)


def main():
    site = pathlib.Path(sys.argv[1]).resolve()
    missed = []
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        said = list(complaints(site, folder))
        for (fault, wanted), lines in zip(FAULTS, said):
            if not any(wanted in line for line in lines):
                missed.append(f"{fault}: '{wanted}' is not said, but {lines}")
        if said[-1]:
            missed.append(f"the page as it is: {said[-1]}")
        lines = use_complaints(site, folder)
        for wanted in ("menu: the menu does not open", "'half-width' does not find", "does not search",
                       "does not leave out"):
            if not any(wanted in line for line in lines):
                missed.append(f"'{wanted}' is not said, but {lines}")
    for line in missed:
        print(f"fuge: a fault is not seen: {line}", file=sys.stderr)
    sys.exit(1 if missed else 0)


if __name__ == "__main__":
    main()
