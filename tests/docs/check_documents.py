# Checks the documents (*.md) of the project.
#
# check_documents.py links ROOT                     every relative link leads to a file and, after #, to one of its headings;
#                                                   every page of docs can be reached from README.md
# check_documents.py histories ROOT                 pages for users have no history of measurements: that is in docs/experiments
# check_documents.py listings ROOT CLSURF PAGE…     the outputs that a page shows are those of its commands
# check_documents.py update ROOT CLSURF PAGE…       writes the outputs into the pages instead
# check_documents.py pictures ROOT CLSURF PAGE…     the pictures of a page are those of its commands
# check_documents.py draw ROOT CLSURF PAGE…         draws them anew instead, those that differ
#
# Listings are code blocks, indented by four blanks. A line `$ COMMAND` is run in an empty folder, in the order of the page;
# the lines below it are its standard output. `…` stands for lines that are left out: what is before it is the beginning
# of the output, what is after it the end. `$ cat FILE` defines the file instead. Lines `cp …` and `xz …` are run as well.
# The folder holds part.nc and run.biip, the sample part bottle_uneven, and `data`.
#
# A command draws a picture of its page if the name after -o is that of the picture. It is drawn in the size of the picture
# unless the command says --size. Lines that make its files are run as well: `cp`, `sed`, `for`, and `clsurf simulate` of a program
# that is there.
import os
import re
import shutil
import struct
import subprocess
import sys
import tempfile

CODE = "    "
LEFT_OUT = "…"


def pages_of(root):
    """Pages and their texts, by path from the root."""
    found = {}
    for folder, folders, names in os.walk(root):
        inside = os.path.relpath(folder, root)
        folders[:] = [f for f in folders if not f.startswith(".") and f not in ("build", "node_modules")]
        for name in names:
            if name.endswith(".md"):
                path = os.path.normpath(os.path.join(inside, name))
                found[path] = open(os.path.join(root, path), encoding="utf-8").read()
    return found


def without_code(text):
    """The text without code blocks, in which a link is none."""
    return re.sub(r"^    .*$", "", re.sub(r"^```.*?^```", "", text, flags=re.M | re.S), flags=re.M)


def anchors_of(text):
    """The anchors of the headings, as GitHub makes them."""
    anchors, count = set(), {}
    for heading in re.findall(r"^#+ +(.*?)\s*$", re.sub(r"^```.*?^```", "", text, flags=re.M | re.S), re.M):
        plain = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).lower()
        anchor = re.sub(r"[^\w\- ]", "", plain).replace(" ", "-")
        number = count.get(anchor, 0)
        count[anchor] = number + 1
        anchors.add(anchor if number == 0 else "%s-%d" % (anchor, number))
    return anchors


def check_links(root):
    """The complaints about links, and the pages of docs that nothing leads to."""
    pages = pages_of(root)
    complaints, leads_to = [], {}
    for page, text in sorted(pages.items()):
        leads_to[page] = set()
        for link in re.findall(r"\]\(([^)\s]+)\)", without_code(text)):
            if re.match(r"[a-z]+:", link):
                continue
            path, _, anchor = link.partition("#")
            target = os.path.normpath(os.path.join(os.path.dirname(page), path)) if path else page
            leads_to[page].add(target)
            if not os.path.exists(os.path.join(root, target)):
                complaints.append("%s: there is no %s" % (page, link))
            elif anchor and target in pages and anchor not in anchors_of(pages[target]):
                complaints.append("%s: %s has no heading #%s" % (page, target, anchor))
    reached, next_ones = set(), ["README.md"]
    while next_ones:
        page = next_ones.pop()
        if page in reached or page not in pages:
            continue
        reached.add(page)
        next_ones += leads_to[page]
    for page in sorted(pages):
        if page.startswith("docs" + os.sep) and page not in reached:
            complaints.append("%s: no way leads here from README.md" % page)
    return complaints


# Pages that may tell the history of a measurement; README.md and the rest of docs give its result.
WITH_HISTORIES = ("docs/experiments/", "docs/design/")
DATE = re.compile(r"\b20\d\d-\d\d-\d\d\b")
# What a dated sentence says of a measurement if it tells how it came about, and not only when.
CONDITION = re.compile(r"\b(load(ed)?|hours?|busy|busier|earlier|before|after|since then|later|passed)\b", re.I)
# What belongs to a history in a sentence without a date, too.
HISTORY = re.compile(r"\b(at a load of|slow(er)? hour|(heavily|less) loaded|busier|(an |the )?earlier version|with other work running)\b", re.I)


def sentences_of(text):
    """The sentences and the rows of tables of a page, without code."""
    plain = re.sub(r"`[^`\n]*`", "``", without_code(text))
    for line in plain.split("\n"):
        yield from ([line] if line.startswith("|") else re.split(r"(?<=[.!?])\s+", line))


def check_histories(root):
    """The sentences of pages for users that tell how a measurement came about."""
    complaints = []
    for page, text in sorted(pages_of(root).items()):
        if page != "README.md" and not page.startswith("docs/") or page.startswith(WITH_HISTORIES):
            continue
        for sentence in sentences_of(text):
            if HISTORY.search(sentence) or DATE.search(sentence) and CONDITION.search(sentence):
                complaints.append("%s: belongs to docs/experiments: %s" % (page, sentence.strip()))
    return complaints


