"""Draws the pieces of a surface that is too large for one process, each process its share, composited by IceT.

usage: mpiexec -n 4 pvbatch draw_pieces.py map.pvtp -o map.png --color speed --range 0,3000

`clsurf export --shard` and `--merge` write the pieces (docs/howto/paraview.md). Tested with ParaView 5.11.
"""

import argparse
import os
import sys

from paraview import simple
from paraview.modules.vtkRemotingCore import vtkProcessModule

ROOM_OF_PART = 0.82  # of the width
VIEWS = {  # direction to the viewer, and up
    "iso": ((1, -1, 1), (0, 0, 1)),
    "top": ((0, 0, 1), (0, 1, 0)),
    "front": ((0, -1, 0), (0, 0, 1)),
    "left": ((-1, 0, 0), (0, 0, 1)),
    "right": ((1, 0, 0), (0, 0, 1)),
    "back": ((0, 1, 0), (0, 0, 1)),
}


def numbers(text, separator, kind):
    first, second = text.split(separator)
    return [kind(first), kind(second)]


def arguments():
    parser = argparse.ArgumentParser(prog="draw_pieces.py", description="Draws a .pvtp file of clsurf under pvbatch.")
    parser.add_argument("pieces", help="the .pvtp file that `clsurf export --merge` wrote")
    parser.add_argument("-o", "--output", required=True, help="the picture (.png)")
    parser.add_argument("--color", default="speed", help="column that colours the surface (default: %(default)s)")
    parser.add_argument("--range", type=lambda t: numbers(t, ",", float), help="MIN,MAX of the colours (default: all values)")
    parser.add_argument("--size", type=lambda t: numbers(t, "x", int), default=[1600, 1200], help="WIDTHxHEIGHT (default: 1600x1200)")
    parser.add_argument("--view", choices=VIEWS, default="iso", help="direction (default: %(default)s)")
    parser.add_argument("--quiet", action="store_true", help="do not say what each process draws")
    return parser.parse_args()


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def unit(a):
    return [x / dot(a, a) ** 0.5 for x in a]


def place_camera(view, bounds, direction, size):
    """The part fills the picture but for a margin, and at the right the room of the colours."""
    towards, up = VIEWS[direction]
    towards = unit(towards)
    right = unit(cross(up, towards))
    above = cross(towards, right)
    half = [0.5 * (bounds[2 * k + 1] - bounds[2 * k]) for k in range(3)]
    across, upwards = (sum(abs(h * c) for h, c in zip(half, axis)) for axis in (right, above))
    scale = 1.05 * max(upwards, across * size[1] / (ROOM_OF_PART * size[0]), 1e-6)
    shift = scale * size[0] / size[1] * (1 - ROOM_OF_PART)
    centre = [0.5 * (bounds[2 * k] + bounds[2 * k + 1]) + shift * right[k] for k in range(3)]
    distance = 4 * sum(half) + 1
    view.CameraFocalPoint = centre
    view.CameraPosition = [centre[k] + distance * towards[k] for k in range(3)]
    view.CameraViewUp = up
    view.CameraParallelProjection = 1
    view.CameraParallelScale = scale
    view.CenterOfRotation = centre


def main():
    options = arguments()
    if not os.path.isfile(options.pieces):
        sys.exit(f"draw_pieces.py: {options.pieces}: no such file")
    reader = simple.XMLPartitionedPolydataReader(FileName=[options.pieces])
    reader.UpdatePipeline()
    columns = [name for name in reader.PointData.keys() if name != "vtkGhostType"]
    if options.color not in columns:
        sys.exit(f"draw_pieces.py: {options.pieces} has no column '{options.color}', only {', '.join(sorted(columns))}")
    information = reader.GetDataInformation()
    low, high = options.range or reader.PointData[options.color].GetRange()

    view = simple.CreateView("RenderView", ViewSize=options.size, OrientationAxesVisibility=0, UseColorPaletteForBackground=0, Background=[1, 1, 1])
    shown = simple.Show(reader, view)
    shown.Representation = "Surface"
    shown.Ambient, shown.Diffuse = 1, 0  # the colours of the legend, on surface and passes
    simple.ColorBy(shown, ("POINTS", options.color))
    colours = simple.GetColorTransferFunction(options.color)
    colours.ApplyPreset("Inferno (matplotlib)", True)
    colours.RescaleTransferFunction(low, high)
    bar = simple.GetScalarBar(colours, view)
    bar.Title, bar.ComponentTitle = options.color, ""
    bar.TitleColor = bar.LabelColor = [0, 0, 0]
    bar.RangeLabelFormat, bar.AutomaticLabelFormat, bar.LabelFormat = "%.4g", 0, "%.4g"
    bar.WindowLocation, bar.Position, bar.ScalarBarLength = "Any Location", [0.86, 0.3], 0.4
    shown.SetScalarBarVisibility(view, True)
    place_camera(view, information.GetBounds(), options.view, options.size)
    simple.SaveScreenshot(options.output, view, ImageResolution=options.size)

    module = vtkProcessModule.GetProcessModule()
    if not options.quiet and module.GetPartitionId() == 0:
        data = reader.GetClientSideObject().GetOutputDataObject(0)
        print(f"process 0 of {module.GetNumberOfLocalPartitions()}: {data.GetNumberOfPoints()} of {information.GetNumberOfPoints()} points", flush=True)


if __name__ == "__main__":
    main()
