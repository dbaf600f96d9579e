#!/usr/bin/python3
"""Makes formed_oracle.txt: sections of surfaces that tools leave, from a z-buffer that shares nothing with the product.

    python3 formed_oracle.py > formed_oracle.txt        (numpy; some minutes)

A tool is placed every 10 µm along zigzag passes, and over each place of a section the lowest outline counts. The parts are
planes, ridges, cylinders, valleys, fillets and waves whose design is a formula, so that the true form is known: Ra and Rz
(ISO 4287, Gaussian filter of ISO 16610-21, along the design and not along its plan) of the section and Sa and Sz (ISO
25178-2) about its middle are those of the distance to the design, not to a fit. They are of 1.6 mm along the feed and,
across it, of the whole even number of step-overs next to that; Sa is the mean over windows of this width that begin at
all places of one step-over. In a valley without a fillet the design is what the tool can
reach. With an ERROR, pass k runs sin(2π x / 5 mm + 2 k) times as far above the commanded path.
Lengths in mm, Ra, Rz, Sa, Sz and ERROR in µm, heights of the section in mm. A case is a line
    case NAME KIND RADIUS CORNER PART A B ERROR X0 Y0 X1 Y1 APART RA RZ SA SZ COUNT
with a line of COUNT heights after it. APART [mm] lie the contacts of adjacent passes, seen from above. RA, RZ, SA and SZ are 0 where the design is not known.
"""
import math

import numpy as np

STEP_OVER, PASSES, LENGTH, SPACING = 0.3, 25, 12.0, 0.01


def outline(tool, rho):
    _, radius, corner = tool
    out = np.maximum(rho - (radius - corner), 0)
    return np.where(rho <= radius, corner - np.sqrt(np.maximum(corner**2 - out**2, 0)), np.inf)


def tan(degrees):
    return math.tan(math.radians(degrees))


def plane(tool, across, along):
    """Design and tip of a plane: the tip stands over it by as much as the tool's rim does."""
    _, radius, corner = tool
    slope = math.hypot(tan(across), tan(along))
    rise = (radius - corner) * slope + corner * (math.hypot(1, slope) - 1)
    design = lambda x, y: tan(along) * x + tan(across) * y
    return design, lambda x, y: design(x, y) + rise


def ridge(tool, direction, slope):
    """A roof whose edge runs through (6, 3.6), `direction` degrees from the passes; a ball rolls round the edge."""
    radius = tool[1]
    normal = -math.sin(math.radians(direction)), math.cos(math.radians(direction))
    aside = lambda x, y: abs((x - 6.0) * normal[0] + (y - 3.6) * normal[1])
    design = lambda x, y: -tan(slope) * aside(x, y)

    def tip(x, y):
        d = aside(x, y)
        rolls = np.sqrt(np.maximum(radius**2 - d**2, 0))
        beside = radius / math.cos(math.radians(slope)) - tan(slope) * d
        return np.where(d <= radius * math.sin(math.radians(slope)), rolls, beside) - radius

    return design, tip


def aside(direction):
    """Distance to a line through (6, 3.6), `direction` degrees from the passes."""
    normal = -math.sin(math.radians(direction)), math.cos(math.radians(direction))
    return lambda x, y: (x - 6.0) * normal[0] + (y - 3.6) * normal[1]


def cylinder(tool, direction, rho):
    """A round rod (rho > 0) or a round groove, whose axis runs as the edge of a ridge does."""
    radius, u = tool[1], aside(direction)
    if rho > 0:
        height = lambda r, x, y: np.sqrt(r**2 - u(x, y) ** 2)
        return (lambda x, y: height(rho, x, y) - rho), lambda x, y: height(rho + radius, x, y) - rho - radius
    height = lambda r, x, y: -np.sqrt(r**2 - u(x, y) ** 2)
    return (lambda x, y: height(-rho, x, y) - rho), lambda x, y: height(-rho - radius, x, y) - rho - radius


