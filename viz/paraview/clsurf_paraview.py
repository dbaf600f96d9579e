"""ParaView plug-in: opens BIIP logs, and a program with its log as the stitched CL surface (docs/howto/paraview.md).

Tools > Manage Plugins > Load New, or `LoadPlugin("clsurf_paraview.py")` in pvpython. Tested with ParaView 5.11.

`clsurf export` computes everything, in a process of its own, and ParaView reads what it wrote: the libraries of clsurf and
those of ParaView are different versions of VTK, which do not work in one process.
"""

import json
import os
import shlex
import shutil
import subprocess
import tempfile

import numpy as np
from paraview import print_error
from paraview.util.vtkAlgorithm import VTKPythonAlgorithmBase, smdomain, smhint, smproperty, smproxy
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkDataArraySelection, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

ROLES = ("", "commanded", "feedback", "actual")
POSITIONS = """<IntVectorProperty name="Positions" command="SetPositions" number_of_elements="1" default_values="0">
  <EnumerationDomain name="enum">
    <Entry value="0" text="Commanded, else what the log has"/>
    <Entry value="1" text="Commanded"/>
    <Entry value="2" text="Feedback"/>
    <Entry value="3" text="Actual"/>
  </EnumerationDomain>
  <Documentation>The positions that the surface is made of: --surface of clsurf.</Documentation>
</IntVectorProperty>"""
# The default columns. Each other one costs its computation and 4 bytes per point.
USUAL_COLUMNS = ("point", "line", "pass", "time", "speed", "acceleration", "speed_mismatch")


class ClsurfError(Exception):
    """What `clsurf` says of an input."""


def clsurf_program():
    """The program: that of $CLSURF, the one that was installed with this file, or the first one in $PATH."""
    here = os.path.dirname(os.path.abspath(__file__)) if "__file__" in globals() else ""
    beside = os.path.normpath(os.path.join(here, "..", "..", "..", "bin", "clsurf"))
    for name in (os.environ.get("CLSURF"), beside, "clsurf"):
        found = shutil.which(name) if name else None
        if found:
            return found
    raise ClsurfError("the program `clsurf` is not found: install it, add its folder to PATH, or set CLSURF to its path")


def run_clsurf(*words):
    """Standard output of the program. Raises ClsurfError with its message."""
    done = subprocess.run([clsurf_program(), *words, "--no-config", "--progress", "never"], capture_output=True, encoding="utf-8")
    if done.returncode != 0:
        raise ClsurfError(done.stderr.strip() or f"clsurf ended with exit code {done.returncode}")
    return done.stdout


def cells_of(members):
    """A vtkCellArray of cells that have as many points as a row."""
    cells = vtkCellArray()
    cells.SetData(members.shape[1], numpy_to_vtkIdTypeArray(np.ascontiguousarray(members, dtype=np.int64).reshape(-1), deep=True))
    return cells


def ends_of(cells):
    """Offsets and connectivity of a vtkCellArray."""
    return vtk_to_numpy(cells.GetOffsetsArray()), vtk_to_numpy(cells.GetConnectivityArray())


def segments_of(cells):
    """The polylines of passes as lines of two points, so that a threshold keeps pieces of a pass."""
    offsets, members = ends_of(cells)
    starts = np.ones(len(members), dtype=bool)
    starts[offsets[1:] - 1] = False  # the last point of a pass starts no segment
    starts = np.flatnonzero(starts)
    return np.column_stack((members[starts], members[starts + 1]))


