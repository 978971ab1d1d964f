"""Look at the site in a browser: check_browser.py SITE [--only PART] [--pictures FOLDER]

Every page, opened as a file at 1280 and at 400 pixels, has to fit in the width, to load nothing but files, to
raise no error, and to show no formula as its source. The menu of narrow windows has to open by the keyboard, and
the search to find what it is asked for. Complaints are printed; the exit status is then 1. --only takes pages
whose address contains PART; --pictures writes a picture of each page that is looked at.
"""

import argparse
import base64
import concurrent.futures
import pathlib
import shutil
import sys

from browser import Browser

WIDTHS = (1280, 400)
# Browsers side by side: most of the time they wait.
BROWSERS = 3
PICTURE_HEIGHT = 2400
# Queries and what has to be among the first hits of a group, of all groups for "": their number, a part of the address.
QUERIES = (("fuge_solve_smooth_punch", "", 1, "fuge_solve_smooth_punch"), ("fuge_solve", "", 1, "#fuge_solve"),
           ("fuge_solve", "Fortran", 5, "proc/fuge_solve_dense"), ("half-width", "Fortran", 5, "fuge_smooth_contact"),
           ("half width", "Fortran", 5, "fuge_smooth_contact"), ("FUGESV", "", 1, "legacy.html#fugesv"),
           ("certificate", "", 3, "theory.html#the-certificate"), ("find_package", "", 5, "install"),
           ("FUGE_ERR_NO_EQUILIBRIUM", "", 3, "module/fuge_status"), ("mortar", "", 3, "tutorial_two_meshes"),
           ("SOLVER", "", 5, "python"), ("how to tilt", "", 3, "#a-punch-that-tilts"),
           ("tilting", "", 5, "#a-punch-that-tilts"), ("pressure", "", 1, "page/"), ("hertz", "", 3, "page/tutorial"),
           ("hertz", "Python", 1, "python.html#hertz_ellipse"), ("stresses", "", 1, "tutorial_stress"))
# Letters with which no word begins, though some words contain them.
INSIDE = "ertz"
# Where a reader of one language gets nothing of another one.
LANGUAGE = ("Python", "hertz", "type/")
LOOK = """(() => {
  const text = document.querySelector('main').cloneNode(true)
  text.querySelectorAll('pre, code, script, style').forEach(part => part.remove())
  const raw = text.textContent.match(
    /\\$[^$\\n]{1,60}\\$|\\\\[(\\[][^\\n]{0,40}|\\\\(?:frac|alpha|sum)\\b[^\\n]{0,30}|fragment\\d+held/)
  const wide = [...document.querySelectorAll('main *')].find(part => part.getBoundingClientRect().right > innerWidth + 1
    && !part.closest('pre, .wide, .katex-display, .katex-mathml, .katex svg'))
  return { scroll: document.documentElement.scrollWidth, width: innerWidth, raw: raw && raw[0],
    hidden: [document.documentElement, document.body].some(part => getComputedStyle(part).overflowX !== 'visible'),
    wide: wide ? wide.outerHTML.slice(0, 90) : null,
    column: document.querySelector('main').getBoundingClientRect().width,
    formulas: document.querySelectorAll('.katex').length,
    plain: [...document.querySelectorAll('.katex .mord')].slice(0, 1).some(
      part => !getComputedStyle(part).fontFamily.includes('KaTeX')),
    broken: [...document.images].filter(image => !image.naturalWidth).map(image => image.src) }
})()"""
NARROWEST_TEXT = 0.85


