#!/usr/bin/python3
"""Replaces the fed-back positions of a log by those of drives that are computed here, apart from clsurf: a position controller
that samples once a period around a velocity loop with a PI controller, integrated in steps that are much shorter.
usage: pi_drive.py RUN.csv DRIVEN.csv

RUN.csv: `clsurf export PROGRAM LOG -o RUN.csv --columns time,line,cmd.x,cmd.y,cmd.z`. Prints nothing."""
import csv
import sys

# position gain [1/s], velocity feed-forward, time constant and integral time of the velocity loop [s]
DRIVES = {"x": (60.0, 0.95, 0.004, 0.010), "y": (60.0, 0.95, 0.005, 0.012), "z": (50.0, 0.90, 1 / 150, 0.015)}
STEPS = 20  # in a period


def followed(commanded, period, gain, feedforward, time_constant, integral_time):
    """The positions that a drive reaches, in mm."""
    step = period / STEPS
    position, speed, integral = commanded[0], 0.0, 0.0
    positions = [position]
    for before, now in zip(commanded, commanded[1:]):
        reference = gain * (before - position) + feedforward * (now - before) / period
        for _ in range(STEPS):
            error = reference - speed
            integral += error * step / integral_time
            speed += (error + integral) * step / time_constant
            position += speed * step
        positions.append(position)
    return positions


def main(run, driven):
    with open(run, newline="") as file:
        header, *rows = csv.reader(file)
    columns = {name.split(" ")[0]: [row[k] for row in rows] for k, name in enumerate(header)}
    times = [float(time) for time in columns["time"]]
    period = (times[-1] - times[0]) / (len(times) - 1)
    for axis, drive in DRIVES.items():
        positions = followed([float(value) for value in columns["cmd." + axis]], period, *drive)
        columns["fb." + axis] = [f"{position:.9f}" for position in positions]
    with open(driven, "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(columns)
        writer.writerows(zip(*columns.values()))


if __name__ == "__main__":
    main(*sys.argv[1:])
