"""Sphinx: how the documentation is built. `make docs` runs it; nothing is fetched."""

import os
import sys
from pathlib import Path

import curvlib

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE / "extensions"))
# By default VTK looks for a screen first, and warns.
os.environ.setdefault("VTK_DEFAULT_OPENGL_WINDOW", "vtkEGLRenderWindow")

project, author = "curvlib", "The curvlib authors"
project_copyright = "2026, The curvlib authors"
version = release = curvlib.__version__
language = "en"

extensions = [
    "sphinx.ext.autodoc",
    "numpydoc",
    "myst_parser",
    "sphinx_gallery.gen_gallery",
    "mathml",
    "pages",
]
exclude_patterns = ["_build", "gallery"]
default_role = "literal"
source_suffix = {".rst": "restructuredtext", ".md": "markdown"}
myst_enable_extensions = ["dollarmath", "deflist"]
myst_heading_anchors = 3

# Every name that a page refers to exists.
nitpicky = True
toc_object_entries = False
suppress_warnings = ["config.cache"]

autodoc_typehints = "none"
autodoc_member_order = "bysource"
numpydoc_show_class_members = False
numpydoc_class_members_toctree = False

sphinx_gallery_conf = {
    "examples_dirs": str(HERE / "gallery"),
    "gallery_dirs": "examples",
    "filename_pattern": r"/plot_",
    "image_scrapers": ("matplotlib", "scraper.pictures"),
    "reset_modules": ("matplotlib", "scraper.quiet"),
    "remove_config_comments": True,
    "show_memory": False,
    "min_reported_time": 1e9,
    "write_computation_times": False,
    "show_signature": False,
    "download_all_examples": False,
    "within_subsection_order": "FileNameSortKey",
    "abort_on_example_error": True,
    "plot_gallery": "True",
}

html_math_renderer = "mathml"
html_theme = "pydata_sphinx_theme"
html_title = f"curvlib {version}"
html_static_path = ["_static"]
html_css_files = ["curvlib.css"]
html_show_sourcelink = False
html_copy_source = False
html_last_updated_fmt = None
html_theme_options = {
    "show_prev_next": True,
    "navigation_with_keys": False,
    "show_nav_level": 1,
    "collapse_navigation": True,
    "header_links_before_dropdown": 7,
    "secondary_sidebar_items": ["page-toc"],
    "footer_start": ["copyright"],
    "footer_end": [],
    "pygments_light_style": "a11y-high-contrast-light",
    "pygments_dark_style": "a11y-high-contrast-dark",
    "back_to_top_button": False,
}
html_sidebars = {"index": [], "start": [], "citing": []}
