#!/usr/bin/env python3
"""Writes samples of controls' text formats from a recorded log, so that each reader has a whole run
whose lines are known: make_scope_samples.py dome_loops.halsampler.txt data/logs

The motion is recorded; the form follows docs/formats/scopes.md and csv.md.
"""
import lzma
import os
import sys


def write(folder, name, lines):
    with lzma.open(os.path.join(folder, name + ".xz"), "wt", preset=9, newline="") as f:
        f.writelines(lines)


def halscope(rows):
    pins = [f"joint.{j}.motor-pos-{w}" for w in ("cmd", "fb") for j in range(3)] + ["motion.program-line"]
    yield "# Sampling period is 1000000 ns\n" + ";".join(pins) + "\n# Position: " + ";".join(["0.500000"] * 7) + "\n# Scale: " + ";".join(["0"] * 7) + "\n"
    for r in rows:
        yield ";".join(f"{v:+.6f}" for v in r) + "\n"


def twincat(rows):
    names = ["cmd.x", "cmd.y", "cmd.z", "fb.x", "fb.y", "fb.z"]
    yield "Name\tdome_loops\nFile\tdome_loops.csv\nStarttime of export\t132959733843760000\tMonday, 2 May 2022\t15:56:24.376\nEndtime of export\t132959733853750000\tMonday, 2 May 2022\t15:56:25.375\n\n\n"
    def header(key, fast, slow):
        return "\t".join([key] + fast + [key, slow]) + "\n"
    yield header("Name", names, "line") + header("SampleTime[ms]", ["1"] * 6, "4") + header("SymbolName", ["GVL." + n for n in names], "GVL.line") + header("Unit", ["mm (Length)"] * 6, "(None)") + "\n"
    slow = rows[::4]
    for i, r in enumerate(rows):
        fast = [str(i)] + [f"{v:.6f}".replace(".", ",") for v in r[:6]]
        yield "\t".join(fast + ([str(4 * i), f"{slow[i][6]:.0f}"] if i < len(slow) else ["", ""])) + "\n"
    yield "EOF\n"


def trace(rows):
    names = [f"/Nck/!SEMA/cmdContrPos [u1, {a}]" for a in (1, 2, 3)] + [f"/Nck/!SD/nckServoDataActPos1stEnc64 [u1, {a}]" for a in (1, 2, 3)] + ["/Channel/ProgramInfo/actLineNumber"]
    yield '<?xml version="1.0" encoding="UTF-8"?>\n<traceSession version="2.0">\n<traceData dataFrames="1">\n<dataFrame>\n<frameHeader startTime="2022-05-02T13:56:24" stopInc="18.530" dropOuts="0"/>\n'
    for i, name in enumerate(names):
        yield f'<dataSignal id="f{i + 1}" name="{name}" description="" interval="0.001" datapointCount="{len(rows)}"/>\n'
    before = [None] * 7
    for i, r in enumerate(rows):
        now = [f"{v:.6f}" for v in r[:6]] + [f"{r[6]:.0f}"]
        yield f'<rec time="{i / 1000:.3f}"' + "".join(f' f{k + 1}="{v}"' for k, v in enumerate(now) if v != before[k]) + "/>\n"
        before = now
    yield "</dataFrame>\n</traceData>\n</traceSession>\n"


def signals(rows):
    yield "Time;" + ";".join(f"DES_POS|{a}" for a in (1, 2, 3)) + ";" + ";".join(f"ENC_POS|{a}" for a in (1, 2, 3)) + "\n"
    for i, r in enumerate(rows):
        yield f"{i * 0.001:.3f};" + ";".join(f"{float(v):.6f}" for v in r[:6]) + "\n"


def events(rows):
    yield "Time;Line\n"
    before = None
    for i, r in enumerate(rows):
        if r[6] != before:
            yield f"{i * 0.001:.3f};{float(r[6]):.0f}\n"
        before = r[6]


def main():
    text, folder = sys.argv[1:]
    with open(text) as f:
        # Sample number, commanded, feedback, line, …: dome_loops.mapping.toml
        rows = [[float(v) for v in line.split()[1:8]] for line in f if not line.startswith("overrun")]
    write(folder, "dome_loops.halscope.csv", halscope(rows))
    write(folder, "dome_loops.twincat.csv", twincat(rows))
    write(folder, "dome_loops.trace.xml", trace(rows))
    write(folder, "dome_loops.signals.csv", signals(rows))
    write(folder, "dome_loops.events.csv", events(rows))


main()
