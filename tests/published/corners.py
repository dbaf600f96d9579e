#!/usr/bin/env python3
"""Writes the tables of docs/experiments/corners.md and its pictures: ways to pass a corner, measured on set points.

    /usr/bin/python3 tests/published/corners.py build/release/src/cli/clsurf

Needs scipy (Debian: python3-scipy). Programs and machines are those of data/.
"""
import os
import re
import subprocess
import sys
import tempfile

import numpy as np

sys.dont_write_bytecode = True
import set_points

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
DOCS = os.path.join(ROOT, "docs", "experiments")
WAYS = {
    "three_axis_mill": {
        "stop": ["stop"],
        "arc, steps in 1 ms": ["arc", "arc_step_time = 0.001"],
        "arc, steps in 5 ms": ["arc", "arc_step_time = 0.005"],
        "spline": ["spline"],
        "junction, steps of 300 mm/min": ["junction", "junction_deviation = 0", "junction_speed_step = 300"],
    },
    "linuxcnc_logs": {
        "stop": ["stop"],
        "arc": ["arc"],
        "spline": ["spline"],
        "junction, steps of 300 mm/min": ["junction", "junction_deviation = 0", "junction_speed_step = 300"],
    },
}
PROGRAMS = ["corners", "dome_loops"]
COLOURS = {"stop": "#888888", "arc, steps in 1 ms": "#d95f02", "arc, steps in 5 ms": "#e6ab02", "arc": "#d95f02", "spline": "#1b6ca8"}


def machine_text(name, lines):
    """A machine of data/machines with its corners passed another way."""
    with open(os.path.join(ROOT, "data", "machines", name + ".toml"), encoding="utf-8") as file:
        text = file.read()
    corner, *keys = lines
    text = re.sub(r"^(arc_step_time|junction_\w+) = .*\n", "", text, flags=re.M)
    text = re.sub(r"^corner = .*\n", "".join(f"{line}\n" for line in [f'corner = "{corner}"', *keys]), text, count=1, flags=re.M)
    not_rounded = {"junction": "curve|tolerance|merging_tolerance", "stop": "merging_tolerance"}
    if corner in not_rounded:
        text = re.sub(rf"^({not_rounded[corner]}) = .*\n", "", text, flags=re.M)
    return text


def limit(text, section, key):
    """A value of the first table with this heading."""
    return float(re.search(rf"^{re.escape(section)}\n(?:.*\n)*?{key} = ([0-9.e+]+)", text, re.M)[1])


def corners_of(clsurf, program):
    """The programmed points; both programs have lines only."""
    table = subprocess.run([clsurf, "moves", program], check=True, capture_output=True, text=True).stdout.splitlines()
    names = table[0].split(",")
    rows = [dict(zip(names, line.split(","))) for line in table[1:]]
    if {row["kind"] for row in rows} - {"rapid", "feed"}:
        raise SystemExit(f"{program} has more than lines")
    points = np.array([[float(row[axis]) for axis in "xyz"] for row in rows])
    return points[np.concatenate([[True], np.linalg.norm(np.diff(points, axis=0), axis=1) > 0])]


class Run:
    def __init__(self, clsurf, program, machine, folder):
        paths = os.path.join(folder, "machine.toml"), os.path.join(folder, "run.biip")
        with open(paths[0], "w", encoding="utf-8") as file:
            file.write(machine)
        corners = corners_of(clsurf, program)
        start = ",".join(f"{c:.6f}" for c in corners[0])
        command = [clsurf, "simulate", program, "--machine", paths[0], "--start", start, "--quiet", "-o", paths[1]]
        subprocess.run(command, check=True)
        self.positions, self.period = set_points.commanded(paths[1], "xyz")
        self.time = (len(self.positions) - 1) * self.period
        self.off_path = set_points.distance_from_lines(self.positions, corners).max() * 1e3
        self.at_corners = set_points.distance_to_nearest(corners, self.positions).max() * 1e3
        axes = [[limit(machine, '[[axis]]\nname = "x"', key)] * 3 for key in ("max_speed", "max_acceleration", "max_jerk")]
        self.has_jerk = axes[2][0] > 0
        axes = np.array(axes) / [[60], [1], [1]]
        axes[2] = axes[2] if self.has_jerk else 1
        self.axes = [max(order) for order in set_points.axis_shares(self.positions, self.period, *axes)]
        path = {key: limit(machine, "[path]", key) for key in ("max_speed", "max_acceleration", "max_normal_acceleration")}
        shares = set_points.path_shares(self.positions, self.period, path["max_speed"] / 60, path["max_acceleration"], 1)
        self.tangential = shares["tangential a"]
        self.normal = shares["normal a"] * path["max_acceleration"] / path["max_normal_acceleration"]


