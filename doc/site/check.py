"""Look at the site with a browser: check.py SITE CHROMIUM

Every page at 1280 and 400 pixels: nothing may be too wide, come from elsewhere, be a lost picture, a broken name, a
formula that is not set or an error of a script. Then the search: what readers ask for, and the page that has to come
first. Before all that faults are planted in one page, and each has to be seen.
"""

import pathlib
import sys

from playwright.sync_api import sync_playwright

WIDTHS = (1280, 400)
FIRST = {"uplift": "tutorial_structures", "misalignment": "tutorial_area", "tilt": "tutorial_fortran", "prove": "proof",
         "memory": "performance", "tableau": "tableau", "hertz": "theory_area", "certificate": "theory",
         "adaptive": "tutorial_accuracy", "mortar": "tutorial_two_meshes", "find_package": "install",
         "FUGE_ERR_NO_EQUILIBRIUM": "errors",
         "fuge_solve_dense": "fortran_core", "fuge_solve_smooth_punch": "fortran_punches",
         "fuge_set_gap": "fuge_core_h", "hertz_ellipse": "autoapi/fuge/index"}
LOOK = r"""() => {
  const said = []
  const text = document.querySelector('article').cloneNode(true)
  text.querySelectorAll('pre, code, script, .katex').forEach(part => part.remove())
  const raw = text.textContent.match(/\$[^$\n]{1,60}\$|\\(?:frac|alpha|sum)\b/)
  if (raw || document.querySelector('.katex-error')) said.push(`a formula is not set: ${raw}`)
  if (document.documentElement.scrollWidth > innerWidth + 1) said.push('is too wide')
  for (const name of document.querySelectorAll('code.literal')) {
    const width = 0.6 * name.textContent.length * parseFloat(getComputedStyle(name).fontSize)
    const lines = name.getClientRects().length
    const isName = !/\s/.test(name.textContent)
    if (isName && width < innerWidth - 100 && lines > 1) said.push(`${name.textContent} is broken`)
  }
  for (const image of document.images) if (!image.naturalWidth) said.push(`no picture ${image.src}`)
  return said
}"""
FAULTS = {'<div style="width: 1400px">wide</div>': "too wide",
          f"<p style='white-space: nowrap'>{30*'too wide '}</p>": "too wide",
          "<p>The load $F_0$ is given.</p>": "not set", '<img src="lost.png">': "no picture",
          '<img src="https://example.invalid/a.png">': "loads https:", "<script>missing()</script>": "script",
          "<p style='width: 6em'><code class='literal'>name_that_is<wbr>_broken</code></p>": "is broken"}


class Reader:
    """A page in the browser, and what is to be said against what it shows."""

    def __init__(self, browser, site):
        self.site, self.heard = site, []
        self.page = browser.new_page()
        self.page.on("pageerror", lambda error: self.heard.append(f"script: {error}"))
        self.page.on("request", lambda request: request.url.startswith(("file:", "data:"))
                     or self.heard.append(f"loads {request.url}"))

    def open(self, address):
        self.heard.clear()
        self.page.goto(self.site.as_uri() + "/" + address, wait_until="load")

    def faults(self):
        said = []
        for width in WIDTHS:
            self.page.set_viewport_size({"width": width, "height": 900})
            said += [f"{what} at {width} px" for what in self.page.evaluate(LOOK)]
        return said + self.heard

    def unseen(self):
        for fault, what in FAULTS.items():
            self.open("errors.html")
            self.page.evaluate("fault => document.querySelector('article').append("
                               "document.createRange().createContextualFragment(fault))", fault)
            self.page.wait_for_timeout(300)
            if not any(what in said for said in self.faults()):
                yield f"a planted fault is not seen: {fault}"

    def found(self, query):
        self.open(f"search.html?q={query}")
        self.page.wait_for_selector("#search-results li a", timeout=60000)
        return self.page.eval_on_selector("#search-results li a", "link => link.href")


def main():
    site = pathlib.Path(sys.argv[1]).resolve()
    with sync_playwright() as play:
        reader = Reader(play.chromium.launch(executable_path=sys.argv[2]), site)
        said = list(reader.unseen())
        pages = sorted(path.relative_to(site).as_posix() for path in site.rglob("*.html"))
        for name in pages:
            reader.open(name)
            said += [f"{name}: {fault}" for fault in reader.faults()]
        for query, wanted in FIRST.items():
            found = reader.found(query).removeprefix(site.as_uri() + "/")
            if found.partition(".html")[0] != wanted:
                said.append(f"search: '{query}' finds {found} first, not {wanted}")
    for fault in said:
        print(f"fuge: {fault}", file=sys.stderr)
    print(f"fuge: {len(pages)} pages and {len(FIRST)} questions in a browser, {len(said)} faults")
    sys.exit(bool(said))


if __name__ == "__main__":
    main()
