"""The repair of programs against that of the program."""

import json
import subprocess

import clsurf
import pytest
from conftest import DATA, PROGRAM, run_json
from crowded_part import crowded_part


def compare(tmp_path, program, log=None):
    """The report, which both must give."""
    written = tmp_path / "better.nc"
    words = ["--log", log] if log else []
    report = run_json("optimize", program, "-o", written, "--machines", "0", "--tool", "none", *words)
    made = clsurf.optimize(program, log=log, machines=0, tool="none")
    assert made.report == report
    assert made.text == (written.read_text() if report["accepted"] else None)
    return report


def crowded(tmp_path):
    program = tmp_path / "part.nc"
    program.write_text(crowded_part())
    return program


def test_a_repaired_program(tmp_path):
    assert compare(tmp_path, crowded(tmp_path))["accepted"]


def test_a_machine_that_is_fitted_to_the_log(tmp_path):
    program, log = crowded(tmp_path), tmp_path / "run.biip"
    machine = DATA / "machines" / "linuxcnc_logs.toml"
    subprocess.run([PROGRAM, "simulate", program, "--machine", machine, "-o", log, "-q"], check=True)
    report = compare(tmp_path, program, log)
    assert report["log"]["points"] > 1000


def test_a_program_that_is_refused(tmp_path):
    program = tmp_path / "part.nc"
    program.write_text("G21 G90\nG0 X0 Y0 Z0\nG1 X10 F600 (A)\nY0.3 (B)\nX0 (C)\nY0.6 (D)\nX10 (E)\nY0.9 (F)\nX0 (G)\nM2\n")
    report = compare(tmp_path, program)
    assert not report["accepted"] and report["reason"]


def test_the_front_of_a_repair_and_a_choice_from_it(tmp_path):
    program, written, front = crowded(tmp_path), tmp_path / "better.nc", tmp_path / "front.json"
    words = ["--machines", "0", "--tool", "none", "--tradeoff", front, "--weight", "0.3"]
    report = run_json("optimize", program, "-o", written, *words)
    made = clsurf.optimize(program, machines=0, tool="none", weight=0.3)
    assert made.report.pop("tradeoff") == json.loads(front.read_text())
    assert made.report == report
    assert made.text == written.read_text()


def test_settings_of_a_machine(tmp_path):
    program, front, settings = crowded(tmp_path), tmp_path / "front.json", tmp_path / "finish.toml"
    words = ["--tradeoff", front, "--weight", "0.5", "--settings", settings, "--runs", "4", "--more-time", "30", "-q"]
    subprocess.run([PROGRAM, "simulate", program, *words], check=True)
    found = clsurf.tradeoff(program, weight=0.5, runs=4, more_time_percent=30)
    assert found.report == json.loads(front.read_text())
    assert found.machine == settings.read_text()
    rows = found.report["rows"]
    assert 2 <= len(rows) <= 4 and rows[found.report["chosen"] - 1]["chosen"]
    # By the definition: what has the least cost of all rows is on the front, and chosen.
    first = rows[0]

    def cost(row):
        keys = "speed_difference_p95_mm_min", "jerk_p95_mm_s3"
        return 0.5 * row["time_s"] / first["time_s"] + 0.25 * sum(row[k] / first[k] for k in keys)

    assert cost(rows[found.report["chosen"] - 1]) == min(map(cost, rows))
    # The file of the choice makes the run of its row.
    chosen = tmp_path / "chosen.toml"
    chosen.write_text(found.machine)
    run = clsurf.simulate(program, chosen)
    assert abs(run.check()["summary"]["time_in_motion_s"] - rows[found.report["chosen"] - 1]["time_s"]) < 1e-9
    assert clsurf.tradeoff(program, runs=2).machine is None


def test_a_weight_that_is_none(tmp_path):
    for call in (clsurf.tradeoff, clsurf.optimize):
        with pytest.raises(clsurf.UsageError):
            call(crowded(tmp_path), weight=1.5)
