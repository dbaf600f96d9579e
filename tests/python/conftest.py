"""What the tests of the Python package need: the sample parts, and the program `clsurf`, whose answers are those of the package."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent.parent / "support"))

DATA = Path(os.environ["CLSURF_DATA"])
SAMPLES = Path(os.environ["CLSURF_SAMPLES"])
PROGRAM = os.environ["CLSURF"]


def files(name, log=None):
    """Program and log of a sample part."""
    return str(DATA / "programs" / name), str(SAMPLES / (log or Path(name).stem + ".biip"))


def run_json(*words):
    """The report of a subcommand. Exit code 1 is a verdict."""
    done = subprocess.run([PROGRAM, *map(str, words), "--json"], capture_output=True, text=True)
    assert done.returncode in (0, 1, 5), done.stderr
    return json.loads(done.stdout)


def check_json(*words):
    """The report of `check` on one log, without `logs`, which holds it once more."""
    report = run_json("check", *words)
    assert report.pop("logs")[0]["summary"] == report["summary"]
    return report


@pytest.fixture(scope="session")
def uneven_files():
    return files("bottle_uneven.nc")


@pytest.fixture(scope="session")
def uneven(uneven_files):
    import clsurf

    return clsurf.Part(*uneven_files, tool="ball:6")


@pytest.fixture(scope="session")
def uneven_report(uneven_files):
    return check_json(*uneven_files, "--tool", "ball:6")
