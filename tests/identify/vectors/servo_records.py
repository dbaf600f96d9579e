#!/usr/bin/python3
"""Writes servo_records.txt: commanded and fed-back positions of servo loops that are computed here, apart from clsurf.
usage: servo_records.py > servo_records.txt

The controller's output u is held over a period; the velocity loop answers as T_v v' = u - v + w - f sign(v), T_n w' = u - v does
at the period's end (w = 0 without T_n), and the drive moves by that speed over the period. One row a case:
name period Kv c_ff T_v T_n friction backlash dead_periods quantum n, then n commanded positions [10 nm] and n fed-back ones [quantum],
as differences from the one before."""
import numpy as np
import scipy.linalg


def moves(rng, count, period):
    """Trapezoidal moves to random places, some after a pause."""
    x, out = 0.0, []
    while len(out) < count:
        way = rng.uniform(-30, 30)
        a, v = rng.uniform(600, 2500), rng.uniform(20, 160)
        v = min(v, np.sqrt(a * abs(way)))
        t1, t2 = v / a, abs(way) / v
        t = np.arange(1, int((t1 + t2) / period) + 2) * period
        s = np.where(t < t1, a * t * t / 2, np.where(t < t2, v * (t - t1 / 2), abs(way) - a * np.maximum(t1 + t2 - t, 0) ** 2 / 2))
        out += list(x + np.sign(way) * np.minimum(s, abs(way)))
        x = out[-1]
        out += [x] * int(rng.integers(0, 60))
    return np.round(np.array(out[:count]), 5)


def loop(cmd, period, kv, ff, tv, tn, friction, backlash, dead, quantum):
    """The table's positions."""
    n = len(cmd)
    k = int(np.floor(dead))
    share = dead - k
    late = np.concatenate([np.full(k + 1, cmd[0]), cmd])
    c = (1 - share) * late[1:1 + n] + share * late[:n]
    x = v = 0.0
    table = 0.0
    before = 0.0
    out = np.zeros(n)
    keep = np.exp(-period / tv) if tv > 0 else 0.0
    w = 0.0
    if tn > 0:
        # Of v, w, u and the friction's push, the last two constant.
        next_state = scipy.linalg.expm(period * np.array([[-1 / tv, 1 / tv, 1 / tv, -1 / tv], [-1 / tn, 0, 1 / tn, 0],
                                                          [0, 0, 0, 0], [0, 0, 0, 0]]))
    for i in range(n):
        u = kv * (before - x) + ff * (c[i] - before) / period
        if tn > 0:
            push = u + w
            if friction > 0 and v == 0 and abs(push) <= friction:
                w += u * period / tn
            else:
                held = friction * np.sign(v if v != 0 else push)
                new, w = (next_state @ [v, w, u, held])[:2]
                v = 0.0 if friction > 0 and v * new < 0 and abs(u + w) <= friction else new
            new = v
        elif friction > 0:
            sign = np.sign(v) if v != 0 else np.sign(u)
            drive = 0.0 if v == 0 and abs(u) <= friction else u - sign * friction
            new = keep * v + (1 - keep) * drive
            if v * new < 0 and abs(u) <= friction:
                new = 0.0
        else:
            new = keep * v + (1 - keep) * u
        v = new
        x += v * period
        half = backlash / 2
        table = x - half if table < x - half else (x + half if table > x + half else table)
        before = c[i]
        out[i] = np.round(table / quantum) * quantum if quantum > 0 else table
    return out


rng = np.random.default_rng(20261123)
cases = [
    ("plain", 0.001, 92.0, 0.93, 0.0031, 0, 0, 0, 0, 1e-4),
    ("slow", 0.002, 28.0, 0.35, 0.011, 0, 0, 0, 0, 1e-4),
    ("stiff", 0.001, 180.0, 1.0, 0.0012, 0, 0, 0, 0, 1e-5),
    ("friction", 0.001, 75.0, 0.9, 0.0025, 0, 1.8, 0, 0, 1e-4),
    ("backlash", 0.001, 60.0, 0.95, 0.004, 0, 0, 0.012, 0, 1e-4),
    ("dead_time", 0.001, 85.0, 0.97, 0.002, 0, 0, 0, 2.4, 1e-4),
    ("all", 0.001, 66.0, 0.96, 0.0035, 0, 1.2, 0.008, 1.0, 1e-4),
    ("integral", 0.001, 60.0, 0.95, 0.004, 0.01, 0, 0, 0, 1e-4),
    ("swinging_integral", 0.002, 40.0, 0.5, 0.005, 0.006, 0, 0, 0, 1e-4),
    ("integral_and_friction", 0.001, 75.0, 0.9, 0.003, 0.02, 1.5, 0, 0, 1e-4),
    ("integral_and_dead_time", 0.001, 50.0, 1.0, 0.0045, 0.012, 0, 0, 1.5, 1e-5),
]
print("# by servo_records.py")
for name, period, kv, ff, tv, tn, friction, backlash, dead, quantum in cases:
    cmd = moves(rng, 2500, period)
    fb = loop(cmd, period, kv, ff, tv, tn, friction, backlash, dead, quantum)
    a, b = np.round(cmd / 1e-5).astype(int), np.round(fb / quantum).astype(int)
    words = [name, period, kv, ff, tv, tn, friction, backlash, dead, quantum, len(cmd)]
    print(*words, *np.diff(a, prepend=0), *np.diff(b, prepend=0))
