# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""AURORA as a library: what the `aurora` command does, as functions with typed results.

    import aurora
    answer = aurora.check('A drone hovers over City Hall at 50 m for 20 seconds.')
    done = aurora.run('A drone hovers over City Hall at 50 m for 20 seconds.')
    again = aurora.verify(done.folder)

Nothing is printed, no signal is caught, no process ends; what breaks raises `AuroraError`. See
docs/library.md.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from aurora.session import Session, check, parse, run, verify
    from aurora_cli.answers import Run
    from aurora_core.errors import AuroraError
    from aurora_core.execution.faults import Fault
    from aurora_core.pipeline.stages import RunControl

__all__ = [
    'AuroraError',
    'Fault',
    'Run',
    'RunControl',
    'Session',
    'check',
    'parse',
    'run',
    'verify',
]

# Imported when first asked for: `import aurora` alone costs nothing.
_ELSEWHERE = {
    'AuroraError': 'aurora_core.errors',
    'Fault': 'aurora_core.execution.faults',
    'Run': 'aurora_cli.answers',
    'RunControl': 'aurora_core.pipeline.stages',
}


def __getattr__(name: str) -> Any:
    if name not in __all__:
        raise AttributeError(f'module {__name__!r} has no attribute {name!r}')
    value = getattr(import_module(_ELSEWHERE.get(name, 'aurora.session')), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
