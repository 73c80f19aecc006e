# SPDX-License-Identifier: BSD-3-Clause
"""The crater of a scene in ParaView: the rail's points by height, the armature taken away, a mirrored half made whole.

    pvbatch paraview_crater.py out/my_case/scenes/NAME/scene.hdf.series picture.png [FIELD]
    paraview --script=paraview_crater.py       # asks for nothing: opens the series named in $BREECH_SERIES

FIELD: what colours the points, height (the default) or an array of the snapshot: damage, temperature, pressure, ...
"""
import json
import os
import sys

try:
    from paraview import servermanager
    from paraview.simple import (Calculator, ColorBy, GetActiveViewOrCreate, GetAnimationScene, GetColorTransferFunction,
                                 GetScalarBar, OpenDataFile, Reflect, Render, SaveScreenshot, Show, Threshold,
                                 UpdatePipeline)
except ModuleNotFoundError:
    sys.exit(f"{sys.executable} has no paraview: run this with pvbatch, which brings its own (apt-get install paraview)")

UNITS = {"height": "mm", "damage": "1", "temperature": "K", "pressure": "Pa"}


def last_time(series):
    with open(series, encoding="ascii") as f:
        return json.load(f)["files"][-1]["time"]


def rail_of(reader, time):
    """Rail, layers and grain: every body but the last, which is the armature."""
    UpdatePipeline(time, reader)
    armature = reader.PointData["body"].GetRange(0)[1]
    rail = Threshold(Input=reader, Scalars=["POINTS", "body"], ThresholdMethod="Below Lower Threshold",
                     LowerThreshold=armature - 0.5)
    sound = Threshold(Input=rail, Scalars=["POINTS", "damage"], ThresholdMethod="Below Lower Threshold",
                      LowerThreshold=0.999999)
    sized = Calculator(Input=sound, ResultArrayName="half", Function="max(size_X,size_Z)")
    top = Calculator(Input=sized, ResultArrayName="height", Function="1000*(coordsY+size_Y)")  # of a point's domain
    UpdatePipeline(time, top)
    low, high = top.GetDataInformation().GetBounds()[4:6]
    return Reflect(Input=top, Plane="Z Min", CopyInput=1) if low > -0.1 * high else top


def fine_zone(rail, time):
    """Bounds of the rail's smallest cells, which lie at the crater [m]."""
    fine = Threshold(Input=rail, Scalars=["POINTS", "half"], ThresholdMethod="Below Lower Threshold",
                     LowerThreshold=1.5 * rail.PointData["half"].GetRange(0)[0])
    UpdatePipeline(time, fine)
    return fine.GetDataInformation().GetBounds()


def look_at(view, bounds):
    """From upstream and above onto the middle of the bounds, which fill the picture."""
    x, y, z = (0.5 * (bounds[2 * k] + bounds[2 * k + 1]) for k in range(3))
    length = max(bounds[1] - bounds[0], bounds[5] - bounds[4])
    view.CameraParallelProjection, view.CameraViewUp = 1, [0, 1, 0]
    view.CameraFocalPoint, view.CameraPosition = [x, y, z], [x - 0.5 * length, y + length, z + 0.9 * length]
    view.CameraParallelScale = 0.4 * length


def show(series, field="height"):
    """The source shown and the view, at the last time of the series."""
    time = last_time(series)
    view = GetActiveViewOrCreate("RenderView")
    GetAnimationScene().AnimationTime = time
    rail = rail_of(OpenDataFile(series), time)
    UpdatePipeline(time, rail)
    shown = Show(rail, view)
    shown.SetRepresentationType("Point Gaussian")
    shown.SetScaleArray, shown.UseScaleFunction = ["POINTS", "half"], 0
    shown.ScaleByArray, shown.GaussianRadius = 1, 1.3  # neighbours overlap: no gaps to look through
    ColorBy(shown, ("POINTS", field))
    colours = GetColorTransferFunction(field)
    if field == "height":  # around the surface, so that crater and rim stand out
        reach = max(0.1, min(1.0, abs(rail.PointData["height"].GetRange(0)[1])))
        colours.RescaleTransferFunction(-reach, reach)
    bar = GetScalarBar(colours, view)
    bar.Title, bar.ComponentTitle = f"{field} [{UNITS.get(field, 'SI')}]", ""
    bar.TitleColor = bar.LabelColor = [0.0, 0.0, 0.0]
    bar.TitleFontSize = bar.LabelFontSize = 12
    bar.WindowLocation, bar.ScalarBarLength = "Upper Left Corner", 0.2
    if field == "height":
        bar.RangeLabelFormat = "%.2f"
    shown.SetScalarBarVisibility(view, True)
    view.UseColorPaletteForBackground, view.Background = 0, [1.0, 1.0, 1.0]
    Render(view)
    look_at(view, fine_zone(rail, time))
    Render(view)
    return rail, view


def points_of(rail):
    return servermanager.Fetch(rail).GetNumberOfPoints()


if len(sys.argv) >= 3:
    source, scene_view = show(sys.argv[1], *sys.argv[3:4])
    SaveScreenshot(sys.argv[2], scene_view, ImageResolution=[1200, 800])
    print("points of the rail:", points_of(source))
elif "BREECH_SERIES" in os.environ:
    show(os.environ["BREECH_SERIES"])
