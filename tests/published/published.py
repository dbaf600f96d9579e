#!/usr/bin/env python3
"""Writes the tables of docs/experiments/published.md: simulated runs of the standard curves next to published times and to optima.

    /usr/bin/python3 tests/published/published.py build/release/src/cli/clsurf [--clone DIR] [--only NAME]

Needs scipy (Debian: python3-scipy). The points of the polylines are in a repository without a licence, so they are not here:

    git clone https://github.com/Theigrams/cnc_interpolation CLONE

Without --clone their tables stay as they are. Optima are those of optima.json, which optima.py writes.
With --period, in s, the page stays as it is: the tables of runs at this period are printed.
"""
import argparse
import json
import os
import re
import resource
import subprocess
import sys
import tempfile

import numpy as np

sys.dont_write_bytecode = True
import set_points
from standard_curves import HERE, ROOT, read_curves

PAGE = os.path.join(ROOT, "docs", "experiments", "published.md")
GROUPS = ["axis", "tangential", "normal", "vector"]
RUNS = 3  # of which the fastest counts


class Run:
    def __init__(self, curve, reading, clsurf, folder):
        ending, text = curve.program()
        program, machine, log = (os.path.join(folder, name) for name in ("part" + ending, "machine.toml", "run.biip"))
        for path, content in ((program, text), (machine, curve.machine(reading))):
            with open(path, "w", encoding="ascii") as file:
                file.write(content)
        start = ",".join(f"{p:.7f}" for p in curve.start) + ",0"
        command = [clsurf, "simulate", program, "--machine", machine, "--start", start, "--quiet", "-o", log]
        self.computing = np.inf
        for _ in range(RUNS):
            before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
            subprocess.run(command, check=True)
            self.computing = min(self.computing, resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before)
            positions, period = set_points.commanded(log, curve.axes, curve.first_line)
            os.remove(log)
        self.positions, self.period = positions, period
        self.time = (len(positions) - 1) * period
        self.off_path = curve.distances(positions).max() * 1e3


def pair(shares, group):
    values = [shares.get(f"{group} {order}") for order in "aj"]
    return "" if None in values else " · ".join(f"{v:.3f}" for v in values)


def row(*cells):
    return "| " + " | ".join(cells) + " |\n"


def measured_cells(run, best):
    over = f"{100 * (run.time / best - 1):+.1f} %" if best else ""
    return [f"{run.time:.3f}", f"{best:.3f}" if best else "", over], [f"{run.off_path:.2f}", f"{run.computing:.2f}"]


def table_of(curve, rows):
    """Rows: of (reading, run, optimum)."""
    if curve.axes == "xy":
        text = row("", "time, s", "optimum, s", "over it", "path v", *(f"{g} a · j" for g in GROUPS), "off path, µm", "computed, s")
    else:
        text = row("", "time, s", "optimum, s", "over it", *(f"{axis.upper()} v · a · j" for axis in curve.axes), "off path, µm", "computed, s")
    text += "|" + "---|" * (text.count("|") - 1) + "\n"
    for reading, run, best in rows:
        head, tail = measured_cells(run, best)
        if curve.axes == "xy":
            limits = curve.speed, curve.acceleration, curve.jerk
            shares = set_points.path_shares(run.positions, run.period, *limits, curve.lengths(run.positions))
            cells = [f"{shares['path v']:.3f}"] + [pair(shares, g) for g in GROUPS]
        else:
            unit = np.where([axis in "abc" for axis in curve.axes], np.degrees(1), 1)
            orders = set_points.axis_shares(run.positions, run.period, *(np.array(l) * unit for l in curve.axis_limits()))
            cells = [" · ".join(f"{order[k]:.3f}" for order in orders) for k in range(len(curve.axes))]
        text += row(f"`{reading}`", *head, *cells, *tail)
    for other in curve.published:
        shares = other.get("shares", {})
        cells = [""] + [pair(shares, g) for g in GROUPS] if curve.axes == "xy" else [""] * len(curve.axes)
        text += row(other["method"], f"{other['time']:.3f}", "", "", *cells, "", "")
    return text


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("clsurf")
    parser.add_argument("--clone")
    parser.add_argument("--only")
    parser.add_argument("--period", type=float)
    options = parser.parse_args()
    with open(os.path.join(HERE, "optima.json"), encoding="ascii") as file:
        optima = json.load(file)
    for name, curve in read_curves(options.clone).items():
        if options.only not in (None, name):
            continue
        if options.period:
            curve.values["period"] = options.period
        rows = []
        with tempfile.TemporaryDirectory() as folder:
            for reading in curve.readings:
                run = Run(curve, reading, options.clsurf, folder)
                best = optima.get(name, {}).get(reading, {}).get("time")
                rows.append((reading, run, best))
                print(f"{name}, {reading}: {run.time:.4f} s, optimum {best}", file=sys.stderr, flush=True)
        if options.period:
            print(table_of(curve, rows))
            continue
        with open(PAGE, encoding="utf-8") as file:
            page = file.read()
        block = re.compile(f"(<!-- {name} -->\n).*?(<!-- end -->\n)", re.S)
        if not block.search(page):
            raise SystemExit(f"{PAGE} has no place for {name}")
        page = block.sub(lambda m: m[1] + table_of(curve, rows) + m[2], page)
        with open(PAGE, "w", encoding="utf-8") as file:
            file.write(page)


if __name__ == "__main__":
    main()
