"""The plug-in as a user of ParaView meets it: open, colour, threshold, draw. Run by tests/paraview/run.

usage: pvpython plugin.py PLUGIN PROGRAM LOG COLUMNS.csv FOLDER
COLUMNS.csv has point, line, pass and speed_mismatch, as `clsurf export` writes them. Pictures go to FOLDER.
"""

import inspect
import sys

import numpy as np

# ParaView 5.11.0 imports it, Python 3.11 has dropped it (docs/howto/paraview.md).
if not hasattr(inspect, "getargspec"):
    inspect.getargspec = inspect.getfullargspec

from paraview import servermanager, simple
from paraview.util.vtkAlgorithm import VTKPythonAlgorithmBase  # noqa: F401  the plug-in's base is there
from vtkmodules.util.numpy_support import vtk_to_numpy

plugin, program, log, table, folder = sys.argv[1:]
simple.LoadPlugin(plugin, ns=globals())
expected = np.genfromtxt(table, delimiter=",", skip_header=1)  # point, line, pass, speed_mismatch


def columns_of(data):
    points = data.GetPointData()
    return {points.GetArrayName(k): vtk_to_numpy(points.GetArray(k)) for k in range(points.GetNumberOfArrays())}


def fetch(source):
    source.UpdatePipeline()
    return servermanager.Fetch(source)


# A program and its log: every point of the log, in its place, with integers where numbers are counted.
part = ClsurfPart(Program=program, Log=log)  # noqa: F821  made by LoadPlugin
part.UpdatePipelineInformation()
assert {"line", "pass", "speed_mismatch", "height", "cmd.x"} <= set(part.Columns.Available), part.Columns.Available
surface = fetch(part)
columns = columns_of(surface)
assert surface.GetNumberOfPoints() == len(expected)
assert surface.GetNumberOfPolys() > len(expected), "no triangles between the passes"
for name, column in (("point", 0), ("line", 1), ("pass", 2)):
    assert columns[name].dtype == np.uint32, (name, columns[name].dtype)
    assert (columns[name] == expected[:, column]).all(), name
np.testing.assert_array_equal(columns["speed_mismatch"], expected[:, 3].astype(np.float32))

# Columns are those that are ticked.
part.Columns = ["speed", "height", "line", "speed_mismatch"]
assert set(columns_of(fetch(part))) == {"speed", "height", "line", "speed_mismatch"}

# The role: feedback lags behind the command, by hundredths of a millimetre here.
commanded = vtk_to_numpy(fetch(part).GetPoints().GetData())
part.Positions = "Feedback"
distance = np.abs(vtk_to_numpy(fetch(part).GetPoints().GetData()) - commanded).max()
assert 0.001 < distance < 1, distance
part.Positions = "Commanded, else what the log has"

# Passes: their points and no others, and triangles between them only.
part.Passes = [3, 5]
some = fetch(part)
members = np.flatnonzero((expected[:, 2] >= 3) & (expected[:, 2] <= 5))
assert some.GetNumberOfLines() == len(members) - 3
assert some.GetNumberOfPoints() == members[-1] - members[0] + 1
np.testing.assert_array_equal(columns_of(some)["line"], expected[members[0] : members[-1] + 1, 1])
assert 0 < some.GetNumberOfPolys() < surface.GetNumberOfPolys() / 8
part.Passes = [1, 0]

# What is slower than its neighbours by 1000 mm/min: pieces of passes. Line 560 of the README is among them.
slow = simple.Threshold(Input=part, Scalars=["POINTS", "speed_mismatch"], ThresholdMethod="Below Lower Threshold", LowerThreshold=-1000)
part.Columns = ["point", "line", "speed_mismatch"]
found = columns_of(fetch(slow))
is_slow = expected[:, 3].astype(np.float32) <= -1000
both = is_slow[:-1] & is_slow[1:] & (expected[:-1, 2] == expected[1:, 2])
assert set(np.flatnonzero(both)) | set(np.flatnonzero(both) + 1) == set(found["point"])
assert 560 in found["line"]


def draw(shown, colour, name):
    view = simple.CreateView("RenderView", ViewSize=[640, 480], OrientationAxesVisibility=0, Background=[1, 1, 1], UseColorPaletteForBackground=0)
    faint = simple.Show(part, view)
    faint.Opacity, faint.AmbientColor, faint.DiffuseColor = 0.25, [0.6] * 3, [0.6] * 3
    faint.ColorArrayName = [None, ""]
    display = simple.Show(shown, view)
    simple.ColorBy(display, ("POINTS", colour))
    display.RescaleTransferFunctionToDataRange(False)
    display.LineWidth = 3
    display.SetScalarBarVisibility(view, False)
    view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [20, -30, 35], [0, 0, 0], [0, 0, 1]
    simple.ResetCamera(view)
    simple.SaveScreenshot(f"{folder}/{name}.png", view)
    simple.Delete(view)


draw(slow, "speed_mismatch", "speed_mismatch")
slow.LowerThreshold = -2600
draw(slow, "speed_mismatch", "other_threshold")

# A log alone, by File > Open: its path through every point.
path = simple.OpenDataFile(log)
alone = fetch(path)
assert alone.GetNumberOfLines() == 1 and alone.GetNumberOfPoints() == len(expected)
assert alone.GetCell(0).GetNumberOfPoints() == len(expected)
path.Columns = ["cmd.x", "fb.x"]
assert set(columns_of(fetch(path))) == {"cmd.x", "fb.x"}

# What cannot be read gives an error and no data.
missing = ClsurfPart(Program=program, Log=log + ".missing")  # noqa: F821
missing.UpdatePipeline()
assert servermanager.Fetch(missing).GetNumberOfPoints() == 0
print("plug-in: all as expected")
