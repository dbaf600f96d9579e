"""Compares the report of `clsurf check --json` on a whole log with the one that was merged from shards: every line the same, but for
the percentiles of the motion, which may differ by 1/4096 of their value (docs/design/shards.md).

usage: read_merged.py WHOLE.json MERGED.json
"""

import json
import sys

PERCENTILES = ("speed_difference_p95_mm_min", "jerk_p95_mm_s3")
texts = [open(name, encoding="utf-8").read() for name in sys.argv[1:]]
lines = [[line for line in text.split("\n") if not any(f'"{key}"' in line for key in PERCENTILES)] for text in texts]
assert lines[0] == lines[1], next((a, b) for a, b in zip(*lines) if a != b)
assert texts[0].count("\n") == texts[1].count("\n")
whole, merged = (json.loads(text)["summary"] for text in texts)
for key, rounding in zip(PERCENTILES, (0.001, 0.1)):
    assert abs(merged[key] - whole[key]) <= whole[key] / 4096 + rounding, (key, merged[key], whole[key])
assert whole["time_in_motion_s"] > 0
