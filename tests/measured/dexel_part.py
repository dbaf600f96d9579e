#!/usr/bin/env python3
"""A part cut by a plain dexel simulator, and what instruments would measure on it. Shares nothing with the product.

    dexel_part.py make FOLDER --part CASE [--without-mark]    writes part.nc, run.csv and the measurements
    dexel_part.py check FOLDER --part CASE --report REPORT    compares a report of `clsurf check --json` with what was planted

A ball or bull-nose tool cuts zigzag passes over a wavy surface; on one pass the measured positions of the log run off the
commanded ones: the mark. Passes are 0.3 mm apart but for a jitter of a few µm, and run a little off in height, as on real parts:
without that, every step-over is like the next one. A dexel is a vertical line: its height is the lowest outline of the tool
over all positions, which here lie 10 µm apart. Lengths in mm.
"""
import argparse
import json
import math
import pathlib
import random
import sys

STEP_OVER, PASSES, LENGTH, PERIOD, FEED = 0.3, 40, 14.0, 0.002, 3000.0
MARK_PASS, MARK_AT, MARK_HALF, MARK_DEPTH = 20, 7.0, 2.0, 0.008
FINE = 0.01  # between tool positions of a dexel
NOISE = 0.00003  # of the instruments
CASES = {  # tool, radius, corner, wave amplitude, slope along the feed, slope across
    "ball": ("ball:6", 3.0, 3.0, 0.4, 0.0, 0.0),
    "tilted_ball": ("ball:6", 3.0, 3.0, 0.3, 0.15, 0.25),
    "bull": ("bull:8,2", 4.0, 2.0, 0.3, 0.10, 0.30),
    "flat_plane": ("ball:6", 3.0, 3.0, 0.0, 0.0, 0.0),
}
# Where the instrument's axes lie on the part: its x axis runs along +Y, across the passes.
AT, ANGLE = (7.1, 2.9), 90.0
OFF_X, OFF_Z, TILT = 0.137, 4.2, 0.3  # what the operator does not know: shift [mm], height [mm], tilt [deg]

CMM_SHIFT, CMM_TURN = (0.06, -0.04, 0.11), (0.02, -0.03, 0.05)  # mm; deg about X, Y, Z