def expected_of(output, shown):
    """The lines that a page should show of the output, where it shows `shown`."""
    lines = [line.rstrip() for line in output.splitlines()]
    while lines and not lines[-1]:
        lines.pop()
    if LEFT_OUT not in [line.strip() for line in shown]:
        return lines
    at = [line.strip() for line in shown].index(LEFT_OUT)
    first, last = at, len(shown) - at - 1
    return lines[:first] + [shown[at]] + (lines[-last:] if last > 0 else [])


class Page:
    """Runs the listings of a page."""

    def __init__(self, root, clsurf, path):
        self.lines = open(os.path.join(root, path), encoding="utf-8").read().split("\n")
        self.path = path
        self.complaints = []
        self.scratch = tempfile.TemporaryDirectory()
        self.folder = self.scratch.name
        os.symlink(os.path.join(root, "data"), os.path.join(self.folder, "data"))
        path_with_clsurf = os.path.dirname(clsurf) + os.pathsep + os.environ["PATH"]
        self.environment = dict(os.environ, PATH=path_with_clsurf, LC_ALL="C.UTF-8")
        self.run("cp data/programs/bottle_uneven.nc part.nc && xz -dc data/logs/bottle_uneven.biip.xz > run.biip")

    def run(self, command):
        ran = subprocess.run(["bash", "-c", command], cwd=self.folder, env=self.environment, capture_output=True, text=True)
        if ran.returncode not in (0, 1, 5):
            said = ran.stderr.strip()
            self.complaints.append("%s: '%s' ends with exit code %d: %s" % (self.path, command, ran.returncode, said))
        return ran.stdout

    def check(self):
        """Replaces what the page shows by what comes out, and lists the differences."""
        i = 0
        while i < len(self.lines):
            line = self.lines[i]
            i += 1
            if re.match(CODE + r"(cp|xz) ", line):
                self.run(line.strip())
            if not line.startswith(CODE + "$ "):
                continue
            command = line[len(CODE) + 2:]
            end = i
            while end < len(self.lines) and (self.lines[end].startswith(CODE) or self.lines[end] == ""):
                if self.lines[end].startswith(CODE + "$ "):
                    break
                end += 1
            while end > i and self.lines[end - 1] == "":
                end -= 1
            shown = [text[len(CODE):].rstrip() for text in self.lines[i:end]]
            if command.startswith("cat "):
                with open(os.path.join(self.folder, command[4:]), "w", encoding="utf-8") as file:
                    file.write("\n".join(shown) + "\n")
                continue
            output = self.run(command)
            expected = expected_of(output, shown) if shown else []
            if shown != expected:
                pairs = zip(shown + [""] * len(expected), expected + [""] * len(shown))
                was, now = next((was, now) for was, now in pairs if was != now)
                self.complaints.append("%s:%d: $ %s\n  shown:   %s\n  printed: %s" % (self.path, i, command, was, now))
            self.lines[i:end] = [(CODE + text).rstrip() for text in expected]
            i += len(expected)
        return self.complaints

    def is_same(self, drawn, picture):
        compared = subprocess.run(["clsurf", "compare", drawn, picture], cwd=self.folder, env=self.environment, capture_output=True)
        return compared.returncode == 0

    def check_pictures(self, root, draw):
        """Draws the pictures whose commands the page shows, and lists those that differ; `draw` replaces them."""
        folder = os.path.join(root, os.path.dirname(self.path))
        shown = {os.path.basename(link): os.path.join(folder, link)
                 for link in re.findall(r"!\[[^\]]*\]\(([^)\s]+\.png)\)", without_code("\n".join(self.lines)))}
        drawn = 0
        for line in self.lines:
            command = line.strip().removeprefix("$ ")
            if not line.startswith(CODE):
                continue
            simulated = re.match(r"clsurf simulate (\S+)", command)
            if re.match(r"(cp|sed|for \w+ in) ", command) or simulated and os.path.exists(os.path.join(self.folder, simulated[1])):
                self.run(command)
            named = re.match(r"clsurf (?:render|plot) .*-o ([\w.]+)", command)
            if named is None or named[1] not in shown:
                continue
            picture = shown[named[1]]
            if "--size" not in command:
                command += " --size %dx%d" % size_of(picture)
            self.run(command)
            drawn += 1
            if self.is_same(named[1], picture):
                continue
            if draw:
                shutil.copyfile(os.path.join(self.folder, named[1]), picture)
            self.complaints.append("%s: %s is not what '%s' draws" % (self.path, named[1], command))
        if drawn == 0:
            self.complaints.append("%s: no picture has a command" % self.path)
        return self.complaints


def size_of(picture):
    """Width and height [px] of a PNG."""
    with open(picture, "rb") as file:
        return struct.unpack(">II", file.read(24)[16:])


def main(arguments):
    what, root = arguments[0], os.path.abspath(arguments[1])
    complaints = []
    if what == "links":
        complaints = check_links(root)
    elif what == "histories":
        complaints = check_histories(root)
    else:
        for path in arguments[3:]:
            page = Page(root, os.path.abspath(arguments[2]), path)
            if what in ("pictures", "draw"):
                complaints += page.check_pictures(root, what == "draw")
                continue
            found = page.check()
            if what == "update":
                with open(os.path.join(root, path), "w", encoding="utf-8") as file:
                    file.write("\n".join(page.lines))
            else:
                complaints += found
    print("\n".join(complaints))
    return 1 if complaints and what != "draw" else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
