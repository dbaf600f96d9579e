"""Executes a notebook from top to bottom, in its folder, and compares what comes out with the outputs that it holds.

run_notebook.py check NOTEBOOK     texts must be equal, pictures equal for `clsurf compare`; that a wrong one is found is checked, too
run_notebook.py update NOTEBOOK    writes the outputs into the notebook
"""

import base64
import copy
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import nbclient
import nbformat


def execute(notebook, folder):
    """A copy with the outputs of now. Throws nbclient.exceptions.CellExecutionError: a cell failed."""
    made = copy.deepcopy(notebook)
    for cell in made.cells:
        if cell.cell_type == "code":
            cell.outputs, cell.execution_count = [], None
    nbclient.NotebookClient(made, timeout=300, kernel_name="python3", record_timing=False, resources={"metadata": {"path": folder}}).execute()
    return made


def same_picture(ours, theirs):
    with tempfile.TemporaryDirectory() as folder:
        names = [os.path.join(folder, name) for name in ("ours.png", "theirs.png")]
        for name, text in zip(names, (ours, theirs)):
            Path(name).write_bytes(base64.b64decode(text))
        return subprocess.run([os.environ["CLSURF"], "compare", *names, "-q"]).returncode == 0


def contents(cell):
    """(type, content) of each output."""
    for output in cell.get("outputs", []):
        if output.output_type == "stream":
            yield output.name, output.text
        for kind, content in sorted(output.get("data", {}).items()):
            yield kind, content


def complaints(stored, made):
    found = []
    for number, (old, new) in enumerate(zip(stored.cells, made.cells), 1):
        before, after = list(contents(old)), list(contents(new))
        if [kind for kind, _ in before] != [kind for kind, _ in after]:
            found.append(f"cell {number}: outputs are {[kind for kind, _ in after]}, not {[kind for kind, _ in before]}")
            continue
        for (kind, theirs), (_, ours) in zip(before, after):
            same = same_picture(ours, theirs) if kind == "image/png" else ours == theirs
            if not same:
                found.append(f"cell {number}: another {kind}" + ("" if kind == "image/png" else f":\n{ours}\ninstead of\n{theirs}"))
    return found


def spoiled(notebook):
    """Copies with one wrong output each: a text, a table, a picture."""
    pictures = [content for cell in notebook.cells for kind, content in contents(cell) if kind == "image/png"]
    for wanted in ("text/plain", "text/html", "image/png"):
        wrong = copy.deepcopy(notebook)
        output = next(o for c in wrong.cells for o in c.get("outputs", []) if wanted in o.get("data", {}))
        output.data[wanted] = pictures[-1] if wanted == "image/png" else output.data[wanted] + "0"
        yield wanted, wrong


def main(what, path):
    notebook = nbformat.read(path, as_version=4)
    made = execute(notebook, os.path.dirname(os.path.abspath(path)))
    if what == "update":
        nbformat.write(made, path)
        return 0
    found = complaints(notebook, made)
    for complaint in found:
        print(complaint)
    for kind, wrong in spoiled(notebook):
        if len(complaints(wrong, made)) != len(found) + 1:
            found.append(kind)
            print(f"a wrong {kind} is not found")
    return 1 if found else 0


sys.exit(main(*sys.argv[1:]))
