"""The repair of programs against that of the program."""

import clsurf
from conftest import files, run_json


def compare(tmp_path, program, log=None):
    """The report, which both must give."""
    written = tmp_path / "better.nc"
    words = ["--log", log] if log else []
    report = run_json("optimize", program, "-o", written, "--machines", "0", "--tool", "none", *words)
    made = clsurf.optimize(program, log=log, machines=0, tool="none")
    assert made.report == report
    assert made.text == (written.read_text() if report["accepted"] else None)
    return report


def test_a_repaired_program(tmp_path):
    program, _ = files("bottle_uneven.nc")
    lines = open(program, encoding="utf-8").readlines()
    beginning = tmp_path / "beginning.nc"
    beginning.write_text("".join(lines[:500]))
    assert compare(tmp_path, beginning)["accepted"]


def test_a_machine_that_is_fitted_to_the_log(tmp_path):
    report = compare(tmp_path, *files("planted_loops.nc"))
    assert not report["accepted"] and report["reason"]
    assert report["log"]["points"] > 1000
