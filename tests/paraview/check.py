# SPDX-License-Identifier: BSD-3-Clause
"""ParaView opens the time series, has its particles, arrays and times, and draws a picture (run by pvbatch).

check.py SCENE.hdf.series PICTURE.png
"""
import json
import sys

from paraview.simple import GetActiveViewOrCreate, GetAnimationScene, OpenDataFile, Render, SaveScreenshot, Show, ColorBy

series, picture = sys.argv[1:3]
with open(series, encoding="ascii") as f:
    times = [entry["time"] for entry in json.load(f)["files"]]

reader = OpenDataFile(series)
assert reader is not None, "ParaView does not open the series"
reader.UpdatePipelineInformation()
assert list(reader.TimestepValues) == times, (list(reader.TimestepValues), times)
particles = []
for time in times:
    reader.UpdatePipeline(time)
    info = reader.GetDataInformation()
    assert info.GetNumberOfPoints() == info.GetNumberOfCells() > 0
    particles.append(info.GetNumberOfPoints())
    names = {reader.PointData[i].Name: reader.PointData[i] for i in range(len(reader.PointData))}
    for name, width in {"velocity": 3, "stress": 6, "damage": 1, "temperature": 1, "body": 1}.items():
        assert names[name].GetNumberOfComponents() == width, name
view = GetActiveViewOrCreate("RenderView")
GetAnimationScene().AnimationTime = times[-1]
shown = Show(reader, view)
shown.SetRepresentationType("Points")
ColorBy(shown, ("POINTS", "pressure"))
view.ResetCamera()
Render(view)
SaveScreenshot(picture, view, ImageResolution=[400, 300])
print("paraview read", len(times), "snapshots of", particles, "particles")
