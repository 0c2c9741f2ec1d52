"""Sphinx's settings for the manual. Mathematics becomes MathML while building: nothing is fetched when a page is read."""

import os
import re

from docutils.nodes import SkipNode
from latex2mathml.converter import convert

project = "carom"
author = "the carom developers"
version = release = os.environ["CAROM_VERSION"]
copyright = "the carom developers; MIT or Apache-2.0"
extensions = ["myst_parser"]
myst_enable_extensions = ["dollarmath", "deflist"]
myst_heading_anchors = 4
myst_url_schemes = {
    "http": None,
    "https": None,
    "doi": None,
    # files of the repository beside the manual, from its top and from one folder down
    "source0": {"url": "files/{{path}}"},
    "source1": {"url": "../files/{{path}}"},
    "page0": {"url": "{{path}}"},
}
# command lines, cases with dots in place of lines: shown plainly where a highlighter cannot follow
suppress_warnings = ["misc.highlighting_failure"]
html_theme = "furo"
html_title = f"carom {release}"
html_extra_path = ["../extra"]
html_copy_source = False
html_show_sphinx = False
html_show_copyright = True
html_math_renderer = "mathml"
html_theme_options = {"navigation_with_keys": True}
html_static_path = ["_static"]
html_css_files = ["manual.css"]


# names of functions keep a distance from a letter that follows
FUNCTION = re.compile(r"(<mi>(?:sin|cos|tan|ln)</mi>|<msup><mi>(?:sin|cos)</mi><mn>\d</mn></msup>)(?=<mi>|<mn>)")


def mathml(node, display):
    return FUNCTION.sub(r'\1<mspace width="0.17em"></mspace>', convert(node.astext(), display=display))


def inline(translator, node):
    translator.body.append(mathml(node, "inline"))
    raise SkipNode


def block(translator, node):
    translator.body.append(f'<div class="math">{mathml(node, "block")}</div>')
    raise SkipNode


def setup(app):
    app.add_html_math_renderer("mathml", (inline, None), (block, None))
    return {"parallel_read_safe": True}
