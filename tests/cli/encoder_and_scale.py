"""A table that our code did not make: from the motors of a recorded log to a log with encoders and scales.

    encoder_and_scale.py make LOG.biip OUT.csv TRUTH.npy          (Debian: python3-numpy)
    encoder_and_scale.py compare CLSURF PROGRAM OUT.csv TRUTH.npy

`make` takes the feedback positions of the log as those of the motors. Each table follows its motor when the backlash is
crossed, less the pitch error and the growth of the screw. The encoder is recorded two records early. Encoder and scale are rounded to
their steps, the scale after white noise. `compare` exports positions and speeds as a user does, prints their rms errors,
and fails where the fused estimate is not better than the scale alone, the encoder alone and the window, or where three
standard deviations hold less than 99 % of its errors.
"""
import csv
import json
import struct
import subprocess
import sys

import numpy as np

BACKLASH = [0.010, 0.008, 0.004]  # mm
PITCH_ERROR, PITCH = 0.002, 10.0  # mm
GROWTH = 0.0002  # mm/s
ENCODER_STEP, SCALE_STEP, SCALE_NOISE = 1e-4, 1e-3, 2e-4  # mm
LEAD = 2  # records
TYPES = ["i1", "u1", "<i2", "<u2", "<i4", "<u4", "<i8", "<u8", "<f4", "<f8"]


def read_biip(name):
    """Channels of a log by name, and its period (docs/formats/biip.md)."""
    data = open(name, "rb").read()
    header, record, count = struct.unpack_from("<3I", data, 12)
    period = struct.unpack_from("<d", data, 32)[0]
    records = (len(data) - header) // record
    channels = {}
    for k in range(count):
        raw, _, kind, offset, scale = struct.unpack_from("<24s8sB3xId", data, 48 + 48 * k)
        values = np.ndarray(records, TYPES[kind - 1], data, header + offset, (record,))
        channels[raw.rstrip(b"\0").decode()] = values * scale
    return channels, period


def follow(motor, backlash):
    table = np.empty_like(motor)
    here = motor[0]
    for i, m in enumerate(motor):
        here = min(max(here, m - backlash / 2), m + backlash / 2)
        table[i] = here
    return table


def make(log, out, truth):
    channels, period = read_biip(log)
    random = np.random.default_rng(5)
    n = len(channels["fb.x"])
    columns = {name: channels[name] for name in ["cmd.x", "cmd.y", "cmd.z", "line"]}
    scales = {}
    tables = []
    for k, axis in enumerate("xyz"):
        motor = channels["fb." + axis]
        table = follow(motor, BACKLASH[k])
        table = table - PITCH_ERROR * np.sin(2 * np.pi * motor / PITCH) - GROWTH * period * np.arange(n)
        tables.append(table)
        early = motor[np.minimum(np.arange(n) + LEAD, n - 1)]
        columns["fb." + axis] = np.round(early / ENCODER_STEP) * ENCODER_STEP
        scales["act." + axis] = np.round((table + SCALE_NOISE * random.standard_normal(n)) / SCALE_STEP) * SCALE_STEP
    columns.update(scales)
    with open(out, "w") as file:
        file.write("time," + ",".join(columns) + "\n")
        for i in range(n):
            values = [f"{v[i]:.6f}" if name != "line" else str(int(v[i])) for name, v in columns.items()]
            file.write(f"{i * period:.6f}," + ",".join(values) + "\n")
    np.save(truth, np.array(tables))


def export(clsurf, program, log, surface, derivative, columns):
    name = "export.csv"
    subprocess.run(
        [clsurf, "export", program, log, "-o", name, "-q", "--surface", surface, "--derivative", derivative]
        + ["--columns", "point," + ",".join(columns)],
        check=True,
    )
    rows = list(csv.reader(open(name)))[1:]
    values = np.array([[float(x) if x else np.nan for x in row] for row in rows])
    return values[:, 0].astype(int), values[:, 1:]


def rms(x):
    return float(np.sqrt(np.nanmean(x**2)))


def compare(clsurf, program, log, truth):
    tables = np.load(truth)
    rows = list(csv.reader(open(log)))
    period = float(rows[2][0]) - float(rows[1][0])
    scale = np.array([[float(x) for x in row[8:11]] for row in rows[1:]]).T
    speed = np.full(tables.shape[1], np.nan)
    speed[1:-1] = 60 * np.linalg.norm(tables[:, 2:] - tables[:, :-2], axis=0) / (2 * period)
    places = ["x", "y", "z"]
    points, recorded = export(clsurf, program, log, "actual", "savgol", places + ["speed"])
    inside = (points > 30) & (points < tables.shape[1] - 30)
    points, recorded = points[inside], recorded[inside]
    # What the workpiece's zero is, the recorded positions tell.
    offset = np.median(recorded[:, :3] - scale[:, points].T, axis=0)
    position = tables[:, points].T + offset
    errors = {"window": (rms(recorded[:, :3] - position), rms(recorded[:, 3] - speed[points]))}
    sigmas = ["position_uncertainty." + axis for axis in places] + ["speed_uncertainty"]
    columns = ["position." + axis for axis in places] + ["speed"]
    _, fused = export(clsurf, program, log, "actual", "kalman", columns + sigmas)
    fused = fused[inside]
    off, off_speed = fused[:, :3] - position, fused[:, 3] - speed[points]
    errors["fused"] = (rms(off), rms(off_speed))
    covered = np.mean(np.abs(off) <= 3e-3 * fused[:, 4:7]), np.mean(np.abs(off_speed) <= 3 * fused[:, 7])
    _, encoder = export(clsurf, program, log, "feedback", "kalman", columns)
    encoder = encoder[inside]
    errors["encoder"] = (rms(encoder[:, :3] - position), rms(encoder[:, 3] - speed[points]))
    # Without the encoder's columns the log has its scale alone.
    with open("scale.csv", "w") as file:
        for row in rows:
            file.write(",".join(row[:5] + row[8:]) + "\n")
    _, alone = export(clsurf, program, "scale.csv", "actual", "kalman", ["speed"])
    errors["scale"] = (rms(recorded[:, :3] - position), rms(alone[inside][:, 0] - speed[points]))
    for name in ["window", "encoder", "scale", "fused"]:
        print(f"{name:8} position {1e3 * errors[name][0]:7.3f} um, speed {errors[name][1]:7.2f} mm/min")
    print(f"within three deviations: positions {100 * covered[0]:.2f} %, speeds {100 * covered[1]:.2f} %")
    print(json.dumps({"covered": covered, **errors}))
    for name in ["window", "encoder", "scale"]:
        assert errors["fused"][0] < 0.7 * errors[name][0], name
        assert errors["fused"][1] < errors[name][1], name
    assert min(covered) >= 0.99


if __name__ == "__main__":
    {"make": make, "compare": compare}[sys.argv[1]](*sys.argv[2:])
