"""How far a program with splines is from one with lines, both ways. The splines are evaluated by SciPy.

usage: read_splines.py LINES SPLINES TOLERANCE LEAST_SPANS

Both programs are absolute, in mm, with X, Y, Z or some of them on a line. Splines are G06.2 (Fanuc), BSPLINE with PL
(Siemens), SPL (Klartext) and G5 with I, J, P, Q (LinuxCNC). It fails where a distance is above TOLERANCE, where there
are fewer than LEAST_SPANS spans, or where there are as many blocks as before.
"""

import re
import sys

import numpy
from scipy.interpolate import BPoly, BSpline

STEP = 0.02  # [mm] between places that are compared
WORD = re.compile(r"(K[123][XYZ]|PL|SD|[A-Z])\s*=?\s*([-+]?[0-9]*\.?[0-9]+)")


class Path:
    def __init__(self):
        self.points = [numpy.zeros(3)]
        self.spans = 0
        self.open = None  # the control points and knots, or intervals, of a spline that is being read

    def line_to(self, end):
        self.points.append(end)

    def curve(self, value, ends):
        """A curve over a parameter between `ends`, whose values are span ends."""
        for begin, end in zip(ends[:-1], ends[1:]):
            if end <= begin:
                continue
            self.spans += 1
            places = numpy.linspace(begin, end, 80)[1:]
            self.points.extend(numpy.atleast_2d(value(places)))

    def close(self):
        control, numbers, is_basis = self.open
        self.open = None
        if is_basis:
            spans = len(control) - 3
            inner = numpy.cumsum(numbers[:spans])
            knots = numpy.concatenate([[0, 0, 0, 0], inner, [inner[-1]] * 3])
        else:
            knots = numpy.array(numbers)
        self.curve(BSpline(knots, numpy.array(control), 3), knots[3:-3])


def read(name):
    path, blocks = Path(), 0
    for text in open(name):
        text = re.sub(r"\(.*?\)|;.*", "", text).strip().upper()
        text = re.sub(r"^N?[0-9]+\s+", "", text)
        if not text:
            continue
        blocks += 1
        words = dict((letter, float(value)) for letter, value in WORD.findall(text))
        here = path.points[-1]
        end = numpy.array([words.get(axis, here[k]) for k, axis in enumerate("XYZ")])
        moves = any(axis in words for axis in "XYZ")
        if text.startswith("G06.2"):
            path.open = ([end], [words["K"]], False)
            assert numpy.allclose(end, here, atol=1.1e-3), (name, text)
        elif text.startswith("BSPLINE"):
            path.open = ([here, end], [words["PL"]], True)
        elif text.startswith("G5 "):
            control = [here, here + [words["I"], words["J"], 0], end + [words["P"], words["Q"], 0], end]
            path.curve(BPoly(numpy.array(control)[:, None], [0, 1]), [0, 1])
        elif text.startswith("SPL"):
            factors = [[words[f"K{power}{axis}"] for axis in "XYZ"] for power in (3, 2, 1)]
            value = lambda u: numpy.array([numpy.polyval([a, b, c, d], 1 - u) for a, b, c, d in zip(*factors, end)]).T
            assert numpy.allclose(value(0.0), here, atol=1.1e-3), (name, text)
            path.curve(value, [0, 1])
        elif path.open and (moves or "K" in words):
            if moves:
                path.open[0].append(numpy.array([words.get(axis, path.open[0][-1][k]) for k, axis in enumerate("XYZ")]))
            if "K" in words or "PL" in words:
                path.open[1].append(words["K"] if "K" in words else words["PL"])
        else:
            if path.open:
                path.close()
                here = path.points[-1]
                end = numpy.array([words.get(axis, here[k]) for k, axis in enumerate("XYZ")])
            if moves:
                path.line_to(end)
    return numpy.array(path.points), path.spans, blocks


def places_on(points):
    places = [points[:1]]
    for a, b in zip(points[:-1], points[1:]):
        pieces = max(1, int(numpy.ceil(numpy.linalg.norm(b - a) / STEP)))
        places.append(a + (b - a) * (numpy.arange(1, pieces + 1) / pieces)[:, None])
    return numpy.concatenate(places)


def farthest(places, points):
    a, way = points[:-1], numpy.diff(points, axis=0)
    square = numpy.maximum((way * way).sum(1), 1e-30)
    most = 0.0
    for p in places:
        share = numpy.clip(((p - a) * way).sum(1) / square, 0, 1)
        most = max(most, numpy.sqrt((((a + share[:, None] * way) - p) ** 2).sum(1).min()))
    return most


old, _, old_blocks = read(sys.argv[1])
new, spans, new_blocks = read(sys.argv[2])
forth, back = farthest(places_on(new), old), farthest(places_on(old), new)
print(f"{spans} spans, {old_blocks} blocks before, {new_blocks} after, off by {forth:.5f} and {back:.5f} mm")
assert spans >= int(sys.argv[4]), spans
assert new_blocks < old_blocks, (old_blocks, new_blocks)
assert max(forth, back) <= float(sys.argv[3]), (forth, back)