def table_of(rows):
    text = "| corners | time, s | off corner, µm | off path, µm | axis v | axis a | axis j | tangential a | normal a |\n|---|---|---|---|---|---|---|---|---|\n"
    for name, run in rows:
        cells = [name, f"{run.time:.3f}", f"{run.at_corners:.2f}", f"{run.off_path:.2f}", f"{run.axes[0]:.3f}", f"{run.axes[1]:.3f}"]
        cells += [f"{run.axes[2]:.3f}" if run.has_jerk else "", f"{run.tangential:.3f}", f"{run.normal:.3f}"]
        text += "| " + " | ".join(cells) + " |\n"
    return text


class Chart:
    """Lines in a frame with ticks, as SVG."""

    WIDTH, HEIGHT, LEFT, BOTTOM, TOP, RIGHT = 900, 420, 70, 56, 40, 20

    def __init__(self, x_range, y_range, x_label, y_label):
        self.x_range, self.y_range = x_range, y_range
        self.left, self.right = self.LEFT, self.WIDTH - self.RIGHT
        self.parts = [
            f'<svg xmlns="http://www.w3.org/2000/svg" width="{self.WIDTH}" height="{self.HEIGHT}" font-family="sans-serif" font-size="14">',
            '<rect width="100%" height="100%" fill="white"/>',
        ]
        self.text(self.WIDTH / 2, self.HEIGHT - 12, x_label)
        self.parts.append(f'<text transform="translate(18 {self.HEIGHT / 2}) rotate(-90)" text-anchor="middle">{y_label}</text>')

    def place(self, x, y):
        along = (np.asarray(x) - self.x_range[0]) / (self.x_range[1] - self.x_range[0])
        up = (np.asarray(y) - self.y_range[0]) / (self.y_range[1] - self.y_range[0])
        height = self.HEIGHT - self.TOP - self.BOTTOM
        return self.left + along * (self.right - self.left), self.HEIGHT - self.BOTTOM - up * height

    def text(self, x, y, words, anchor="middle", colour="black"):
        self.parts.append(f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" fill="{colour}">{words}</text>')

    def line(self, x, y, colour, width=1.5):
        places = " ".join(f"{a:.1f},{b:.1f}" for a, b in zip(*self.place(x, y)))
        self.parts.append(f'<polyline points="{places}" fill="none" stroke="{colour}" stroke-width="{width}"/>')

    def dots(self, x, y, colour, radius):
        for a, b in zip(*self.place(x, y)):
            self.parts.append(f'<circle cx="{a:.1f}" cy="{b:.1f}" r="{radius}" fill="{colour}"/>')

    def ticks(self, xs, ys, names=None):
        """`names`: of the ys; without any, a grid alone."""
        for x in xs:
            place = self.place(x, self.y_range[0])
            self.line([x, x], self.y_range, "#dddddd", 1)
            self.text(place[0], place[1] + 18, f"{x:g}")
        for k, y in enumerate(ys):
            place = self.place(self.x_range[0], y)
            self.line(self.x_range, [y, y], "#dddddd", 1)
            if names:
                self.text(place[0] - 8, place[1] + 5, names[k], "end")

    def legend(self, names):
        x = self.LEFT
        for name in names:
            self.parts.append(f'<rect x="{x}" y="16" width="22" height="4" fill="{COLOURS[name]}"/>')
            self.text(x + 28, 24, name, "start")
            x += 60 + 8 * len(name)

    def save(self, name):
        with open(os.path.join(DOCS, name), "w", encoding="utf-8") as file:
            file.write("\n".join([*self.parts, "</svg>"]) + "\n")


def draw_speeds(runs, corners):
    """Speed over the way from each corner, the corners side by side; logarithmic."""
    speeds = [10, 30, 100, 300, 1000, 3000]
    chart = Chart((-1, 1), (1, np.log10(4000)), "way along the path from the corner, mm", "speed, mm/min")
    names = ["stop", "spline", "arc, steps in 5 ms", "arc, steps in 1 ms"]
    bends = corners[1:-1]
    gap, width = 24, (chart.right - chart.left) / len(bends)
    for k, corner in enumerate(bends):
        chart.left, chart.right = Chart.LEFT + k * width, Chart.LEFT + (k + 1) * width - gap
        chart.ticks([-1, 0, 1], np.log10(speeds), [f"{v}" for v in speeds] if k == 0 else None)
        ways = [corner - corners[k], corners[k + 2] - corner]
        cosine = ways[0] @ ways[1] / np.prod([np.linalg.norm(way) for way in ways])
        chart.text((chart.left + chart.right) / 2, chart.TOP + 16, f"{np.degrees(np.arccos(cosine)):.0f}°")
        for name in names:
            positions = runs[name].positions
            steps = np.linalg.norm(np.diff(positions, axis=0), axis=1)
            at = np.cumsum(steps) - steps / 2
            at -= at[np.argmin(np.linalg.norm(positions[1:] - corner, axis=1))]
            near = (np.abs(at) <= 1) & (steps > 0)
            speed = np.maximum(steps[near] / runs[name].period * 60, 10)
            chart.line(at[near], np.log10(speed), COLOURS[name])
    chart.left = Chart.LEFT
    chart.legend(names)
    chart.save("corners_speed.svg")


def draw_corner(runs, before, corner, after):
    """Set points about a corner, which is turned so that the path comes from the upper left and leaves to the upper right."""
    inward = [(end - corner) / np.linalg.norm(end - corner) for end in (before, after)]
    up = sum(inward) / np.linalg.norm(sum(inward))
    axes = np.array([[up[1], -up[0]], up])
    ys = np.arange(0, 0.05, 0.01).round(2)
    chart = Chart((-0.06, 0.06), (-0.004, 0.044), "mm", "mm")
    chart.ticks(np.arange(-0.06, 0.07, 0.02).round(2), ys, [f"{y:g}" for y in ys])
    arms = [axes @ arm * 0.06 for arm in inward]
    chart.line([arms[0][0], 0, arms[1][0]], [arms[0][1], 0, arms[1][1]], "black", 1)
    names = ["stop", "spline", "arc, steps in 1 ms"]
    for name in names:
        points = runs[name].positions[:, :2] - corner
        x, y = axes @ points[np.linalg.norm(points, axis=1) < 0.06].T
        chart.line(x, y, COLOURS[name], 1)
        chart.dots(x, y, COLOURS[name], 3)
    chart.legend(names)
    chart.save("corners_zoomed.svg")


def main():
    clsurf = os.path.abspath(sys.argv[1])
    with open(os.path.join(DOCS, "corners.md"), encoding="utf-8") as file:
        page = file.read()
    for program in PROGRAMS:
        path = os.path.join(ROOT, "data", "programs", program + ".nc")
        for machine, ways in WAYS.items():
            with tempfile.TemporaryDirectory() as folder:
                rows = [(name, Run(clsurf, path, machine_text(machine, way), folder)) for name, way in ways.items()]
            for name, run in rows:
                print(f"{program}, {machine}, {name}: {run.time:.3f} s", file=sys.stderr, flush=True)
            block = re.compile(f"(<!-- {program} {machine} -->\n).*?(<!-- end -->\n)", re.S)
            if not block.search(page):
                raise SystemExit(f"docs/experiments/corners.md has no place for {program} on {machine}")
            page = block.sub(lambda m: m[1] + table_of(rows) + m[2], page)
            if (program, machine) == ("corners", "three_axis_mill"):
                corners = corners_of(clsurf, path)
                draw_speeds(dict(rows), corners)
                draw_corner(dict(rows), *corners[2:5, :2])
    with open(os.path.join(DOCS, "corners.md"), "w", encoding="utf-8") as file:
        file.write(page)


if __name__ == "__main__":
    main()
