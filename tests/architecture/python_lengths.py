#!/usr/bin/env python3
"""The lengths of Python files and functions: the limits that structure_test.cpp has for C++.

    python_lengths.py ROOT

ROOT: the project. Reads files that end in .py, and scripts whose first line names python.
Exit code 1: something is too long; it is named.
"""
import ast
import pathlib
import sys

LONGEST_FILE = 500  # lines
LONGEST_FUNCTION = 60  # lines, from its def to its last statement
FOLDERS = ["src", "io", "viz", "tests", "data", "docs", ".ci"]


def is_python(path):
    if path.suffix == ".py":
        return True
    if path.suffix or not path.is_file():
        return False
    with path.open("rb") as file:
        first = file.readline(200)
    return first.startswith(b"#!") and b"python" in first


def complaints_of(name, text):
    lines = len(text.splitlines())
    if lines > LONGEST_FILE:
        yield f"{name} has {lines} lines"
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)):
            lines = node.end_lineno - node.lineno + 1
            if lines > LONGEST_FUNCTION:
                yield f"{name}:{node.lineno}: {node.name} has {lines} lines"


def check_itself():
    def body(lines):
        return "def f():\n" + "    pass\n" * lines

    assert not list(complaints_of("a.py", body(LONGEST_FUNCTION - 1)))
    assert list(complaints_of("a.py", body(LONGEST_FUNCTION))) == ["a.py:1: f has 61 lines"]
    assert list(complaints_of("a.py", "\n" * (LONGEST_FILE + 1))) == ["a.py has 501 lines"]


def main():
    root = pathlib.Path(sys.argv[1])
    check_itself()
    files = [path for folder in FOLDERS for path in sorted((root / folder).rglob("*"))
             if "node_modules" not in path.parts and is_python(path)]
    assert files, f"no Python in {root}"
    complaints = [text for path in files for text in complaints_of(path.relative_to(root), path.read_text())]
    print("\n".join(complaints), end="\n" if complaints else "")
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main())
