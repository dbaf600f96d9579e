"""Part: a program and a log of its run."""

from __future__ import annotations

import json
import os
import warnings
from typing import TYPE_CHECKING, Any, Dict, List, Mapping, Optional, Sequence, Tuple, Union

import numpy as np

from . import _clsurf
from .surface import Surface

if TYPE_CHECKING:
    import pandas

Path = Union[str, "os.PathLike[str]"]

# Keys that every defect has: the columns of a table without rows.
_DEFECT_KEYS = (
    "id rank score severity cause quantity systematic text bounds_mm area_mm2 length_mm depth_um depth_scallops shape "
    "speed_jump_mm_min speed_jump_percent acceleration_jump_mm_s2 point position_mm tip_mm passes lines points "
    "neighbours fingerprint accepted"
).split()


class Picture:
    """A picture in PNG format. A notebook shows it.

    Attributes:
        png: the bytes of the file.
    """

    def __init__(self, png: bytes) -> None:
        self.png = png

    def __repr__(self) -> str:
        width, height = (int.from_bytes(self.png[at : at + 4], "big") for at in (16, 20))
        return f"<clsurf.Picture: {width} × {height} pixels>"

    def _repr_png_(self) -> bytes:
        return self.png

    def save(self, path: Path) -> None:
        """Writes the file. An existing one is replaced."""
        with open(path, "wb") as file:
            file.write(self.png)


def options_of(
    program: Optional[Path],
    log: Optional[Path],
    *,
    tool: Optional[str] = None,
    machine: Optional[Path] = None,
    surface: Optional[str] = None,
    dialect: Optional[str] = None,
    tools: Optional[Path] = None,
    block_delete: bool = True,
    layout: Optional[Path] = None,
    mapping: Optional[Path] = None,
    period: Optional[float] = None,
    work_offset: Optional[Sequence[float]] = None,
    ignore_lines: bool = False,
    force: bool = False,
    derivative: str = "savgol",
) -> _clsurf.PartOptions:
    """The native options, from those of `Part`."""
    options = _clsurf.PartOptions()
    options.program = "" if program is None else os.fspath(program)
    options.log = "" if log is None else os.fspath(log)
    options.tool = tool or ""
    options.machine = "" if machine is None else os.fspath(machine)
    options.surface = surface or ""
    options.dialect = dialect or ""
    options.tools = "" if tools is None else os.fspath(tools)
    options.block_delete = block_delete
    options.layout = "" if layout is None else os.fspath(layout)
    options.mapping = "" if mapping is None else os.fspath(mapping)
    options.period = period
    if work_offset is not None:
        if len(work_offset) not in (3, 4):
            from .errors import UsageError

            raise UsageError("work_offset is (x, y, z) or (x, y, z, rotation about Z)")
        options.work_offset = (*work_offset, 0.0) if len(work_offset) == 3 else tuple(work_offset)
    options.ignore_lines = ignore_lines
    options.force = force
    options.derivative = derivative
    return options