def surface_of(poly, first, last):
    """Passes `first` to `last` of a surface, counted from 1, with the triangles between them. `last` 0: up to the last one."""
    offsets, members = ends_of(poly.GetLines())
    count = len(offsets) - 1
    if first > count or 0 < last < first:
        raise ClsurfError(f"Passes: {first} to {last}; the part has passes 1 to {count}")
    first = max(first, 1)
    last = count if last <= 0 else min(last, count)
    # Passes follow one another in time, so their points are one range.
    low, high = (members[offsets[first - 1]], members[offsets[last] - 1] + 1)
    if first == 1 and last == count:
        low, high = 0, poly.GetNumberOfPoints()

    def inside(cells):
        return cells[np.all((cells >= low) & (cells < high), axis=1)] - low

    made = vtkPolyData()
    points = vtkPoints()
    points.SetData(numpy_to_vtk(vtk_to_numpy(poly.GetPoints().GetData())[low:high], deep=True))
    made.SetPoints(points)
    made.SetLines(cells_of(inside(segments_of(poly.GetLines()))))
    made.SetPolys(cells_of(inside(ends_of(poly.GetPolys())[1].reshape(-1, 3))))
    for k in range(poly.GetPointData().GetNumberOfArrays()):
        column = poly.GetPointData().GetArray(k)
        values = numpy_to_vtk(vtk_to_numpy(column)[low:high], deep=True)
        values.SetName(column.GetName())
        made.GetPointData().AddArray(values)
    return made


def path_of(poly):
    """The points of a log in the order of time, as one line."""
    made = vtkPolyData()
    made.SetPoints(poly.GetPoints())
    made.GetPointData().ShallowCopy(poly.GetPointData())
    count = poly.GetNumberOfPoints()
    made.SetLines(cells_of(np.arange(count).reshape(1, count)))
    return made


class ClsurfSource(VTKPythonAlgorithmBase):
    """What both have in common: files, columns, and `clsurf export`. The result is kept until one of them changes.

    The property panel has the alphabetical order of methods, from SetInputProgram to UsedColumns.
    """

    def __init__(self):
        super().__init__(nInputPorts=0, nOutputPorts=1, outputType="vtkPolyData")
        self._program = self._log = self._machine = self._options = ""
        self._role = 0
        self._columns = vtkDataArraySelection()
        self._columns.AddObserver("ModifiedEvent", lambda *_: self.Modified())
        self._listed = self._loaded = None  # for which files and options
        self._poly = None

    def _set(self, name, value):
        value = "" if value in (None, "None") else value
        if getattr(self, name) != value:
            setattr(self, name, value)
            self.Modified()

    def _words(self):
        """Arguments of `export` that say which part it is."""
        words = [os.path.abspath(self._program)] if self._program else []
        words.append(os.path.abspath(self._log))
        if self._role:
            words += ["--surface", ROLES[self._role]]
        if self._machine:
            words += ["--machine", os.path.abspath(self._machine)]
        return words + shlex.split(self._options)

    def _key(self):
        """Changes with the options, and with the files."""
        files = [os.path.abspath(name) for name in (self._program, self._log, self._machine) if name]
        return self._words(), [os.stat(name).st_mtime_ns if os.path.exists(name) else 0 for name in files]

    def _list_columns(self):
        key = self._key()
        if self._listed == key:
            return
        names = [row["name"] for row in json.loads(run_clsurf("export", *self._words(), "--list", "--json"))["columns"]]
        self._listed = key
        known = [self._columns.GetArrayName(k) for k in range(self._columns.GetNumberOfArrays())]
        for name in set(known) - set(names):
            self._columns.RemoveArrayByName(name)
        for name in names:
            if name not in known:
                self._columns.AddArray(name, not known and name in USUAL_COLUMNS)

    def _read(self):
        enabled = [
            self._columns.GetArrayName(k)
            for k in range(self._columns.GetNumberOfArrays())
            if self._columns.GetArraySetting(k)
        ]
        key = (self._key(), enabled)
        if self._loaded != key:
            with tempfile.TemporaryDirectory(prefix="clsurf-paraview-") as folder:
                path = os.path.join(folder, "part.vtp")
                run_clsurf("export", *self._words(), "-o", path, "--columns", ",".join(enabled or ["line"]))
                reader = vtkXMLPolyDataReader()
                reader.SetFileName(path)
                reader.Update()
                self._poly = reader.GetOutput()
            self._loaded = key
        return self._poly

    def _shape(self, poly):
        raise NotImplementedError

    def _attempt(self, act):
        """Errors of the input are messages; ParaView prints a traceback for others."""
        try:
            act()
        except ClsurfError as error:
            print_error(str(error))
            return 0
        return 1

    def RequestInformation(self, request, inputs, outputs):
        return self._attempt(self._list_columns) if self._log else 1

    def RequestData(self, request, inputs, outputs):
        output = vtkPolyData.GetData(outputs, 0)

        def read():
            if not self._log:
                raise ClsurfError("Log: no file is chosen")
            self._list_columns()
            output.ShallowCopy(self._shape(self._read()))

        return self._attempt(read)