class Part:
    def __init__(self, case, mark):
        self.tool, self.radius, self.corner, self.wave, self.along, self.across = CASES[case]
        jitter = random.Random(7)
        still = case == "flat_plane"
        self.aside = [0.0 if still else jitter.uniform(-0.006, 0.006) for _ in range(PASSES)]
        self.lift = [0.0 if still else jitter.uniform(-0.0008, 0.0008) for _ in range(PASSES)]
        self.mark = mark

    def design(self, x, y):
        return (self.along * x + self.across * y + self.wave * math.sin(2 * math.pi * (x + 1.3) / 17)
                + self.wave * math.cos(2 * math.pi * y / 13))

    def tip(self, k, x):
        """The commanded tip of pass k at x: it touches the design surface, to first order of its slopes."""
        y = k * STEP_OVER + self.aside[k]
        e = 1e-4
        # The contact moves off the axis; two rounds of a fixed point are enough for these gentle slopes.
        cx, cy = x, y
        for _ in range(20):
            sx = (self.design(cx + e, cy) - self.design(cx - e, cy)) / (2 * e)
            sy = (self.design(cx, cy + e) - self.design(cx, cy - e)) / (2 * e)
            n = math.sqrt(1 + sx * sx + sy * sy)
            flat = math.hypot(sx, sy)
            arm = self.corner * flat / n + (self.radius - self.corner if flat > 1e-12 else 0.0)
            if flat < 1e-12:
                break
            cx, cy = x + arm * sx / flat, y + arm * sy / flat
        z = self.design(cx, cy) - (self.corner - self.corner / n)
        return y, z + self.lift[k]

    def off(self, k, x, cut):
        """How far the measured positions run below the commanded ones."""
        marked = self.mark or not cut
        if k != MARK_PASS or not marked or abs(x - MARK_AT) >= MARK_HALF:
            return 0.0
        return MARK_DEPTH * math.cos(0.5 * math.pi * (x - MARK_AT) / MARK_HALF) ** 2

    def outline(self, rho2):
        """Height of the tool over its tip."""
        rho = math.sqrt(rho2)
        if rho > self.radius:
            return math.inf
        out = max(0.0, rho - (self.radius - self.corner))
        return self.corner - math.sqrt(self.corner * self.corner - out * out)

    def cut_line(self, places):
        """Heights of dexels at places that lie near one line across the passes."""
        xs = [p[0] for p in places]
        middle = 0.5 * (min(xs) + max(xs))
        n = math.hypot(self.along + self.wave * 2 * math.pi / 17, 0)
        arm = self.corner * n / math.sqrt(1 + n * n) + (self.radius - self.corner)
        reach = 0.5 * (max(xs) - min(xs)) + arm + 0.15
        steps = int(2 * reach / FINE) + 1
        passes = []
        for k in range(PASSES):
            row = []
            for s in range(steps):
                x = middle - reach + s * FINE
                y, z = self.tip(k, x)
                row.append((x, y, z - self.off(k, x, True)))
            passes.append(row)
        sy = abs(self.across) + self.wave * 2 * math.pi / 13
        arm_y = self.corner * sy / math.sqrt(1 + sy * sy) + (self.radius - self.corner if sy > 0 else 0)
        heights = []
        for px, py in places:
            lowest = math.inf
            for row in passes:
                if abs(row[0][1] - py) > arm_y + 2.5 * STEP_OVER:
                    continue
                best = self.over_row(row, px, py)
                lowest = min(lowest, best)
            heights.append(lowest)
        return heights

    def over_row(self, row, px, py):
        """The lowest outline over a place along one pass. Coarse first, then every position about the best."""
        def height(s):
            x, y, z = row[s]
            return z + self.outline((x - px) ** 2 + (y - py) ** 2)

        coarse = 12
        best = min(range(0, len(row), coarse), key=height)
        return min(height(s) for s in range(max(0, best - coarse), min(len(row), best + coarse + 1)))


def write_part(part, folder):
    step = FEED / 60 * PERIOD
    with open(folder / "part.nc", "w") as nc, open(folder / "run.csv", "w") as run:
        nc.write("G21 G90 G94 G64\nG0 Z20\n")
        run.write("time,cmd.x,cmd.y,cmd.z,fb.x,fb.y,fb.z\n")
        time, last = 0.0, None

        def record(x, y, z, off=0.0):
            nonlocal time, last
            run.write(f"{time:.4f},{x:.7f},{y:.7f},{z:.7f},{x:.7f},{y:.7f},{z - off:.7f}\n")
            time += PERIOD
            last = (x, y, z)

        for k in range(PASSES):
            count = int(round(LENGTH / step))
            xs = [LENGTH * i / count for i in range(count + 1)]
            if k % 2:
                xs.reverse()
            for i, x in enumerate(xs):
                y, z = part.tip(k, x)
                if k == 0 and i == 0:
                    nc.write(f"G0 X{x:.4f} Y{y:.4f}\nG1 Z{z:.4f} F{FEED:g}\n")
                elif i % 5 == 0 or i == count:
                    nc.write(f"G1 X{x:.4f} Y{y:.4f} Z{z:.5f}\n")
                if i == 0 and last is not None:
                    for j in range(1, 3):
                        record(*(a + (b - a) * j / 3 for a, b in zip(last, (x, y, z))))
                record(x, y, z, part.off(k, x, False))
        nc.write("G0 Z20\nM30\n")


