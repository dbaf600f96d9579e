"""What the set points of a log say of a run: time, and the worst share of every limit. Knows nothing of the planner.

First, second and third differences of the commanded positions over the period to its first, second and third power; the
direction is that of central differences. A share of 1 is the limit.
"""
import struct

import numpy as np

MAGIC = b"\x89BIIP\r\n\x1a"
TYPES = ["", "<i1", "<u1", "<i2", "<u2", "<i4", "<u4", "<i8", "<u8", "<f4", "<f8"]
STILL = 1e-9  # mm or deg in a period: no movement


def read_log(path):
    """Channels of a BIIP log (docs/formats/biip.md) by name, and the period [s]."""
    with open(path, "rb") as file:
        raw = file.read()
    if raw[:8] != MAGIC:
        raise ValueError(f"{path} is not a BIIP log")
    _, _, header, record, count, _, period, _, _ = struct.unpack_from("<HHIIIQdII", raw, 8)
    channels = {}
    for k in range(count):
        name, _, kind, offset, scale = struct.unpack_from("<24s8sB3xId", raw, 48 + 48 * k)
        place = np.dtype({"names": ["value"], "formats": [TYPES[kind]], "offsets": [offset], "itemsize": record})
        values = np.frombuffer(raw, place, count=(len(raw) - header) // record, offset=header)["value"]
        channels[name.rstrip(b"\0").decode()] = values * scale
    return channels, period


def commanded(path, axes, from_line=0):
    """Commanded positions from the first movement to the last, (n, axes), of the records from a line on; and the period."""
    channels, period = read_log(path)
    positions = np.column_stack([channels["cmd." + axis] for axis in axes])
    # The position before the first record of the line belongs to the movement.
    first = max(np.argmax(channels["line"] >= from_line) - 1, 0) if from_line else 0
    positions = positions[first:]
    moving = np.nonzero(np.abs(np.diff(positions, axis=0)).max(axis=1) > STILL)[0]
    return positions[moving[0] : moving[-1] + 2], period


def differences(positions, period):
    """First to third differences with rests before and after, over the period; and the padded positions."""
    padded = np.vstack([np.repeat(positions[:1], 3, 0), positions, np.repeat(positions[-1:], 3, 0)])
    first = np.diff(padded, axis=0) / period
    second = np.diff(first, axis=0) / period
    return padded, first, second, np.diff(second, axis=0) / period


def axis_shares(positions, period, speeds, accelerations, jerks):
    """The worst shares of the limits of every axis: three lists, of speed, acceleration and jerk."""
    _, *orders = differences(positions, period)
    return [list(np.abs(d).max(axis=0) / np.asarray(l)) for d, l in zip(orders, (speeds, accelerations, jerks))]


def path_shares(positions, period, speed, acceleration, jerk, lengths=None):
    """The worst shares of the limits of a path, and of the same limits for every axis and for vectors.

    tangential: s'' and s''', of the arc lengths where they are known; normal: v² k and v³ k²; vector: the lengths of the second and
    third difference.
    """
    padded, first, second, third = differences(positions, period)
    velocity = (padded[2:] - padded[:-2]) / (2 * period)
    pace = np.linalg.norm(velocity, axis=1)
    still = pace < 1e-6
    direction = np.where(still[:, None], 0, velocity / np.maximum(pace, 1e-12)[:, None])
    along = np.where(still, np.linalg.norm(second, axis=1), (second * direction).sum(axis=1))
    across = np.where(still, 0, np.sqrt(np.maximum((second**2).sum(axis=1) - along**2, 0)))
    change = np.diff(along) / period
    if lengths is not None:
        _, _, second_of_length, third_of_length = differences(lengths[:, None], period)
        along, change = second_of_length[:, 0], third_of_length[:, 0]
    bend_jerk = np.where(still, 0, across**2 / np.maximum(pace, 1e-12))

    def worst(values, limit):
        return float(np.abs(values).max() / limit)

    return {
        "path v": worst(np.linalg.norm(first, axis=1), speed),
        "axis a": worst(second, acceleration),
        "axis j": worst(third, jerk),
        "tangential a": worst(along, acceleration),
        "tangential j": worst(change, jerk),
        "normal a": worst(across, acceleration),
        "normal j": worst(bend_jerk, jerk),
        "vector a": worst(np.linalg.norm(second, axis=1), acceleration),
        "vector j": worst(np.linalg.norm(third, axis=1), jerk),
    }


def distance_from_lines(points, corners):
    """From each point to a polyline."""
    begin, way = corners[:-1], np.diff(corners, axis=0)
    square = (way * way).sum(axis=1)
    distances = np.empty(len(points))
    for first in range(0, len(points), 500):
        from_begin = points[first : first + 500, None, :] - begin[None]
        share = np.clip(np.einsum("ijk,jk->ij", from_begin, way) / square, 0, 1)
        distances[first : first + 500] = np.sqrt(((from_begin - share[..., None] * way) ** 2).sum(axis=2)).min(axis=1)
    return distances


def distance_to_nearest(places, points):
    """From each place to the line of points, which is as dense as set points are: to the two pieces at the nearest point."""
    from scipy.spatial import cKDTree

    moving = np.concatenate([[True], np.linalg.norm(np.diff(points, axis=0), axis=1) > STILL])
    points = points[moving]
    _, nearest = cKDTree(points).query(places)
    distances = np.full(len(places), np.inf)
    for piece in (np.maximum(nearest - 1, 0), np.minimum(nearest, len(points) - 2)):
        way = points[piece + 1] - points[piece]
        share = np.clip(((places - points[piece]) * way).sum(axis=1) / (way * way).sum(axis=1), 0, 1)
        distances = np.minimum(distances, np.linalg.norm(places - points[piece] - share[:, None] * way, axis=1))
    return distances
