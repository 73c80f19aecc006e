# SPDX-License-Identifier: BSD-3-Clause
"""The crater of a scene in ParaView: the rail's points as cells, by height, the armature taken away.

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
                                 GetScalarBar, OpenDataFile, Render, SaveScreenshot, Show, Threshold, UpdatePipeline)
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
    return Calculator(Input=sized, ResultArrayName="height", Function="1000*coordsY")


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
        x = rail.PointData["height"].GetRange(0)
        reach = max(0.1, min(1.0, abs(x[1])))
        colours.RescaleTransferFunction(-reach, reach)
    bar = GetScalarBar(colours, view)
    bar.Title, bar.ComponentTitle = f"{field} [{UNITS.get(field, 'SI')}]", ""
    bar.TitleColor = bar.LabelColor = [0.0, 0.0, 0.0]
    bar.TitleFontSize = bar.LabelFontSize = 12
    shown.SetScalarBarVisibility(view, True)
    view.UseColorPaletteForBackground, view.Background = 0, [1.0, 1.0, 1.0]
    view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [-0.01, 0.02, 0.02], [0.004, 0.0, 0.0], [0, 1, 0]
    view.CameraParallelProjection = 1
    view.ResetCamera()
    view.CameraParallelScale *= 0.75  # the rail is long: fill the picture
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
