#!/usr/bin/env python3
"""A part that is cut by a machine with a known error, for `clsurf profile --compensate`.

    compensated_part.py make FOLDER [RADIUS]     pass.ngc and deviations.csv of a wanted profile
    compensated_part.py check FOLDER [RADIUS]    cuts corrected.ngc with the same machine: what is left of the error

The ball is a dilation: its tip is as low as it can be without going below the wanted profile. The part is an erosion: the
lowest point of all balls above a place. Both by brute force in NumPy, without normals, offsets or fits. The machine leaves
the part too high by error(x), wherever the pass is.
"""
import re
import sys

import numpy as np

STEP = 0.01  # mm
X = np.arange(0, 80 + STEP / 2, STEP)


def wanted(x):
    return 2.0 * np.sin(x / 9) + 0.4 * np.cos(x / 5)


def error(x):
    return 0.030 * np.sin(x / 11) + 0.012


def reach(radius):
    k = np.arange(-int(radius / STEP) + 1, int(radius / STEP))
    return k, np.sqrt(radius**2 - (k * STEP) ** 2)


def tips(profile, radius):
    if radius == 0:
        return profile
    best = np.full(profile.shape, -np.inf)
    for k, height in zip(*reach(radius)):
        best = np.maximum(best, np.roll(profile, k) + height)
    return best - radius


def part(tip, radius):
    if radius == 0:
        return tip
    least = np.full(tip.shape, np.inf)
    for k, height in zip(*reach(radius)):
        least = np.minimum(least, np.roll(tip, k) + radius - height)
    return least


def make(folder, radius):
    z = tips(wanted(X), radius)
    inside = slice(int(5 / STEP), -int(5 / STEP), 20)  # the ends have no neighbours
    with open(f"{folder}/pass.ngc", "w", encoding="ascii") as out:
        out.write("G21 G90 G17 G54\nG0 Z20\n")
        for n, (x, height) in enumerate(zip(X[inside], z[inside])):
            out.write(f"{'G0' if n == 0 else 'G1'} X{x:.4f} Y2{' F1000' if n == 1 else ''}" +
                      (f"\nG1 Z{height:.4f} F500\n" if n == 0 else f" Z{height:.4f}\n"))
        out.write("G0 Z20\nM2\n")
    noise = np.random.default_rng(3).normal(0, 0.3, X.shape)
    with open(f"{folder}/deviations.csv", "w", encoding="utf-8") as out:
        out.write("x [mm],dz [µm]\n")
        for k in range(int(4 / STEP), X.size - int(4 / STEP), 50):
            out.write(f"{X[k]:.3f},{1000 * error(X[k]) + noise[k]:.3f}\n")


def check(folder, radius):
    places = [(float(m[1]), float(m[2])) for line in open(f"{folder}/corrected.ngc", encoding="ascii")
              if (m := re.match(r"(?:N\d+ )?(?:G1 )?X([-\d.]+).* Z([-\d.]+)", line))]
    first = re.search(r"X([-\d.]+)", open(f"{folder}/corrected.ngc", encoding="ascii").read())
    assert len(places) > 20, places[:3]
    x, z = np.array(places).T
    assert (np.diff(x) > 0).all() and float(first[1]) <= x[0]
    tip = np.interp(X, x, z)
    seen = (X > x[0] + radius + 0.5) & (X < x[-1] - radius - 0.5)
    off = (part(tip, radius) + error(X) - wanted(X))[seen]
    before = (part(tips(wanted(X), radius), radius) + error(X) - wanted(X))[seen]
    print(f"before {1000 * np.abs(before).max():.1f} µm, after {1000 * np.abs(off).max():.1f} µm, "
          f"rms {1000 * off.std():.1f} µm")
    assert np.abs(before).max() > 0.038
    assert np.abs(off).max() < 0.003, np.abs(off).max()


if __name__ == "__main__":
    {"make": make, "check": check}[sys.argv[1]](sys.argv[2], float(sys.argv[3]) if len(sys.argv) > 3 else 0.0)
