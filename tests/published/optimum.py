"""The shortest time along a path under limits of speed, acceleration and jerk: a second opinion on the planner, by a method
and a program that are not ours.

Unknown is b = v^2 at places of the path, v the speed along its parameter. Limits of speed and acceleration are linear in b; a limit
of the jerk has J / sqrt(b) on its right side, which is convex: its tangent lies below it, so that each linear program (HiGHS, by
scipy.optimize.linprog) stays inside the limits. The time is linearised too, and steps are held to a trust region, until the time
no longer falls. Next to a rest b is no polynomial: there the jerk is constant over a piece of at most REST_WAY.
"""
from dataclasses import dataclass

import numpy as np
from scipy.optimize import linprog
from scipy.sparse import csr_matrix, diags, vstack

REST_SHARE = 0.2  # of the time in which the jerk reaches the acceleration: the longest piece next to a rest
REST_WAY = 0.02  # mm
MOST_PROGRAMS = 60
SOFT_PROGRAMS = 8  # whose limits give way by the same part, at a high cost: the first speeds break them
LEAST_GAIN = 1e-4


@dataclass
class Limits:
    """Of the path, and one of each axis, or none: mm (or deg), s."""

    speed: float = np.inf
    acceleration: float = np.inf  # tangential
    normal_acceleration: float = np.inf
    jerk: float = np.inf  # tangential
    bend_jerk: float = np.inf  # v^3 k^2
    axis_speeds: tuple = ()
    axis_accelerations: tuple = ()
    axis_jerks: tuple = ()


def differences(u):
    """First and second derivative at the inner places, as matrices."""
    before, after = np.diff(u)[:-1], np.diff(u)[1:]
    inner = np.arange(1, len(u) - 1)
    rows = np.tile(np.arange(len(inner)), 3)
    columns = np.concatenate([inner - 1, inner, inner + 1])
    both = before + after
    first = np.concatenate([-after / (before * both), (after - before) / (before * after), before / (after * both)])
    second = np.concatenate([2 / (before * both), -2 / (before * after), 2 / (after * both)])
    shape = (len(inner), len(u))
    return csr_matrix((first, (rows, columns)), shape=shape), csr_matrix((second, (rows, columns)), shape=shape)


def along(slope, of_path, of_axes):
    """The greatest value along a straight line in which axes have these shares."""
    pace = np.linalg.norm(slope)
    return min([of_path / pace] + [limit / abs(part) for part, limit in zip(slope, of_axes) if part != 0])


def square_from_rest(way, jerk):
    return (0.5 * jerk * np.cbrt(6 * way / jerk) ** 2) ** 2


def with_rests(places, length, near, far):
    """The places, but next to the ends finer and finer, from `near` after the begin to `far` before the end."""

    def graded(shortest, longest):
        ways = [shortest]
        while ways[-1] < longest:
            ways.append(ways[-1] * 1.12)
        ways = np.array(ways)
        return shortest + (ways - shortest) * (longest - shortest) / max(ways[-1] - shortest, 1e-12)

    inner = places[(places > 1.5 * near) & (places < length - 1.5 * far)]
    lead = graded(near, inner[0])[:-1]
    tail = (length - graded(far, length - inner[-1])[:-1])[::-1]
    return np.concatenate([lead, inner, tail])


def rows_of(path, u, limits):
    """Linear and jerk-limited rows at the inner places, over their limits, and the caps of b at all places."""
    slope, bend, _ = path.derivatives(u)
    first, second = differences(u)
    inner = slice(1, len(u) - 1)
    one = csr_matrix((np.ones(len(u) - 2), (np.arange(len(u) - 2), np.arange(1, len(u) - 1))), shape=first.shape)
    pace = np.linalg.norm(slope, axis=1)
    pace_slope = (slope * bend).sum(1) / pace
    across = np.maximum(np.sqrt(np.maximum((bend * bend).sum(1) - pace_slope**2, 0)), 1e-12)
    caps = np.minimum((limits.speed / pace) ** 2, limits.normal_acceleration / across)
    caps = np.minimum(caps, (limits.bend_jerk * pace / across**2) ** (2 / 3))
    for k, speed in enumerate(limits.axis_speeds):
        caps = np.minimum(caps, (speed / np.maximum(np.abs(slope[:, k]), 1e-12)) ** 2)

    def accelerating(s, b, limit):
        return (diags(s[inner]) @ first * 0.5 + diags(b[inner]) @ one) / limit

    def jerking(s, b, t, limit):
        return (diags(s[inner]) @ second * 0.5 + diags(1.5 * b[inner]) @ first + diags(t[inner]) @ one) / limit

    linear, curved = [], []
    if np.isfinite(limits.acceleration):
        linear.append(accelerating(pace, pace_slope, limits.acceleration))
    linear += [accelerating(slope[:, k], bend[:, k], limit) for k, limit in enumerate(limits.axis_accelerations)]
    for side in (-1e-9, 1e-9):  # third derivatives jump: both count
        twist = path.derivatives(u + side)[2]
        if np.isfinite(limits.jerk):
            pace_curve = (across**2 + (slope * twist).sum(1)) / pace
            curved.append(jerking(pace, pace_slope, pace_curve, limits.jerk))
        curved += [jerking(slope[:, k], bend[:, k], twist[:, k], limit) for k, limit in enumerate(limits.axis_jerks)]
    return linear, curved, caps