def complaints_of(events):
    """What a page has logged, and what it has loaded that is no file."""
    for event in events:
        method, said = event.get("method"), event.get("params", {})
        if method == "Runtime.exceptionThrown":
            yield "error: " + said["exceptionDetails"].get("exception", {}).get("description", "exception")
        elif method == "Runtime.consoleAPICalled" and said["type"] in ("error", "warning", "assert"):
            yield "console: " + " ".join(str(part.get("value")) for part in said["args"])
        elif method == "Log.entryAdded" and said["entry"]["level"] in ("error", "warning"):
            yield "log: " + said["entry"]["text"] + " " + said["entry"].get("url", "")
        elif method == "Network.requestWillBeSent":
            if not said["request"]["url"].startswith(("file:", "data:")):
                yield "loads " + said["request"]["url"]
        elif method == "Network.loadingFailed":
            yield "does not load: " + said["errorText"]


def set_width(browser, width):
    browser.call("Emulation.setDeviceMetricsOverride", width=width, height=900, deviceScaleFactor=1, mobile=False)


def open_page(browser, address):
    browser.events.clear()
    browser.call("Page.navigate", url=address)
    browser.wait_for("Page.loadEventFired")


def picture(browser, path):
    size = browser.call("Page.getLayoutMetrics")["cssContentSize"]
    clip = {"x": 0, "y": 0, "width": size["width"], "height": min(size["height"], PICTURE_HEIGHT), "scale": 1}
    data = browser.call("Page.captureScreenshot", format="png", clip=clip, captureBeyondViewport=True)["data"]
    path.write_bytes(base64.b64decode(data))


def check_page(browser, path, site, pictures):
    set_width(browser, WIDTHS[0])
    open_page(browser, path.as_uri())
    formulas = 0
    for width in WIDTHS:
        set_width(browser, width)
        seen = browser.evaluate(LOOK)
        formulas = seen["formulas"]
        if seen["width"] != width or seen["hidden"]:
            yield f"the check at {width} px does not count: {seen}"
        if seen["scroll"] > width:
            yield f"{seen['scroll']} px wide at {width} px"
        if seen["wide"]:
            yield f"beyond the edge at {width} px: {seen['wide']}"
        if width == WIDTHS[1] and seen["column"] < NARROWEST_TEXT*width:
            yield f"the text is {seen['column']:.0f} px wide at {width} px"
        for source in seen["broken"]:
            yield f"no picture {source}"
        if pictures:
            name = path.relative_to(site).as_posix().replace("/", "_").removesuffix(".html")
            picture(browser, pictures/f"{name}_{width}.png")
    if seen["raw"]:
        yield f"a formula is not set: {seen['raw']}"
    if seen["plain"]:
        yield "formulas have no font"
    yield from complaints_of(browser.events)
    return formulas


def check_menu(browser, site):
    """The menu of a narrow window: closed at first, opened by the space bar."""
    set_width(browser, WIDTHS[1])
    open_page(browser, (site/"page/index.html").as_uri())
    shown = "getComputedStyle(document.getElementById('tree')).display !== 'none'"
    if browser.evaluate(shown):
        yield "the menu is open at first"
    browser.evaluate("document.getElementById('menu').focus()")
    for kind in ("keyDown", "keyUp"):
        browser.call("Input.dispatchKeyEvent", type=kind, key=" ", code="Space", text=" ", windowsVirtualKeyCode=32)
    if not browser.evaluate(shown):
        yield "the menu does not open by the keyboard"
    if browser.evaluate("document.documentElement.scrollWidth") > WIDTHS[1]:
        yield "the open menu is too wide"


