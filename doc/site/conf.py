"""Sphinx's settings for the site; pages.py writes the pages."""

import os
import pathlib
import re

root = pathlib.Path(__file__).resolve().parents[2]

project = "fuge"
version = release = re.search(r'FUGE_VERSION "(.*)"', (root/"include/fuge_core.h").read_text())[1]
extensions = ["myst_parser", "sphinxcontrib.katex", "autoapi.extension", "sphinx.ext.napoleon"]
root_doc = "index"
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
html_theme_options = {"navigation_with_keys": False}
pygments_style = "friendly"

# Formulas are set here, once: readers need neither a network nor a script.
katex_prerender = True
katex_js_path = str(pathlib.Path(os.environ["FUGE_KATEX"]).resolve()/"katex.min.js")
katex_css_path = "katex.min.css"

# The package is read, not imported: it needs the library.
autoapi_dirs = [str(root/"python/fuge")]
autoapi_options = ["members", "imported-members", "show-module-summary"]
autoapi_add_toctree_entry = False
autoapi_keep_files = False
toc_object_entries = False
autoapi_python_class_content = "both"
autoapi_member_order = "bysource"
napoleon_use_param = False
napoleon_use_ivar = True


def skip_hidden(app, what, name, obj, skip, options):
    """Only the package itself has a page; its modules are no interface."""
    return skip or (what in ("module", "package") and name != "fuge")


def setup(app):
    app.connect("autoapi-skip-member", skip_hidden)
