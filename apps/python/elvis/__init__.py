"""ElVis, the Element Visualizer: pictures and values of high-order finite element fields, straight from the solver's own basis.

    import elvis
    ball = elvis.open("ball.h5")
    ball.probe([[0.1, 0.2, 0.3]], ["p", "norm(grad(p))"])
    ball.scene(cut_planes=[[0, 0, 1, 0]], isosurfaces={"p": [0.5]}).render(800, 600).save("ball.png")
"""

from ._answers import Break, Integral, Mesh, Side, Streamline
from ._arrays import Elements, Space, from_arrays
from ._elvis import Error
from ._flag import Flag
from ._frames import Frames
from ._library import context, convert, devices, plugins, set_up
from ._picture import Picture
from ._probe import Samples
from ._scene import Scene
from ._view import View
from ._volume import Field, Range, Volume, open
from .scene_objects import *  # noqa: F403: the objects of scenes, by their names in the scene file.
from .scene_objects import __all__ as _objects

__all__ = ["Break", "Elements", "Error", "Field", "Flag", "Frames", "Integral", "Mesh", "Picture", "Range", "Samples", "Scene", "Side", "Space", "Streamline", "View", "Volume",
           "context", "convert", "devices", "from_arrays", "open", "plugins", "set_up", *_objects]
