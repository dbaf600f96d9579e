"""Curves as paths for optimum.py: exact derivatives by the arc length, and distances."""
import re

import numpy as np
from scipy.interpolate import BSpline, CubicHermiteSpline, make_interp_spline
from scipy.spatial import cKDTree

from places import graded_places

FINE = 2000  # steps a span of tables
GROWTH = 0.1  # of the step, a mm
GAUSS = np.polynomial.legendre.leggauss(5)


def read_nurbs(path):
    """Control points, weights, knots and degree of the G06.2 of a Fanuc program."""
    points, weights, knots, degree = [], [], [], None
    with open(path, encoding="ascii") as file:
        for line in file:
            words = dict(re.findall(r"([A-Z])(-?[\d.]+)", line))
            if line.startswith("G06.2"):
                degree = int(words["P"]) - 1
            if "K" not in words or degree is None:
                continue
            knots.append(float(words["K"]))
            if "X" in words:
                points.append([float(words["X"]), float(words["Y"])])
                weights.append(float(words["R"]))
    return np.array(points), np.array(weights), np.array(knots), degree


def by_length(by_parameter):
    """Derivatives by the arc length of a curve with these by its parameter."""
    first, second, third = by_parameter
    pace = np.linalg.norm(first, axis=1)[:, None]
    tangent = first / pace
    pace_slope = (tangent * second).sum(axis=1)[:, None]
    bend = (second - tangent * pace_slope) / pace**2
    pace_curve = ((second * second + first * third).sum(axis=1)[:, None] - pace_slope**2) / pace
    return tangent, bend, (third - 3 * bend * pace * pace_slope - tangent * pace_curve) / pace**3


class NurbsPath:
    def __init__(self, points, weights, knots, degree):
        homogeneous = np.column_stack([points * weights[:, None], weights])
        self._curves = [BSpline(knots, homogeneous, degree)]
        for _ in range(3):
            self._curves.append(self._curves[-1].derivative())
        breaks = np.unique(knots)
        self._table = np.concatenate([np.linspace(a, b, FINE, endpoint=False) for a, b in zip(breaks[:-1], breaks[1:])] + [breaks[-1:]])
        pieces = self._way(self._table[:-1], self._table[1:])
        lengths = np.concatenate([[0], np.cumsum(pieces)])
        self.length = lengths[-1]
        self._parameter = CubicHermiteSpline(lengths, self._table, 1 / np.linalg.norm(self._by_parameter(self._table)[0], axis=1))
        self._lengths = lengths
        self._marks = np.interp(breaks, self._table, lengths)
        self._nearest = cKDTree(self.at(self._table))

    def at(self, parameter):
        value = self._curves[0](parameter)
        return value[..., :-1] / value[..., -1:]

    def points(self, u):
        """Points at arc lengths."""
        return self.at(self._parameter(u))

    def _by_parameter(self, t):
        a, a1, a2, a3 = (c(t) for c in self._curves)
        w, w1, w2, w3 = (v[:, -1:] for v in (a, a1, a2, a3))
        c = a[:, :-1] / w
        first = (a1[:, :-1] - w1 * c) / w
        second = (a2[:, :-1] - 2 * w1 * first - w2 * c) / w
        return first, second, (a3[:, :-1] - 3 * w1 * second - 3 * w2 * first - w3 * c) / w

    def derivatives(self, u):
        """First, second and third derivative by the arc length; each (n, axes)."""
        return by_length(self._by_parameter(self._parameter(np.clip(u, 0, self.length))))

    def places(self, fine, coarse):
        """Places along the path: steps of `fine` radii of curvature, at most `coarse` mm."""
        bend = np.linalg.norm(by_length(self._by_parameter(self._table))[1], axis=1)
        step = np.minimum(coarse, fine / np.maximum(bend, 1e-9))
        for order in (slice(None), slice(None, None, -1)):  # no step much longer than those beside it
            grown = step[order] - GROWTH * np.abs(self._lengths - self._lengths[order][0])[order]
            step[order] = np.minimum.accumulate(grown) + GROWTH * np.abs(self._lengths - self._lengths[order][0])[order]
        return graded_places(self._marks, lambda u: np.interp(u, self._lengths, step))

    def lengths_at(self, points):
        """Arc lengths of points on the curve, in the order in which they are passed."""
        table, low = self.at(self._table), 0
        near = []
        for point in points:
            low += int(((table[low : low + FINE] - point) ** 2).sum(axis=1).argmin())
            near.append(low)
        t = self._foot(points, self._table[near])
        begin = np.clip(np.searchsorted(self._table, t, side="right") - 1, 0, len(self._table) - 2)
        return self._lengths[begin] + self._way(self._table[begin], t)

    def _way(self, begin, end):
        """Arc lengths between parameters."""
        middle, half = (begin + end) / 2, (end - begin) / 2
        return sum(w * half * np.linalg.norm(self._by_parameter(middle + half * x)[0], axis=1) for x, w in zip(*GAUSS))

    def _foot(self, points, t):
        """Parameters of the places nearest to points, from places near them."""
        for _ in range(5):
            first, second, _ = self._by_parameter(t)
            off = self.at(t) - points
            slope = (first * first + off * second).sum(axis=1)
            t = t - (off * first).sum(axis=1) / np.where(slope > 0, slope, np.inf)
            t = np.clip(t, self._table[0], self._table[-1])
        return t

    def distances(self, points):
        """From each point to the curve."""
        best = np.full(len(points), np.inf)
        for near in self._nearest.query(points, k=4)[1].T:  # the curve may come near a point twice
            t = self._foot(points, self._table[near])
            best = np.minimum(best, np.linalg.norm(self.at(t) - points, axis=1))
        return best


class AxesPath:
    """Positions of axes at parameters along a path, as quintic splines of the arc length of its tip."""

    def __init__(self, lengths, positions):
        self.length = lengths[-1]
        spline = make_interp_spline(lengths, positions, k=5)
        self._derivatives = [spline.derivative(k) for k in (1, 2, 3)]

    def derivatives(self, u):
        return tuple(d(np.clip(u, 0, self.length)) for d in self._derivatives)

    def places(self, _, coarse):
        return np.linspace(0, self.length, int(np.ceil(self.length / coarse)) + 1)
