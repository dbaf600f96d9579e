"""Calls that make parts, and compare them."""

from __future__ import annotations

import json
import os
from typing import Any, Dict, Iterable, NamedTuple, Optional, Sequence

from . import _clsurf
from .part import Part, Path, options_of


def simulate(
    program: Path,
    machine: Optional[Path] = None,
    *,
    tool: Optional[str] = None,
    start: Sequence[float] = (0.0, 0.0, 0.0),
    dialect: Optional[str] = None,
    tools: Optional[Path] = None,
    block_delete: bool = True,
    work_offset: Optional[Sequence[float]] = None,
) -> Part:
    """Runs a program on a simulated machine and returns the run as a part. Its `simulation` has the summary.

    Args:
        program: the NC program.
        machine: machine file. Default: the machine of `clsurf machine --defaults`.
        tool, dialect, tools, block_delete: as those of `Part`.
        start: where the axes stand before the program [mm].
        work_offset: for machines with rotary axes, the position of the program's zero with both angles zero [mm].
    """
    options = options_of(program, None, machine=machine, tool=tool, dialect=dialect, tools=tools, block_delete=block_delete, work_offset=work_offset)
    x, y, z = (float(value) for value in start)
    return Part._of(_clsurf.simulate(options, (x, y, z)))


class IdentifiedMachine(NamedTuple):
    """What `identify` finds."""

    report: Dict[str, Any]
    """The keys of `clsurf identify --json`: `parameters`, `rules`, `fit`, `unidentified` …."""
    text: str
    """A machine file (TOML): write it to a file, and name that as `machine`."""


def identify(parts: Iterable[Part], machine: Optional[Path] = None, tests: Iterable[Part] = ()) -> IdentifiedMachine:
    """Fits a machine to recorded runs: servo loops, limits, rules of the planner.

    Args:
        parts: recorded runs.
        machine: machine file with what is known already.
        tests: runs that are not used for the fit, but compared with their simulation.

    Raises:
        InputError: nothing can be identified, or the periods of the runs differ.
    """
    report, text = _clsurf.identify(
        [part._native for part in parts],
        [part._native for part in tests],
        "" if machine is None else os.fspath(machine),
    )
    return IdentifiedMachine(json.loads(report), text)


def diff(reference: Part, *others: Part) -> Dict[str, Any]:
    """Compares runs of a part with the first one, by path: the keys of `clsurf diff --json`.

    `runs` has for each other part the sections where speed, acceleration, lag or height differ: other minus reference.

    Raises:
        InputError: no piece of a run lies on the path of the reference.
    """
    return json.loads(_clsurf.diff([reference._native, *(other._native for other in others)]))
