#!/usr/bin/env python3
"""Writes speed_optimum.txt: the shortest times along a path under limits, by a method and a program that are not ours.

Unknown is b = v^2 on a fine grid. Limits of speed and acceleration are linear in b; a limit of the jerk has J / sqrt(b) on
its right side, which is convex: its tangent lies below it, so that each linear program (HiGHS, by scipy.optimize.linprog)
stays inside the limits. The time is linearised too, and steps are held to a trust region, until the time no longer falls.

The path has the curvature k sin^2(2 pi u / L) in the plane of X and Y; tests/simulation/speed_problem_test.cpp says the same.
Needs scipy (Debian: python3-scipy). Takes about a minute.
"""
import numpy as np
from scipy.optimize import linprog
from scipy.sparse import diags, vstack, identity

LENGTH = 12.0  # mm


def path(u, k):
    """Derivatives of the path: x', x'', x''' in X and Y."""
    kappa = k * np.sin(2 * np.pi * u / LENGTH) ** 2
    turn = k * (2 * np.pi / LENGTH) * np.sin(4 * np.pi * u / LENGTH)
    angle = k * (u / 2 - LENGTH / (8 * np.pi) * np.sin(4 * np.pi * u / LENGTH))
    t = np.array([np.cos(angle), np.sin(angle)])
    n = np.array([-np.sin(angle), np.cos(angle)])
    return t, kappa * n, turn * n - kappa**2 * t


def optimum(k, cap, slow_cap, a_path, j_path, a_axis, j_axis, speed, h):
    n = round(LENGTH / h) + 1
    u = np.linspace(0, LENGTH, n)
    slope, bend, twist = path(u, k)
    first = diags([-0.5, 0.5], [-1, 1], shape=(n, n)).tolil() / h
    second = diags([1, -2, 1], [-1, 0, 1], shape=(n, n)).tolil() / h**2
    # b' = 0 at both ends: the point beyond mirrors the one inside.
    first[0, :] = 0
    first[-1, :] = 0
    second[0, 1] *= 2
    second[-1, -2] *= 2
    first, second, one = first.tocsr(), second.tocsr(), identity(n, format="csr")
    linear = [(0.5 * first, a_path)]
    curved = [(0.5 * second, j_path)]
    for axis in range(2):
        linear.append((diags(slope[axis]) @ first * 0.5 + diags(bend[axis]), a_axis))
        if j_axis > 0:
            curved.append((diags(slope[axis]) @ second * 0.5 + 1.5 * diags(bend[axis]) @ first + diags(twist[axis]), j_axis))
    caps = np.where(abs(u - LENGTH / 2) < LENGTH / 12, slow_cap, cap) ** 2.0
    weight = np.full(n, h)
    weight[[0, -1]] = h / 2

    def time(b):
        root = np.sqrt(b)
        return np.sum(2 * h / (root[1:] + root[:-1]))

    b = np.full(n, speed**2.0)
    radius = 0.5
    while radius > 1e-4:
        rows, rights = [], []
        for matrix, limit in linear:
            rows += [matrix, -matrix]
            rights += [np.full(n, limit)] * 2
        for matrix, limit in curved:
            fall = diags(0.5 * limit / b**1.5)
            rows += [matrix + fall, -matrix + fall]
            rights += [1.5 * limit / np.sqrt(b)] * 2
        low, high = b * (1 - radius), np.minimum(b * (1 + radius), caps)
        low[[0, -1]] = high[[0, -1]] = speed**2.0
        found = linprog(-weight / b**1.5, A_ub=vstack(rows), b_ub=np.concatenate(rights),
                        bounds=np.column_stack([np.minimum(low, high), high]), method="highs")
        assert found.status == 0, found.message
        if time(found.x) < time(b) * (1 - 1e-6):
            b = found.x
        else:
            radius /= 2
    return time(b)


CASES = {
    # name: k [1/mm], cap, cap in the middle sixth [mm/s], path: acceleration, jerk; axes: acceleration, jerk (0: none); ends [mm/s]
    "straight": (0.0, 100, 100, 1500, 1e5, 2000, 0, 20),
    "slow_middle": (0.0, 100, 30, 1500, 1e5, 2000, 0, 20),
    "bend_without_axis_jerk": (0.8, 100, 100, 1500, 1e6, 2000, 0, 20),
    "bend": (0.8, 100, 100, 1500, 1e5, 2000, 1e5, 20),
    "narrow_bend": (2.0, 100, 100, 1500, 1e5, 2000, 2e5, 20),
    "bend_with_slow_middle": (0.8, 100, 25, 1500, 1e5, 2000, 1e5, 20),
}

if __name__ == "__main__":
    print("# name k cap slow_cap a_path j_path a_axis j_axis speed | time_at_0.04 time_at_0.02 (speed_optimum.py)")
    for name, case in CASES.items():
        times = [optimum(*case, h) for h in (0.04, 0.02)]
        print(name, *(f"{x:g}" for x in case), "|", *(f"{t:.6f}" for t in times), flush=True)
