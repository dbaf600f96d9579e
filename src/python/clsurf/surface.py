"""The CL surface: passes of the tool, joined by triangles."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Iterable

import numpy as np

if TYPE_CHECKING:
    from .part import Part


class Surface:
    """The cutter-location surface of a part, as `clsurf export` writes it.

    The arrays are read-only and share the memory of the part.

    Attributes:
        points: N×3 float64, positions of the tool tip [mm], one a logged point, rounded to 32-bit floats from the first
            point.
        triangles: M×3 int64, numbers of points: the bands between adjacent passes.
        passes: P×2 int64, first and last point of each pass.
        step_over: median distance of adjacent passes [mm]; 0 if there is one pass only.
    """

    def __init__(self, part: Part) -> None:
        self._part = part
        self.points: np.ndarray = part._native.vertices()
        self.triangles: np.ndarray = part._native.triangles()
        self.passes: np.ndarray = part.passes
        self.step_over: float = part._native.step_over()

    def to_vtk(self, fields: Iterable[str] = ("speed",)) -> Any:
        """A `vtkPolyData` with passes as lines, triangles, and these fields as point data, in shown units.

        `"point"`, `"line"`, `"pass"` are integers, `"time"` is float64, as `clsurf export` writes them.

        Points and fields share their memory with the part; connectivity is copied. Needs VTK (Debian: python3-vtk9).
        """
        from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
        from vtkmodules.vtkCommonCore import vtkPoints
        from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

        points = vtkPoints()
        points.SetData(numpy_to_vtk(self.points))
        poly = vtkPolyData()
        poly.SetPoints(points)

        sizes = self.passes[:, 1] - self.passes[:, 0] + 1
        members = [np.arange(first, last + 1, dtype=np.int64) for first, last in self.passes]
        lines = vtkCellArray()
        lines.SetData(
            numpy_to_vtkIdTypeArray(np.concatenate(([0], np.cumsum(sizes))).astype(np.int64), deep=True),
            numpy_to_vtkIdTypeArray(np.concatenate(members) if members else np.empty(0, np.int64), deep=True),
        )
        poly.SetLines(lines)

        triangles = vtkCellArray()
        triangles.SetData(3, numpy_to_vtkIdTypeArray(self.triangles.reshape(-1), deep=True))
        poly.SetPolys(triangles)

        own = {
            "point": lambda: np.arange(len(self.points), dtype=np.uint32),
            "line": lambda: self._part.line,
            "pass": lambda: self._part.pass_number,
            "time": lambda: self._part.time,
        }
        for name in fields:
            values = numpy_to_vtk(own[name]() if name in own else self._part.field(name))
            values.SetName(name)
            poly.GetPointData().AddArray(values)
        return poly

    def to_pyvista(self, fields: Iterable[str] = ("speed",)) -> Any:
        """The same as a `pyvista.PolyData`. Needs PyVista."""
        import pyvista

        return pyvista.wrap(self.to_vtk(fields))
