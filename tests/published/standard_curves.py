"""The curves of curves.toml: their programs, machine files, and paths for optimum.py."""
import os
import re
import tomllib

import numpy as np
from scipy.interpolate import BSpline

from nurbs_path import AxesPath, NurbsPath, read_nurbs
from optimum import Limits
from rounded_path import RoundedPath
from set_points import distance_from_lines

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
READINGS = {"path": 0, "axes": 1, "vector": 2**-0.5}  # share of the path's limits that each axis has; 0: as good as none
TOP_SHARE = 0.25  # of a rounding's width, where only the path limits the jerk
FREE = 1e6  # mm/s², of an axis


def read_curves(clone):
    """The curves by name; those whose points are in the clone of a repository only with it."""
    with open(os.path.join(HERE, "curves.toml"), "rb") as file:
        curves = tomllib.load(file)["curve"]
    return {c["name"]: KINDS[c["kind"]](c, clone) for c in curves if "file" not in c or clone}


def axis_table(name, speed, acceleration, jerk):
    return (
        f'\n[[axis]]\nname = "{name}"\ntravel = [-1000, 1000]\nmax_speed = {60 * speed:.10g}\n'
        f"max_acceleration = {acceleration:.10g}\nmax_jerk = {jerk:.10g}\n"
    )


class Curve:
    """What plane curves have in common."""

    axes = "xy"
    readings = list(READINGS)
    grid = 0.05, 0.1  # steps of optimum(): widths of a bend, mm
    first_line = 0  # of the program, that counts

    def __init__(self, of_file):
        self.values = of_file
        self.name, self.title = of_file["name"], of_file["title"]
        self.speed, self.acceleration, self.jerk = (of_file.get(k) for k in ("speed", "acceleration", "jerk"))
        self.published = of_file.get("published", [])

    def controller(self):
        c = self.values
        return (
            f'name = "{self.name}"\n\n[controller]\nperiod = {c["period"]}\nlookahead_blocks = 2000\ncorner = "spline"\n'
            f'tolerance = {c["tolerance"]}\nchord_tolerance = {c["tolerance"]}\n'
        )

    def machine(self, reading):
        v, a, j = self.speed, self.acceleration, self.jerk
        path = f"\n[path]\nmax_speed = {60 * v}\nmax_acceleration = {a}\nmax_normal_acceleration = {a}\nmax_jerk = {j}\n"
        share = READINGS[reading]
        limits = (v, share * a, share * j) if share else (v, FREE, 0)
        return self.controller() + path + "".join(axis_table(axis, *limits) for axis in "xyz")

    def limits(self, reading):
        share = READINGS[reading]
        of_axes = {"axis_accelerations": (share * self.acceleration,) * 2, "axis_jerks": (share * self.jerk,) * 2} if share else {}
        bend_jerk = np.inf if share else self.jerk
        return Limits(self.speed, self.acceleration, self.acceleration, self.jerk, bend_jerk, **of_axes)


class Polyline(Curve):
    grid = 0.05, 0.3

    def __init__(self, of_file, clone):
        super().__init__(of_file)
        # The coordinates of the program.
        self.points = np.round(np.loadtxt(os.path.join(clone, of_file["file"])) * of_file["scale"], 7)
        self.start = self.points[0]

    def program(self):
        x, y = self.start
        lines = ["G17 G21 G90 G94", f"G0 X{x:.7f} Y{y:.7f} Z0", f"F{60 * self.speed}"]
        return ".ngc", "\n".join(lines + [f"G1 X{x:.7f} Y{y:.7f}" for x, y in self.points[1:]] + ["M2", ""])

    def path(self, reading):
        return RoundedPath(self.points, self.values["tolerance"], 0 if READINGS[reading] else TOP_SHARE)

    def lengths(self, _positions):
        return None

    def distances(self, positions):
        return distance_from_lines(positions, self.points)


class Nurbs(Curve):
    def __init__(self, of_file, _clone):
        super().__init__(of_file)
        self.file = os.path.join(ROOT, of_file["program"])
        self.nurbs = NurbsPath(*read_nurbs(self.file))
        self.start = self.nurbs.points(0.0)

    def program(self):
        with open(self.file, encoding="ascii") as file:
            return ".nc", re.sub(r" F[\d.]+", f" F{60 * self.speed}", file.read())

    def path(self, _reading):
        return self.nurbs

    def lengths(self, positions):
        return self.nurbs.lengths_at(positions)

    def distances(self, positions):
        return self.nurbs.distances(positions)


