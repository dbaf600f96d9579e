#!/usr/bin/python3
"""Does a repair hold on a controller that nobody here wrote? Promised next to kept, for each machine and part.

    verify.py CLSURF FOLDER [MACHINE.ini] [PROGRAM…]

Each program is run on the LinuxCNC kernel (the script `controller`), repaired on a machine that was identified from the runs
of other parts, and run again. `clsurf check` judges the kernel's logs. FOLDER keeps all programs, logs, machine files and
reports; a second call continues where the first one stopped. Prints the table of docs/experiments/kernel.md.
Exit code 1: a promise was broken (more defects or more time on the kernel than before).
"""
import csv
import json
import math
import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
DATA = HERE.parent.parent / "data" / "programs"
FITTED = ["bottle_uneven.nc", "dome_loops.nc", "bottle_zigzag.nc"]  # two of these that are not the part itself
PARTS = ["bottle_uneven.nc", "dome_loops.nc", "bottle_zigzag.nc", "petal_zigzag_irregular.ngc", "petal_spiral.ngc",
         "petal_loops_g64.ngc", "petal_zigzag_g64.ngc"]
MOTION = ("speed", "acceleration")
REST = 0.1  # mm/min


class Bench:
    """One machine: its configuration of the kernel, and a folder for everything that was made on it."""

    def __init__(self, clsurf, folder, configuration):
        self.clsurf, self.folder, self.configuration = clsurf, folder, configuration
        folder.mkdir(parents=True, exist_ok=True)

    def call(self, *words, codes=(0,)):
        """Its standard output. `codes`: exit codes that are an answer, not an error."""
        # The kernel of another call of this script needs the processor in time.
        done = subprocess.run(["nice", "-n", "19", self.clsurf, *map(str, words)], capture_output=True, text=True)
        if done.returncode not in codes:
            sys.exit("%s\n%s" % (" ".join(map(str, done.args)), done.stderr))
        return done.stdout

    def kernel_log(self, program):
        log = self.folder / (program.stem + ".biip")
        for _ in range(3):
            if log.exists():
                return log
            text, new = log.with_suffix(".csv"), log.with_suffix(".new.biip")
            subprocess.check_call([str(HERE / "controller"), str(program), str(text)] + self.configuration)
            self.call("convert", text, "--program", program, "-o", new, "-q")
            text.unlink()
            # On a busy computer the kernel may give up before the end.
            found = json.loads(self.call("check", program, new, "--json", codes=(0, 5)))["diagnostics"]
            if all(diagnostic["code"] != "map.ends-early" for diagnostic in found):
                new.rename(log)
        sys.exit("%s: the kernel does not run it to its end" % program)

    def machine_for(self, program):
        others = [DATA / name for name in FITTED if name != program.name][:2]
        machine = self.folder / ("from_" + "_and_".join(other.stem for other in others) + ".toml")
        if not machine.exists():
            runs = [file for other in others for file in (other, self.kernel_log(other))]
            self.call("identify", *runs, "-o", machine, "-q")
        return machine

    def repaired(self, program):
        """The report of optimize, and the new program."""
        better, report = self.folder / (program.stem + "_better.nc"), self.folder / (program.stem + ".optimize.json")
        if not report.exists():
            report.write_text(self.call("optimize", program, "--machine", self.machine_for(program), "-o", better,
                                        "--json", codes=(0, 1)))
        return json.loads(report.read_text()), better

    def judged(self, program):
        """What the kernel's log says: time, defects, defects of motion, mismatch (95 %) in mm/min."""
        log = self.kernel_log(program)
        quality = json.loads(self.call("check", program, log, "--json"))
        points = self.folder / "points.csv"
        self.call("export", program, log, "-o", points, "--columns", "time,speed,speed_difference", "-q")
        with open(points) as file:
            next(file)
            rows = [[float(word) if word else math.nan for word in row] for row in csv.reader(file)]
        points.unlink()
        moving = [time for time, speed, _ in rows if speed > REST]
        sizes = sorted(abs(difference) for _, _, difference in rows if not math.isnan(difference))
        defects = quality["defects"]
        return {
            "time": moving[-1] - moving[0],
            "defects": len(defects),
            "motion": sum(defect["quantity"] in MOTION for defect in defects),
            "mismatch": sizes[int(0.95 * len(sizes))] if sizes else 0.0,
        }


def repair(bench, program):
    """The report of optimize, and what the kernel's logs say before and after; after is None if nothing was accepted."""
    promised, better = bench.repaired(program)
    before = bench.judged(program)
    return promised, before, bench.judged(better) if promised["accepted"] else None


def arrow(before, after, form):
    return "%s → %s" % (form % before, form % after)


def row_text(program, promised, before, after):
    motion = [sum(promised["defects_by_quantity"][quantity][side] for quantity in MOTION) for side in (0, 1)]
    cells = [program.stem,
             arrow(promised["mismatch_before"], promised["mismatch_after"], "%.0f"),
             arrow(before["mismatch"], after["mismatch"], "%.0f") if after else "%.0f" % before["mismatch"],
             arrow(promised["defects_before"], promised["defects_after"], "%d"),
             arrow(before["defects"], after["defects"], "%d") if after else "%d" % before["defects"],
             arrow(motion[0], motion[1], "%d"),
             arrow(before["motion"], after["motion"], "%d") if after else "%d" % before["motion"],
             arrow(promised["time_before_s"], promised["time_after_s"], "%.2f"),
             arrow(before["time"], after["time"], "%.2f") if after else "%.2f" % before["time"],
             "" if after else "refused: " + promised["reason"]]
    return "| " + " | ".join(cells) + " |"


def main():
    words = sys.argv[1:]
    if len(words) < 2:
        sys.exit(__doc__)
    configuration = [word for word in words[2:] if word.endswith(".ini")]
    programs = [pathlib.Path(word) for word in words[2:] if not word.endswith(".ini")]
    bench = Bench(words[0], pathlib.Path(words[1]), configuration)
    print("| part | speed mismatch (95 %), mm/min: promised | kept | defects: promised | kept | of motion: promised | kept "
          "| time, s: promised | kept | |")
    print("|" + "---|" * 10)
    broken = 0
    for program in programs or [DATA / name for name in PARTS]:
        promised, before, after = repair(bench, program)
        print(row_text(program, promised, before, after), flush=True)
        broken += after is not None and (after["defects"] > before["defects"] or after["time"] > before["time"])
    return 1 if broken else 0


sys.exit(main())
