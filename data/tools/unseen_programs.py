#!/usr/bin/python3
"""Writes programs that were not used to develop the repair or the identification: those of docs/experiments/repair.md and
docs/experiments/kernel.md. Every call writes the same files.

    unseen_programs.py FOLDER
"""
import math
import pathlib
import random
import sys

HEAD = "G21 G90 G17 G40 G80 G54"


def gauss(x, y):
    return math.exp(-((x - 8) ** 2 + (y - 4) ** 2) / 30)


def saddle(x, y):
    return 0.005 * (x * x - y * y) + 1.5 * gauss(x, y)


def waves(x, y):
    return 2 * math.sin(0.25 * x) * math.cos(0.2 * y)


def by_chord_error(point, begin, end, error, shortest=0.05, longest=3.0):
    """Points of a curve whose chords leave it by `error` at most, as a CAM system spaces them."""
    points, at = [point(begin)], begin
    while at < end - 1e-9:
        step = min(longest, end - at)
        while step > shortest:
            middle = [(a + b) / 2 for a, b in zip(point(at), point(at + step))]
            if math.dist(point(at + step / 2), middle) <= error:
                break
            step *= 0.8
        at += step
        points.append(point(at))
    return points


def zigzag(passes):
    return [points if k % 2 == 0 else points[::-1] for k, points in enumerate(passes)]


def write_three_axes(file, mode, feed, passes, form="%.3f"):
    points = [point for one in passes for point in one]
    x, y, z = (form % value for value in points[0])
    lines = ["(unseen)", HEAD, mode, "M3 S10000", "G0 Z20", "G0 X%s Y%s" % (x, y), "G1 Z%s F1500" % z, "F%d" % feed]
    lines += ["G1 X%s Y%s Z%s" % tuple(form % value for value in point) for point in points[1:]]
    file.write_text("\n".join(lines + ["G0 Z20", "M5", "M2"]) + "\n")


