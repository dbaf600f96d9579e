"""Makes a wheel of the Python package of a build, by its CMake install; run by the target clsurf_wheel (docs/python.md).

usage: make_wheel.py CMAKE BUILD SOURCE VERSION FOLDER

The same build gives the same file, byte for byte: times are SOURCE_DATE_EPOCH, by default the time of the commit. The wheel links
the libraries of the system that it was built on, and says so by its platform (linux, not manylinux).
"""

import os
import shutil
import subprocess
import sys
import sysconfig
import tempfile
from pathlib import Path

METADATA = """Metadata-Version: 2.1
Name: clsurf
Version: {version}
Summary: Finds the NC program lines that mark a machined surface
License: BSD-3-Clause
Requires-Python: =={python}.*
Requires-Dist: numpy
Provides-Extra: tables
Requires-Dist: pandas; extra == "tables"
"""
WHEEL = """Wheel-Version: 1.0
Generator: clsurf
Root-Is-Purelib: false
Tag: {tag}
"""


def installed(cmake, build, component, name, folder):
    """Installs a component below `folder`; the path of the one thing there that is called `name`."""
    subprocess.run([cmake, "--install", build, "--component", component, "--strip", "--prefix", folder], check=True, stdout=subprocess.DEVNULL)
    found = list(Path(folder).rglob(name))
    if len(found) != 1:
        sys.exit(f"make_wheel: {name} was installed {len(found)} times")
    return found[0]


def commit_time(source):
    """[s] since 1970 as text; without a repository, or without git, the earliest that a zip file can hold."""
    earliest = "315532800"
    try:
        done = subprocess.run(["git", "-C", source, "log", "-1", "--format=%ct"], capture_output=True, text=True)
    except FileNotFoundError:
        return earliest
    return done.stdout.strip() or earliest


def main(cmake, build, source, version, folder):
    python = "{}.{}".format(*sys.version_info)
    interpreter = "cp{}{}".format(*sys.version_info)
    tag = "{0}-{0}-{1}".format(interpreter, sysconfig.get_platform().replace("-", "_").replace(".", "_"))
    os.environ.setdefault("SOURCE_DATE_EPOCH", commit_time(source))
    os.umask(0o022)
    with tempfile.TemporaryDirectory() as work:
        content = Path(work, "content")
        shutil.copytree(installed(cmake, build, "python3-clsurf", "clsurf", Path(work, "python")), content / "clsurf")
        # The module finds it beside itself.
        shutil.copy(installed(cmake, build, "clsurf", "libclsurf_image.so", Path(work, "program")), content / "clsurf")
        info = content / f"clsurf-{version}.dist-info"
        info.mkdir()
        (info / "METADATA").write_text(METADATA.format(version=version, python=python))
        (info / "WHEEL").write_text(WHEEL.format(tag=tag))
        shutil.copy(Path(source, "LICENSE"), info)
        Path(folder).mkdir(parents=True, exist_ok=True)
        subprocess.run([sys.executable, "-m", "wheel", "pack", "--dest-dir", folder, content], check=True, stdout=subprocess.DEVNULL)
    print(Path(folder, f"clsurf-{version}-{tag}.whl"))


main(*sys.argv[1:])
