"""A scan made from a known profile, and the program of `clsurf profile` judged against that profile. Standard library only.

    scanned_part.py make FOLDER            scan.csv: 1500 points, scatter 4 µm, outliers at seven places
                                           laser.txt: the same without outliers, as distances below 120 mm, sensor 35 mm ahead
    scanned_part.py check PROGRAM REPORT --radius R [--outliers N] [--within MM]

The profile is z = 5 + 4 sin(0.2 x). `check` reads lines of G1 by itself, and measures how far the tip of a ball that touches
the profile without scatter is from them.
"""
import argparse
import json
import math
import random
import re
import sys

OUTLIERS = (0, 100, 101, 400, 777, 1200, 1499)


def height(x):
    return 5 + 4 * math.sin(0.2 * x)


def make(folder):
    draw = random.Random(4)
    with open(folder + "/scan.csv", "w") as scan, open(folder + "/laser.txt", "w") as laser:
        scan.write("# a part on the bench\nx;height\nmm;mm\n")
        laser.write("record\tway\tdistance\n")
        for i in range(1500):
            x, z = 0.1 * i, height(0.1 * i) + draw.gauss(0, 0.004)
            laser.write(f"{i}\t{x - 35:.3f}\t{120 - z:.4f}\n")
            z += (0.3 if i % 2 else -0.3) if i in OUTLIERS else 0
            scan.write(f"{x:.3f};{z:.4f}\n")


def tip(x, radius):
    slope = 0.8 * math.cos(0.2 * x)
    scale = radius / math.hypot(1, slope)
    return x - scale * slope, height(x) + scale - radius


def distance(p, a, b):
    wx, wy = b[0] - a[0], b[1] - a[1]
    square = wx * wx + wy * wy
    t = min(max(((p[0] - a[0]) * wx + (p[1] - a[1]) * wy) / square, 0), 1) if square else 0
    return math.hypot(p[0] - a[0] - t * wx, p[1] - a[1] - t * wy)


def check(arguments):
    x = z = None
    points = []
    for line in open(arguments.program):
        words = dict(re.findall(r"([GXZ])(-?[0-9.]+)", re.sub(r"\(.*\)", "", line)))
        x, z = float(words.get("X", x or 0)), float(words.get("Z", z or 0))
        if words.get("G") == "1":
            points.append((x, z))
    worst = 0
    for k in range(30, 14970):
        p = tip(k / 100, arguments.radius)
        worst = max(worst, min(distance(p, a, b) for a, b in zip(points, points[1:]) if a[0] - 1 <= p[0] <= b[0] + 1))
    report = json.load(open(arguments.report))
    found = sorted(round(at[0] * 10) for at in report["rejected_mm"])
    print(f"{len(points)} points, {worst:.4f} mm from the profile, rejected {found}")
    good = worst < arguments.within and found == sorted(OUTLIERS[: arguments.outliers])
    good = good and report["output_points"] == len(points) and report["chord_error_mm"] <= report["tolerance_mm"] + 1e-4
    good = good and 0.0035 < report["rms_residual_mm"] < 0.0045 and report["rejected"] == len(found)
    sys.exit(0 if good else 1)


parser = argparse.ArgumentParser()
commands = parser.add_subparsers(dest="command", required=True)
commands.add_parser("make").add_argument("folder")
checked = commands.add_parser("check")
checked.add_argument("program")
checked.add_argument("report")
checked.add_argument("--radius", type=float, default=0)
checked.add_argument("--outliers", type=int, default=len(OUTLIERS))
checked.add_argument("--within", type=float, default=0.013)
arguments = parser.parse_args()
make(arguments.folder) if arguments.command == "make" else check(arguments)
