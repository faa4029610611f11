"""Sphinx settings of the site; docs/build runs it."""

import os

from docutils import nodes
from docutils.utils.math import latex2mathml

project = "SurgeFront"
author = "The SurgeFront authors"
copyright = author  # noqa: A001
version = release = os.environ.get("SURGE_VERSION", "")
extensions = ["myst_parser", "breathe"]
breathe_projects = {"SurgeFront": os.environ.get("SURGE_DOXYGEN", "")}
breathe_default_project = "SurgeFront"
breathe_show_include = False
myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 3
html_theme = "furo"
html_title = f"SurgeFront {version}"
html_copy_source = False
html_show_sourcelink = False
exclude_patterns = ["examples"]
# TOML and shell blocks hold placeholders that no lexer takes.
highlight_language = "none"
suppress_warnings = ["misc.highlighting_failure"]
html_math_renderer = "mathml"


def mathml(self, node):
    """Equations as MathML, which browsers draw themselves: the site needs no script from elsewhere."""
    inline = not isinstance(node, nodes.math_block)
    self.body.append(latex2mathml.tex2mathml(node.astext(), inline=inline))
    raise nodes.SkipNode


def setup(app):
    app.add_html_math_renderer("mathml", (mathml, None), (mathml, None))
