#!/usr/bin/env python3
"""Writes one map of heights as surface data files in all variants of ISO 25178-71 and its relatives, and the map as text.

An independent writer for the reader's test: Python's struct, from the table of fields in the standard (version 8
bytes, manufacturer 10, two dates of 12, numbers of points and profiles, four scales as doubles, compression, type, check).

    make_surface_data.py FOLDER

writes FOLDER/<name>.sdf, and FOLDER/expected.txt with a line for each file: name, columns, rows, missing, the sum of the
heights [mm] and the sum of each height times its number.
"""
import math
import struct
import sys

COLUMNS, ROWS = 7, 5
X_SCALE, Y_SCALE, Z_SCALE = 2.5e-6, 4e-6, 1e-9
TYPES = {0: "B", 1: "H", 2: "I", 3: "f", 4: "b", 5: "h", 6: "i", 7: "d"}
MARKS = {1: 2**16 - 1, 2: 2**32 - 1, 4: -(2**7), 5: -(2**15), 6: -(2**31)}


def heights(kind: int) -> list[float]:
    """Numbers that each type can hold; NaN at two places, where the type has a way to say so."""
    z = [float(k * 37 % 101) - (50 if kind > 2 else 0) + (0.25 if kind in (3, 7) else 0) for k in range(COLUMNS * ROWS)]
    if kind != 0:
        z[4] = z[20] = math.nan
    return z


def as_stored(z: list[float], kind: int, order: str) -> bytes:
    whole = kind not in (3, 7)
    stored = [MARKS.get(kind, v) if math.isnan(v) else int(v) if whole else v for v in z]
    return struct.pack(f"{order}{len(stored)}{TYPES[kind]}", *stored)


def binary(z: list[float], version: str, kind: int, order: str = "<", added: bytes = b"") -> bytes:
    counts = "II" if version == "ISO-2.0" else "HH"
    head = struct.pack(
        f"{order}8s10s12s12s{counts}4d3B", b"b" + version.encode(), b"WRITER", b"251120260000", b"251120260000",
        COLUMNS, ROWS, X_SCALE, Y_SCALE, Z_SCALE, -1.0, 0, kind, 0)
    return head + added + as_stored(z, kind, order)


def text(z: list[float], version: str, kind: int, *, bad: str = "BAD", end: str = "\r\n", comma: bool = False,
         comments: bool = False, per_line: int = COLUMNS) -> bytes:
    def number(value: float) -> str:
        words = f"{value:.10g}"
        return words.replace(".", ",") if comma else words

    lines = [f"a{version}", "ManufacID = WRITER", "CreateDate = 251120260000", "ModDate = 251120260000",
             f"NumPoints = {COLUMNS}", f"NumProfiles = {ROWS}",
             *(f"{name} = {value:.3e}".replace(".", "," if comma else ".")
               for name, value in (("Xscale", X_SCALE), ("Yscale", Y_SCALE), ("Zscale", Z_SCALE))),
             "Zresolution = -1", "Compression = 0", f"DataType = {kind}", "CheckType = 0"]
    if comments:
        lines = [line + " ; said by the writer" for line in lines[:1]] + ["; of its own"] + lines[1:]
    fields = [bad if math.isnan(v) else number(v) for v in z]
    rows = [" ".join(fields[k:k + per_line]) for k in range(0, len(fields), per_line)]
    if comments:
        rows = [row + " ; heights" for row in rows]
    return end.join([*lines, "*", *rows, "*", "<Note>trailer</Note>", "*", ""]).encode()


def files() -> dict[str, tuple[bytes, list[float]]]:
    made = {}
    for version in ("ISO-1.0", "ISO-2.0", "BCR-1.0"):
        for kind in TYPES:
            z = heights(kind)
            made[f"binary_{version}_{kind}"] = (binary(z, version, kind), z)
            made[f"turned_{version}_{kind}"] = (binary(z, version, kind, ">"), z)
    z = heights(6)
    made["added_fields"] = (binary(z, "ISO-1.0", 6, added=struct.pack("<II", 5, 1)), z)
    real = heights(7)
    for version in ("ISO-1.0", "ISO-2.0", "BCR-1.0", "NIST-1.0", "NPL-V1.0"):
        made[f"text_{version}"] = (text(real, version, 7), real)
    made["text_integers"] = (text(z, "ISO-1.0", 6, bad=str(MARKS[6])), z)
    made["text_nan"] = (text(real, "ISO-1.0", 7, bad="NaN", end="\n", per_line=1), real)
    made["text_one_line"] = (text(real, "ISO-1.0", 7, per_line=1000), real)
    made["text_comma"] = (text(real, "BCR-1.0", 7, comma=True), real)
    made["text_comments"] = (text(real, "ISO-1.0", 7, comments=True), real)
    return made


def main(folder: str) -> None:
    with open(f"{folder}/expected.txt", "w", encoding="utf-8") as expected:
        for name, (content, z) in files().items():
            with open(f"{folder}/{name}.sdf", "wb") as out:
                out.write(content)
            mm = [0.0 if math.isnan(v) else v * Z_SCALE * 1e3 for v in z]
            expected.write(f"{name} {COLUMNS} {ROWS} {sum(map(math.isnan, z))} {sum(mm):.17g} "
                           f"{sum(k * v for k, v in enumerate(mm)):.17g}\n")


if __name__ == "__main__":
    main(sys.argv[1])