def oblique(passes, step_over, degrees, height, ends, error, rng):
    """Parallel passes at an angle to X, with lines of uneven length. `ends`: where a pass begins and ends."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))

    def point(u, v):
        x, y = u * c - v * s + 5, u * s + v * c
        return x, y, height(x, y)

    made = []
    for k in range(passes):
        v = k * step_over
        u, end = ends(v)
        points = [point(u, v)]
        while u < end:
            before, here, after = (point(u + d, v)[2] for d in (-1e-3, 0, 1e-3))
            bend = max(abs(before - 2 * here + after) / 1e-6, 1e-3)
            u = min(u + min(2.5, math.sqrt(8 * error / bend)) * rng.uniform(0.5, 1), end)
            points.append(point(u, v))
        made.append(points)
    return zigzag(made)


def rounded_rectangle(a, b, radius, steps, z):
    corners = [(a - radius, b - radius, 0), (radius - a, b - radius, 90), (radius - a, radius - b, 180),
               (a - radius, radius - b, 270)]
    outline = []
    for x, y, first in corners:
        for k in range(steps + 1):
            angle = math.radians(first + 90 * k / steps)
            outline.append((x + radius * math.cos(angle), y + radius * math.sin(angle)))
    outline.append(outline[0])
    points = []
    for (x0, y0), (x1, y1) in zip(outline, outline[1:]):
        parts = max(1, int(math.hypot(x1 - x0, y1 - y0) / 1.7))
        points += [(x0 + (x1 - x0) * k / parts, y0 + (y1 - y0) * k / parts) for k in range(parts)]
    return [(x, y, z(x, y)) for x, y in points + outline[:1]]


def write_arcs(file):
    lines = ["(unseen arcs)", "G21 G90 G18 G40 G80 G54", "G64 P0.008 Q0", "M3 S10000", "G0 Z20", "G0 X-20 Y-5",
             "G1 Z0 F1500", "F3000"]
    for k in range(24):
        lines.append("G1 Y%.3f" % (-5 + 0.4 * k))
        ends = [-12, -4, 4, 12, 20] if k % 2 == 0 else [12, 4, -4, -12, -20]
        for n, x in enumerate(ends):
            word = "G2" if (n + k) % 2 else "G3"
            lines.append("G1 X%d Z0" % x if n == 2 else "%s X%d Z0 R%.3f" % (word, x, 9 + 0.02 * k))
    file.write_text("\n".join(lines + ["G0 Z20", "M5", "M2"]) + "\n")


def write_three_axis_programs(folder):
    rng = random.Random(7)
    write_three_axes(folder / "saddle.ngc", "G64 P0.01 Q0", 5000,
                     zigzag([by_chord_error(lambda x, y=0.35 * k - 6: (x, y, saddle(x, y)), -30, 30, 0.003)
                             for k in range(34)]))
    # Lines of 0.12 mm, which the controller may merge.
    write_three_axes(folder / "merge.ngc", "G64 P0.02 Q0.006", 3500,
                     zigzag([[(0.12 * n - 22, y, waves(0.12 * n - 22, y)) for n in range(368)]
                             for y in (0.4 * k - 5 for k in range(28))]))
    angle, turn = 0.0, []
    while (radius := 2 + 0.4 * angle / (2 * math.pi)) <= 16:
        turn.append((radius * math.cos(angle), radius * math.sin(angle),
                     0.6 * math.sin(3 * angle) * radius / 16 - 0.01 * radius * radius))
        angle += rng.uniform(0.25, 0.7) / radius
    write_three_axes(folder / "spiral.ngc", "G64 P0.004 Q0", 3600, [turn], "%.4f")
    # Every fourth loop has corners of eleven lines instead of eight.
    write_three_axes(folder / "rects.ngc", "G64 P0.03 Q0", 4200,
                     [rounded_rectangle(8 + 0.4 * k, 5 + 0.4 * k, 3 + 0.2 * k, 11 if k % 4 == 2 else 8,
                                        lambda x, y: -0.012 * (x * x + 0.6 * y * y)) for k in range(26)])
    # No G64 with a tolerance; every fifth pass has each point twice, 0.03 mm apart.
    passes = []
    for k in range(30):
        y = 0.45 * k - 6
        points = by_chord_error(lambda x, y=y: (x, y, waves(0.8 * x, y)), -20, 20, 0.004)
        if k % 5 == 3:
            points = [(x, y, waves(0.8 * x, y)) for p in points for x in (p[0], p[0] + 0.03) if x < 20]
        passes.append(points)
    write_three_axes(folder / "plainmode.ngc", "(no G64)", 2800, zigzag(passes))
    write_arcs(folder / "arcs.ngc")


def write_oblique_programs(folder):
    """Adjacent passes differ only in their ramps before and after the turns."""
    rng = random.Random(23)
    write_three_axes(folder / "oblique.ngc", "G64 P0.01", 5000,
                     oblique(28, 0.4, 23, lambda x, y: 5 * math.sin(x / 9) * math.cos(y / 11) + 0.006 * (x - 20) ** 2,
                             lambda v: (0, 38), 0.004, rng), "%.4f")
    write_three_axes(folder / "bounded.ngc", "G64 P0.005", 4000,
                     oblique(30, 0.35, -13, lambda x, y: 4 * math.sin(x / 8) * math.cos(y / 13),
                             lambda v: (3 * math.sin(v / 3), 34 - 2 * math.cos(v / 2.5)), 0.004, rng))
    write_three_axes(folder / "fast.ngc", "G64 P0.01", 6000,
                     oblique(30, 0.35, 31, lambda x, y: 3.5 * math.sin(x / 11) * math.cos(y / 9) + 0.006 * (x - 20) ** 2,
                             lambda v: (2 * math.sin(v / 4), 30 - math.cos(v / 2)), 0.005, rng))


def angles_of(axis):
    """A and C of a tool axis: t = (sin A sin C, −sin A cos C, cos A), A at most 0."""
    tilt = -math.acos(max(-1.0, min(1.0, axis[2])))
    return math.degrees(tilt), math.degrees(math.atan2(-axis[0], axis[1])) % 360


def write_five_axes(file, passes, feeds, decimals):
    """`passes`: of (tip, tool axis)."""
    form = "X%%.%df Y%%.%df Z%%.%df A%%.4f C%%.4f" % (decimals, decimals, decimals)
    lines = ["(unseen, five axes)", "G21 G90 G17 G54", "T1 M6", "S12000 M3", "G43.4 H1"]
    turn, last = 0, None

    def block(tip, axis):
        nonlocal turn, last
        tilt, rotation = angles_of(axis)
        if last is not None:  # the turn next to the last angle
            turn = round((last - rotation) / 360)
        last = rotation + 360 * turn
        return form % (*tip, tilt, last)

    tip, axis = passes[0][0]
    lines.append("G0 " + block((tip[0], tip[1], tip[2] + 10), axis))
    for points, feed in zip(passes, feeds):
        for k, (tip, axis) in enumerate(points):
            lines.append(("G1 " if k == 0 else "") + block(tip, axis) + (" F%d" % feed if k == 0 else ""))
    file.write_text("\n".join(lines + ["G0 Z60", "G49", "M5", "M30"]) + "\n")


def on_ball(radius, x, y):
    z = math.sqrt(radius * radius - x * x - y * y)
    return (x, y, z - radius), (x / radius, y / radius, z / radius)


def write_five_axis_programs(folder):
    rng = random.Random(5)
    passes = []
    for k in range(25):
        xs, x = [], 12.0
        while x < 36 + 1e-9:
            xs.append(x)
            x += 0.03 if k % 6 == 3 and 22 <= x < 25 else 0.6
        passes.append([on_ball(60, x, 0.5 * k - 6) for x in xs])
    write_five_axes(folder / "ball.nc", zigzag(passes), [3000] * 25, 4)
    loops = []
    for k in range(14):
        steps = []
        for n in range(160):
            parts = 12 if k % 5 == 3 and 40 <= n < 45 else 1
            steps += [n + p / parts for p in range(parts)]
        radius = 12 + 0.45 * k
        loops.append([on_ball(50, radius * math.cos(a), radius * math.sin(a))
                      for a in (2 * math.pi * step / 160 for step in steps + [160])])
    write_five_axes(folder / "loops.nc", loops, [2500] * 14, 3)
    passes = []
    for k in range(22):
        y, xs = 0.45 * k, [0.0]
        while xs[-1] < 30:
            xs.append(min(30.0, xs[-1] + rng.uniform(0.25, 0.9)))
        points = []
        for x in xs:
            z = 0.03 * x + 1.5 * math.sin(0.22 * x) * math.cos(0.15 * y)
            dx = 0.03 + 1.5 * 0.22 * math.cos(0.22 * x) * math.cos(0.15 * y)
            dy = -1.5 * 0.15 * math.sin(0.22 * x) * math.sin(0.15 * y)
            length = math.sqrt(dx * dx + dy * dy + 1)
            nx, ny, nz = -dx / length, -dy / length, 1 / length
            c, s = math.cos(math.radians(38)), math.sin(math.radians(38))
            points.append(((x, y, z), (c * nx + s * nz, ny, c * nz - s * nx)))
        passes.append(points)
    write_five_axes(folder / "waves.nc", zigzag(passes), [1800 if k in (7, 15) else 3000 for k in range(22)], 3)


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    write_three_axis_programs(folder)
    write_oblique_programs(folder)
    write_five_axis_programs(folder)


main()
