#!/usr/bin/env python3
"""Writes optima.json: the shortest times of the curves of curves.toml under each reading of their limits (optimum.py), which no run of
ours has a part in.

    OMP_NUM_THREADS=1 /usr/bin/python3 tests/published/optima.py [--clone CLONE] [--only NAME[,READING]]

Needs scipy (Debian: python3-scipy). A polyline takes minutes. CLONE: see published.py.
"""
import argparse
import json
import os
import sys

sys.dont_write_bytecode = True
from optimum import optimum
from standard_curves import HERE, read_curves

FILE = os.path.join(HERE, "optima.json")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--clone")
    parser.add_argument("--only", default=",")
    options = parser.parse_args()
    only_name, only_reading = (options.only + ",").split(",")[:2]
    for name, curve in read_curves(options.clone).items():
        for reading in curve.readings:
            if only_name not in ("", name) or only_reading not in ("", reading):
                continue
            time, places, _ = optimum(curve.path(reading), curve.limits(reading), *curve.grid)
            print(f"{name}, {reading}: {time:.4f} s, {len(places)} places", flush=True)
            try:
                with open(FILE, encoding="ascii") as file:
                    optima = json.load(file)
            except FileNotFoundError:
                optima = {}
            optima.setdefault(name, {})[reading] = {"time": round(time, 5), "places": len(places)}
            with open(FILE, "w", encoding="ascii") as file:
                json.dump(optima, file, indent=1, sort_keys=True)
                file.write("\n")


if __name__ == "__main__":
    main()
