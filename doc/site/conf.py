"""Sphinx's settings for the site; pages.py writes the pages."""

import os
import pathlib
import re

root = pathlib.Path(__file__).resolve().parents[2]

project = "fuge"
version = release = re.search(r'FUGE_VERSION "(.*)"', (root/"include/fuge_core.h").read_text())[1]
extensions = ["myst_parser", "sphinxcontrib.katex", "autoapi.extension", "sphinx.ext.napoleon"]
exclude_patterns = ["*.txt", "doctrees"]

myst_enable_extensions = ["dollarmath"]
myst_fence_as_directive = ["math"]
myst_heading_anchors = 4
# Code that the lexer does not know, as FORTRAN 77 and pFUnit; attributes of several classes that have the same name.
suppress_warnings = ["misc.highlighting_failure", "ref.python"]

html_theme = "furo"
html_title = "fuge"
html_static_path = [str(root/"doc/site/static"), os.environ["FUGE_KATEX"]]
html_css_files = ["site.css"]
html_copy_source = False
html_show_copyright = False

# Formulas are set here, once: readers need neither a network nor a script.
katex_prerender = True
katex_js_path = str(pathlib.Path(os.environ["FUGE_KATEX"]).resolve()/"katex.min.js")
katex_css_path = "katex.min.css"

# The package is read, not imported: it needs the library.
autoapi_dirs = [str(root/"python/fuge")]
autoapi_options = ["members", "imported-members", "show-module-summary"]
autoapi_add_toctree_entry = False
toc_object_entries = False
autoapi_python_class_content = "both"
autoapi_member_order = "bysource"
napoleon_use_param = False
napoleon_use_ivar = True


def setup(app):
    # Only the package itself has a page; its modules are no interface.
    app.connect("autoapi-skip-member", lambda app, what, name, obj, skip, options:
                skip or (what in ("module", "package") and name != "fuge"))
