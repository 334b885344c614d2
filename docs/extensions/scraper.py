"""How the gallery draws: off-screen, with a text for those who do not see the picture."""

from pathlib import Path

import pyvista
from pyvista.plotting.plotter import _ALL_PLOTTERS
from pyvista.plotting.utilities.sphinx_gallery import generate_images
from sphinx_gallery.scrapers import figure_rst


def pictures(block, block_vars, gallery_conf, **kwargs):
    """Pictures of pyvista, told of by the title of their page and by what their colours show."""
    bars = [bar for plotter in _ALL_PLOTTERS.values() for bar, _ in plotter.scalar_bars.items()]
    names = generate_images(block_vars["image_path_iterator"], dynamic=False)
    title = Path(block_vars["src_file"]).read_text(encoding="utf-8").splitlines()[1]
    return figure_rst(names, gallery_conf["src_dir"], f"{title}: {', '.join(bars)} in colours")


def quiet(gallery_conf, name):
    """Before each example: no window, and no plot of another one."""
    pyvista.OFF_SCREEN = pyvista.BUILDING_GALLERY = True
    pyvista.close_all()
