# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What a worker does with a candidate: the local engine executes it, its bag goes back."""

from __future__ import annotations

import os
import tempfile
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path

from aurora_cli.installed import installed
from aurora_cli.local_engine import ENGINE, LocalStages
from aurora_core.errors import ConfigError
from aurora_core.pipeline.beside import Candidate, Recorded
from aurora_core.pipeline.stages import RunControl
from aurora_core.report.run_folder import RunFolder

_PREFIX = 'aurora_beside_'
_MAP = 'downtown'


@dataclass(frozen=True)
class Executing:
    """Executes candidates.

    Attributes:
        owner: Process whose death ends an execution; None where it is on another machine.
    """

    owner: int | None = None

    def prepare(self) -> None:
        """Load what every execution needs."""
        for name in ENGINE:
            import_module(name)
        installed().parts(_MAP)

    def __call__(self, candidate: Candidate) -> Recorded:
        """Execute one.

        Raises:
            AuroraError: What is installed here would give another trace, or something broke.
        """
        known, graph = installed(), candidate.graph
        if known.basis != candidate.basis:
            raise ConfigError(
                'a worker has another version or configuration than the run',
                hint='give all machines the same version and configuration folder',
            )
        if known.map(graph.map_name).digest != graph.map_digest:
            raise ConfigError(f'a worker has another map {graph.map_name} than the run')
        control = RunControl(cancelled=self._is_orphaned)
        with tempfile.TemporaryDirectory(prefix=f'{_PREFIX}{self.owner or os.getpid()}_') as name:
            bag = RunFolder(Path(name), candidate.run_id).bag_path(graph.iteration)
            result = LocalStages(known).execute(graph, bag, candidate.request, control)
            files = {path.name: path.read_bytes() for path in bag.iterdir()}
        return Recorded(result=result, files=files)

    def _is_orphaned(self) -> bool:
        return self.owner is not None and os.getppid() != self.owner


def leftovers(owner: int) -> list[Path]:
    """Return the folders that workers of a process have left when they were ended."""
    return sorted(Path(tempfile.gettempdir()).glob(f'{_PREFIX}{owner}_*'))
