"""Reads what `clsurf export` wrote with VTK's own readers: numbers of points, lines and passes must be integers, times 64-bit.

usage: read_vtk.py FILE.vtp|FILE.vtkhdf
"""

import sys

from vtkmodules.vtkIOHDF import vtkHDFReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

reader = vtkXMLPolyDataReader() if sys.argv[1].endswith(".vtp") else vtkHDFReader()
reader.SetFileName(sys.argv[1])
reader.Update()
data = reader.GetOutputDataObject(0).GetPointData()
types = {data.GetArrayName(i): data.GetArray(i).GetDataTypeAsString() for i in range(data.GetNumberOfArrays())}
expected = {"point": "unsigned int", "line": "unsigned int", "pass": "unsigned int", "time": "double", "speed": "float"}
assert types == expected, types
numbers = data.GetArray("point")
assert [numbers.GetTuple1(i) for i in range(numbers.GetNumberOfTuples())] == list(range(numbers.GetNumberOfTuples()))
