#!/usr/bin/python3
"""Reads every source and every header by itself with the compiler, without making code: what it uses without including it is
an error. Then reads all headers together: a type that two of them define is an error there. Everywhere else it would be
undefined behaviour without a message.

    read_separately.py ROOT BUILD [eighth]

ROOT: the project; BUILD: a folder configured without unity builds and precompiled headers, with its compile_commands.json;
eighth: of the sources only those that the last commit changed, and an eighth of the others, another one for each commit.
Exit code 1: a file is refused; the compiler has said why.

Headers that many files include take most of the time. Files that include the same headers of SHARED, directly or through
other headers, share one precompiled file of them. The compiler reads it before the file itself. This hides no missing include:
the file includes these headers in any case, and each of them is also read by itself.
"""
import collections
import functools
import json
import multiprocessing.pool
import os
import pathlib
import re
import shlex
import subprocess
import sys

from commit_share import share_of_commit

# Expensive headers that many files include. A header comes after those that it includes.
SHARED = ["gtest/gtest.h", "fmt/format.h", "boost/program_options.hpp", "nlohmann/json.hpp", "core/geometry.h",
          "program/program.h", "surface/cl_surface.h", "machine/machine.h", "predictor/signals.h", "cli/options/options.h"]
FEWEST = 4  # files that make a precompiled one worth its cost

INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^">]+)[">]', re.MULTILINE)


class Project:
    def __init__(self, root, build):
        self.root = root
        self.folders = [root / "src", root, root / "tests", root / "data" / "tools"]
        entries = json.loads((build / "compile_commands.json").read_text())
        self.words = {pathlib.Path(entry["file"]): self.reading(entry["command"]) for entry in entries
                      if build not in pathlib.Path(entry["file"]).parents}

    @staticmethod
    def reading(command):
        """The words of a compiler's command without its output and its source."""
        words = shlex.split(command)
        for option in ("-o", "-c"):
            del words[words.index(option):words.index(option) + 2]
        return tuple(words)

    @functools.lru_cache(maxsize=None)
    def reached(self, file):
        """The names of all headers that `file` includes, also through others. Headers of other projects are not opened."""
        names = set()
        for name in INCLUDE.findall(file.read_text()):
            names.add(name)
            header = next((folder / name for folder in [*self.folders, file.parent] if (folder / name).is_file()), None)
            if header:
                names |= self.reached(header)
        return names

    def shared(self, file):
        names = self.reached(file)
        return tuple(name for name in SHARED if name in names)

    def headers(self):
        return sorted(header for room in ("src", "io", "viz") for header in (self.root / room).rglob("*.h"))

    def words_of_header(self, header):
        """As a source of its folder, or of the nearest one above, is read."""
        for folder in header.parents:
            for source, words in self.words.items():
                if folder in source.parents:
                    return words
        raise SystemExit(f"no source is read as {header} would be")

    def words_of_all(self):
        """The words of one source, and the folders of headers of all."""
        words = list(self.words[self.root / "src" / "cli" / "subcommands" / "simulate.cpp"])
        for other in self.words.values():
            for k, word in enumerate(other):
                if word == "-isystem" and other[k + 1] not in words:
                    words += ["-isystem", other[k + 1]]
                elif word.startswith("-I") and word not in words:
                    words.append(word)
        return tuple(words)


def eighth_of(sources, root):
    names = subprocess.run(["git", "-C", root, "show", "--format=", "--name-only", "HEAD"], check=True, capture_output=True,
                           text=True).stdout.split()
    chosen = {root / name for name in names}.union(share_of_commit(sources, 8, root))
    return [each for each in sources if each in chosen]


def accepted(words, folder):
    done = subprocess.run(words, cwd=folder, capture_output=True, text=True)
    sys.stderr.write(done.stderr)
    return done.returncode == 0


def main(root, build, eighth):
    project = Project(root, build)
    made = build / "read_separately"
    made.mkdir(exist_ok=True)

    groups = collections.defaultdict(list)  # (words, shared headers) → files
    for source in eighth_of(project.words, root) if eighth else project.words:
        groups[project.words[source], project.shared(source)].append(source)
    headers = project.headers()
    for header in headers:
        # Its own source begins with it (architecture_test).
        if header.with_suffix(".cpp") in project.words:
            continue
        twice = made / (str(header.relative_to(root)).replace("/", "-") + ".cpp")
        twice.write_text(f'#include "{header}"\n#include "{header}"\n')
        groups[project.words_of_header(header), project.shared(header)].append(twice)
    together = made / "all_headers.cpp"
    together.write_text("".join(f'#include "{header}"\n' for header in headers))
    groups[project.words_of_all(), ()].append(together)

    def shared_file(numbered):
        number, ((words, shared), files) = numbered
        if not shared or len(files) < FEWEST:
            return ()
        header = made / f"{number}.h"
        header.write_text("".join(f'#include "{name}"\n' for name in shared))
        made_it = accepted([*words, "-w", "-x", "c++-header", header, "-o", f"{header}.gch"], build)
        return ("-Winvalid-pch", "-include", header) if made_it else ()

    with multiprocessing.pool.ThreadPool(len(os.sched_getaffinity(0))) as pool:
        before = pool.map(shared_file, enumerate(groups.items()), chunksize=1)
        tasks = [[*words, *shared, "-fsyntax-only", file]
                 for ((words, _), files), shared in zip(groups.items(), before) for file in files]
        good = pool.map(lambda words: accepted(words, build), tasks, chunksize=1)
    print(f"{len(good)} files, {sum(map(bool, before))} precompiled ones of shared headers")
    return 0 if all(good) else 1


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve(), sys.argv[3:] == ["eighth"]))
