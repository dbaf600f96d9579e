"""Whether a front of `clsurf simulate --tradeoff`, or of `clsurf optimize --tradeoff`, is what its runs alone give.

usage: read_tradeoff.py settings FRONT.json PROGRAM MACHINE WEIGHT
       read_tradeoff.py choice FRONT.json PROGRAM MACHINE WEIGHT
       read_tradeoff.py repair FRONT.json NEW_PROGRAM MACHINE WEIGHT

settings: the machine file of each row is made from MACHINE by scaling the numbers in its text; `simulate` and `check` run
and judge it alone. choice: the same of the chosen row only. repair: the program that was written is run and judged, and must be
the chosen row. All: which rows are on the front, and which one the weight chooses, by brute force. $CLSURF is the program.
"""

import json
import os
import re
import subprocess
import sys

CLSURF = os.environ["CLSURF"]
MEASURES = ["time_s", "speed_difference_p95_mm_min", "jerk_p95_mm_s3"]
# Key of a front, key of check's summary, largest difference.
SAME = [
    ("time_s", "time_in_motion_s", 1e-6),
    ("speed_difference_p95_mm_min", "speed_difference_p95_mm_min", 1.1e-3),
    ("speed_difference_rms_mm_min", "speed_difference_rms_mm_min", 1.1e-3),
    ("jerk_p95_mm_s3", "jerk_p95_mm_s3", 0.11),
    ("jerk_rms_mm_s3", "jerk_rms_mm_s3", 0.11),
]


def scaled(text, settings):
    """A machine file with shares of its limits."""

    def scale(pattern, percent):
        def changed(match):
            return match[1] + repr(float(match[2]) * percent / 100)

        return re.sub(rf"(?m)^({pattern} = )([0-9.e+]+)", changed, text)

    text = scale("max_jerk", settings["jerk_percent"])
    text = scale("max_(?:normal_)?acceleration", settings["acceleration_percent"])
    text = scale("feed_override", settings["feed_percent"])
    return re.sub(r'(?m)^feed = "\w+"', f'feed = "{settings["feed"]}"', text)


def judged(program, machine):
    """check's report of a simulated run."""
    subprocess.run([CLSURF, "simulate", program, "--machine", machine, "-o", "alone.biip", "-q"], check=True)
    report = subprocess.run(
        [CLSURF, "check", program, "alone.biip", "--json", "--tool", "ball:6"], capture_output=True, text=True
    )
    return json.loads(report.stdout)


def compare(row, report, counts):
    for ours, of_check, most in SAME:
        value, alone = row[ours], report["summary"][of_check]
        assert abs(value - alone) <= most, f"row {row['number']}: {ours} is {value}, alone {alone}"
    if not counts:
        return
    assert row["defects"] == report["summary"]["defects"], f"row {row['number']}: defects"
    deepest = max((d["depth_um"] for d in report["defects"]), default=0)
    assert abs(row["deepest_um"] - deepest) <= 0.006, f"row {row['number']}: {row['deepest_um']}, alone {deepest}"


def dominates(a, b):
    return all(a[k] <= b[k] for k in MEASURES) and any(a[k] < b[k] for k in MEASURES)


def cost(row, reference, weight):
    time, mismatch, jerk = (row[k] / reference[k] for k in MEASURES)
    return (1 - weight) * time + weight * (mismatch + jerk) / 2


def main():
    kind, front, program, machine, weight = sys.argv[1:]
    front = json.load(open(front))
    rows = front["rows"]
    for row in rows:
        beaten = any(dominates(other, row) for other in rows)
        assert row["front"] != beaten, f"row {row['number']} is{'' if row['front'] else ' not'} on the front"
    chosen = [row for row in rows if row["chosen"]]
    assert len(chosen) == 1 and chosen[0]["number"] == front["chosen"] and chosen[0]["front"]
    candidates = [row for row in rows if row["front"] and (kind != "repair" or row["number"] > 1)]
    order = sorted(candidates, key=lambda row: cost(row, rows[0], float(weight)))
    if kind == "repair":
        compare(chosen[0], judged(program, machine), counts=False)
        # What other machines refuse, the next one takes the place of.
        assert chosen[0] in order[:8], "the weight would not choose this one"
        return
    assert cost(chosen[0], rows[0], float(weight)) <= cost(order[0], rows[0], float(weight)) + 1e-9
    text = open(machine).read()
    for row in rows if kind == "settings" else chosen:
        with open("alone.toml", "w") as file:
            file.write(scaled(text, row["settings"]))
        compare(row, judged(program, "alone.toml"), counts=True)


main()
