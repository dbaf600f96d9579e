"""A report of `check` on two logs of which the first, b.biip, cannot be used: an error for it, three defects for the other.

usage: read_unusable.py json|csv|sarif|junit REPORT
"""

import csv
import json
import sys
import xml.etree.ElementTree as ElementTree


def read_json(file):
    unusable, judged = json.load(file)["logs"]
    assert "is not a log" in unusable["error"] and not unusable["summary"]["judged"], unusable
    assert unusable["diagnostics"][0]["severity"] == "error" and "defects" not in unusable, unusable
    assert len(judged["defects"]) == 3 and "error" not in judged


def read_csv(file):
    rows = list(csv.DictReader(file))
    assert all(None not in row and None not in row.values() for row in rows), "as many values as titles"
    assert rows[0]["log"] == "b.biip" and rows[0]["cause"] == "error" and "is not a log" in rows[0]["comment"], rows[0]
    assert {row["id"] for row in rows[1:]} == {"1", "2", "3"}


def read_sarif(file):
    unusable, judged = json.load(file)["runs"]
    assert not unusable["invocations"][0]["executionSuccessful"], unusable
    assert [result["level"] for result in unusable["results"]] == ["error"]
    assert len(judged["results"]) == 3


def read_junit(file):
    unusable, judged = ElementTree.parse(file).getroot()
    assert unusable.attrib["errors"] == "1" and judged.attrib["errors"] == "0"
    assert "is not a log" in unusable.find("testcase/error").attrib["message"]
    assert unusable.find("testcase").attrib["name"] == judged.find("testcase").attrib["name"]


with open(sys.argv[2], encoding="utf-8") as report:
    {"json": read_json, "csv": read_csv, "sarif": read_sarif, "junit": read_junit}[sys.argv[1]](report)