def fillet(tool, direction, rho, slope=25):
    """Two slopes with a fillet of radius rho, more than the ball's; rho = 0: without, where the ball leaves its own."""
    radius, u = tool[1], aside(direction)
    sine, cosine = math.sin(math.radians(slope)), math.cos(math.radians(slope))
    rho = max(rho, radius)

    def valley(r, x, y):
        """A groove of radius r; that of the ball's centres is the design's, less the ball's radius."""
        off = abs(u(x, y))
        return np.where(off < r * sine, r - np.sqrt(r**2 - np.minimum(off, r * sine) ** 2),
                        off * sine / cosine + r - r / cosine)

    return (lambda x, y: valley(rho, x, y)), (lambda x, y: valley(rho - radius, x, y))


def wave(_, height, length):
    return None, lambda x, y: height * np.sin(x / length) + 0.5 * height * np.cos(y / length)


def cut(tool, tip, x, y, error=0.0):
    """The heights over places."""
    radius = tool[1]
    along = np.arange(0, LENGTH + SPACING / 2, SPACING)
    low = np.full(len(x), np.inf)
    for number in range(PASSES):
        row = number * STEP_OVER
        z = tip(along, np.full_like(along, row)) + error * np.sin(2 * math.pi * along / 5 + 2 * number)
        # The rim of a flat tool is a step: between the positions it moves straight, and is placed every 0.2 µm.
        fine = np.arange(0, LENGTH, SPACING / 50) if tool[2] == 0 else along
        z = np.interp(fine, along, z)
        for k in np.flatnonzero(abs(y - row) < radius):
            near = slice(*np.searchsorted(fine, (x[k] - radius, x[k] + radius)))
            low[k] = min(low[k], np.min(z[near] + outline(tool, np.hypot(fine[near] - x[k], row - y[k]))))
    return low


def arc_length(design, x, y):
    z = design(x, y)
    return np.concatenate([[0], np.cumsum(np.sqrt(np.diff(x) ** 2 + np.diff(y) ** 2 + np.diff(z) ** 2))])


def roughness(deviation, along, cutoff=0.8):
    equal = np.linspace(0, along[-1], len(along))
    deviation, step = np.interp(equal, along, deviation), equal[1]
    a = math.sqrt(math.log(2) / math.pi)
    reach = int(cutoff / step)
    weights = np.exp(-math.pi * (np.arange(-reach, reach + 1) * step / (a * cutoff)) ** 2)
    rough = deviation - np.convolve(deviation, weights, "same") / np.convolve(np.ones_like(deviation), weights, "same")
    lengths = min(5, int(len(rough) * step / cutoff - 1 + 1e-9))
    each = round(cutoff / step)
    first = (len(rough) - lengths * each) // 2
    rough = rough[first:first + lengths * each]
    return np.mean(abs(rough)), np.mean([np.ptp(part) for part in rough.reshape(lengths, each)])


def deviation(design, z, x, y):
    """Distance to the design, along its normal."""
    e = 1e-5
    slope_x = (design(x + e, y) - design(x - e, y)) / (2 * e)
    slope_y = (design(x, y + e) - design(x, y - e)) / (2 * e)
    return (z - design(x, y)) / np.sqrt(1 + slope_x**2 + slope_y**2)


def area(tool, tip, design, middle, error, apart, side=1.6):
    """Sa and Sz about a place; lines across the feed are fine enough for the tips of the cusps."""
    fine = 150
    whole = 2 * max(1, round(side / apart / 2)) * fine  # places across whole step-overs
    weights = np.convolve(np.ones(whole), np.ones(fine))
    weights /= weights.sum()
    across = (np.arange(len(weights)) - (len(weights) - 1) / 2) * apart / fine
    along = np.arange(-side / 2, side / 2, side / 40)
    x, y = (v.ravel() for v in np.meshgrid(along, across))
    x, y = x + middle[0], y + middle[1]
    off = deviation(design, cut(tool, tip, x, y, error), x, y).reshape(len(across), len(along)).T
    mean = np.mean(off @ weights)
    return np.mean(abs(off - mean) @ weights), np.ptp(off[:, abs(across) <= whole / 2 * apart / fine])


