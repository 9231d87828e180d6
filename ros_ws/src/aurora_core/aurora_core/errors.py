# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The one error tree: an exception is a broken contract, never an ordinary outcome.

Wire codes come in blocks of 100 per stage; ROS results and `report.json` carry the same number.
"""

from __future__ import annotations

import errno
from typing import ClassVar

_NO_MEMORY = ('failed to map segment', 'cannot allocate memory')


class AuroraError(Exception):
    """Something broke: what was expected, what was found, where, and what to do.

    Args:
        message: Expected, found, where, in one sentence.
        hint: What the user can do about it.
        component: Part that failed (node or layer name); the class default is used when omitted.
        code: Wire code; the class default is used when omitted.
    """

    default_code: ClassVar[int] = 1
    default_component: ClassVar[str] = 'aurora'

    def __init__(
        self,
        message: str,
        *,
        hint: str = '',
        component: str | None = None,
        code: int | None = None,
    ) -> None:
        super().__init__(message)
        self.message = message
        self.hint = hint
        self.component = component if component is not None else self.default_component
        self.code = code if code is not None else self.default_code

    def __str__(self) -> str:
        return f'{self.message} ({self.hint})' if self.hint else self.message


class ConfigError(AuroraError):
    """A file of the configuration is missing, damaged or out of its schema."""

    default_code = 100
    default_component = 'config'


class MapError(ConfigError):
    """A map is missing or its files are not what they were measured on."""

    default_code = 110
    default_component = 'map'


class PromptError(AuroraError):
    """A prompt that cannot be read at all (not UTF-8, NUL, too long, empty)."""

    default_code = 200
    default_component = 'parser'


class SpecError(AuroraError):
    """A specification that contradicts its own schema or references."""

    default_code = 210
    default_component = 'parser'


class SimulatorError(AuroraError):
    """A simulator refused, failed or fell silent."""

    default_code = 400
    default_component = 'simulator'


class GroundSimulatorError(SimulatorError):
    """SUMO refused a placement or a command, or failed."""

    default_code = 410
    default_component = 'sumo_bridge'


class AirSimulatorError(SimulatorError):
    """The multirotor simulator refused, failed or fell silent."""

    default_code = 420
    default_component = 'uav_bridge'


class ExecutionError(AuroraError):
    """The managed executor or the lockstep broke."""

    default_code = 500
    default_component = 'executor'


class ParticipantSilentError(ExecutionError):
    """A participant of the lockstep did not finish its tick in time."""

    default_code = 510
    default_component = 'sync'


class BagError(AuroraError):
    """A bag that cannot be written or read."""

    default_code = 600
    default_component = 'recorder'


class VerificationError(AuroraError):
    """The monitor was given what it cannot judge (not: a condition that fails)."""

    default_code = 700
    default_component = 'monitor'


class ReportError(AuroraError):
    """The run folder or the report cannot be written."""

    default_code = 800
    default_component = 'report'


def hint_for(err: BaseException) -> str:
    """Return what to do about an exception that is none of ours: not all are defects."""
    return hint_of_limits(err) or 'this is a defect of AURORA: please report it'


def hint_of_limits(err: BaseException) -> str:
    """Return what to do where the system has given too little of something, else ''."""
    number = err.errno if isinstance(err, OSError) else None
    told = str(err).lower()
    # A library that finds no room when it is loaded says so in an ImportError.
    if isinstance(err, MemoryError) or any(text in told for text in _NO_MEMORY):
        return 'this process gets no more memory: end other programs, or raise ulimit -v'
    if number in (errno.EMFILE, errno.ENFILE):
        return 'no more files may be open: raise ulimit -n'
    if number in (errno.ENOSPC, errno.EDQUOT, errno.EFBIG):
        return 'free some room on the disk, raise ulimit -f, or write elsewhere with --out'
    return ''


def error_class(code: int) -> type[AuroraError]:
    """Return the class with this wire code, else the one that opens its block of 100."""
    # Only classes of this file: what a process happens to import must not change the outcome.
    by_code = {kind.default_code: kind for kind in reversed(_tree(AuroraError))}
    return by_code.get(code) or by_code.get(code - code % 100) or AuroraError


def _tree(kind: type[AuroraError]) -> list[type[AuroraError]]:
    ours = (child for child in kind.__subclasses__() if child.__module__ == __name__)
    return [kind, *(below for child in ours for below in _tree(child))]
