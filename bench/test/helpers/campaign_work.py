# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Cheap runs for tests of campaigns; in a module that the workers can import."""

from __future__ import annotations

import os
import signal
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from aurora_bench.campaign.plan import Plan, Task
from aurora_bench.campaign.record import CampaignRun, Ending, identity
from aurora_core.outcomes.verdict import VerdictStatus


@dataclass(kw_only=True)
class CheapWork:
    """Judges by the prompt's words, without any run.

    Attributes:
        marks: Folder for what happened once: who finds its mark does not do it again.
    """

    marks: Path

    def prepare(self) -> None:
        """Nothing is loaded."""

    def __call__(self, task: Task) -> CampaignRun:
        """Return a run that passes unless the prompt says otherwise."""
        text = task.trial.prompt.prompt
        mark = self.marks / task.key.replace(':', '_')
        if 'always' in text or ('once' in text and not mark.exists()):
            mark.touch()
            os.kill(os.getpid(), signal.SIGKILL)
        verdict = VerdictStatus.VIOLATED if 'fails' in text else VerdictStatus.VERIFIED
        values: dict[str, Any] = {
            **identity(task),
            'status': verdict.value,
            'ending': Ending.COMPLETED,
            'first': verdict,
            'final': verdict,
            'margin': 0.1 + task.trial.seed,
            'seconds': {'all': float(os.getpid())},
        }
        return CampaignRun(**values)


def cheap(plan: Plan, _folder: Path) -> CheapWork:
    """Return the work of a plan; marks lie beside the first prompt file."""
    return CheapWork(marks=Path(plan.prompts[0]).parent)