class Part:
    """A program and a log of its run, in one coordinate system, with the program line of every point.

    Arrays are read-only, share the memory of the part, and stay valid after it is gone. A part keeps each column that it
    has computed. Points count from 0, lines and passes from 1.

    Args:
        program: the NC program; None: the log comes alone, and lines are those of its channel `line`.
        log: the log of its run, in any readable format.
        tool: `"ball:D"`, `"bull:D,R"` or `"flat:D"` [mm], or `"none"`. Places are then contact points on the part.
            Default: from the log's metadata, or from `tools`.
        machine: machine file (TOML): kinematics of five axes, limits for `check()`.
        surface: `"commanded"`, `"feedback"` or `"actual"`: the positions that are used. Default: commanded, else what
            the log has. `check()` measures heights from them.
        dialect: of the program. Default: detected.
        tools: tool table.
        block_delete: skip blocks that begin with `/`.
        layout, mapping: files that describe a foreign log.
        period: [s], instead of the one that the log or its mapping states.
        work_offset: machine position of the program's zero: (x, y, z) [mm], or with the rotation about Z [deg].
        ignore_lines: find lines by geometry, even if the log has them.
        force: go on with a log that does not belong to the program.
        derivative: `"savgol"` or `"kalman"`: how speeds are estimated.

    Raises:
        InputError: a file cannot be read or used, or the log belongs to another program.
        UsageError: an unknown tool, dialect or surface.
    """

    def __init__(
        self,
        program: Optional[Path],
        log: Path,
        tool: Optional[str] = None,
        machine: Optional[Path] = None,
        **options: Any,
    ) -> None:
        self._native = _clsurf.Part(options_of(program, log, tool=tool, machine=machine, **options))

    @classmethod
    def _of(cls, native: _clsurf.Part) -> Part:
        part = cls.__new__(cls)
        part._native = native
        return part

    def __repr__(self) -> str:
        return f"<clsurf.Part {self.program} · {self.log}: {len(self)} points>"

    def __len__(self) -> int:
        """Points of the log."""
        return self._native.records

    @property
    def program(self) -> str:
        """Name of the program's file."""
        return self._native.program

    @property
    def log(self) -> str:
        """Name of the log's file."""
        return self._native.log

    @property
    def tool(self) -> Optional[str]:
        """The tool, `"ball:6"` [mm]; None if it is not known."""
        return self._native.tool or None

    @property
    def period(self) -> float:
        """Time between two points [s]."""
        return self._native.period

    @property
    def simulation(self) -> Optional[Dict[str, Any]]:
        """Of a simulated run the keys of `clsurf simulate --json`; None of a recorded one."""
        return json.loads(self._native.simulation) if self._native.simulation else None

    @property
    def time(self) -> np.ndarray:
        """N float64: time since the first point [s]."""
        return self._native.time()

    @property
    def line(self) -> np.ndarray:
        """N uint32: line of the main program; 0: none."""
        return self._native.line()

    @property
    def position(self) -> np.ndarray:
        """N×3 float64: X, Y, Z of the tool tip in the workpiece [mm]; NaN where the log has none."""
        return self._native.position()

    @property
    def pass_number(self) -> np.ndarray:
        """N uint32: pass of each point; 0: it belongs to none."""
        return self._native.pass_number()

    @property
    def passes(self) -> np.ndarray:
        """P×2 int64: first and last point of each pass. Row 0 is pass 1."""
        return self._native.passes()

    @property
    def fields(self) -> Mapping[str, str]:
        """Name and unit of each field that `field()` can compute."""
        return dict(self._native.fields())

    def field(self, name: str) -> np.ndarray:
        """N float32: a field in the unit that `fields` gives, as `clsurf export` writes it; NaN: no value.

        Speeds are in mm/min, accelerations in mm/s², jerks in mm/s³, errors in µm.

        Raises:
            UsageError: there is no such field, or the part lacks what it needs.
        """
        return self._native.field(name)

    @property
    def channels(self) -> Mapping[str, str]:
        """Name and unit of each channel of the log."""
        return dict(self._native.channels())

    def channel(self, name: str) -> np.ndarray:
        """A channel of the log, in its unit.

        The array lies in the log's file, in the type that is stored there. Channels that are stored with a scale become
        float64.
        """
        return self._native.channel(name)

    def check(self) -> Dict[str, Any]:
        """The keys of `clsurf check --json`: `summary`, `defects`, `limits` (with a machine), `diagnostics` ….

        Computed once. Units are in the names of the keys.
        """
        return json.loads(self._native.check())

    def defects(self) -> pandas.DataFrame:
        """The defects that `clsurf check` lists, most conspicuous first.

        Columns are the keys of a defect there: `severity` (1 trace … 4 reject), `cause`, `depth_um`,
        `speed_jump_mm_min`, `length_mm`, `lines` ([first, last] of each pass) …. The index is `id`. Without defects
        there are no rows. Warns (UserWarning) where the log could not be judged. Needs pandas.
        """
        import pandas

        report = self.check()
        summary = report["summary"]
        if not summary["judged"]:
            warnings.warn("not judged: " + " ".join(summary["not_judged_reasons"]), stacklevel=2)
        defects = report["defects"]
        frame = pandas.DataFrame(defects) if defects else pandas.DataFrame(columns=_DEFECT_KEYS)
        return frame.set_index("id")

    def query(
        self,
        *,
        point: Optional[int] = None,
        line: Optional[int] = None,
        at: Optional[Sequence[float]] = None,
        time: Optional[float] = None,
        file: str = "",
        of_tip: bool = False,
        nearest: int = 1,
    ) -> List[Dict[str, Any]]:
        """What is known of points: the `matches` of `clsurf query --json`.

        Each has `point`, `time_s`, `line`, `text`, `position_mm`, `speed_mm_min`, `slow_because` ….

        Args:
            point: number of a point.
            line: every execution of a line: the first point of each.
            at: (x, y, z) [mm], the nearest point on the part, or among tool tips where no tool is known;
                (x, y): the highest one there.
            of_tip: `at` is a place of the tool tip, which the axes of pictures show.
            time: [s], the point nearest to it.
            file: the file of `line`, if not the main program.
            nearest: with `at`, the nearest point of each of so many passes.

        Raises:
            UsageError: nothing to look for, or the part does not have it.
        """
        if point is None and line is None and at is None and time is None:
            from .errors import UsageError

            raise UsageError("no point is given", "give one of point=, line=, at= and time=")
        place = None if at is None else [float(x) for x in at]
        report = self._native.query(
            point=point, line=line, file=file, time=time, at=place, of_tip=of_tip, nearest=nearest
        )
        return json.loads(report)["matches"]

    def surface(self) -> Surface:
        """The CL surface: points, triangles and passes as arrays, and as VTK or PyVista mesh."""
        return Surface(self)

    def picture(
        self,
        color: Optional[str] = None,
        view: str = "iso",
        *,
        range: Optional[Tuple[float, float]] = None,
        colormap: str = "",
        size: Tuple[int, int] = (1600, 1200),
    ) -> Picture:
        """The quality map that `clsurf render --gl egl` draws, without a display.

        Args:
            color: a field. Default: the share of the programmed feed, or the speed if no feed is known.
            view: `"iso"`, `"top"`, `"front"`, `"left"`, `"right"`, `"back"`, `"bottom"` or `"AZ,EL"` [deg].
            range: values at the ends of the colours, in the unit of the field. Default: chosen by the field.
            colormap: a name of `clsurf help colormaps`. Default: the one that suits the field.
            size: width and height [px].
        """
        return Picture(self._native.picture(color or "", view, range, colormap, size))