def stylus(part, folder, name="profile.csv", seed=1):
    """A profile across the passes: x along the trace, z up, tilted, shifted and with noise; heights in µm."""
    noise, spacing, length = random.Random(seed), 0.002, 6.0
    tilt = math.radians(TILT)
    count = int(length / spacing) + 1
    # (u, w) of the instrument lies OFF_X + u cos t + w sin t along the trace, at height OFF_Z - u sin t + w cos t.
    ways = [OFF_X + i * spacing for i in range(count)]
    heights = part.cut_line([(AT[0], AT[1] + way) for way in ways])
    with open(folder / name, "w") as out:
        out.write("x [mm],z [µm]\n")
        for way, z in zip(ways, heights):
            s, h = way - OFF_X, z - OFF_Z
            u = s * math.cos(tilt) - h * math.sin(tilt)
            w = s * math.sin(tilt) + h * math.cos(tilt)
            out.write(f"{u:.6f},{1000 * (w + noise.gauss(0, NOISE)):.4f}\n")


def touch(part, folder):
    """Points of a coordinate measuring machine: a grid of lines across the passes, in axes that lie off the part's."""
    noise = random.Random(3)
    a, b, c = map(math.radians, CMM_TURN)
    rows = [[math.cos(b) * math.cos(c), math.sin(a) * math.sin(b) * math.cos(c) - math.cos(a) * math.sin(c),
             math.cos(a) * math.sin(b) * math.cos(c) + math.sin(a) * math.sin(c)],
            [math.cos(b) * math.sin(c), math.sin(a) * math.sin(b) * math.sin(c) + math.cos(a) * math.cos(c),
             math.cos(a) * math.sin(b) * math.sin(c) - math.sin(a) * math.cos(c)],
            [-math.sin(b), math.sin(a) * math.cos(b), math.cos(a) * math.cos(b)]]
    shift = CMM_SHIFT
    with open(folder / "cmm.csv", "w") as out:
        out.write("# x y z\n")
        for x in (2.5, 4.1, 5.6, 8.4, 9.9, 11.6):
            places = [(x, 1.5 + 0.083 * i) for i in range(108)]
            for (px, py), z in zip(places, part.cut_line(places)):
                d = (px - shift[0], py - shift[1], z - shift[2])
                m = [sum(rows[r][k] * d[r] for r in range(3)) for k in range(3)]
                out.write(" ".join(f"{v + noise.gauss(0, 2 * NOISE):.6f}" for v in m) + "\n")


def areal(part, folder):
    """A map of 3 × 0.8 mm about the mark as a surface data file of text; one place was not measured."""
    spacing, wide, high = 0.008, 376, 9
    lines = []
    for row in range(high):
        x = AT[0] - 0.1 * row  # the map's y axis runs along -X of the part
        lines.append(part.cut_line([(x, AT[1] + 1.4 + spacing * i) for i in range(wide)]))
    noise = random.Random(5)
    with open(folder / "map.sdf", "w", newline="") as out:
        out.write("aISO-1.0\r\nManufacID   = dexel\r\nCreateDate  = 010120260000\r\nModDate     = 010120260000\r\n")
        out.write(f"NumPoints   = {wide}\r\nNumProfiles = {high}\r\nXscale      = {spacing / 1000:.6e}\r\nYscale      = {0.1 / 1000:.6e}\r\n")
        out.write("Zscale      = 1.0e-9\r\nZresolution = -1\r\nCompression = 0\r\nDataType    = 7\r\nCheckType   = 0\r\n*\r\n")
        for row, heights in enumerate(lines):
            values = [f"{1e6 * (z + noise.gauss(0, NOISE)):.1f}" for z in heights]
            if row == 4:
                values[17] = "BAD"
            out.write(" ".join(values) + "\r\n")
        out.write("*\r\n*\r\n")


def heights_of(z):
    """Ra, Rq, Rz [µm] of a profile in 2 µm steps, λc 0.8 mm: ISO 4287 with the Gaussian filter of ISO 16610-21."""
    def mean_line(z, cutoff):
        half, alpha = int(cutoff / 0.002), math.sqrt(math.log(2) / math.pi)
        w = [math.exp(-math.pi * (k * 0.002 / (alpha * cutoff)) ** 2) for k in range(half + 1)]
        out = []
        for i in range(len(z)):
            lo, hi = max(0, i - half), min(len(z), i + half + 1)
            ws = [w[abs(j - i)] for j in range(lo, hi)]
            out.append(sum(a * b for a, b in zip(ws, z[lo:hi])) / sum(ws))
        return out

    line = mean_line(z, 0.8)
    rough = [1000 * (a - b) for a, b in zip(z, line)]
    each = 400
    first = (len(z) - 5 * each) // 2
    used = rough[first:first + 5 * each]
    rz = sum(max(used[s:s + each]) - min(used[s:s + each]) for s in range(0, len(used), each)) / 5
    return (sum(map(abs, used)) / len(used), math.sqrt(sum(v * v for v in used) / len(used)), rz)


