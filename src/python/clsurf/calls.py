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
    options = options_of(
        program,
        None,
        machine=machine,
        tool=tool,
        dialect=dialect,
        tools=tools,
        block_delete=block_delete,
        work_offset=work_offset,
    )
    x, y, z = (float(value) for value in start)
    return Part._of(_clsurf.simulate(options, (x, y, z)))


class Tradeoff(NamedTuple):
    """What `tradeoff` finds."""

    report: Dict[str, Any]
    """The keys of `clsurf simulate --tradeoff front.json`: `rows`, `weight`, `chosen`."""
    machine: Optional[str]
    """The machine file (TOML) of the chosen settings; None without a weight."""


def tradeoff(
    program: Path,
    machine: Optional[Path] = None,
    *,
    weight: Optional[float] = None,
    more_time_percent: float = 50.0,
    runs: int = 48,
    start: Sequence[float] = (0.0, 0.0, 0.0),
    dialect: Optional[str] = None,
    tools: Optional[Path] = None,
    block_delete: bool = True,
    work_offset: Optional[Sequence[float]] = None,
) -> Tradeoff:
    """Simulates a program at many settings of its machine: the Pareto front of time, mismatch between adjacent passes, and jerk.

    Args:
        program: the NC program.
        machine: machine file. Default: the machine of `clsurf machine --defaults`.
        weight: chooses from the front: 0 time alone, 1 surface alone.
        more_time_percent: settings that take longer than this are left out.
        runs: largest number of settings that are simulated.
        start, dialect, tools, block_delete, work_offset: as those of `simulate`.

    Raises:
        InputError: the program cannot be run, or has no adjacent passes.
    """
    options = options_of(
        program,
        None,
        machine=machine,
        dialect=dialect,
        tools=tools,
        block_delete=block_delete,
        work_offset=work_offset,
    )
    wanted = _clsurf.TradeoffOptions()
    x, y, z = (float(value) for value in start)
    wanted.start = (x, y, z)
    wanted.more_time_percent = more_time_percent
    wanted.runs = runs
    wanted.weight = weight
    report, text = _clsurf.tradeoff(options, wanted)
    return Tradeoff(json.loads(report), text or None)


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


class OptimizedProgram(NamedTuple):
    """What `optimize` makes."""

    report: Dict[str, Any]
    """The keys of `clsurf optimize --json`: `accepted`, `reason`, `time_before_s`, `time_after_s` …; and `tradeoff`, if asked for."""
    text: Optional[str]
    """The new program; None if none was accepted."""


def optimize(
    program: Path,
    machine: Optional[Path] = None,
    log: Optional[Path] = None,
    *,
    tool: Optional[str] = None,
    tolerance: float = 0.005,
    more_time_percent: float = 0.0,
    machines: int = 4,
    decimals: int = 0,
    feeds: str = "searched",
    tradeoff: bool = False,
    weight: Optional[float] = None,
    dialect: Optional[str] = None,
    tools: Optional[Path] = None,
    block_delete: bool = True,
    layout: Optional[Path] = None,
    mapping: Optional[Path] = None,
    period: Optional[float] = None,
    work_offset: Optional[Sequence[float]] = None,
) -> OptimizedProgram:
    """Makes a smoother program within a tolerance, verified by simulation.

    Args:
        program: the NC program.
        machine: machine file. Without it, and with a log, the machine is fitted to the log.
        log: a recorded run: only places that differ from adjacent passes there are repaired.
        tool: the new program must not leave a rougher surface. Default: from the log or from `tools`.
        tolerance: largest distance from the programmed path [mm].
        more_time_percent: additional machining time that is allowed for fewer defects.
        machines: other machines that the new program must be better on.
        decimals: smallest number of decimals of new coordinates; 0: as in the program.
        feeds: `"searched"` or `"intervals"`, the speeds of constant-speed intervals.
        tradeoff: the report gets the front of all acceptable candidates, with the keys of `clsurf optimize --tradeoff front.json`.
        weight: chooses from this front instead of the objective: 0 time alone, 1 surface alone. Implies `tradeoff`.
        dialect, tools, block_delete, layout, mapping, period, work_offset: as those of `Part`.

    Raises:
        InputError: the program cannot be run, or has no adjacent passes.
    """
    options = options_of(
        program, log, tool=tool, machine=machine, dialect=dialect, tools=tools, block_delete=block_delete,
        layout=layout, mapping=mapping, period=period, work_offset=work_offset,
    )
    repair = _clsurf.RepairOptions()
    repair.tolerance = tolerance
    repair.more_time_percent = more_time_percent
    repair.machines = machines
    repair.decimals = decimals
    repair.feeds = feeds
    repair.tradeoff = tradeoff
    repair.weight = weight
    return _repaired(options, repair)


def _repaired(options: _clsurf.PartOptions, repair: _clsurf.RepairOptions) -> OptimizedProgram:
    """Runs the repair; its report as dictionaries."""
    made = _clsurf.optimize(options, repair)
    report = json.loads(made.report)
    if made.front:
        report["tradeoff"] = json.loads(made.front)
    return OptimizedProgram(report, made.text or None)


def diff(reference: Part, *others: Part) -> Dict[str, Any]:
    """Compares runs of a part with the first one, by path: the keys of `clsurf diff --json`.

    `runs` has for each other part the sections where speed, acceleration, lag or height differ: other minus reference.

    Raises:
        InputError: no piece of a run lies on the path of the reference.
    """
    return json.loads(_clsurf.diff([reference._native, *(other._native for other in others)]))
