#!/usr/bin/env python3
"""The tools of docs/experiments/published.md against answers from paper, and one short curve of the page: published_test.py CLSURF"""
import os
import sys
import tempfile
import unittest

import numpy as np

sys.dont_write_bytecode = True
import set_points
from nurbs_path import NurbsPath
from optimum import Limits, optimum
from published import Run
from rounded_path import RoundedPath
from standard_curves import read_curves

KNOTS = np.array([0, 0, 0, 0, 1, 1, 1, 1], float)


def straight(length):
    points = np.column_stack([np.linspace(0, length, 4), np.zeros(4)])
    return NurbsPath(points, np.ones(4), KNOTS, 3)


def quarter_circle(radius):
    """Of degree 3: the quadratic (1, 1/sqrt 2, 1) with its degree raised."""
    w = np.sqrt(0.5)
    weights = np.array([1, (1 + 2 * w) / 3, (1 + 2 * w) / 3, 1])
    points = np.array([[1, 0], [1, 2 * w / 3 / weights[1]], [2 * w / 3 / weights[1], 1], [0, 1]]) * radius
    return NurbsPath(points, weights, KNOTS, 3)


class Tools(unittest.TestCase):
    def test_shares_of_a_circle(self):
        """Uniform motion: normal v²/r and v³/r²."""
        radius, speed, period = 10, 50, 0.001
        angle = speed * period / radius * np.arange(2000)
        positions = radius * np.column_stack([np.cos(angle), np.sin(angle)])
        _, first, second, third = set_points.differences(positions, period)
        inner = slice(10, -10)
        self.assertAlmostEqual(np.linalg.norm(first, axis=1)[inner].max(), 50, delta=1e-3)
        self.assertAlmostEqual(np.linalg.norm(second, axis=1)[inner].max(), 250, delta=1e-2)
        self.assertAlmostEqual(np.linalg.norm(third, axis=1)[inner].max(), 1250, delta=1e-1)

    def test_shares_of_four_phases(self):
        """From rest to rest along (0.6, 0.8), jerk 60000 for 40 periods, its negative for 80, itself for 40."""
        jerk, period, count = 60000, 0.0005, 40
        third = jerk * np.repeat([1, -1, -1, 1], count)
        way = np.append(0, np.cumsum(np.cumsum(np.cumsum(third)))) * period**3
        positions = np.column_stack([0.6 * way, 0.8 * way])
        shares = set_points.path_shares(positions, period, 100, 3000, jerk)
        acceleration = jerk * count * period
        self.assertAlmostEqual(shares["tangential j"], 1, places=6)
        self.assertAlmostEqual(shares["vector j"], 1, places=6)
        self.assertAlmostEqual(shares["axis j"], 0.8, places=6)
        self.assertAlmostEqual(shares["tangential a"], acceleration / 3000, places=6)
        self.assertAlmostEqual(shares["path v"], acceleration * count * period / 100, places=6)
        self.assertLess(shares["normal j"], 1e-6)

    def test_nurbs_is_a_circle(self):
        circle = quarter_circle(5.0)
        self.assertAlmostEqual(circle.length, 2.5 * np.pi, places=9)
        u = np.linspace(0.1, circle.length - 0.1, 50)
        first, second, third = circle.derivatives(u)
        np.testing.assert_allclose(np.linalg.norm(first, axis=1), 1, atol=1e-9)
        np.testing.assert_allclose(np.linalg.norm(second, axis=1), 1 / 5, atol=1e-8)
        np.testing.assert_allclose(third, -first / 25, atol=1e-6)
        points = np.array([[3.0, 4.0], [3.3, 4.4]])
        np.testing.assert_allclose(circle.distances(points), [0, 0.5], atol=1e-9)
        np.testing.assert_allclose(circle.lengths_at(points[:1]), 5 * np.arctan2(4, 3), atol=1e-9)

    def test_rounded_path_leaves_a_corner_by_the_tolerance(self):
        path = RoundedPath([[0, 0], [20, 0], [20, 20]], 0.05)
        u = np.array([20.0])
        self.assertAlmostEqual(np.linalg.norm(path.points(u) - [20, 0]), 0.05, places=12)
        step = 1e-4
        around = np.array([19.9, 19.9 + step, 19.9 + 2 * step])
        slope = np.diff(path.points(around), axis=0) / step
        np.testing.assert_allclose(slope.mean(axis=0), path.derivatives(around)[0][1], atol=1e-6)

    def test_optimum_of_a_line(self):
        """Four phases of jerk where neither speed nor acceleration is reached: 4 (L/2j)^(1/3)."""
        time, _, _ = optimum(straight(2.0), Limits(1000, 3000, 3000, 60000), 0.05, 0.01)
        self.assertAlmostEqual(time, 4 * np.cbrt(2 / (2 * 60000)), delta=2e-4)

    def test_optimum_of_a_long_line(self):
        """Seven phases: L/v + v/a + a/j. Steps of 0.05 mm are 0.15 % short."""
        time, _, _ = optimum(straight(60.0), Limits(300, 3000, 3000, 60000), 0.05, 0.05)
        self.assertAlmostEqual(time, 60 / 300 + 300 / 3000 + 3000 / 60000, delta=7e-4)


class ShortCurve(unittest.TestCase):
    def test_trident(self):
        curve = read_curves(None)["trident"]
        with tempfile.TemporaryDirectory() as folder:
            run = Run(curve, "axes", os.environ["CLSURF"], folder)
        best, _, _ = optimum(curve.path("axes"), curve.limits("axes"), 0.1, 0.3)
        self.assertLess(run.off_path, 0.01)
        self.assertGreater(run.time, best)
        self.assertLess(run.time, 1.015 * best)
        limits = curve.speed, curve.acceleration, curve.jerk
        shares = set_points.path_shares(run.positions, run.period, *limits, curve.lengths(run.positions))
        for name in ("path v", "axis a", "axis j", "tangential a", "tangential j", "normal a"):
            self.assertLessEqual(shares[name], 1.0005, name)


if __name__ == "__main__":
    os.environ["CLSURF"] = sys.argv.pop(1)
    unittest.main()
