"""Adds to a history as many runs as it has, of the days after, each with the defects of one of them at twice the score and
a higher severity, and with the parameter tool=worn: a shop whose tool wore out.

usage: worsen_runs.py DB RUNS
"""

import sqlite3
import sys

connection = sqlite3.connect(sys.argv[1])
runs = int(sys.argv[2])
connection.execute("PRAGMA foreign_keys = ON")
columns = [row[1] for row in connection.execute("PRAGMA table_info(runs)")]
with connection:
    for old in range(1, runs + 1):
        new = old + runs
        run = dict(zip(columns, connection.execute("SELECT * FROM runs WHERE id = ?", (old,)).fetchone()))
        run.update(id=new, identity=f"worn {new}", time=f"2026-11-{new:02}T00:00:00Z", log_sha256=f"worn {new}")
        run["worst_score"] *= 2
        run["worst_severity"] = min(4, run["worst_severity"] + 1)
        connection.execute(f"INSERT INTO runs VALUES ({','.join('?' * len(columns))})", [run[c] for c in columns])
        connection.execute("INSERT INTO parameters VALUES (?, 'tool', 'worn'), (?, 'number', ?)", (new, new, f"{new:02}"))
        defects = connection.execute("SELECT * FROM defects WHERE run = ?", (old,)).fetchall()
        for d in defects:
            connection.execute(f"INSERT INTO defects VALUES ({','.join('?' * len(d))})", (new, *d[1:4], min(4, d[4] + 1), 2 * d[5], *d[6:]))
        for s in connection.execute("SELECT * FROM sections WHERE run = ?", (old,)).fetchall():
            connection.execute("INSERT INTO sections VALUES (?, ?, ?, ?, ?, ?)", (new, *s[1:]))
