"""Exceptions: all of them are a :class:`PulvisError`."""

from __future__ import annotations

__all__ = ["InputError", "InternalError", "PulvisError", "RunError", "ViewError"]


def checked_threads(threads: int | None) -> int | None:
    """A number of threads, or ``None`` for as many as there is work for."""
    if threads is not None and (isinstance(threads, bool) or not hasattr(threads, "__index__") or threads < 1):
        raise InputError(f"threads: found {threads!r}, expected a whole number of at least 1", key="threads")
    return threads


class PulvisError(Exception):
    """Whatever Pulvis refuses or cannot do."""


class InputError(PulvisError, ValueError):
    """Something that was asked for is wrong; nothing was computed.

    The text is that of the command line: line, key, what was found, what was expected, what helps; of several mistakes
    all.

    Attributes
    ----------
    file : str or None
        The file, or a name in angle brackets of what was not one, such as ``<collide>``.
    line : int or None
        Line of the first mistake, from 1.
    key : str or None
        Dotted key of the first mistake, such as ``contact.normal.kp``.
    """

    def __init__(
        self, text: str, file: str | None = None, line: int | None = None, key: str | None = None
    ) -> None:
        super().__init__(text)
        self.file = file
        self.line = line
        self.key = key


class RunError(PulvisError, RuntimeError):
    """Something went wrong while computing."""


class ViewError(PulvisError, BufferError):
    """Steps are refused while arrays look at the columns of particles."""


class InternalError(PulvisError):
    """A mistake in Pulvis itself."""
