#!/usr/bin/python3
"""Selects a share of files for each commit: after as many commits as there are parts, all files have been selected once,
unless files were added.

    commit_share.py ROOT PARTS <NAMES      prints those of the names (one per line) that this commit selects
"""
import pathlib
import subprocess
import sys
import zlib


def share_of_commit(files, parts, root):
    """Those of the files below root that the commit checked out there selects, one part of `parts`."""
    count = subprocess.run(["git", "-C", root, "rev-list", "--count", "HEAD"], check=True, capture_output=True, text=True)
    turn = int(count.stdout) % parts
    return [each for each in files if zlib.crc32(str(each.relative_to(root)).encode()) % parts == turn]


if __name__ == "__main__":
    top = pathlib.Path(sys.argv[1]).resolve()
    for file in share_of_commit([top / line.rstrip("\n") for line in sys.stdin], int(sys.argv[2]), top):
        print(file)
