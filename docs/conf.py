"""Settings of the documentation site; `python -m docs.site` builds it."""

import os
import sys
from importlib.metadata import version as version_of
from pathlib import Path

from docutils import nodes
from latex2mathml.converter import convert
from sphinx.application import Sphinx
from sphinx.writers.html5 import HTML5Translator

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))
# the kernels of the notebooks import the package of this folder too
os.environ["PYTHONPATH"] = os.pathsep.join(filter(None, (str(ROOT), os.environ.get("PYTHONPATH"))))
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # likewise: several run beside each other

project = "gearlube"
author = copyright = "The gearlube developers"
version = release = version_of("gearlube")

extensions = ["myst_nb", "sphinx_copybutton", "sphinx_design", "sphinxcontrib.bibtex"]
exclude_patterns = ["_build"]

myst_enable_extensions = ["attrs_inline", "colon_fence", "deflist", "dollarmath"]
myst_heading_anchors = 4

bibtex_bibfiles = ["bibliography.bib"]
bibtex_default_style = "unsrt"
bibtex_reference_style = "author_year"

nb_execution_mode = "cache"
nb_execution_timeout = 600  # s, for one cell
nb_execution_raise_on_error = True
nb_merge_streams = True

html_math_renderer = "mathml"  # drawn by the browser itself, so pages work offline
html_theme = "furo"
html_title = "gearlube"
html_static_path = ["_static"]
html_css_files = ["site.css"]

# links that leave docs/ in the source, and where they lead on the site
_ELSEWHERE = {
    "](../benchmarks/README.md": "](project/benchmarks.md",
    "[examples/ssp](../examples/ssp)": "`examples/ssp`",
    "](../examples/ssp)": "](https://ssp-standard.org)",
}


def _links_inside(app: Sphinx, page: str, content: list[str]) -> None:
    for old, new in _ELSEWHERE.items():
        content[0] = content[0].replace(old, new)


def _inline_math(writer: HTML5Translator, node: nodes.math) -> None:
    writer.body.append(convert(node.astext()))
    raise nodes.SkipNode


def _block_math(writer: HTML5Translator, node: nodes.math_block) -> None:
    writer.body.append(f'<div class="math">{convert(node.astext(), display="block")}</div>')
    raise nodes.SkipNode


def setup(app: Sphinx) -> None:
    """Connect the change of links and the formulas."""
    app.connect("source-read", _links_inside)
    app.add_html_math_renderer("mathml", (_inline_math, None), (_block_math, None))
