#!/usr/bin/env python3
"""Writes the tables of docs/experiments/rounded_rectangle.md that a simulated lap gives.

    /usr/bin/python3 tests/published/rounded_rectangle.py build/release/src/cli/clsurf

Needs numpy (Debian: python3-numpy). Program and machine: data/programs/rounded_rectangle.nc, data/machines/li_2025.toml.
"""
import os
import re
import subprocess
import sys
import tempfile

import numpy as np

sys.dont_write_bytecode = True
import set_points
from corners import DOCS, ROOT, machine_text

PROGRAM = os.path.join(ROOT, "data", "programs", "rounded_rectangle.nc")
PAGE = os.path.join(DOCS, "rounded_rectangle.md")
NODES = {
    "A": (-205, -200),
    "B": (-205, -177.08),
    "C": (-205, 200),
    "D": (-200, 205),
    "E": (200, 205),
    "F": (205, 200),
    "G": (205, -200),
    "H": (200, -205),
    "I": (-200, -205),
    "J": (-205, -200),
    "K": (-205, -177.08),
}
WAYS = {
    "arc": (["arc"], 0),
    "spline": (["spline"], 0),
    "stop": (["stop"], 0),
    "arc, 300 mm/s³ for each axis": (["arc", "arc_step_time = 0.001"], 300),
    "spline, 300 mm/s³ for each axis": (["spline"], 300),
    "stop, 300 mm/s³ for each axis": (["stop"], 300),
}


class Lap:
    def __init__(self, clsurf, lines, axis_jerk):
        text = re.sub(r"^max_jerk = 0$", f"max_jerk = {axis_jerk}", machine_text("li_2025", lines), flags=re.M)
        with tempfile.TemporaryDirectory() as folder:
            machine, log = os.path.join(folder, "machine.toml"), os.path.join(folder, "run.biip")
            with open(machine, "w", encoding="utf-8") as file:
                file.write(text)
            subprocess.run([clsurf, "simulate", PROGRAM, "--machine", machine, "--start=-205,-210,0", "--quiet", "-o", log], check=True)
            self.positions, self.period = set_points.commanded(log, "xy")
        _, self.velocity, second, third = set_points.differences(self.positions, self.period)
        self.acceleration, self.jerk = np.abs(second).max(), np.abs(third).max()

    def passes(self):
        """Time of each node from that of A, and the speed there [s, mm/min]: the lap is travelled once, so that each node is looked for
        after the one before."""
        found, first = [], 0
        arrived = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(self.positions, axis=0), axis=1))])
        for name, node in NODES.items():
            distance = np.linalg.norm(self.positions - node, axis=1)
            distance[:first] = np.inf
            distance[arrived > arrived[first] + 450] = np.inf  # A and J, B and K are one place
            at = int(np.argmin(distance))
            step = (self.positions[at + 1] - self.positions[at - 1]) / (2 * self.period)
            speed = np.linalg.norm(step)
            time = at * self.period + (np.array(node) - self.positions[at]) @ step / speed**2
            found.append((name, node, time, 60 * speed))
            first = at + 1
        return [(name, node, time - found[0][2], speed) for name, node, time, speed in found]


def replace(page, name, table):
    block = re.compile(f"(<!-- {name} -->\n).*?(<!-- end -->\n)", re.S)
    if not block.search(page):
        raise SystemExit(f"{PAGE} has no place for {name}")
    return block.sub(lambda m: m[1] + table + m[2], page)


def main():
    clsurf = os.path.abspath(sys.argv[1])
    laps = {name: Lap(clsurf, *way) for name, way in WAYS.items()}
    nodes = "| node | | X, mm | Y, mm | time from A, s | speed, mm/min |\n|---|---|---|---|---|---|\n"
    for k, (name, node, time, speed) in enumerate(laps["arc"].passes()):
        nodes += f"| {k + 1} | {name} | {node[0]:g} | {node[1]:g} | {time:.3f} | {speed:.1f} |\n"
    ways = "| corners | A to K, s | greatest axis acceleration, mm/s² | greatest axis jerk, mm/s³ |\n|---|---|---|---|\n"
    for name, lap in laps.items():
        ways += f"| {name} | {lap.passes()[-1][2]:.3f} | {lap.acceleration:.1f} | {lap.jerk:.0f} |\n"
    with open(PAGE, encoding="utf-8") as file:
        page = replace(replace(file.read(), "nodes", nodes), "ways", ways)
    with open(PAGE, "w", encoding="utf-8") as file:
        file.write(page)


if __name__ == "__main__":
    main()