def contacts_apart(tool, part, direction, rho):
    """Of adjacent passes, seen from above: a ball on a rod touches nearer to its axis than its centre lies."""
    return STEP_OVER * rho / (rho + tool[1]) if part is cylinder and direction == 0 else STEP_OVER


BALL, BULL, FLAT = ("ball", 3.0, 3.0), ("bull", 3.0, 1.5), ("flat", 3.0, 0.0)
ACROSS = (6.0, 1.2, 6.0, 6.0)
# Sections lie where all of the surface is cut: beyond a slope's first contacts stands the tool's flank.
CASES = [
    ("level", BALL, plane, 0, 0, 0, ACROSS),
    ("across", BALL, plane, 30, 0, 0, (6.0, 2.1, 6.0, 6.9)),
    ("across", BULL, plane, 30, 0, 0, (6.0, 2.7, 6.0, 7.5)),
    ("along", BULL, plane, 0, 30, 0, (8.0, 1.2, 8.0, 6.0)),
    ("oblique", BULL, plane, 20, 20, 0, (8.0, 2.9, 8.0, 7.7)),
    ("across", FLAT, plane, 20, 0, 0, (6.0, 3.5, 6.0, 8.3)),
    ("ridge across the passes", BALL, ridge, 90, 20, 0, (6.3, 1.2, 5.7, 6.0)),
    ("ridge oblique", BALL, ridge, 35, 20, 0, ACROSS),
    ("ridge along the passes", BALL, ridge, 0, 20, 0, ACROSS),
    ("steep ridge along the passes", BALL, ridge, 0, 30, 0, (6.0, 1.6, 6.0, 5.6)),
    ("steep ridge oblique", BALL, ridge, 60, 30, 0, ACROSS),
    ("oblique", BALL, plane, 20, -25, 0, (6.0, 2.4, 6.5, 7.2)),
    ("rod along the passes", BALL, cylinder, 0, 12, 0, ACROSS),
    ("groove along the passes", BALL, cylinder, 0, -12, 0, ACROSS),
    ("fillet oblique", BALL, fillet, 50, 5, 0, ACROSS),
    ("fillet across the passes", BALL, fillet, 90, 4, 0, ACROSS),
    ("sharp valley across the passes", BALL, fillet, 90, 0, 0, ACROSS),
    ("sharp valley oblique", BALL, fillet, 35, 0, 0, ACROSS),
    ("level with error", BALL, plane, 0, 0, 3, ACROSS),
    ("ridge with error", BALL, ridge, 35, 20, 3, ACROSS),
    ("valley with error", BALL, fillet, 60, 0, 3, ACROSS),
    ("wave", BALL, wave, 0.8, 2, 0, (5.0, 1.2, 6.5, 6.0)),
    ("wave", BULL, wave, 0.8, 2, 0, (5.0, 1.2, 6.5, 6.0)),
    ("wave", FLAT, wave, 0.8, 2, 0, (5.0, 1.2, 6.5, 6.0)),
]

for name, tool, part, a, b, error, (x0, y0, x1, y1) in CASES:
    design, tip = part(tool, a, b)
    length = math.hypot(x1 - x0, y1 - y0)
    u = np.linspace(0, 1, round(length / 0.0015) + 1)
    x, y = x0 + u * (x1 - x0), y0 + u * (y1 - y0)
    z = cut(tool, tip, x, y, 1e-3 * error)
    ra = rz = sa = sz = 0.0
    apart = contacts_apart(tool, part, a, b)
    if design:
        ra, rz = roughness(deviation(design, z, x, y), arc_length(design, x, y))
        sa, sz = area(tool, tip, design, ((x0 + x1) / 2, (y0 + y1) / 2), 1e-3 * error, apart)
    few = z[::16]
    print("case", name.replace(" ", "_"), *tool, part.__name__, a, b, error, x0, y0, x1, y1, apart,
          *(f"{1e3 * value:.4f}" for value in (ra, rz, sa, sz)), len(few))
    print(" ".join(f"{value:.6f}" for value in few))
