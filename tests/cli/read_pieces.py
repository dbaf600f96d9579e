"""Compares the surface that `clsurf export` wrote at once with the pieces of --shard, which a .pvtp file names: every point once,
with the same values, and the same lines and triangles.

usage: read_pieces.py WHOLE.vtp PIECES.pvtp
"""

import sys

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLPPolyDataReader


def read(reader, name):
    reader.SetFileName(name)
    reader.Update()
    return reader.GetOutput()


def column(data, name):
    return vtk_to_numpy(data.GetPointData().GetArray(name))


def cells(array, numbers):
    offsets = vtk_to_numpy(array.GetOffsetsArray())
    points = numbers[vtk_to_numpy(array.GetConnectivityArray())]
    return sorted(tuple(points[a:b]) for a, b in zip(offsets[:-1], offsets[1:]))


whole = read(vtkXMLPolyDataReader(), sys.argv[1])
pieces = read(vtkXMLPPolyDataReader(), sys.argv[2])
names = {whole.GetPointData().GetArrayName(i) for i in range(whole.GetPointData().GetNumberOfArrays())}
assert names == {pieces.GetPointData().GetArrayName(i) for i in range(pieces.GetPointData().GetNumberOfArrays())} - {"vtkGhostType"}
numbers = column(pieces, "point")
own = column(pieces, "vtkGhostType") == 0
order = numpy.argsort(numbers[own], kind="stable")
for name in names:
    a, b = column(whole, name), column(pieces, name)[own][order]
    assert a.dtype == b.dtype and numpy.array_equal(a, b, equal_nan=a.dtype.kind == "f"), name
xyz = vtk_to_numpy(whole.GetPoints().GetData())
assert numpy.array_equal(xyz, vtk_to_numpy(pieces.GetPoints().GetData())[own][order])
# Points that belong to other pieces are where they are there.
assert numpy.array_equal(xyz[numbers], vtk_to_numpy(pieces.GetPoints().GetData()))
for of_whole, of_pieces, what in ((whole.GetLines(), pieces.GetLines(), "lines"), (whole.GetPolys(), pieces.GetPolys(), "triangles")):
    assert cells(of_whole, column(whole, "point")) == cells(of_pieces, numbers), what
print(whole.GetNumberOfPoints(), "points,", whole.GetNumberOfPolys(), "triangles,", int((~own).sum()), "points beside")
