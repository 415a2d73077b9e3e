# The site of the documents: `make docs`. The sources are the documents of docs/ themselves; what of them lies beside the folder is
# copied into a working folder first (scripts/make_docs.py), so that a link means the same on the site as in the tree.
import os
import re

project = "OpenFlank"
author = "The OpenFlank authors"
copyright = author
release = re.search(r"project\(OpenFlank VERSION (\S+)", open(os.environ["FLANK_SOURCE"] + "/CMakeLists.txt").read()).group(1)
extensions = ["myst_parser", "breathe", "sphinx.ext.autodoc"]
myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 3
html_theme = "furo"
html_title = f"OpenFlank {release}"
breathe_projects = {"openflank": os.environ["FLANK_DOXYGEN"]}
breathe_default_project = "openflank"
exclude_patterns = ["site"]
# Lines of code in the documents are of no language that must be known.
suppress_warnings = ["misc.highlighting_failure"]
html_show_sphinx = False


def escape_bars(app, what, name, obj, options, lines):
    """|c| is a magnitude here, and no substitution."""
    lines[:] = [line.replace("|", "\\|") for line in lines]


def setup(app):
    app.connect("autodoc-process-docstring", escape_bars)
