"""Compares the surface that `clsurf export` wrote at once with the pieces of --shard, which a .pvtp file names or a .vtkhdf file holds
as partitions: every point once, with the same values, and the same lines and triangles.

usage: read_pieces.py WHOLE.vtp PIECES.pvtp
       read_pieces.py WHOLE.vtkhdf PIECES.vtkhdf PARTITIONS
"""

import sys

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOHDF import vtkHDFReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLPPolyDataReader

READERS = {"vtp": vtkXMLPolyDataReader, "pvtp": vtkXMLPPolyDataReader, "vtkhdf": vtkHDFReader}


def read(name, piece=0, of=1):
    reader = READERS[name.rsplit(".", 1)[1]]()
    reader.SetFileName(name)
    reader.UpdatePiece(piece, of, 0)
    return reader.GetOutputDataObject(0)


def column(data, name):
    return vtk_to_numpy(data.GetPointData().GetArray(name))


def corners(array, numbers):
    offsets = vtk_to_numpy(array.GetOffsetsArray())
    points = numbers[vtk_to_numpy(array.GetConnectivityArray())]
    return [tuple(points[a:b]) for a, b in zip(offsets[:-1], offsets[1:])]


def cells(data, numbers):
    """Lines (VTK's type 4) and triangles (5) by the numbers of their points."""
    if data.IsA("vtkPolyData"):
        return sorted([(4, c) for c in corners(data.GetLines(), numbers)] + [(5, c) for c in corners(data.GetPolys(), numbers)])
    return sorted(zip(vtk_to_numpy(data.GetCellTypesArray()).tolist(), corners(data.GetCells(), numbers)))


whole, pieces = read(sys.argv[1]), read(sys.argv[2])
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
found = cells(whole, column(whole, "point"))
assert found == cells(pieces, numbers) and {4, 5} == {kind for kind, _ in found}
if len(sys.argv) > 3:
    # Each of as many processes as there are partitions reads one of them.
    count = int(sys.argv[3])
    parts = [read(sys.argv[2], k, count) for k in range(count)]
    assert all(0 < part.GetNumberOfPoints() < pieces.GetNumberOfPoints() for part in parts)
    assert sum(part.GetNumberOfCells() for part in parts) == len(found)
print(whole.GetNumberOfPoints(), "points,", len(found), "cells,", int((~own).sum()), "points beside")
