"""Runs the shell steps of the GitHub action as a runner does: its inputs in the environment, `bash -eo pipefail`.

usage: run_action.py ACTION.yml CLSURF PROGRAM LOG
"""

import json
import os
import re
import shutil
import subprocess
import sys
import textwrap

action, clsurf, program, log = sys.argv[1:]
text = open(action, encoding="utf-8").read()
inputs_text, steps_text = text.split("\nruns:", 1)
# What users of the action may leave out.
DEFAULTS = {name: value for name, value in re.findall(r"^  (\w+):\n(?:    .*\n)*?    default: (.*)$", inputs_text, re.M)}
INPUTS = re.findall(r"^  (\w+):$", inputs_text, re.M)
STEPS = {}
for step in re.split(r"\n    - name: ", steps_text)[1:]:
    name = step.split("\n", 1)[0]
    run = re.search(r"\n      run: \|\n((?:        .*\n?|\n)+)", step)
    STEPS[name] = {
        "script": textwrap.dedent(run.group(1)) if run else None,
        "env": dict(re.findall(r"^        (\w+): \$\{\{ inputs\.(\w+) \}\}$", step, re.M)),
    }
scripts = [name for name, step in STEPS.items() if step["script"]]
assert scripts == ["Install clsurf", "Check"], scripts
assert set(STEPS["Check"]["env"].values()) == set(INPUTS), "an input is not passed on"


def run_step(name, path, given=None, **more):
    values = {key: json.loads(value) if value.startswith('"') else value for key, value in DEFAULTS.items()} | (given or {})
    env = {"PATH": path, "HOME": os.getcwd()} | {key: values[value] for key, value in STEPS[name]["env"].items()} | more
    with open("step.sh", "w", encoding="utf-8") as script:
        script.write(STEPS[name]["script"])
    return subprocess.run(["/bin/bash", "--noprofile", "--norc", "-eo", "pipefail", "step.sh"], env=env, capture_output=True, text=True)


def write_program(path, body):
    with open(path, "w", encoding="utf-8") as file:
        file.write("#!/bin/bash\n" + body)
    os.chmod(path, 0o755)


system = "/usr/bin:/bin"
os.makedirs("installed", exist_ok=True)
os.symlink(clsurf, "installed/clsurf")
installed = os.path.abspath("installed") + ":" + system

# Where clsurf is installed nothing is built.
done = run_step("Install clsurf", installed, GITHUB_ACTION_PATH="/nowhere")
assert done.returncode == 0 and done.stdout.strip() == os.path.abspath("installed/clsurf"), done

# Elsewhere it is built from the action's own files, and a step that fails ends it. Its programs are stood in for.
os.makedirs("action/data")
os.makedirs("tools")
for tool in ("bash", "env"):
    os.symlink(shutil.which(tool, path=system), "tools/" + tool)
tools = os.path.abspath("tools")
write_program("action/data/install-packages", f'echo "packages $*" >> {os.getcwd()}/called\n')
write_program("tools/cmake", f'echo "cmake $*" >> {os.getcwd()}/called\n[ "$1" != "$FAILS_AT" ]\n')
here = os.path.abspath("action")
done = run_step("Install clsurf", tools, GITHUB_ACTION_PATH=here, FAILS_AT="none")
calls = open("called", encoding="utf-8").read().splitlines()
assert done.returncode == 0, done
assert calls == [
    "packages data/packages",
    "cmake --preset release -DBUILD_TESTING=OFF",
    "cmake --build --preset release",
    "cmake --install build/release --prefix /usr/local",
], calls
os.remove("called")
done = run_step("Install clsurf", tools, GITHUB_ACTION_PATH=here, FAILS_AT="--build")
assert done.returncode != 0 and "--install" not in open("called", encoding="utf-8").read(), done
root = os.path.dirname(os.path.abspath(action))
for name in ("data/install-packages", "data/packages", "CMakePresets.json"):
    assert os.path.isfile(os.path.join(root, name)), name


def sarif(name="clsurf.sarif"):
    return json.load(open(name, encoding="utf-8"))["runs"]


# The check: a program whose name has a blank, two logs, options.
shutil.copy(program, "my part.nc")
shutil.copy(log, "monday.biip")
shutil.copy(log, "friday.biip")
given = {"program": "my part.nc", "logs": "monday.biip friday.biip"}
done = run_step("Check", installed, given)
assert done.returncode == 0, done
assert len(sarif()) == 2 and sarif()[0]["results"], "two logs are two runs"
done = run_step("Check", installed, given | {"options": "--tool ball:6 --fail-on trace", "sarif": "out.sarif"})
assert done.returncode == 1 and sarif("out.sarif")[0]["results"], done
# Nothing is new against its own report; against a report without defects all is.
given["logs"] = "monday.biip"
done = run_step("Check", installed, given | {"sarif": "baseline.sarif"})
assert done.returncode == 0, done
done = run_step("Check", installed, given | {"baseline": "baseline.sarif"})
assert done.returncode == 0 and {result["baselineState"] for result in sarif()[0]["results"]} == {"unchanged"}, done
report = json.load(open("baseline.sarif", encoding="utf-8"))
report["runs"][0]["results"] = []
json.dump(report, open("empty.sarif", "w", encoding="utf-8"))
done = run_step("Check", installed, given | {"baseline": "empty.sarif"})
assert done.returncode == 1 and {result["baselineState"] for result in sarif()[0]["results"]} == {"new"}, done
# A log that is not there is an error, and no report.
done = run_step("Check", installed, given | {"logs": "sunday.biip", "sarif": "none.sarif"})
assert done.returncode == 3 and not os.path.exists("none.sarif") and "sunday.biip: error: cannot open" in done.stderr, done
print("the steps of the action do what they say")