@smproxy.source(name="ClsurfPart", label="Clsurf Part")
class ClsurfPart(ClsurfSource):
    """A program and a log of its run as the stitched CL surface: passes are lines of two points each, what is between them
    triangles.
    """

    def __init__(self):
        super().__init__()
        self._passes = (1, 0)

    @smproperty.stringvector(name="Program", number_of_elements=1, default_values="", panel_visibility="default")
    @smdomain.filelist()
    @smhint.filechooser(extensions=["nc", "ngc", "mpf", "h", "i", "tap", "txt"], file_description="NC programs")
    def SetInputProgram(self, name):
        """Empty: the log comes alone."""
        self._set("_program", name)

    @smproperty.stringvector(name="Log", number_of_elements=1, default_values="", panel_visibility="default")
    @smdomain.filelist()
    @smhint.filechooser(extensions=["biip", "csv", "txt", "xml"], file_description="Logs that clsurf reads")
    def SetLog(self, name):
        self._set("_log", name)

    @smproperty.xml(POSITIONS)
    def SetPositions(self, role):
        self._set("_role", role)

    @smproperty.xml(
        """<IntVectorProperty name="Passes" command="SetPasses" number_of_elements="2" default_values="1 0">
             <IntRangeDomain name="range" min="0 0"/>
             <Documentation>First and last pass, counted from 1. 0 as the last: up to the last one.</Documentation>
           </IntVectorProperty>"""
    )
    def SetPasses(self, first, last):
        self._set("_passes", (first, last))

    @smproperty.dataarrayselection(name="Columns")
    def UsedColumns(self):
        """Fields, channels of the log, and numbers of points, lines and passes."""
        return self._columns

    @smproperty.stringvector(name="Machine", number_of_elements=1, default_values="", panel_visibility="advanced")
    @smdomain.filelist()
    @smhint.filechooser(extensions=["toml"], file_description="Machine files")
    def SetMachine(self, name):
        """Kinematics of five axes."""
        self._set("_machine", name)

    @smproperty.stringvector(name="Options", number_of_elements=1, default_values="", panel_visibility="advanced")
    def SetOptions(self, words):
        """More options of `clsurf export`: `--dialect klartext --work-offset 1,2,3`."""
        self._set("_options", words)

    def _shape(self, poly):
        return surface_of(poly, *self._passes)


@smproxy.reader(name="ClsurfLog", label="Clsurf Log", extensions="biip", file_description="Interpolation logs (BIIP)")
class ClsurfLog(ClsurfSource):
    """A log alone: its points in the order of time as one line, with channels and fields."""

    @smproperty.stringvector(name="FileName", number_of_elements=1, default_values="", panel_visibility="never")
    @smdomain.filelist()
    @smhint.filechooser(extensions="biip", file_description="Interpolation logs (BIIP)")
    def SetFileName(self, name):
        self._set("_log", name)

    @smproperty.xml(POSITIONS)
    def SetPositions(self, role):
        self._set("_role", role)

    @smproperty.dataarrayselection(name="Columns")
    def UsedColumns(self):
        return self._columns

    def _shape(self, poly):
        return path_of(poly)
