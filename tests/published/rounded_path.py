"""The path that `corner = "spline"` makes of a polyline (docs/simulate.md), with its derivatives.

Each corner adds t ((w - |d|)^3 - (c - |d|)^3) / (6 (w^2 - c^2)) to the polyline, each cube where it is positive; t is the jump of
the direction, d the way from the corner, w the width of its rounding, and c = `top` w (0.5 where only the path limits the jerk,
otherwise 0). Widths: alone with its neighbours as wide as itself, a rounding leaves the corner by the tolerance;
then the deviations of all that overlap are summed, and each width is scaled by the worst excess that it reaches.
"""
import numpy as np

from places import graded_places

REACH = 20  # corners to each side that a rounding may cross
GROWTH = 0.08  # of the step of places, a mm away from a rounding


class RoundedPath:
    def __init__(self, points, tolerance, top=0.0):
        self.corner_points = np.asarray(points, float)
        steps = np.diff(self.corner_points, axis=0)
        lengths = np.linalg.norm(steps, axis=1)
        self.directions = steps / lengths[:, None]
        self.corners = np.cumsum(lengths)[:-1]
        self.length = lengths.sum()
        self.turns = np.diff(self.directions, axis=0)
        self.top = top
        self.widths = self._widths(tolerance)

    def _near(self, i):
        return slice(max(0, i - REACH), min(len(self.corners), i + REACH + 1))

    def _hump(self, width, distance):
        top = self.top * width
        cubes = np.maximum(width - distance, 0) ** 3 - np.maximum(top - distance, 0) ** 3
        return cubes / (6 * (width**2 - top**2))

    def _widest(self, i, tolerance, turn):
        """With its neighbours as wide as itself, its deviation is the tolerance; inside the path; over REACH corners at most."""
        at, top = self.corners, self.top
        width = min(at[i], self.length - at[i], 6 * tolerance / turn[i] * (1 + top) / (1 + top + top**2))
        if i >= REACH:
            width = min(width, at[i] - at[i - REACH])
        if i + REACH < len(at):
            width = min(width, at[i + REACH] - at[i])
        near = self._near(i)

        def excess(w):
            return (turn[near] * self._hump(w, np.abs(at[near] - at[i]))).sum() - tolerance

        if excess(width) <= 0:
            return width
        low, high = 0.0, width
        for _ in range(60):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if excess(middle) <= 0 else (low, middle)
        return low

    def _widths(self, tolerance):
        at, turn = self.corners, np.linalg.norm(self.turns, axis=1)
        widest = np.array([self._widest(i, tolerance, turn) for i in range(len(at))])
        humps = [turn[self._near(i)] * self._hump(widest[self._near(i)], np.abs(at[self._near(i)] - at[i])) for i in range(len(at))]
        deviation = np.array([h.sum() for h in humps])
        widths = widest.copy()
        for i in range(len(at)):
            near = self._near(i)
            reached = deviation[near][(np.abs(at[near] - at[i]) < widest[i])]
            widths[i] *= min(1.0, tolerance / reached.max())
        return widths

    def _sum(self, u, terms):
        """Sums terms(side, left) of the cubes that reach each place, for each part of a corner's cube."""
        for at, turn, width in zip(self.corners, self.turns, self.widths):
            top = self.top * width
            share = turn / (6 * (width**2 - top**2))
            low, high = np.searchsorted(u, [at - width, at + width])
            d = u[low:high] - at
            side = np.where(d >= 0, 1.0, -1.0)
            for reach, sign in ((width, 1.0), (top, -1.0)):
                terms(slice(low, high), side, np.maximum(reach - np.abs(d), 0)[:, None], sign * share)

    def points(self, u):
        """Points at rising arc lengths of the polyline."""
        ends = np.concatenate([[0], self.corners, [self.length]])
        sums = np.column_stack([np.interp(u, ends, column) for column in self.corner_points.T])

        def add(where, side, left, share):
            sums[where] += left**3 * share

        self._sum(u, add)
        return sums

    def derivatives(self, u):
        """First, second and third derivative at rising arc lengths of the polyline; each (n, axes)."""
        first = self.directions[np.searchsorted(self.corners, u, side="right")].copy()
        second, third = np.zeros_like(first), np.zeros_like(first)

        def add(where, side, left, share):
            first[where] -= 3 * side[:, None] * left**2 * share
            second[where] += 6 * left * share
            third[where] -= 6 * side[:, None] * (left > 0) * share

        self._sum(u, add)
        return first, second, third

    def places(self, fine, coarse):
        """Places along the path, dense where it is rounded: steps of `fine` widths there, at most `coarse` mm elsewhere."""
        ends = [self.corners + side * part * self.widths for side in (-1, 1) for part in (1, self.top, 0)]
        marks = np.unique(np.round(np.clip(np.concatenate([[0, self.length], *ends]), 0, self.length), 7))

        def step(u):
            away = np.abs(u[:, None] - self.corners) - self.widths
            # Roundings overlap: the narrowest of them counts.
            return np.minimum(coarse, np.maximum(fine * self.widths, GROWTH * away).min(axis=1))

        return graded_places(np.append(marks[marks < self.length], self.length), step)