def linear_program(b, linear, curved, cost, bounds, soft):
    """The next squares over the present ones, and by how much limits are broken."""
    inside = b[1:-1]
    rows, rights = [], []
    for matrix in linear:
        rows += [matrix, -matrix]
        rights += [np.ones(len(inside))] * 2
    root = np.sqrt(inside)
    fall = csr_matrix((0.5 / inside, (np.arange(len(inside)), np.arange(1, len(b) - 1))), shape=(len(inside), len(b)))
    for matrix in curved:
        part = diags(root) @ matrix
        rows += [part + fall, fall - part]
        rights += [np.full(len(inside), 1.5)] * 2
    table = vstack(rows).tocsr() @ diags(b)
    if soft:
        table = vstack([table.T, csr_matrix(-np.ones((1, table.shape[0])))]).T.tocsr()
        cost, bounds = np.append(cost, soft), np.vstack([bounds, [0, np.inf]])
    found = linprog(cost, A_ub=table, b_ub=np.concatenate(rights), bounds=bounds, method="highs-ipm")
    if found.status != 0:
        raise RuntimeError(found.message)
    return found.x[: len(b)], found.x[-1] if soft else 0.0


def optimum(path, limits, fine=0.1, coarse=0.3, report=None):
    """The shortest time from rest to rest [s], and v² at its places. `path`: see nurbs_path.py. Steps of `fine` widths of a bend, and of `coarse` mm."""
    ends = path.derivatives(np.array([0.0, path.length]))[0]
    jerks = [along(slope, limits.jerk, limits.axis_jerks) for slope in ends]
    accelerations = [along(slope, limits.acceleration, limits.axis_accelerations) for slope in ends]
    rest_times = [min(REST_SHARE * a / j, np.cbrt(6 * REST_WAY / j)) for a, j in zip(accelerations, jerks)]
    near, far = (j * t**3 / 6 for j, t in zip(jerks, rest_times))
    u = with_rests(path.places(fine, coarse), path.length, near, far)
    steps = np.diff(u)
    linear, curved, caps = rows_of(path, u, limits)
    rests = square_from_rest(u, jerks[0]), square_from_rest(path.length - u, jerks[1])
    b = 1 / (1 / rests[0] + 1 / rests[1] + 1 / (0.05 * caps))
    pinned = {0: rests[0][0], 1: rests[0][1], len(u) - 2: rests[1][-2], len(u) - 1: rests[1][-1]}
    for place, square in pinned.items():
        b[place] = square
    weight = np.concatenate([[steps[0] / 2], (steps[1:] + steps[:-1]) / 2, [steps[-1] / 2]])

    def time(square):
        root = np.sqrt(square)
        return np.sum(2 * steps / (root[1:] + root[:-1])) + sum(rest_times)

    best, radius = time(b), 1.0
    for count in range(MOST_PROGRAMS):
        low = np.minimum(1 / (1 + 2 * radius), caps / b)
        high = np.minimum(1 + (4 if count < 5 else 1) * radius, caps / b)
        for place, square in pinned.items():
            low[place] = high[place] = square / b[place]
        soft = 1e3 * time(b) if count < SOFT_PROGRAMS else 0
        factors, broken = linear_program(b, linear, curved, -0.5 * weight / np.sqrt(b), np.column_stack([low, high]), soft)
        new = b * factors
        if report:
            report(f"{count}: {time(new):.5f} s, limits broken by {broken:.2g}, {len(u)} places")
        if broken > 1e-6:
            b, best = new, np.inf
            continue
        gain = 1 - time(new) / best
        if gain > LEAST_GAIN / 10:
            b, best = new, time(new)
            if gain < LEAST_GAIN and radius < 0.2:
                break
        else:
            radius /= 3
            if radius < 0.01:
                break
    return best, u, b