def check_search(browser, site):
    def hits(group=""):
        inside = f"[data-group='{group}'] " if group else ""
        return f"[...document.querySelectorAll(\"#results {inside}a\")].map(link => link.getAttribute('href'))"
    for query, group, count, wanted in QUERIES:
        open_page(browser, (site/"search.html").as_uri() + "?language=&q=" + query.replace(" ", "+"))
        found = browser.evaluate(hits(group))
        if not any(wanted in address for address in found[:count]):
            yield f"'{query}' does not find {wanted} in its first {count} hits: {found[:count]}"
        missing = [address for address in found if not (site/address.split("#")[0]).is_file()]
        if missing:
            yield f"'{query}' finds {missing[0]}, which is not there"
        if browser.evaluate("document.documentElement.scrollWidth > innerWidth"):
            yield f"the results of '{query}' are too wide"
        yield from complaints_of(browser.events)
        if browser.evaluate("[...document.querySelectorAll('#results p')].some(text => !text.textContent.trim())"):
            yield f"a hit of '{query}' has no excerpt"
    open_page(browser, (site/"search.html").as_uri() + "?q=" + INSIDE)
    if browser.evaluate(hits()):
        yield f"'{INSIDE}' is found inside of words"
    language, query, other = LANGUAGE
    open_page(browser, (site/"search.html").as_uri() + f"?language=&q={query}")
    all_hits = browser.evaluate(hits())
    browser.evaluate(f"document.querySelector('#languages input[value={language}]').click()")
    found = browser.evaluate(hits())
    if not any(other in address for address in all_hits) or any(other in address for address in found) or not found:
        yield f"'{query}' in {language} alone does not leave out {other}: {found}"
    open_page(browser, (site/"search.html").as_uri() + f"?q={query}")
    if browser.evaluate(hits()) != found:
        yield f"the language {language} is not remembered"
    browser.evaluate("document.querySelector('#languages input').click()")
    # From the box of another page, by the keyboard alone.
    open_page(browser, (site/"page/index.html").as_uri())
    browser.evaluate("document.querySelector('header input').focus()")
    browser.call("Input.insertText", text=QUERIES[0][0])
    browser.events.clear()
    browser.call("Input.dispatchKeyEvent", type="keyDown", key="Enter", code="Enter", text="\r",
                 windowsVirtualKeyCode=13)
    browser.wait_for("Page.loadEventFired")
    if not any(QUERIES[0][3] in address for address in browser.evaluate(hits())[:1]):
        yield "the box at the top of a page does not search"


def checked(check):
    """What a check complains about; a page that the browser cannot be asked about is a complaint too."""
    try:
        yield from check
    except RuntimeError as error:
        yield str(error)


def program():
    """The browser that there is."""
    found = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
    if not found:
        raise SystemExit("fuge: there is no Chromium to look at the site with")
    return found


def opened(browser_program):
    """A browser that tells what its page loads and logs."""
    browser = Browser(browser_program)
    for domain in ("Page", "Runtime", "Log", "Network"):
        browser.call(f"{domain}.enable")
    browser.call("Emulation.setScrollbarsHidden", hidden=True)
    return browser


def check_pages(browser_program, pages, site, pictures):
    with opened(browser_program) as browser:
        return [f"{path.relative_to(site)}: {said}" for path in pages
                for said in checked(check_page(browser, path, site, pictures))]


def check_use(browser_program, site):
    with opened(browser_program) as browser:
        return [*(f"menu: {said}" for said in checked(check_menu(browser, site))),
                *(f"search: {said}" for said in checked(check_search(browser, site)))]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("site", type=pathlib.Path)
    parser.add_argument("--only", default="")
    parser.add_argument("--pictures", type=pathlib.Path)
    given = parser.parse_args()
    site = given.site.resolve()
    pages = [path for path in sorted(site.rglob("*.html")) if given.only in path.relative_to(site).as_posix()]
    with concurrent.futures.ThreadPoolExecutor(BROWSERS) as pool:
        shares = [pool.submit(check_pages, program(), pages[k::BROWSERS], site, given.pictures)
                  for k in range(BROWSERS)]
        if not given.only:
            shares.append(pool.submit(check_use, program(), site))
        faults = sorted(said for share in shares for said in share.result())
    for fault in faults:
        print(f"fuge: {fault}", file=sys.stderr)
    print(f"fuge: {len(pages)} pages seen in a browser, {len(faults)} faults")
    sys.exit(1 if faults or not pages else 0)


if __name__ == "__main__":
    main()
