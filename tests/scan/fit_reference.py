"""Writes vectors/joined_fits.txt: least squares with constraints by NumPy, for windowed_fit_test.cpp.

    python3 fit_reference.py > vectors/joined_fits.txt      (Debian: python3-numpy, here 1.24.2)

Fits of degree d with continuous value and slope are computed in powers of u of each window, with both conditions as
equations between the windows: the solution lies in their null space. Blended fits are numpy.polyfit of each window, mixed
by 3 q² − 2 q³. Neither has anything of the Bernstein forms that the product computes with.
"""
import numpy

rng = numpy.random.default_rng(7)
x = 2000 + numpy.cumsum(rng.uniform(0.4, 1.6, 83))
z = numpy.round(5 * numpy.sin((x - 2000) / 9) + 0.05 * rng.standard_normal(x.size), 6)
x = numpy.round(x, 6)
places = numpy.linspace(x[0], x[-1], 41)


def row(name, values):
    print(name, *(repr(float(v)) for v in values))


def null_space(matrix):
    _, s, v = numpy.linalg.svd(matrix)
    return v[(s > 1e-12 * s[0]).sum():].T


def continuous(degree, window):
    starts = [s for s in range(0, x.size, window)]
    if x.size - starts[-1] < degree + 1:
        starts.pop()
    breaks = numpy.append(x[starts], x[-1])
    pieces, n = len(starts), degree + 1

    def powers(k, at, derivative=0):
        centre, half = (breaks[k] + breaks[k + 1]) / 2, (breaks[k + 1] - breaks[k]) / 2
        u = (at - centre) / half
        line = numpy.zeros(pieces * n)
        for p in range(n):
            line[k * n + p] = u**p if derivative == 0 else (p * u ** (p - 1) / half if p else 0)
        return line

    def piece(at):
        return min(max(numpy.searchsorted(breaks, at, side="right") - 1, 0), pieces - 1)

    conditions = [powers(k, breaks[k + 1], d) - powers(k + 1, breaks[k + 1], d) for k in range(pieces - 1) for d in (0, 1)]
    basis = null_space(numpy.array(conditions))
    design = numpy.array([powers(piece(at), at) for at in x])
    found = basis @ numpy.linalg.lstsq(design @ basis, z, rcond=None)[0]
    return [powers(piece(at), at) @ found for at in places]


def blended(degree, window):
    firsts = list(range(0, x.size - window, window // 2)) + [x.size - window]
    fits = []
    for f in firsts:
        a, b = x[f], x[f + window - 1]
        u = lambda at, a=a, b=b: (2 * at - a - b) / (b - a)
        fits.append((a, b, u, numpy.polyfit(u(x[f:f + window]), z[f:f + window], degree)))
    values = []
    for at in places:
        value = numpy.polyval(fits[0][3], fits[0][2](at))
        before = fits[0][1]
        begin_before = x[0]
        for k in range(1, len(fits)):
            begin, end = max(fits[k][0], begin_before), before
            q = min(max((at - begin) / (end - begin), 0), 1)
            weight = 3 * q**2 - 2 * q**3
            if q > 0:
                value = (1 - weight) * numpy.polyval(fits[k - 1][3], fits[k - 1][2](at)) + weight * numpy.polyval(
                    fits[k][3], fits[k][2](at))
            begin_before, before = end, fits[k][1]
        values.append(value)
    return values


row("x", x)
row("z", z)
row("places", places)
for degree, window in ((2, 8), (3, 10), (5, 16), (9, 27)):
    row(f"c1_{degree}_{window}", continuous(degree, window))
for degree, window in ((1, 6), (3, 10), (5, 13)):
    row(f"blend_{degree}_{window}", blended(degree, window))
