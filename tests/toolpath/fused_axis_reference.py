"""Writes vectors/fused_axis.csv: an axis fused by batch least squares, for encoder_and_scale_test.cpp.

    python3 fused_axis_reference.py > vectors/fused_axis.csv   (Debian: python3-scipy, here 1.10.1)

The scale measures s = p + n_s, the encoder e = p + b + n_e. p and b have white snap of known density. All measurements and
all steps are one weighted least-squares problem, solved at once by SciPy's QR: no recursion in it. Three of them are solved:

    b from d = e - s alone,
    p from the fused position s + w (d - b), w = s^2 / (s^2 + e^2) of the noises,
    p and b jointly from s and e, which is the best that there is.

First line: period [s], standard deviations of scale and encoder [mm], wandering of p in units of the fused noise, of b in units of
the difference's noise (src/numeric/kalman_smoother.h). Then one line a record: scale, encoder; b and its three
derivatives; fused; p and its derivatives; the same jointly; their standard deviations in the joint solution [mm/s^d].
"""
import math

import numpy
from scipy.linalg import cholesky, qr, solve_triangular

N = 120
PERIOD = 0.001
SCALE, ENCODER = 3e-4, 6e-5
WANDERING_P, WANDERING_B = 1e-3, 1e-7
# Nothing is known of the first state: far more than machines do [mm/s^d], in units of noise and period (SmootherModel).
GREATEST = [0.0, 2e4, 1e6, 1e9]
LEAST, MOST = 1e3, 1e6

FACTORIAL = [1, 1, 2, 6]
TRANSITION = numpy.array([[1 / FACTORIAL[j - i] if j >= i else 0.0 for j in range(4)] for i in range(4)])
SNAP = numpy.array([[1 / (FACTORIAL[3 - i] * FACTORIAL[3 - j] * (7 - i - j)) for j in range(4)] for i in range(4)])


def unit(sigma):
    return numpy.array([sigma / PERIOD**d for d in range(4)])


def motion_rows(first, wandering, sigma, columns):
    """Rows, whitened, of the start and the steps of a motion whose states begin at column `first`."""
    start = numpy.clip(numpy.array(GREATEST) / unit(sigma), LEAST, MOST)
    whiten = solve_triangular(cholesky(wandering * SNAP, lower=True), numpy.eye(4), lower=True)
    rows = numpy.zeros((4 * N, columns))
    rows[:4, first : first + 4] = numpy.diag(1 / start)
    for i in range(1, N):
        at = first + 4 * i
        rows[4 * i : 4 * i + 4, at : at + 4] = whiten
        rows[4 * i : 4 * i + 4, at - 4 : at] = -whiten @ TRANSITION
    return rows


def solve(rows, right):
    q, r = qr(rows, mode="economic")
    inverse = solve_triangular(r, numpy.eye(r.shape[0]))
    return solve_triangular(r, q.T @ right), numpy.sqrt((inverse**2).sum(axis=1))


def smooth(values, sigma, wandering):
    """States of one motion from its positions, [mm/s^d] by record."""
    rows = numpy.zeros((N, 4 * N))
    rows[numpy.arange(N), 4 * numpy.arange(N)] = 1
    right = numpy.concatenate([(values - values[0]) / sigma, numpy.zeros(4 * N)])
    solution, _ = solve(numpy.vstack([rows, motion_rows(0, wandering, sigma, 4 * N)]), right)
    states = solution.reshape(N, 4) * unit(sigma)
    states[:, 0] += values[0]
    return states


def jointly(scale, encoder, noise_p, noise_b):
    """The same of p, with its standard deviations, from both channels at once. States of p, then of b."""
    columns = 8 * N
    rows = numpy.zeros((2 * N, columns))
    i = numpy.arange(N)
    rows[i, 4 * i] = noise_p / SCALE
    rows[N + i, 4 * i] = noise_p / ENCODER
    rows[N + i, 4 * N + 4 * i] = noise_b / ENCODER
    right = numpy.concatenate([(scale - scale[0]) / SCALE, (encoder - scale[0]) / ENCODER, numpy.zeros(8 * N)])
    motions = [motion_rows(0, WANDERING_P, noise_p, columns), motion_rows(4 * N, WANDERING_B, noise_b, columns)]
    solution, sigmas = solve(numpy.vstack([rows, *motions]), right)
    states = solution[: 4 * N].reshape(N, 4) * unit(noise_p)
    states[:, 0] += scale[0]
    return states, sigmas[: 4 * N].reshape(N, 4) * unit(noise_p)


random = numpy.random.default_rng(11)
t = PERIOD * numpy.arange(N)
table = 3 + 40 * t + 300 * t**2 - 0.4 * numpy.cos(60 * t)
difference = 0.005 + 0.002 * numpy.sin(2 * math.pi * 5 * t)
scale = table + SCALE * random.standard_normal(N)
encoder = table + difference + ENCODER * random.standard_normal(N)
noise_b = math.hypot(SCALE, ENCODER)
noise_p = SCALE * ENCODER / noise_b
weight = (SCALE / noise_b) ** 2
b = smooth(encoder - scale, noise_b, WANDERING_B)
fused = scale + weight * (encoder - scale - b[:, 0])
p = smooth(fused, noise_p, WANDERING_P)
joint, sigmas = jointly(scale, encoder, noise_p, noise_b)
print(",".join(repr(float(x)) for x in [PERIOD, SCALE, ENCODER, WANDERING_P, WANDERING_B]))
for k in range(N):
    values = [scale[k], encoder[k], *b[k], fused[k], *p[k], *joint[k], *sigmas[k]]
    print(",".join(f"{float(x):.15g}" for x in values))
