"""clsurf shows before the cut which NC lines and controller behaviour will mark a freeform part.

    import clsurf

    part = clsurf.Part("part.nc", "run.biip", tool="ball:6")
    part.defects()          # a pandas DataFrame, as `clsurf check` lists them
    part.field("speed")     # a NumPy array [mm/min], one value a logged point
    part.picture()          # a map, shown by a notebook

Lengths are in mm, times in s, speeds in mm/min, accelerations in mm/s², angles in deg; depths and errors in µm.
"""

from ._clsurf import version as __version__
from .calls import IdentifiedMachine, OptimizedProgram, Tradeoff, diff, identify, optimize, simulate, tradeoff
from .errors import Error, InputError, SystemError, UsageError
from .part import Part, Picture
from .surface import Surface

__all__ = [
    "Error",
    "IdentifiedMachine",
    "InputError",
    "OptimizedProgram",
    "Part",
    "Picture",
    "Surface",
    "SystemError",
    "Tradeoff",
    "UsageError",
    "diff",
    "identify",
    "optimize",
    "simulate",
    "tradeoff",
]
