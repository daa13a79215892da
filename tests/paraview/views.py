"""What pvbatch draws for test_paraview.py: views.py PLUGIN WHAT VOLUME OUTPUT."""

import sys

from paraview.simple import *  # noqa: F403, as scripts of ParaView do

plugin, what, volume, output = sys.argv[1:]
LoadPlugin(plugin, remote=False, ns=globals())


def make_view():
    view = CreateView("RenderView")
    view.ViewSize = [200, 150]
    view.OrientationAxesVisibility = 0
    view.UseColorPaletteForBackground = 0
    view.Background = [0.2, 0.4, 0.6]
    # Pixels are those of the plugin.
    view.UseFXAA = 0
    view.CameraPosition = [3, 2.5, 2]
    view.CameraFocalPoint = [0, 0, 0]
    view.CameraViewUp = [0, 0, 1]
    return view


def show_volume(view):
    reader = ElVisReader(FileName=volume)
    shown = Show(reader, view)
    assert shown.Representation == "ElVis", shown.Representation
    ColorBy(shown, ("POINTS", "waves"))
    shown.SetScalarBarVisibility(view, False)
    return reader, shown


def save(view):
    SaveScreenshot(output, view, ImageResolution=[200, 150])


def surfaces():
    """Everything at once; the scene that the plugin drew lies beside."""
    view = make_view()
    reader, shown = show_volume(view)
    values = reader.PointData["waves"].GetRange()
    print("range", *values)
    GetColorTransferFunction("waves").ApplyPreset("Viridis (matplotlib)", True)
    shown.ClipPlanes = [1, 0, 0, 0]
    shown.CutPlanes = [1, 0, 0, 0, 0, 1, 0, -0.3]
    shown.Isovalues = [-0.4, 0.4]
    shown.Contours = [-0.2, 0.2]
    shown.MeshLines = 1
    save(view)
    shown.UpdatePropertyInformation()
    with open(output + ".json", "w") as file:
        file.write(shown.GetProperty("Scene").GetData())
    print("remarks", shown.GetProperty("Remarks").GetData())


def behind():
    """A plane of ParaView in front of the volume's cut plane on one side, behind it on the other."""
    view = make_view()
    view.CameraPosition = [0, 0, 4]
    view.CameraViewUp = [0, 1, 0]
    _, shown = show_volume(view)
    ColorBy(shown, None)
    shown.DiffuseColor = [1, 0, 0]
    shown.Boundary = 0
    shown.Lit = 0
    shown.CutPlanes = [0, 0, 1, 0]
    plane = Show(Plane(Origin=[-1, -1, -0.5], Point1=[1, -1, 0.5], Point2=[-1, 1, -0.5]), view)
    plane.DiffuseColor = [0, 1, 0]
    plane.AmbientColor = [0, 1, 0]
    plane.Ambient = 1
    plane.Diffuse = 0
    save(view)


def light():
    """The volume itself, with a cut plane in it."""
    view = make_view()
    _, shown = show_volume(view)
    shown.Boundary = 0
    shown.Lit = 0
    shown.CutPlanes = [0, 0, 1, 0]
    shown.VolumeRendering = 1
    shown.OpacityUnitDistance = 0.5
    GetOpacityTransferFunction("waves").Points = [-1, 0, 0.5, 0, 1, 0.8, 0.5, 0]
    save(view)
    shown.UpdatePropertyInformation()
    with open(output + ".json", "w") as file:
        file.write(shown.GetProperty("Scene").GetData())
    print("remarks", shown.GetProperty("Remarks").GetData())


def light_and_plane():
    """The same with a plane of ParaView in place of the cut plane, and the cut plane alone in its place."""
    for own in (True, False):
        view = make_view()
        _, shown = show_volume(view)
        shown.Boundary = 0
        shown.VolumeRendering = 1
        GetOpacityTransferFunction("waves").Points = [-1, 0, 0.5, 0, 1, 0.8, 0.5, 0]
        plane = Plane(Origin=[-0.4, -0.4, 0], Point1=[0.4, -0.4, 0], Point2=[-0.4, 0.4, 0])
        if own:
            green = Show(ElVisReader(FileName=volume), view)
            green.DiffuseColor = [0, 1, 0]
            green.Boundary = 0
            green.Lit = 0
            green.CutPlanes = [0, 0, 1, 0]
        else:
            shown_plane = Show(plane, view)
            shown_plane.DiffuseColor = shown_plane.AmbientColor = [0, 1, 0]
            shown_plane.Ambient = 1
            shown_plane.Diffuse = 0
        SaveScreenshot(output + ("" if own else ".plane.png"), view, ImageResolution=[200, 150])


def one_color():
    view = make_view()
    view.CameraParallelProjection = 1
    view.CameraParallelScale = 1.5
    _, shown = show_volume(view)
    ColorBy(shown, None)
    shown.DiffuseColor = [0.2, 0.6, 1]
    shown.DoublePrecision = 1
    save(view)
    shown.UpdatePropertyInformation()
    with open(output + ".json", "w") as file:
        file.write(shown.GetProperty("Scene").GetData())


def other_data():
    view = make_view()
    shown = Show(Sphere(), view)
    shown.SetRepresentationType("ElVis")
    save(view)


def steps():
    """The last of some time steps."""
    view = make_view()
    reader = ElVisReader(FileName=volume)
    shown = Show(reader, view)
    name = reader.PointData.keys()[0]
    ColorBy(shown, ("POINTS", name))
    view.ViewTime = reader.TimestepValues[-1]
    save(view)
    shown.UpdatePropertyInformation()
    print("times", *reader.TimestepValues)
    with open(output + ".json", "w") as file:
        file.write(shown.GetProperty("Scene").GetData())


def several_files():
    """A mesh and, after a comma, its field."""
    mesh, field = volume.split(",")
    reader = ElVisReader(FileName=mesh, FurtherFiles=[field])
    print("fields", *reader.PointData.keys())


globals()[what]()
