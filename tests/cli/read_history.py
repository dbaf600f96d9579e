"""A history against the report of `clsurf check` on the same run, read by SQLite of Python.

usage: read_history.py DB CHECK.json PROGRAM LOG
"""

import hashlib
import json
import sqlite3
import sys

database, report, program, log = sys.argv[1:]
checked = json.load(open(report))
connection = sqlite3.connect(database)
connection.row_factory = sqlite3.Row
assert connection.execute("PRAGMA integrity_check").fetchone()[0] == "ok"
assert connection.execute("PRAGMA journal_mode").fetchone()[0] == "wal"
run = connection.execute("SELECT * FROM runs WHERE id = 1").fetchone()
for name, key in (("program_sha256", program), ("log_sha256", log)):
    assert run[name] == hashlib.sha256(open(key, "rb").read()).hexdigest(), name

summary = checked["summary"]


def close(a, b, what, least=0.006):
    assert abs(a - b) <= least + 1e-6 * abs(b), (what, a, b)


close(run["defects"], summary["defects"], "defects")
close(run["worst_severity"], summary["worst_severity"], "severity")
close(run["speed_p99_percent"], summary["speed_mismatch_p99_percent"], "mismatch")
close(run["coverage_percent"], summary["coverage_percent"], "coverage")
close(run["ra_um"], summary["ra_um"], "ra")
close(run["worst_score"], max(d["score"] for d in checked["defects"]), "score")
close(run["deepest_um"], max(d["depth_um"] for d in checked["defects"]), "depth")
assert bool(run["judged"]) == summary["judged"]
rows = connection.execute("SELECT * FROM defects WHERE run = 1 ORDER BY rank").fetchall()
assert len(rows) == len(checked["defects"])
for row, defect in zip(rows, checked["defects"]):
    assert row["cause"] == defect["cause"] and row["severity"] == defect["severity"], defect
    close(row["score"], defect["score"], "score of a defect")
    for axis, value in zip(("tip_x", "tip_y", "tip_z"), defect["tip_mm"]):
        close(row[axis], value, axis, 1e-4)
    sections = connection.execute(
        "SELECT pass, first_line, last_line FROM sections WHERE run = 1 AND rank = ? ORDER BY number", (row["rank"],)
    ).fetchall()
    assert [s[0] for s in sections] == defect["passes"], defect
    assert [[s[1], s[2]] for s in sections] == defect["lines"], defect
print(f"{len(rows)} defects as check says")
