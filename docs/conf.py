"""Settings of the documentation site; `python -m docs.site` builds it."""

import os
import sys
from importlib.metadata import version as version_of
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))
# the kernels of the notebooks import the package of this folder too
os.environ["PYTHONPATH"] = os.pathsep.join(filter(None, (str(ROOT), os.environ.get("PYTHONPATH"))))

project = "gearlube"
author = "The gearlube developers"
version = release = version_of("gearlube")

extensions = ["myst_nb", "sphinx_copybutton", "sphinx_design", "sphinxcontrib.bibtex"]
# text.md and text/: parts that scripts put into their pages
exclude_patterns = ["**/text.md", "**/text/*", "_build"]

myst_enable_extensions = ["attrs_inline", "colon_fence", "deflist", "dollarmath"]
myst_heading_anchors = 4

bibtex_bibfiles = ["bibliography.bib"]
bibtex_default_style = "unsrt"
bibtex_reference_style = "author_year"

nb_execution_mode = "cache"
nb_execution_timeout = 600  # s, for one cell
nb_execution_raise_on_error = True
nb_merge_streams = True

html_theme = "furo"
html_title = "gearlube"
html_static_path = ["_static"]
html_css_files = ["site.css"]