class DualBspline(Curve):
    """The tip on one B-spline, the tool axis towards the same parameter of another; A and C in a table, no offsets."""

    axes = "xyzac"
    readings = ["axes"]
    grid = 0, 0.05
    first_line = 8  # after the approach and a dwell

    def __init__(self, of_file, _clone):
        super().__init__(of_file)
        degree, knots = of_file["degree"], np.array(of_file["knots"], float)
        self.tip = BSpline(knots, np.array(of_file["control_points"], float), degree)
        self.top = BSpline(knots, np.array(of_file["axis_control_points"], float), degree)
        self.fine = np.linspace(0, 1, 40001)
        slope, bend = (self.tip.derivative(k)(self.fine) for k in (1, 2))
        pace = np.linalg.norm(slope, axis=1)
        self.lengths = np.concatenate([[0], np.cumsum((pace[1:] + pace[:-1]) / 2 * np.diff(self.fine))])
        sharpest = (np.linalg.norm(np.cross(slope, bend), axis=1) / pace**3).max()
        self.count = int(np.ceil(self.lengths[-1] / np.sqrt(8 * 0.8 * of_file["chord_error"] / sharpest)))
        self.start = np.zeros(2)

    def pose(self, u):
        """Tip, and A and C [rad] with the tool axis (sin A sin C, -sin A cos C, cos A)."""
        tip = self.tip(u)
        axis = self.top(u) - tip
        axis /= np.linalg.norm(axis, axis=1)[:, None]
        return tip, np.arccos(axis[:, 2]), np.unwrap(np.arctan2(axis[:, 0], -axis[:, 1]))

    def program(self):
        u = np.interp(np.linspace(0, self.lengths[-1], self.count + 1), self.lengths, self.fine)
        tip, a, c = self.pose(u)
        rows = [
            f"X{x:.7f} Y{y:.7f} Z{z:.7f} A{t:.8f} C{r:.8f}" for (x, y, z), t, r in zip(tip, np.degrees(a), np.degrees(c))
        ]
        head = ["%", "O1000", "G17 G21 G90 G94", "G43.4 H1", "G0 " + rows[0], "G04 P100", "F6000"]
        return ".nc", "\n".join(head + ["G1 " + row for row in rows[1:]] + ["G49", "M30", "%", ""])

    def axis_limits(self):
        """Speeds, accelerations and jerks of x y z a c, mm and rad."""
        return [[self.values["axes"][axis][k] for axis in self.axes] for k in ("speed", "acceleration", "jerk")]

    def machine(self, _reading):
        speeds, accelerations, jerks = self.axis_limits()
        # What x, y and z allow together.
        v, a, j = (np.sqrt(3) * limits[0] for limits in (speeds, accelerations, jerks))
        path = f"\n[path]\nmax_speed = {60 * v}\nmax_acceleration = {a}\nmax_normal_acceleration = {a}\nmax_jerk = {j}\n"
        text = self.controller() + path
        for axis, *limits in zip(self.axes, speeds, accelerations, jerks):
            text += axis_table(axis, *(np.degrees(limits) if axis in "ac" else limits))
        text = text.replace('name = "a"\ntravel = [-1000, 1000]', 'name = "a"\ntravel = [-120, 120]')
        return text + '\n[kinematics]\ntype = "table-table"\nrotary = ["a", "c"]\n'

    def machine_axes(self, u):
        """Positions of the axes, mm and rad: q = R_x(-A) R_z(-C) p."""
        tip, a, c = self.pose(u)
        x = np.cos(c) * tip[:, 0] + np.sin(c) * tip[:, 1]
        y = -np.sin(c) * tip[:, 0] + np.cos(c) * tip[:, 1]
        return np.column_stack([x, np.cos(a) * y + np.sin(a) * tip[:, 2], -np.sin(a) * y + np.cos(a) * tip[:, 2], a, c])

    def limits(self, _reading):
        speeds, accelerations, jerks = self.axis_limits()
        return Limits(axis_speeds=tuple(speeds), axis_accelerations=tuple(accelerations), axis_jerks=tuple(jerks))

    def path(self, _reading):
        some = slice(None, None, 20)
        return AxesPath(self.lengths[some], self.machine_axes(self.fine[some]))

    def distances(self, positions):
        """Of the tip, from the B-spline."""
        a, c = np.radians(positions[:, 3]), np.radians(positions[:, 4])
        x, y, z = positions[:, :3].T
        y, z = np.cos(a) * y - np.sin(a) * z, np.sin(a) * y + np.cos(a) * z
        tip = np.column_stack([np.cos(c) * x - np.sin(c) * y, np.sin(c) * x + np.cos(c) * y, z])
        knots, degree = self.tip.t, self.tip.k
        return NurbsPath(self.tip.c, np.ones(len(self.tip.c)), knots, degree).distances(tip)


KINDS = {"polyline": Polyline, "nurbs": Nurbs, "dual_bspline": DualBspline}
