"""Builds the documentation site with Sphinx, MyST (Markdown) and Furo: `make docs`."""

from __future__ import annotations

import sys
from pathlib import Path

from sphinx.application import Sphinx

_DOCS = Path(__file__).parent
sys.path[:0] = [str(_DOCS.parent), str(_DOCS / "_ext")]  # the project, and the extensions below

from service.version import VERSION  # noqa: E402

project = "Roadtalk"
author = "The Roadtalk authors"
release = version = VERSION
language = "en"

extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "generated_reference",
    "no_inline_code",
]
exclude_patterns = ["site", "_ext", "_templates", "**/README.md"]
suppress_warnings = ["misc.highlighting_failure"]

# Markdown. Links to headings are checked. Links to files of the project become downloads, checked too.
myst_enable_extensions = ["deflist", "attrs_inline", "colon_fence"]
myst_heading_anchors = 3

# Docstrings are plain text in which `single` backticks mark code.
default_role = "literal"
autodoc_member_order = "bysource"
autodoc_typehints = "signature"
autodoc_typehints_format = "short"
autodoc_preserve_defaults = True
autodoc_default_options = {"members": True, "show-inheritance": False}
python_use_unqualified_type_names = True
python_maximum_signature_line_length = 90
add_module_names = False
toc_object_entries = False  # else the sidebar lists every method

html_theme = "furo"
html_title = "Roadtalk"
html_static_path = ["_static"]
html_css_files = ["site.css"]
html_favicon = "../web/favicon.svg"
html_show_sphinx = False
html_show_copyright = False
html_copy_source = False
html_show_sourcelink = False
html_theme_options = {
    "footer_icons": [],
    "top_of_page_buttons": [],
    "light_css_variables": {"color-brand-primary": "#0b6b3a", "color-brand-content": "#0b6b3a"},
    "dark_css_variables": {"color-brand-primary": "#5fd08f", "color-brand-content": "#5fd08f"},
}


def setup(app: Sphinx) -> None:
    """Keeps the decisions out of the sidebar: their index lists them, and a hundred entries build slowly."""

    def mark(app: Sphinx, _: object) -> None:
        if app.env.docname.startswith("decisions/0"):
            app.env.metadata[app.env.docname]["orphan"] = True

    app.connect("doctree-read", mark)
