#!/usr/bin/env python3
"""Compares the keys of the JSON that subcommands write with a list. Scripts of users depend on them.

usage: json_keys.py CLSURF PROJECT SAMPLES [--write]

The list is json_keys.txt beside this file: each command, then the paths of its keys, where [] is an item of an array.
--write replaces it. Look at the change: a key that disappears breaks scripts, and needs another schema_version.
"""

import difflib
import json
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "support"))
from crowded_part import crowded_part

KEYS = pathlib.Path(__file__).with_name("json_keys.txt")
# Each line makes what the lines below it read. {data}, {samples} and {tests} are folders.
PREPARATION = """
cp {data}/programs/bottle_uneven.nc part.nc
cp {samples}/bottle_uneven.biip run.biip
clsurf check part.nc run.biip --tool none -o before.json
clsurf simulate part.nc --machine {data}/machines/three_axis_mill.toml -o simulated.biip
/usr/bin/python3 {tests}/measured/dexel_part.py make .
cp part.nc measured.nc
cp {data}/programs/bottle_uneven.nc part.nc
/usr/bin/python3 {tests}/scan/scanned_part.py make .
clsurf simulate crowded.nc --machine {data}/machines/three_axis_mill.toml -o crowded.biip
clsurf history shop.db add part.nc run.biip --tool none --time 2026-11-01 --param tool=new
clsurf history shop.db add part.nc run.biip --tool none --time 2026-11-02 --param tool=worn
"""
COMMANDS = """
check part.nc run.biip --tool ball:6 --machine {data}/machines/three_axis_mill.toml --max-depth 5um --baseline before.json
check part.nc simulated.biip --tool none
check measured.nc run.csv --tool ball:6 --measured profile.csv --measured-at 7.1,2.9,90
align profile.csv measured.nc run.csv --tool ball:6 --measured-at 7.1,2.9,90
query part.nc run.biip --line 1200
info part.nc run.biip
simulate part.nc -o s.biip
identify crowded.nc crowded.biip -o m.toml
diff run.biip simulated.biip --program part.nc --tool ball:6 --budget runs.toml
optimize crowded.nc --machine {data}/machines/three_axis_mill.toml -o better.nc
profile scan.csv --x x --z height --window 40 -o cut.nc
lint part.nc
intervals part.nc
history shop.db list
history shop.db show 1
history shop.db trend
history shop.db outliers
history shop.db against first
help fields
help channels
"""


def paths(value, at=""):
    if isinstance(value, dict):
        for key, inner in value.items():
            here = f"{at}.{key}" if at else key
            yield here
            yield from paths(inner, here)
    elif isinstance(value, list):
        for inner in value:
            yield from paths(inner, at + "[]")


def main():
    clsurf, project, samples = (str(pathlib.Path(path).resolve()) for path in sys.argv[1:4])
    folders = {"data": f"{project}/data", "samples": samples, "tests": f"{project}/tests"}
    found = []
    with tempfile.TemporaryDirectory() as folder:

        def run(words):
            words = [word.format(**folders) for word in words]
            words[:1] = [clsurf, "--no-config"] if words[0] == "clsurf" else words[:1]
            return subprocess.run(words, cwd=folder, capture_output=True, text=True)

        (pathlib.Path(folder) / "runs.toml").write_text("max_height_difference_um = 1\n", encoding="utf-8")
        (pathlib.Path(folder) / "crowded.nc").write_text(crowded_part(), encoding="utf-8")
        for line in PREPARATION.strip().splitlines():
            done = run(line.split())
            assert done.returncode in (0, 1), f"{line}\n{done.stderr}"
        for line in COMMANDS.strip().splitlines():
            done = run(["clsurf", *line.split(), "--json"])
            assert done.returncode in (0, 1, 5) and done.stdout, f"{line}: exit code {done.returncode}\n{done.stderr}"
            written = json.loads(done.stdout)
            found += [line + "\n", *sorted({f"    {path}\n" for path in paths(written)})]
    if "--write" in sys.argv:
        KEYS.write_text("".join(found), encoding="utf-8")
    stated = KEYS.read_text(encoding="utf-8").splitlines(keepends=True)
    difference = list(difflib.unified_diff(stated, found, KEYS.name, "written", n=0))
    sys.stdout.writelines(difference)
    return 1 if difference else 0


sys.exit(main())