def check(part, report, marks):
    found = json.load(open(report))
    failures = []

    def expect(what, ok, detail):
        print(("ok    " if ok else "FAILED"), what, detail)
        if not ok:
            failures.append(what)

    if "measured" not in found:  # of `clsurf align` on the touched points
        pose = found["pose"]
        planted = {"x_mm": CMM_SHIFT[0], "y_mm": CMM_SHIFT[1], "z_mm": CMM_SHIFT[2],
                   "a_deg": CMM_TURN[0], "b_deg": CMM_TURN[1], "c_deg": CMM_TURN[2]}
        for key, value in planted.items():
            expect(key, abs(pose[key] - value) < (1e-3 if key.endswith("mm") else 2e-3), f"{pose[key]} for {value}")
        if failures:
            sys.exit(1)
        return
    measured = found["measured"]
    expect("compared", measured["compared"], measured["reason"])
    for key in ("ra_um", "rq_um", "rz_um"):
        is_, was = measured[key], measured["predicted"][key]
        if marks == "found":
            expect(key, abs(is_ / was - 1) < 0.03, f"{is_} measured, {was} predicted")
    if measured["kind"] == "profile":
        places = [(AT[0], AT[1] + OFF_X + 0.002 * i) for i in range(2801)]
        z = [h - part.design(*p) for h, p in zip(part.cut_line(places), places)]
        normal = [v / math.hypot(1, part.across + part.wave * 2 * math.pi / 13 * -math.sin(2 * math.pi * p[1] / 13))
                  for v, p in zip(z, places)]
        for key, own in zip(("ra_um", "rq_um", "rz_um"), heights_of(normal) if marks == "found" else ()):
            expect(f"{key} of the dexels", abs(measured["predicted"][key] / own - 1) < 0.03, f"{measured['predicted'][key]} predicted, {own:.4f} of the dexels")
        values = {p["name"]: p for p in measured["alignment"]["parameters"]}
        pose = measured["alignment"]["pose"]
        x = values["x"]
        origin = pose["y_mm"] - AT[1]
        expect("shift", abs(origin - OFF_X) < max(3 * x["standard_error"], 2e-4), f"{origin} for {OFF_X} ± {x['standard_error']}")
        tilt = values["b"]
        expect("tilt", abs(tilt["value"] - TILT) < max(3 * tilt["standard_error"], 1e-4), f"{tilt['value']} for {TILT} ± {tilt['standard_error']}")
    expect(f"mark {marks}", len(measured[f"marks_{marks}"]) == 1 and not measured["marks_missing" if marks == "found" else "marks_found"],
           json.dumps({k: measured[k] for k in ("marks_found", "marks_missing", "marks_not_judged")}))
    expect("correlation", measured["correlation"] > (0.97 if marks == "found" else 0.5), measured["correlation"])
    if failures:
        sys.exit(1)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("act", choices=("make", "check"))
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--part", choices=CASES, default="ball")
    parser.add_argument("--without-mark", action="store_true", help="the part was cut without the mark that the log shows")
    parser.add_argument("--measure", default="stylus", help="stylus, touch or areal, several with commas")
    parser.add_argument("--report")
    options = parser.parse_args()
    part = Part(options.part, not options.without_mark)
    if options.act == "check":
        check(part, options.report, "missing" if options.without_mark else "found")
        return
    write_part(part, options.folder)
    for name in options.measure.split(","):
        {"stylus": stylus, "touch": touch, "areal": areal}[name](part, options.folder)


if __name__ == "__main__":
    main()
