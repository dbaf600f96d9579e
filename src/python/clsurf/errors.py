"""What clsurf raises. All of it is an `Error`; `MemoryError` and `KeyboardInterrupt` are Python's own."""

from __future__ import annotations

from typing import Optional


class Error(Exception):
    """Base of all errors of clsurf."""


class InputError(Error, ValueError):
    """A file that cannot be used, or a log of another program.

    `str(error)` is the whole message, with file, place and hint.

    Attributes:
        text: what was found and what was expected, one sentence.
        hint: what to do; may be empty.
        file: the file, as it was named; empty if the error is of no file.
        line: line of the file, from 1, or None.
        column: column of the line, in bytes from 1, or None.
        point: point of the log, from 0, or None.
        byte: byte of the file, from 0, or None.
    """

    def __init__(
        self,
        message: str,
        text: str = "",
        hint: str = "",
        file: str = "",
        line: Optional[int] = None,
        column: Optional[int] = None,
        point: Optional[int] = None,
        byte: Optional[int] = None,
    ) -> None:
        super().__init__(message)
        self.text = text
        self.hint = hint
        self.file = file
        self.line = line
        self.column = column
        self.point = point
        self.byte = byte


class UsageError(Error, ValueError):
    """Arguments that make no sense: an unknown field, a point that the log does not have.

    Attributes:
        hint: what to do; may be empty.
    """

    def __init__(self, message: str, hint: str = "") -> None:
        super().__init__(f"{message} ({hint})" if hint else message)
        self.hint = hint


class SystemError(Error, OSError):  # noqa: A001 - the name of the library's own
    """A system failure: disk, memory, graphics."""
