"""A history of a run that failed and one that has defects, as JSON of `history list` and of `show` of the failed one.

usage: read_failed.py LIST.json SHOW.json
"""

import json
import sys

runs, shown = (json.load(open(name, encoding="utf-8"))["runs"] for name in sys.argv[1:])
failed = [run for run in runs if run["failure"]]
assert [run["id"] for run in failed] == [run["id"] for run in shown], failed
known = {name for name in runs[0] if all(run[name] is not None for run in runs if not run["failure"])}
for name in ("defects", "worst_score", "deepest_um"):
    assert name in known and failed[0][name] is None, name
for name, value in shown[0].items():
    assert not isinstance(value, (int, float)) or isinstance(value, bool) or name == "id", (name, value)
