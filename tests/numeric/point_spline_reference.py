#!/usr/bin/python3
# Writes vectors/point_spline.txt: middles of the spans of splines through points over chord lengths, by scipy.
import numpy as np
from scipy.interpolate import Akima1DInterpolator, CubicSpline

rng = np.random.default_rng(20)


def row(name, values):
    return name + "".join(f" {v:.12g}" for v in np.ravel(values)) + "\n"


with open("vectors/point_spline.txt", "w") as out:
    out.write("# point_spline_reference.py\n")
    for count in (5, 9, 30):
        p = np.cumsum(rng.uniform(-1, 2, (count, 3)), axis=0)
        u = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(p, axis=0), axis=1))])
        middle = 0.5 * (u[1:] + u[:-1])
        begin, end = (v / np.linalg.norm(v) for v in rng.normal(size=(2, 3)))
        out.write("case\n" + row("points", p) + row("begin", begin) + row("end", end))
        out.write(row("natural", CubicSpline(u, p, bc_type="natural")(middle)))
        out.write(row("tangent", CubicSpline(u, p, bc_type=((1, begin), (1, end)))(middle)))
        out.write(row("free", CubicSpline(u, p, bc_type="not-a-knot")(middle)))
        out.write(row("akima", Akima1DInterpolator(u, p)(middle)))
