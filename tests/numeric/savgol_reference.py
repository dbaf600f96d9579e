"""Writes savgol_reference.csv: SciPy's savgol_filter of a made signal, for derivative_test.cpp.

    python3 savgol_reference.py > savgol_reference.csv      (Debian: python3-scipy, here 1.10.1)

One line a filter: window, order, derivative, then its values at every sample. The signal itself is
the line with window 0. The sampling interval is 0.25, so that scaling by it is exact.
"""
import numpy
from scipy.signal import savgol_filter

INTERVAL = 0.25
FILTERS = [(21, 2, 1), (21, 2, 2), (41, 3, 3), (5, 2, 1), (5, 3, 3), (9, 4, 2), (63, 2, 1)]

i = numpy.arange(160)
signal = numpy.sin(0.11 * i) + 0.3 * numpy.cos(0.7 * i + 1) + 0.02 * i + numpy.where(i > 77, 0.5, 0)
signal = numpy.round(signal, 6)  # what a log's quantised positions look like


def write(*columns):
    print(",".join(repr(float(v)) if isinstance(v, float) else str(v) for v in columns))


write(0, 0, 0, *signal.tolist())
for window, order, derivative in FILTERS:
    values = savgol_filter(signal, window, order, deriv=derivative, delta=INTERVAL, mode="interp")
    write(window, order, derivative, *values.tolist())
