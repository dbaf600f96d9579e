#!/usr/bin/env python3
"""Arcs in corners of a machine whose axes have jerk limits, against a second opinion: corners_test.py CLSURF

Radius, speed and times are computed here from the rule alone (docs/simulate.md, "Speed of arcs"), the shares of the limits from set
points.
"""
import math
import os
import subprocess
import sys
import tempfile
import unittest

import numpy as np

sys.dont_write_bytecode = True
import set_points
from corners import WAYS, Run, machine_text

# data/machines/three_axis_mill.toml, F3000, in mm and s.
TOLERANCE, FEED, ACCELERATION, PATH_JERK, AXIS_JERK, PERIOD = 0.01, 50, 2000, 50000, 80000, 0.001


def ramp_time(change):
    """Of a change of the speed, without acceleration at its ends."""
    if change <= ACCELERATION**2 / PATH_JERK:
        return 2 * math.sqrt(change / PATH_JERK)
    return change / ACCELERATION + ACCELERATION / PATH_JERK


def line_time(length, start, end):
    def way(top):
        return (start + top) / 2 * ramp_time(top - start) + (end + top) / 2 * ramp_time(top - end)

    low, high = max(start, end), FEED
    if way(FEED) <= length:
        low = FEED
    else:
        for _ in range(100):
            middle = (low + high) / 2
            low, high = (middle, high) if way(middle) <= length else (low, middle)
    return ramp_time(low - start) + ramp_time(low - end) + (length - way(low)) / low


def arc(deflection):
    """Radius and tangent length of the arc that leaves the corner by the tolerance."""
    half = deflection / 2
    radius = TOLERANCE * math.cos(half) / (1 - math.cos(half))
    return radius, radius * math.tan(half)


def arc_speed(heading, deflection, step_time):
    """The normal turns from heading + 90° by the deflection. No axis changes its acceleration by more than J t within t: looked for in
    small steps of the angle, for falling speeds."""
    radius, _ = arc(deflection)
    angles = np.linspace(0, deflection, 2001)
    normals = np.column_stack([-np.sin(heading + angles), np.cos(heading + angles)])

    def greatest_change(speed):
        within = min(int(speed * step_time / radius / (angles[1] - angles[0])), len(angles))
        window = np.vstack([np.zeros((within + 1, 2)), normals, np.zeros((within + 1, 2))])
        return max(np.abs(window[shift:] - window[: len(window) - shift]).max() for shift in range(1, within + 1))

    low, high = 0, 1000
    for _ in range(30):
        middle = (low + high) / 2
        holds = middle**2 / radius * greatest_change(middle) <= AXIS_JERK * step_time
        low, high = (middle, high) if holds else (low, middle)
    return low


def time_on_paper(lengths, deflection, speed, step_time):
    """Beside each arc the speed is that of the arc for a period and half the time of the steps."""
    radius, tangent = arc(deflection)
    beside = PERIOD + step_time / 2
    time = (len(lengths) - 1) * radius * deflection / speed
    for k, length in enumerate(lengths):
        start, end = speed if k > 0 else 0, speed if k + 1 < len(lengths) else 0
        arcs = (start > 0) + (end > 0)
        time += arcs * beside + line_time(length - arcs * (tangent + speed * beside), start, end)
    return time


class Arcs(unittest.TestCase):
    def run_on_mill(self, points, step_time):
        with tempfile.TemporaryDirectory() as folder:
            program = os.path.join(folder, "part.nc")
            with open(program, "w", encoding="ascii") as file:
                first, *others = [f"X{x} Y{y}" for x, y in points]
                file.write(f"G21 G90 G64\nG0 {first} Z0\nG1 F3000\n" + "".join(f"{place}\n" for place in others) + "M2\n")
            return Run(CLSURF, program, machine_text("three_axis_mill", ["arc", f"arc_step_time = {step_time}"]), folder)

    def expect(self, run, time):
        self.assertAlmostEqual(run.time, time, delta=PERIOD + 1e-3 * time)
        self.assertLessEqual(max(run.axes), 1.001)
        self.assertAlmostEqual(run.at_corners, 1e3 * TOLERANCE, delta=0.1)

    def test_square(self):
        speed = arc_speed(0, math.pi / 2, PERIOD)
        self.assertAlmostEqual(speed, math.sqrt(AXIS_JERK * arc(math.pi / 2)[0] * PERIOD), delta=1e-5)
        run = self.run_on_mill([(0, 0), (10, 0), (10, 10), (0, 10), (0, 0)], PERIOD)
        self.expect(run, time_on_paper([10] * 4, math.pi / 2, speed, PERIOD))

    def test_zigzag(self):
        """At 45° to the axes the normal turns towards an axis within the period."""
        speed = arc_speed(math.pi / 4, math.pi / 2, PERIOD)
        run = self.run_on_mill([(k, k % 2) for k in range(7)], PERIOD)
        self.expect(run, time_on_paper([math.sqrt(2)] * 6, math.pi / 2, speed, PERIOD))

    def test_hexagon(self):
        speed = min(arc_speed(k * math.pi / 3, math.pi / 3, PERIOD) for k in range(6))
        points = [(8 * math.cos(k * math.pi / 3), 8 * math.sin(k * math.pi / 3)) for k in range(7)]
        run = self.run_on_mill([(round(x, 6), round(y, 6)) for x, y in points], PERIOD)
        self.assertLess(run.time, time_on_paper([8] * 6, math.pi / 3, speed, PERIOD) + PERIOD)
        self.assertLessEqual(max(run.axes), 1.001)

    def test_set_points_lie_on_the_arc(self):
        run = self.run_on_mill([(0, 0), (10, 0), (10, 10)], PERIOD)
        radius, _ = arc(math.pi / 2)
        x, y = run.positions[:, 0] - 10 + radius, run.positions[:, 1] - radius
        inside = (x > 0) & (y < 0)
        self.assertGreater(inside.sum(), 20)
        np.testing.assert_allclose(np.hypot(x, y)[inside], radius, atol=1e-8)

    def test_longer_steps_show_in_set_points(self):
        """What drives spread over five periods, set points have within one: a step of 5 J T shows as 5 times 3/4."""
        run = self.run_on_mill([(0, 0), (10, 0), (10, 10)], 5 * PERIOD)
        self.assertGreater(run.axes[2], 3)
        self.assertLess(run.axes[2], 5)


class Tools(unittest.TestCase):
    def test_machines_can_be_used(self):
        """A key that a way does not use is an error."""
        with tempfile.TemporaryDirectory() as folder:
            for machine, ways in WAYS.items():
                for name, way in ways.items():
                    with self.subTest(machine=machine, way=name):
                        path = os.path.join(folder, "machine.toml")
                        with open(path, "w", encoding="utf-8") as file:
                            file.write(machine_text(machine, way))
                        answer = subprocess.run([CLSURF, "machine", path], capture_output=True, text=True)
                        self.assertEqual(answer.returncode, 0, answer.stderr)

    def test_distance_to_nearest(self):
        points = np.array([[0, 0, 0], [1, 0, 0], [1, 0, 0], [2, 1, 0]], float)
        places = np.array([[0.5, 0.25, 0], [2, 0, 0], [3, 1, 0]], float)
        np.testing.assert_allclose(set_points.distance_to_nearest(places, points), [0.25, math.sqrt(0.5), 1])


if __name__ == "__main__":
    CLSURF = os.path.abspath(sys.argv.pop(1))
    unittest.main()
